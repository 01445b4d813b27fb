// Against turns about known axes (Rodrigues' formula), matrix products, and the quaternions of the
// step loop.
#include "core/spatial/euler_parameters.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "core/kinematics/joint_kinematics.h"
#include "tests/support/near.h"
#include "tests/support/random.h"

namespace linkstudy::testing::euler_parameters_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Matrix4d;
using Eigen::Vector3d;
using Eigen::Vector4d;

constexpr double kRounding = 2e-15;

Matrix3d cross_matrix(const Vector3d& n) {
  Matrix3d N;
  N << 0.0, -n.z(), n.y(), n.z(), 0.0, -n.x(), -n.y(), n.x(), 0.0;
  return N;
}

// Rodrigues' formula. A turn just short of half a turn is given by what it lacks: pi is no double.
Matrix3d turn(const Vector3d& n, double sine, double cosine) {
  return cosine * Matrix3d::Identity() + sine * cross_matrix(n) +
         (1.0 - cosine) * n * n.transpose();
}
Matrix3d turn(const Vector3d& n, double angle) {
  return turn(n, std::sin(angle), std::cos(angle));
}
Matrix3d half_turn(const Vector3d& n, double short_of) {
  return turn(n, std::sin(short_of), -std::cos(short_of));
}

Vector4d expected(const Vector3d& n, double half_cosine, double half_sine) {
  Vector4d e;
  e << half_cosine, half_sine * n;
  return e;
}

Vector3d axis(Random& random) {
  for (;;) {
    const Vector3d n = random.vector(3, 1.0);
    if (n.norm() > 0.1) return n.normalized();
  }
}

// Coordinate axes, diagonals of faces and of the cube (ties between parts), and any.
std::vector<Vector3d> axes() {
  std::vector<Vector3d> all;
  for (int i = 0; i < 27; ++i) {
    const Vector3d n(i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1);
    if (n.norm() > 0.0) all.push_back(n.normalized());
  }
  Random random(5);
  for (int i = 0; i < 500; ++i) all.push_back(axis(random));
  return all;
}

double up_to_sign(const Vector4d& a, const Vector4d& b) {
  return std::min((a - b).norm(), (a + b).norm());
}

Matrix4d rigid(Random& random) {
  Matrix4d T = Matrix4d::Identity();
  const Vector3d n = axis(random);
  T.topLeftCorner<3, 3>() = turn(n, random.within(M_PI));
  T.topRightCorner<3, 1>() = random.vector(3, 2.0);
  return T;
}

}  // namespace

TEST(EulerParameters, Are_cosine_and_sine_of_half_the_turn_about_its_axis) {
  Random random(1);
  for (int i = 0; i < 20000; ++i) {
    const Vector3d n = axis(random);
    const double angle = random.within(M_PI);
    const Vector4d e = euler_parameters(turn(n, angle));
    ASSERT_LT(up_to_sign(e, expected(n, std::cos(angle / 2), std::sin(angle / 2))), kRounding);
    ASSERT_NEAR(e.norm(), 1.0, kRounding);
    ASSERT_GE(e[0], 0.0);
  }
}

TEST(EulerParameters, Give_the_direction_cosines_back_in_every_orientation) {
  Random random(2);
  for (int i = 0; i < 20000; ++i) {
    const Matrix3d S = turn(axis(random), random.within(M_PI)) * turn(axis(random), M_PI);
    ASSERT_TRUE(near_absolute(direction_cosines(euler_parameters(S)), S, kRounding)) << i;
  }
}

TEST(EulerParameters, Lose_nothing_at_and_near_half_turns) {
  for (const Vector3d& n : axes()) {
    for (const double short_of : {0.0, 1e-300, 1e-16, 1e-12, 1e-8, -1e-8, 1e-5, -1e-3}) {
      const Matrix3d S = half_turn(n, short_of);
      const Vector4d e = euler_parameters(S);
      ASSERT_LT(up_to_sign(e, expected(n, std::sin(short_of / 2), std::cos(short_of / 2))),
                kRounding)
          << n.transpose() << " short of a half turn by " << short_of;
      ASSERT_TRUE(near_absolute(direction_cosines(e), S, kRounding)) << n.transpose();
    }
  }
}

