// Coordinates of the joints that close loops, against differences along closed motions.
#include "core/kinematics/cut_joint.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>

#include "core/kinematics/assembly.h"
#include "core/kinematics/scaled_closures.h"
#include "core/spatial/euler_parameters.h"
#include "tests/mechanisms/random_linkages.h"
#include "tests/support/near.h"

namespace linkstudy::testing::cut_joint_test {
namespace {

using Eigen::Vector4d;
using Eigen::VectorXd;

VectorXd to_vector(const std::vector<double>& x) {
  return Eigen::Map<const VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
}

// A motion of a closed random linkage: out of its start with its velocities, and accelerations that
// the closure allows.
class Moving {
 public:
  Moving(std::uint64_t seed, JointType type)
      : closed_(compile_closed(random_closed_linkage(seed, type, ClosureModel::cut))),
        joint_(cut_joint_of(closed_.mechanism, ClosureIndex(0))),
        scale_(find_closure_scale(closed_, closed_.start)) {
    const ScaledClosures c = compute_scaled_closures(closed_, scale_, closed_.start);
    const VectorXd free = VectorXd::LinSpaced(closed_.mechanism.nv, -1.0, 1.5);
    const VectorXd wrong = c.jacobian * free.cwiseQuotient(scale_.velocity) + c.bias;
    const VectorXd mended = c.jacobian.completeOrthogonalDecomposition().solve(-wrong);
    qdd_ = free + scale_.velocity.cwiseProduct(mended);
  }

  const CutJoint& joint() const { return joint_; }
  CutJointMotion motion() const {
    const State<double>& s = closed_.start;
    return cut_joint_motions(closed_.mechanism, closed_.parameters, s.q.data(), s.v.data(),
                             qdd_.data())
        .front();
  }

  // Coordinates of the closure at a time near 0, continued from those at 0.
  VectorXd position(double t) const {
    State<double> s = displaced(closed_.mechanism, closed_.start,
                                t * to_vector(closed_.start.v) + 0.5 * t * t * qdd_);
    EXPECT_LT(close_from(closed_, scale_, s), 1e-12);
    const VectorXd v = VectorXd::Zero(closed_.mechanism.nv);
    VectorXd q =
        cut_joint_motions(closed_.mechanism, closed_.parameters, s.q.data(), v.data(), v.data())
            .front()
            .position;
    continue_position(joint_, motion().position, q);
    return q;
  }

  // First and second derivative of the coordinates at 0, of fourth order.
  VectorXd rate() const {
    const auto d = [&](double h) -> VectorXd { return (position(h) - position(-h)) / (2 * h); };
    return (4.0 * d(0.5 * kStep) - d(kStep)) / 3.0;
  }
  VectorXd second_rate() const {
    const auto d = [&](double h) -> VectorXd {
      return (position(h) + position(-h) - 2.0 * position(0.0)) / (h * h);
    };
    return (4.0 * d(0.5 * kStep) - d(kStep)) / 3.0;
  }

 private:
  static constexpr double kStep = 0.01;
  Model closed_;
  CutJoint joint_;
  ClosureScale scale_;
  VectorXd qdd_;
};

// e o (0, w)
Vector4d turning(const Vector4d& e, const Eigen::Vector3d& w) {
  return compose(e, {0.0, w.x(), w.y(), w.z()});
}

constexpr std::uint64_t kSeeds = 15;

TEST(CutJoint, Rates_are_the_derivatives_of_its_coordinates) {
  for (const JointType type : {JointType::revolute, JointType::prismatic, JointType::cylindrical,
                               JointType::universal, JointType::planar}) {
    for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
      SCOPED_TRACE(::testing::Message() << static_cast<int>(type) << " seed " << seed);
      const Moving linkage(seed, type);
      const CutJointMotion motion = linkage.motion();
      const double fast = 1.0 + motion.velocity.squaredNorm() + motion.acceleration.norm();
      EXPECT_TRUE(near_absolute(motion.velocity, linkage.rate(), 1e-6 * fast));
      EXPECT_TRUE(near_absolute(motion.acceleration, linkage.second_rate(), 1e-5 * fast));
    }
  }
}

TEST(CutJoint, Of_a_ball_turns_its_Euler_parameters) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    const Moving linkage(seed, JointType::spherical);
    const CutJointMotion m = linkage.motion();
    const Vector4d e = m.position, rate = 0.5 * turning(e, m.velocity);
    const Vector4d second = 0.5 * (turning(rate, m.velocity) + turning(e, m.acceleration));
    const double fast = 1.0 + m.velocity.squaredNorm() + m.acceleration.norm();
    EXPECT_TRUE(near_absolute(rate, linkage.rate(), 1e-6 * fast));
    EXPECT_TRUE(near_absolute(second, linkage.second_rate(), 1e-5 * fast));
  }
}

