// Flexible links: uniform beams pass however they lie in their link, others are told what they
// lack.
#include "core/topology/check_flexible.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>

#include "core/topology/check_linkage.h"

namespace linkstudy::check_flexible_test {
namespace {

using Eigen::Vector3d;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// A rod of 1.5 kg and 0.5 m along a direction, steel of 20 mm diameter.
Link steel_rod(const Vector3d& direction = Vector3d::UnitY()) {
  const Vector3d e = direction.normalized();
  const Vector3d begin(0.1, -0.2, 0.3);
  const double across = 1.5 * 0.25 / 12.0;
  Link link;
  link.name = "coupler";
  link.mass = 1.5;
  link.center_of_mass = begin + 0.25 * e;
  link.inertia = across * Eigen::Matrix3d::Identity() + (1e-4 - across) * e * e.transpose();
  link.flexible = FlexibleBeam{.segments = 4,
                               .begin = begin,
                               .end = begin + 0.5 * e,
                               .across = Vector3d(1, 0.2, -0.1),
                               .young = 2.07e11,
                               .shear = 8e10,
                               .second_moment_y = 7.85e-9,
                               .second_moment_z = 7.85e-9,
                               .torsion_constant = 1.57e-8,
                               .position = {},
                               .velocity = {}};
  return link;
}

std::vector<Problem> problems_of(const Link& link) {
  std::vector<Problem> problems;
  check_flexible(link, "link.coupler", problems);
  return problems;
}

std::vector<std::string> paths_with(const std::function<void(Link&)>& change) {
  Link link = steel_rod();
  change(link);
  std::vector<std::string> result;
  for (const Problem& problem : problems_of(link)) {
    EXPECT_FALSE(problem.remedy.empty()) << problem.message;
    EXPECT_THAT(problem.message, HasSubstr("link 'coupler': "));
    result.push_back(problem.path);
  }
  return result;
}

TEST(CheckFlexible, A_uniform_rod_is_right_in_any_direction_of_its_link) {
  for (const Vector3d& direction :
       {Vector3d(0, 1, 0), Vector3d(1, 2, 3), Vector3d(-1, 0.5, -0.2), Vector3d(0, 0, -1)}) {
    EXPECT_THAT(problems_of(steel_rod(direction)), IsEmpty()) << direction.transpose();
  }
}

TEST(CheckFlexible, Moments_beyond_those_of_a_thin_rod_belong_to_the_section) {
  EXPECT_THAT(paths_with([](Link& link) { link.inertia += 0.01 * Eigen::Matrix3d::Identity(); }),
              IsEmpty());
}

TEST(CheckFlexible, Numbers_of_the_section_are_positive_and_located) {
  EXPECT_THAT(
      paths_with([](Link& link) {
        FlexibleBeam& b = *link.flexible;
        b.young = b.shear = b.second_moment_y = b.second_moment_z = 0.0;
        b.torsion_constant = b.retardation = -1.0;
        b.segments = 0;
      }),
      ElementsAre("link.coupler.flexible.segments", "link.coupler.flexible.young",
                  "link.coupler.flexible.shear", "link.coupler.flexible.section.second_moment_y",
                  "link.coupler.flexible.section.second_moment_z",
                  "link.coupler.flexible.section.torsion_constant",
                  "link.coupler.flexible.retardation"));
  EXPECT_THAT(paths_with([](Link& link) { link.flexible->segments = 1000000; }),
              ElementsAre("link.coupler.flexible.segments"));
}

TEST(CheckFlexible, A_beam_has_two_ends_and_a_direction_across) {
  EXPECT_THAT(paths_with([](Link& link) { link.flexible->end = link.flexible->begin; }),
              ElementsAre("link.coupler.flexible.end"));
  EXPECT_THAT(paths_with([](Link& link) { link.flexible->across = Vector3d(0, -3, 0); }),
              ElementsAre("link.coupler.flexible.across"));
  EXPECT_THAT(paths_with([](Link& link) { link.flexible->across.setZero(); }),
              ElementsAre("link.coupler.flexible.across"));
  EXPECT_THAT(paths_with([](Link& link) { link.flexible->begin[0] = std::nan(""); }),
              ElementsAre("link.coupler.flexible.begin"));
}

TEST(CheckFlexible, A_centre_off_the_middle_is_told_where_the_middle_is) {
  EXPECT_THAT(paths_with([](Link& link) { link.center_of_mass[1] += 1e-5; }),
              ElementsAre("link.coupler.center_of_mass"));
  Link link = steel_rod();
  link.center_of_mass = Vector3d(0.1, 0, 0.3);
  EXPECT_THAT(problems_of(link)[0].message, HasSubstr("the middle [0.1, 0.05, 0.3]"));
  EXPECT_THAT(problems_of(link)[0].message, HasSubstr("got [0.1, 0, 0.3]"));
}

TEST(CheckFlexible, A_moment_below_that_of_a_thin_rod_is_told_the_least) {
  EXPECT_THAT(paths_with([](Link& link) { link.inertia(0, 0) -= 1e-6; }),
              ElementsAre("link.coupler.inertia"));
  Link link = steel_rod();
  link.inertia(0, 0) = link.inertia(2, 2) = 0.03;
  ASSERT_EQ(problems_of(link).size(), 1u);
  EXPECT_THAT(problems_of(link)[0].message, HasSubstr("0.03125 kg m^2 across its axis, got 0.03"));
}

TEST(CheckFlexible, The_axis_of_the_beam_is_a_principal_axis) {
  EXPECT_THAT(paths_with([](Link& link) { link.inertia(0, 1) = link.inertia(1, 0) = 1e-5; }),
              ElementsAre("link.coupler.inertia"));
  EXPECT_THAT(paths_with([](Link& link) {
                link.inertia(0, 0) += 0.01;
                link.inertia(2, 2) += 0.01;
                link.inertia(0, 2) = link.inertia(2, 0) = 0.005;  // of the section: any
              }),
              IsEmpty());
}

TEST(CheckFlexible, A_link_that_is_no_body_is_not_reported_again_as_no_beam) {
  EXPECT_THAT(paths_with([](Link& link) { link.mass = -1.0; }), IsEmpty());
  EXPECT_THAT(paths_with([](Link& link) { link.inertia.setZero(); }), IsEmpty());
}

Linkage rod_on_ground() {
  Linkage linkage;
  linkage.links = {steel_rod()};
  Joint joint;
  joint.name = "A";
  joint.parent = kGround;
  joint.child = "coupler";
  linkage.joints = {joint};
  return linkage;
}

TEST(CheckFlexible, It_is_part_of_the_check_of_a_linkage) {
  Linkage linkage = rod_on_ground();
  EXPECT_THAT(check(linkage), IsEmpty());
  linkage.links[0].flexible->young = -1.0;
  ASSERT_EQ(check(linkage).size(), 1u);
  EXPECT_EQ(check(linkage)[0].path, "link.coupler.flexible.young");
}

TEST(CheckFlexible, Names_of_the_parts_are_nobody_else_s) {
  Linkage linkage = rod_on_ground();
  const auto add = [&](const std::string& link, const std::string& joint) {
    linkage.links.push_back(steel_rod());
    linkage.links.back().name = link;
    linkage.links.back().flexible.reset();
    linkage.joints.push_back(linkage.joints[0]);
    linkage.joints.back().name = joint;
    linkage.joints.back().child = link;
  };
  add("coupler_rfe5", "coupler_sde5");  // 4 segments: elements 0 to 4, joints 1 to 4
  add("coupler_sde1", "coupler_rfe0");  // names of links and of joints do not mix
  add("a", "coupler_sde0");
  EXPECT_THAT(check(linkage), IsEmpty());
  add("coupler_rfe4", "B");
  add("b", "coupler_sde4");
  const std::vector<Problem> problems = check(linkage);
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_EQ(problems[0].path, "link.4.name");
  EXPECT_EQ(problems[1].path, "joint.5.name");
  EXPECT_THAT(problems[0].message,
              HasSubstr("'coupler_rfe4' is that of a part of the flexible link 'coupler'"));
}

}  // namespace
}  // namespace linkstudy::check_flexible_test