TEST(EulerParameters, Of_a_small_turn_keep_all_their_digits) {
  for (const Vector3d& n : axes()) {
    for (const double angle : {1e-3, 1e-8, 1e-12, 1e-100}) {
      // The part of second order in the angle is below the rounding of 1 from 1e-8 on.
      const Matrix3d S = Matrix3d::Identity() + angle * cross_matrix(n);
      const Vector4d e = euler_parameters(angle < 1e-4 ? S : turn(n, angle));
      ASSERT_LT((e.tail<3>() - std::sin(angle / 2) * n).norm(), kRounding * angle) << angle;
    }
  }
}

TEST(EulerParameters, Have_a_first_part_that_is_positive) {
  EXPECT_EQ(euler_parameters(Matrix3d::Identity()), Vector4d(1, 0, 0, 0));
  for (int i = 0; i < 3; ++i) {
    Matrix3d S = -Matrix3d::Identity();
    S(i, i) = 1.0;
    EXPECT_EQ(euler_parameters(S), Vector4d::Unit(i + 1));
  }
  const Vector4d e = euler_parameters(half_turn(Vector3d(-3, 4, 0) / 5, 0.0));
  EXPECT_TRUE(near_absolute(e, Vector4d(0.0, 0.6, -0.8, 0.0), kRounding));
}

TEST(EulerParameters, Of_any_length_give_a_rotation) {
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const Vector4d e = random.vector(4, 1.0) + 0.01 * Vector4d::Ones();
    const Matrix3d S = direction_cosines(e);
    ASSERT_TRUE(near_absolute(S * S.transpose(), Matrix3d::Identity(), kRounding));
    ASSERT_NEAR(S.determinant(), 1.0, kRounding);
    ASSERT_LT(up_to_sign(euler_parameters(S), e.normalized()), kRounding);
  }
}

TEST(EulerParameters, Compose_as_matrices_multiply) {
  Random random(4);
  for (int i = 0; i < 5000; ++i) {
    const Matrix3d a = turn(axis(random), random.within(M_PI));
    const Matrix3d b = turn(axis(random), random.within(M_PI));
    const Vector4d e = compose(euler_parameters(a), euler_parameters(b));
    ASSERT_TRUE(near_absolute(direction_cosines(e), a * b, kRounding));
    ASSERT_LT(up_to_sign(e, euler_parameters(a * b)), kRounding);
  }
}

TEST(EulerParameters, Are_the_positions_of_quaternion_joints) {
  Random random(6);
  for (int i = 0; i < 1000; ++i) {
    const Vector3d n = axis(random);
    const Matrix3d S = turn(n, random.within(M_PI));
    const Mat3<double> r = rotation_of(euler_parameters(S).data());
    Matrix3d R;
    R << r.x.x, r.y.x, r.z.x, r.x.y, r.y.y, r.z.y, r.x.z, r.y.z, r.z.z;
    ASSERT_TRUE(near_absolute(R, S, kRounding));
  }
}

TEST(ShortenedDualQuaternion, Gives_the_transform_back) {
  Random random(7);
  for (int i = 0; i < 5000; ++i) {
    const Matrix4d T = rigid(random);
    const ShortenedDualQuaternion E = shortened_dual_quaternion(T);
    ASSERT_EQ(E.r, Vector3d(T.topRightCorner<3, 1>()));
    ASSERT_TRUE(near_absolute(homogeneous_matrix(E), T, kRounding));
  }
}

TEST(ShortenedDualQuaternion, Composes_as_transforms_multiply) {
  Random random(8);
  for (int i = 0; i < 5000; ++i) {
    const Matrix4d ab = rigid(random), bc = rigid(random);
    const ShortenedDualQuaternion E =
        compose(shortened_dual_quaternion(ab), shortened_dual_quaternion(bc));
    ASSERT_TRUE(near_absolute(homogeneous_matrix(E), ab * bc, 2 * kRounding));
    ASSERT_GE(E.e[0], 0.0);
  }
}

TEST(ShortenedDualQuaternion, And_its_inverse_compose_to_rest) {
  Random random(9);
  for (int i = 0; i < 5000; ++i) {
    const Matrix4d T = rigid(random);
    const ShortenedDualQuaternion back = inverse(shortened_dual_quaternion(T));
    ASSERT_TRUE(near_absolute(homogeneous_matrix(back) * T, Matrix4d::Identity(), 2 * kRounding));
    const ShortenedDualQuaternion rest = compose(back, shortened_dual_quaternion(T));
    ASSERT_TRUE(near_absolute(rest.e, Vector4d(1, 0, 0, 0), kRounding));
    ASSERT_LT(rest.r.norm(), 2 * kRounding);
  }
}

}  // namespace linkstudy::testing::euler_parameters_test
