// Values of clearance and of friction: what has a meaning passes, what has none is located.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "core/topology/check_values.h"

namespace linkstudy::check_contact_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Table 1 of [AugUrb18].
Friction document_friction() {
  return {0.2, 0.1, 0.0175, 600.0, std::sqrt(600.0), 0.0, 0.0};
}

Closure document_closure() {
  Closure closure;
  closure.name = "R";
  closure.type = JointType::revolute;
  closure.first.link = "coupler";
  closure.second.link = "yoke";
  closure.model = ClosureModel::clearance;
  closure.clearance.radial = 1e-3;
  closure.clearance.bearing_radius = 5e-3;
  closure.clearance.length = 20e-3;
  closure.clearance.friction = document_friction();
  return closure;
}

Joint rubbing_joint(JointType type) {
  Joint joint;
  joint.name = "A";
  joint.type = type;
  joint.parent = kGround;
  joint.child = "crank";
  joint.friction = JointFriction{document_friction(), FrictionLoad::reaction, 10e-3, 30e-3, 5.0};
  return joint;
}

std::vector<std::string> paths(const std::vector<Problem>& problems) {
  std::vector<std::string> result;
  for (const Problem& problem : problems) {
    EXPECT_FALSE(problem.remedy.empty()) << problem.message;
    result.push_back(problem.path);
  }
  return result;
}

std::vector<Problem> problems_of(const Closure& closure) {
  std::vector<Problem> problems;
  check_closure(closure, "closure." + closure.name, problems);
  return problems;
}

std::vector<Problem> problems_of(const Joint& joint) {
  std::vector<Problem> problems;
  check_joint(joint, "joint." + joint.name, problems);
  return problems;
}

// The document's closure with one thing changed.
std::vector<std::string> paths_with(const std::function<void(Clearance&)>& change) {
  Closure closure = document_closure();
  change(closure.clearance);
  return paths(problems_of(closure));
}

TEST(CheckClearance, The_document_s_bearing_is_right_planar_and_spatial_for_every_law) {
  for (const auto kind : {ClearanceKind::planar, ClearanceKind::spatial}) {
    for (const auto law :
         {ContactLaw::lankarani_nikravesh, ContactLaw::flores, ContactLaw::hunt_crossley}) {
      EXPECT_THAT(paths_with([&](Clearance& c) {
                    c.kind = kind;
                    c.law = law;
                  }),
                  IsEmpty());
    }
  }
}

TEST(CheckClearance, Only_a_revolute_closure_has_it) {
  Closure closure = document_closure();
  for (const JointType type : {JointType::spherical, JointType::cylindrical, JointType::fixed}) {
    closure.type = type;
    EXPECT_THAT(paths(problems_of(closure)), ElementsAre("closure.R.type"));
  }
}

TEST(CheckClearance, Other_closures_may_carry_its_values_unused) {
  Closure closure = document_closure();
  closure.clearance.radial = -1.0;
  for (const auto model : {ClosureModel::cut, ClosureModel::sde}) {
    closure.model = model;
    closure.sde.stiffness = {1, 1, 1, 0, 1, 1};
    EXPECT_THAT(problems_of(closure), IsEmpty());
  }
}

TEST(CheckClearance, The_journal_fits_into_the_bearing) {
  EXPECT_THAT(paths_with([](Clearance& c) { c.bearing_radius = 1e-3; }),
              ElementsAre("closure.R.clearance.bearing_radius"));
  EXPECT_THAT(paths_with([](Clearance& c) { c.bearing_radius = std::nan(""); }),
              ElementsAre("closure.R.clearance.bearing_radius"));
  Closure closure = document_closure();
  closure.clearance.bearing_radius = 0.9e-3;
  EXPECT_THAT(problems_of(closure)[0].message, HasSubstr("clearance.radial = 0.001, got 0.0009"));
}

TEST(CheckClearance, Radii_are_needed_for_friction_and_for_stiffness_from_materials_only) {
  const auto without_radius = [](bool number, bool friction) {
    return paths_with([&](Clearance& c) {
      c.bearing_radius = 0.0;
      if (number) c.stiffness = 1e10;
      if (!friction) c.friction.reset();
    });
  };
  EXPECT_THAT(without_radius(true, false), IsEmpty());
  EXPECT_THAT(without_radius(true, true), ElementsAre("closure.R.clearance.bearing_radius"));
  EXPECT_THAT(without_radius(false, false), ElementsAre("closure.R.clearance.bearing_radius"));
}

TEST(CheckClearance, A_fit_without_play_needs_a_stiffness_that_is_not_from_its_radii) {
  EXPECT_THAT(paths_with([](Clearance& c) { c.radial = 0.0; }),
              ElementsAre("closure.R.clearance.radial"));
  EXPECT_THAT(paths_with([](Clearance& c) {
                c.radial = 0.0;
                c.stiffness = 1e10;
              }),
              IsEmpty());
  EXPECT_THAT(paths_with([](Clearance& c) {
                c.radial = -1e-4;
                c.stiffness = 1e10;
              }),
              ElementsAre("closure.R.clearance.radial"));
}

