// Motion of chosen points against closed forms, the recursion of the free-body oracle, differences.
#include "core/kinematics/point_motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/model/compile.h"
#include "core/spatial/to_eigen.h"
#include "tests/mechanisms/pendulum.h"
#include "tests/mechanisms/random_linkages.h"
#include "tests/support/free_bodies.h"
#include "tests/support/near.h"
#include "tests/support/random.h"

namespace linkstudy::testing::point_motion_test {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using Motions = std::vector<linkstudy::PointMotion>;

Motions motions_at(const Model& model, const VectorXd& q, const VectorXd& v, const VectorXd& a) {
  return point_motions(model.mechanism, model.parameters, q.data(), v.data(), a.data());
}

VectorXd to_vector(const std::vector<double>& x) {
  return Eigen::Map<const VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
}

// A random tree with a point somewhere on ground and on every link.
Linkage watched_tree(std::uint64_t seed) {
  RandomTree options;
  options.shuffled = false;  // joints in tree order, as link_motions wants them
  Linkage linkage = random_tree(seed, options);
  Random random(seed + 50);
  linkage.points = {{"still", kGround, random.vector(3, 1.0)}};
  for (const Link& link : linkage.links) {
    linkage.points.push_back({link.name, link.name, random.vector(3, 1.0)});
  }
  return linkage;
}

}  // namespace

TEST(PointMotion, Of_a_pendulum_s_tip_is_that_of_a_point_on_a_circle) {
  const double length = 0.7;
  Linkage linkage = pendulum(1.0, length);
  linkage.points = {{"tip", "rod", Vector3d(length, 0, 0)}};
  const Model model = compile(linkage);
  Random random(3);
  for (int i = 0; i < 20; ++i) {
    const VectorXd q = random.vector(1, 3.0), v = random.vector(1, 5.0), a = random.vector(1, 9.0);
    const Vector3d outward(std::cos(q[0]), std::sin(q[0]), 0);
    const Vector3d along(-std::sin(q[0]), std::cos(q[0]), 0);
    const linkstudy::PointMotion tip = motions_at(model, q, v, a).front();
    EXPECT_TRUE(near_absolute(to_eigen(tip.position), length * outward, 1e-15));
    EXPECT_TRUE(near_absolute(to_eigen(tip.velocity), length * v[0] * along, 1e-14));
    EXPECT_TRUE(near_absolute(to_eigen(tip.acceleration),
                              length * (a[0] * along - v[0] * v[0] * outward), 1e-13));
  }
}

TEST(PointMotion, Agrees_with_the_motion_of_links_for_all_joint_types) {
  for (std::uint64_t seed = 0; seed < 25; ++seed) {
    const Linkage linkage = watched_tree(seed);
    const Model model = compile(linkage);
    const VectorXd q = to_vector(model.start.q), v = to_vector(model.start.v);
    const VectorXd a = Random(seed).vector(v.size(), 2.0);
    const auto links = link_motions(linkage, q, v, a);
    const Motions points = motions_at(model, q, v, a);
    ASSERT_EQ(points.size(), linkage.points.size());
    for (std::size_t i = 1; i < points.size(); ++i) {
      const LinkMotion& link = motion_of(links, linkage.points[i].link);
      const testing::PointMotion expected = point_motion(link, linkage.points[i].position);
      const double size = 1.0 + expected.a.norm();
      EXPECT_TRUE(near_absolute(to_eigen(points[i].position), expected.p, 1e-12 * size)) << seed;
      EXPECT_TRUE(near_absolute(to_eigen(points[i].velocity), expected.v, 1e-12 * size)) << seed;
      EXPECT_TRUE(near_absolute(to_eigen(points[i].acceleration), expected.a, 1e-12 * size))
          << seed;
      // The same as a vector in the link's frame: p' = v + omega x r.
      const Vector3d r = link.R * linkage.points[i].position;
      EXPECT_TRUE(
          near_absolute(to_eigen(points[i].velocity), link.v + link.omega.cross(r), 1e-12 * size));
    }
  }
}

TEST(PointMotion, Of_a_point_on_ground_is_none) {
  const Linkage linkage = watched_tree(4);
  const Model model = compile(linkage);
  const VectorXd v = to_vector(model.start.v);
  const linkstudy::PointMotion still = motions_at(model, to_vector(model.start.q), v, v).front();
  EXPECT_TRUE(near_absolute(to_eigen(still.position), linkage.points[0].position, 0.0));
  EXPECT_TRUE(near_absolute(to_eigen(still.velocity), Vector3d::Zero(), 0.0));
  EXPECT_TRUE(near_absolute(to_eigen(still.acceleration), Vector3d::Zero(), 0.0));
}

// On a course of constant accelerations, where coordinates and velocities are of one kind.
TEST(PointMotion, Velocities_and_accelerations_are_differences_of_positions) {
  constexpr double h = 1e-4;  // s
  int tried = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Linkage linkage = watched_tree(seed);
    const Model model = compile(linkage);
    if (model.mechanism.nq != model.mechanism.nv) continue;
    ++tried;
    const VectorXd q = to_vector(model.start.q), v = to_vector(model.start.v);
    const VectorXd a = Random(seed).vector(v.size(), 2.0);
    const auto at_time = [&](double t) {
      return motions_at(model, q + t * v + 0.5 * t * t * a, v + t * a, a);
    };
    const Motions before = at_time(-h), now = at_time(0.0), after = at_time(h);
    for (std::size_t i = 0; i < now.size(); ++i) {
      const Vector3d p0 = to_eigen(before[i].position), p1 = to_eigen(after[i].position);
      const Vector3d p = to_eigen(now[i].position);
      const double size = 1.0 + to_eigen(now[i].acceleration).norm();
      EXPECT_TRUE(near_absolute((p1 - p0) / (2 * h), to_eigen(now[i].velocity), 1e-6 * size));
      EXPECT_TRUE(
          near_absolute((p1 - 2 * p + p0) / (h * h), to_eigen(now[i].acceleration), 1e-6 * size));
    }
  }
  EXPECT_GT(tried, 5);
}

}  // namespace linkstudy::testing::point_motion_test
