// Rotation vectors against turns about known axes, and their gradient against finite differences.
#include "core/spatial/rotation_vector.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/spatial/to_eigen.h"
#include "tests/support/near.h"
#include "tests/support/random.h"

namespace linkstudy::testing::rotation_vector_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Vec3<double> plain(const Vector3d& a) {
  return {a.x(), a.y(), a.z()};
}
Mat3<double> plain(const Matrix3d& m) {
  return {plain(Vector3d(m.col(0))), plain(Vector3d(m.col(1))), plain(Vector3d(m.col(2)))};
}

Vector3d direction(Random& random) {
  return Vector3d(random.within(1.0), random.within(1.0), random.within(1.0)).normalized();
}

Matrix3d turned(const Vector3d& phi) {
  return Eigen::AngleAxisd(phi.norm(), phi.normalized()).toRotationMatrix();
}

}  // namespace

TEST(RotationVector, Any_turn_short_of_half_a_turn_is_found_again) {
  Random random(1);
  for (const double angle : {1e-12, 1e-6, 0.01, 0.8, 1.5, 2.5, 3.1, M_PI - 1e-6, M_PI - 1e-9}) {
    for (int k = 0; k < 200; ++k) {
      const Matrix3d base = turned(2.0 * direction(random));
      const Vector3d phi = angle * direction(random);
      const RotationVector<double> r =
          rotation_vector(plain(base), plain(Matrix3d(base * turned(phi))));
      // The matrices round by some 1e-16 an entry, each turn by as much.
      EXPECT_TRUE(near_absolute(to_eigen(r.phi), phi, 3e-15)) << angle;
    }
  }
}

TEST(RotationVector, Without_a_turn_it_is_zero_with_the_gradient_of_the_axes) {
  const RotationVector<double> r = rotation_vector(identity3<double>(), identity3<double>());
  EXPECT_EQ(to_eigen(r.phi), Vector3d::Zero());
  for (int i = 0; i < 3; ++i) {
    const Vector3d e = Vector3d::Unit(i);
    EXPECT_EQ(to_eigen(rotation_vector_gradient(r, plain(e))), e);
  }
}

TEST(RotationVector, Half_a_turn_has_the_length_pi_about_its_axis) {
  Random random(2);
  for (int k = 0; k < 100; ++k) {
    const Vector3d n = k < 3 ? Vector3d(Vector3d::Unit(k)) : direction(random);
    const Matrix3d half = 2.0 * n * n.transpose() - Matrix3d::Identity();
    const Vector3d phi = to_eigen(rotation_vector(identity3<double>(), plain(half)).phi);
    EXPECT_NEAR(phi.norm(), M_PI, 1e-15 * M_PI * 4);
    EXPECT_NEAR(std::abs(phi.dot(n)), M_PI, 1e-14);
  }
}

TEST(RotationVector, Its_gradient_is_that_of_finite_differences_and_along_itself_it_is_the_turn) {
  Random random(3);
  const double h = 1e-6;  // central differences: 1e-12 truncation, 1e-9 rounding near pi
  for (const double angle : {1e-3, 0.7, 1.6, 2.6, 3.1}) {
    for (int k = 0; k < 20; ++k) {
      const Vector3d phi = angle * direction(random);
      const Matrix3d here = turned(phi);
      const RotationVector<double> r = rotation_vector(identity3<double>(), plain(here));
      const auto at = [&](const Vector3d& turn) {
        const Matrix3d moved = turned(turn) * here;
        return to_eigen(rotation_vector(identity3<double>(), plain(moved)).phi);
      };
      Matrix3d t;
      for (int i = 0; i < 3; ++i) {
        t.row(i) = to_eigen(rotation_vector_gradient(r, plain(Vector3d(Vector3d::Unit(i)))));
      }
      for (int i = 0; i < 3; ++i) {
        const Vector3d slope = (at(h * Vector3d::Unit(i)) - at(-h * Vector3d::Unit(i))) / (2 * h);
        EXPECT_TRUE(near_absolute(t.col(i), slope, 2e-9)) << angle;
      }
      EXPECT_TRUE(near_absolute(t.transpose() * phi, phi, 1e-14));
    }
  }
}

}  // namespace linkstudy::testing::rotation_vector_test