TEST(CheckClearance, A_spatial_bearing_has_a_length) {
  EXPECT_THAT(paths_with([](Clearance& c) { c.length = 0.0; }), IsEmpty());
  EXPECT_THAT(paths_with([](Clearance& c) {
                c.length = 0.0;
                c.kind = ClearanceKind::spatial;
              }),
              ElementsAre("closure.R.clearance.length"));
}

TEST(CheckClearance, Contact_values_are_those_of_a_contact) {
  EXPECT_THAT(paths_with([](Clearance& c) {
                c.restitution = 0.0;
                c.exponent = 0.9;
                c.least_speed = 0.0;
                c.stiffness = 0.0;
              }),
              ElementsAre("closure.R.contact.restitution", "closure.R.contact.exponent",
                          "closure.R.contact.least_speed", "closure.R.contact.stiffness"));
  EXPECT_THAT(paths_with([](Clearance& c) { c.restitution = 1.01; }),
              ElementsAre("closure.R.contact.restitution"));
  EXPECT_THAT(paths_with([](Clearance& c) {
                c.restitution = 1.0;
                c.exponent = 1.0;
                c.stiffness = 1e7;
              }),
              IsEmpty());
  EXPECT_THAT(paths_with([](Clearance& c) { c.exponent = 1.4; }),
              ElementsAre("closure.R.contact.exponent"));
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THAT(paths_with([&](Clearance& c) {
                c.bearing = {0.0, 0.6};
                c.journal = {infinity, -1.0};
              }),
              ElementsAre("closure.R.contact.bearing.young", "closure.R.contact.bearing.poisson",
                          "closure.R.contact.journal.young", "closure.R.contact.journal.poisson"));
}

TEST(CheckFriction, Every_value_of_the_law_is_located) {
  EXPECT_THAT(paths_with([](Clearance& c) {
                c.friction = Friction{-1.0, 0.0, 0.0, 0.0, -1.0, -1.0, -1.0};
              }),
              ElementsAre("closure.R.friction.mu_k", "closure.R.friction.mu_s",
                          "closure.R.friction.stribeck_speed", "closure.R.friction.sigma0",
                          "closure.R.friction.sigma1", "closure.R.friction.sigma2",
                          "closure.R.friction.damping_speed"));
}

TEST(CheckFriction, Static_friction_is_not_below_kinetic) {
  EXPECT_THAT(paths_with([](Clearance& c) { c.friction->mu_s = 0.1; }), IsEmpty());
  EXPECT_THAT(paths_with([](Clearance& c) { c.friction->mu_s = 0.09; }),
              ElementsAre("closure.R.friction.mu_s"));
}

TEST(CheckFriction, A_bristle_relaxes_in_a_time_or_not_at_all) {
  EXPECT_THAT(paths_with([](Clearance& c) { c.free_bristle = FreeBristle::relax; }), IsEmpty());
  EXPECT_THAT(paths_with([](Clearance& c) {
                c.free_bristle = FreeBristle::relax;
                c.friction->sigma1 = 0.0;
              }),
              ElementsAre("closure.R.contact.free_bristle"));
}

TEST(CheckFriction, Joints_that_rub_are_revolute_prismatic_or_cylindrical) {
  for (const auto type : {JointType::revolute, JointType::prismatic, JointType::cylindrical}) {
    EXPECT_THAT(problems_of(rubbing_joint(type)), IsEmpty());
  }
  for (const auto type : {JointType::universal, JointType::spherical, JointType::fixed}) {
    EXPECT_THAT(paths(problems_of(rubbing_joint(type))), ElementsAre("joint.A.friction"));
  }
}

TEST(CheckFriction, A_surface_that_turns_has_a_radius_and_one_that_slides_may) {
  for (const auto type : {JointType::revolute, JointType::prismatic, JointType::cylindrical}) {
    Joint joint = rubbing_joint(type);
    joint.friction->radius = 0.0;
    if (type == JointType::prismatic) {
      EXPECT_THAT(problems_of(joint), IsEmpty());
    } else {
      EXPECT_THAT(paths(problems_of(joint)), ElementsAre("joint.A.friction.radius"));
    }
    joint.friction->radius = joint.friction->length = joint.friction->preload = -1.0;
    joint.friction->law.mu_s = 0.05;
    EXPECT_THAT(paths(problems_of(joint)),
                ElementsAre("joint.A.friction.mu_s", "joint.A.friction.radius",
                            "joint.A.friction.length", "joint.A.friction.preload"));
  }
}

}  // namespace
}  // namespace linkstudy::check_contact_test