TEST(CutJoint, Has_the_freedoms_of_its_type) {
  const std::tuple<JointType, int, int> known[] = {
      {JointType::fixed, 0, 0},       {JointType::revolute, 1, 1},  {JointType::prismatic, 1, 1},
      {JointType::cylindrical, 2, 2}, {JointType::universal, 2, 2}, {JointType::planar, 3, 3},
      {JointType::spherical, 4, 3}};
  for (const auto& [type, positions, velocities] : known) {
    const CutJoint joint = Moving(1, type).joint();
    EXPECT_EQ(joint.position_count(), positions);
    EXPECT_EQ(joint.velocity_count(), velocities);
  }
}

// Its own motion takes {1,e} to {2,e}, and its twists are the differences of moved frames.
TEST(CutJoint, Moves_one_frame_to_the_other) {
  for (const JointType type :
       {JointType::fixed, JointType::revolute, JointType::prismatic, JointType::cylindrical,
        JointType::universal, JointType::planar, JointType::spherical}) {
    SCOPED_TRACE(static_cast<int>(type));
    const CutJoint joint = Moving(2, type).joint();
    ClosureFrame first;
    first.rotation = direction_cosines(Vector4d(0.4, -0.3, 0.7, 0.5).normalized());
    first.position = {0.3, -0.2, 0.9};
    VectorXd q = VectorXd::LinSpaced(joint.position_count(), 0.7, -0.4);
    if (joint.turns == 3) q.tail<4>().normalize();
    const ClosureFrame second = moved_by(joint, q, first);
    EXPECT_TRUE(near_absolute(cut_joint_position(joint, first, second), q, 1e-14));
    const Eigen::MatrixXd twists = cut_joint_twists(joint, first, second);
    ASSERT_EQ(twists.cols(), joint.velocity_count());
    for (int k = 0; k < joint.velocity_count(); ++k) {
      const double h = 1e-6;
      VectorXd step =
          VectorXd::Unit(joint.position_count(), std::min<int>(k, joint.position_count() - 1));
      const int ball = k - static_cast<int>(joint.shifts.size());
      if (joint.turns == 3 && ball >= 0) {
        step.setZero();
        step.tail<4>() = 0.5 * turning(q.tail<4>(), Eigen::Vector3d::Unit(ball));
      }
      const ClosureFrame up = moved_by(joint, q + h * step, first);
      const ClosureFrame down = moved_by(joint, q - h * step, first);
      const Eigen::Matrix3d spin =
          (up.rotation - down.rotation) / (2 * h) * second.rotation.transpose();
      EXPECT_TRUE(near_absolute(Eigen::Vector3d(spin(2, 1), spin(0, 2), spin(1, 0)),
                                twists.col(k).head<3>(), 1e-9));
      EXPECT_TRUE(
          near_absolute((up.position - down.position) / (2 * h), twists.col(k).tail<3>(), 1e-9));
    }
  }
}

}  // namespace
}  // namespace linkstudy::testing::cut_joint_test
