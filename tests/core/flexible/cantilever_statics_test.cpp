// Statics of flexible links against beam theory. With n segments the deflection under a force at
// the tip is short of it by 1 / (4 n^2), all other values below are exact for every n.
#include <gtest/gtest.h>

#include <cmath>

#include "core/dynamics/statics.h"
#include "core/flexible/rigid_finite_elements.h"
#include "tests/mechanisms/cantilever.h"
#include "tests/support/engine_probe.h"
#include "tests/support/trace_kinematics.h"

namespace linkstudy::testing::cantilever_statics_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Where a point of the beam goes, and how far its element turns.
struct Bent {
  Vector3d shift;  // m
  Vector3d turn;   // rotation vector, small, or about one axis only
};

Load end_load(LoadType type, const Vector3d& direction, double value, double at) {
  Load load;
  load.name = "load";
  load.type = type;
  load.link = "beam";
  load.point = Vector3d(at, 0, 0);
  load.direction = direction;
  load.course.shape = CourseShape::constant;
  load.course.value = value;
  return load;
}

Vector3d rotation_vector(const Matrix3d& r) {
  const Vector3d axis(r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1));  // 2 sin
  const double sine = 0.5 * axis.norm();
  return sine > 0.0 ? Vector3d(axis.normalized() * std::atan2(sine, 0.5 * (r.trace() - 1.0)))
                    : Vector3d(Vector3d::Zero());
}

// Equilibrium of the engine, read by the transforms of the oracle; the load's element is the one
// that is measured, at the load's point.
Bent bend(Linkage linkage, const Load& load) {
  linkage.loads = {load};
  const Linkage expanded = expand_flexible_links(linkage);
  const Model model = compile(expanded);
  State<double> s = model.start;
  const StaticsReport report = solve_statics(model, s);
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.stability, Stability::stable);
  const TraceModel trace = make_trace_model(expanded);
  const std::vector<int> order = oracle_coordinates(model.mechanism, trace);
  Vector q(trace.dof);
  for (std::size_t k = 0; k < order.size(); ++k) q[order[k]] = s.q[PositionIndex(k)];
  const auto transforms = link_transforms(trace, q);
  const int element = link_index(trace, expanded.loads[0].link);
  const Matrix3d turned = transforms[static_cast<std::size_t>(element)].T.topLeftCorner<3, 3>();
  return {point_position(trace, transforms, element, load.point) - load.point,
          rotation_vector(turned)};
}

const BeamData kBeam;
const double kLength = kBeam.length;
// Loads that turn the tip by some 1e-4 rad: what is not linear stays below 1e-8.
const double kForce = 0.2, kMoment = 0.1;
const double kSmall = 1e-7;

double shortfall(int n) {
  return 1.0 - 1.0 / (4.0 * n * n);
}

}  // namespace

TEST(CantileverStatics, A_force_at_the_tip_deflects_it_as_beam_theory_says_less_the_known_factor) {
  for (int n = 1; n <= 8; ++n) {
    const Bent y = bend(cantilever(kBeam, n),
                        end_load(LoadType::link_force, Vector3d::UnitY(), kForce, kLength));
    const double in_y = kForce * std::pow(kLength, 3) / (3.0 * kBeam.bending_z()) * shortfall(n);
    EXPECT_NEAR(y.shift.y() / in_y, 1.0, kSmall) << n;
    EXPECT_LT(std::abs(y.shift.z()), kSmall * in_y);
    const Bent z = bend(cantilever(kBeam, n),
                        end_load(LoadType::link_force, Vector3d::UnitZ(), kForce, kLength));
    const double in_z = kForce * std::pow(kLength, 3) / (3.0 * kBeam.bending_y()) * shortfall(n);
    EXPECT_NEAR(z.shift.z() / in_z, 1.0, kSmall) << n;
    EXPECT_LT(std::abs(z.shift.y()), kSmall * in_z);
  }
}

TEST(CantileverStatics, A_force_at_the_tip_turns_it_exactly_as_beam_theory_says) {
  for (int n = 1; n <= 8; ++n) {
    const double square = kForce * kLength * kLength / 2.0;
    const Bent y = bend(cantilever(kBeam, n),
                        end_load(LoadType::link_force, Vector3d::UnitY(), kForce, kLength));
    EXPECT_NEAR(y.turn.z() / (square / kBeam.bending_z()), 1.0, kSmall) << n;
    const Bent z = bend(cantilever(kBeam, n),
                        end_load(LoadType::link_force, Vector3d::UnitZ(), kForce, kLength));
    EXPECT_NEAR(z.turn.y() / (-square / kBeam.bending_y()), 1.0, kSmall) << n;
  }
}

TEST(CantileverStatics, A_moment_at_the_end_deflects_and_turns_it_exactly) {
  for (int n = 1; n <= 8; ++n) {
    const Bent z = bend(cantilever(kBeam, n),
                        end_load(LoadType::link_torque, Vector3d::UnitZ(), kMoment, kLength));
    EXPECT_NEAR(z.turn.z() / (kMoment * kLength / kBeam.bending_z()), 1.0, kSmall) << n;
    EXPECT_NEAR(z.shift.y() / (kMoment * kLength * kLength / 2.0 / kBeam.bending_z()), 1.0, kSmall)
        << n;
    const Bent y = bend(cantilever(kBeam, n),
                        end_load(LoadType::link_torque, Vector3d::UnitY(), kMoment, kLength));
    EXPECT_NEAR(y.turn.y() / (kMoment * kLength / kBeam.bending_y()), 1.0, kSmall) << n;
    EXPECT_NEAR(y.shift.z() / (-kMoment * kLength * kLength / 2.0 / kBeam.bending_y()), 1.0, kSmall)
        << n;
  }
}

TEST(CantileverStatics, A_torque_at_the_end_twists_it_exactly_and_bends_nothing) {
  for (int n = 1; n <= 8; ++n) {
    const Bent x = bend(cantilever(kBeam, n),
                        end_load(LoadType::link_torque, Vector3d::UnitX(), kMoment, kLength));
    EXPECT_NEAR(x.turn.x() / (kMoment * kLength / kBeam.torsion()), 1.0, kSmall) << n;
    EXPECT_LT(x.shift.norm(), 1e-12);
  }
}

// Under a pure moment M the beam is an arc, its end turned by M L / (E J) however large that is;
// the elements are sides of a polygon that touch a circle in their middles, the ends of the beam
// among them.
TEST(CantileverStatics, A_large_moment_turns_the_end_exactly_and_puts_it_on_a_circle) {
  const double angle = 1.2;
  BeamData data;  // stiff across the plane: it does not buckle sideways
  data.second_moment_y = data.torsion_constant = 1e-7;
  const double moment = angle * data.bending_z() / kLength;
  for (int n = 1; n <= 8; ++n) {
    const Bent b = bend(cantilever(data, n),
                        end_load(LoadType::link_torque, Vector3d::UnitZ(), moment, kLength));
    const double radius = kLength / (2.0 * n) / std::tan(angle / (2.0 * n));
    EXPECT_NEAR(b.turn.z(), angle, 1e-8) << n;
    EXPECT_NEAR(kLength + b.shift.x(), radius * std::sin(angle), 1e-8) << n;
    EXPECT_NEAR(b.shift.y(), radius * (1.0 - std::cos(angle)), 1e-8) << n;
  }
}

TEST(CantileverStatics, A_beam_held_in_its_middle_is_a_cantilever_on_either_side) {
  for (int n = 2; n <= 8; n += 2) {  // the middle of an element
    for (const double at : {0.0, kLength}) {
      const Bent b = bend(cantilever(kBeam, n, 0.5 * kLength),
                          end_load(LoadType::link_force, Vector3d::UnitY(), 4 * kForce, at));
      const double arm = 0.5 * kLength;
      const double side = at > 0.0 ? 1.0 : -1.0;
      EXPECT_NEAR(b.shift.y() / (4 * kForce * std::pow(arm, 3) / (3.0 * kBeam.bending_z())),
                  shortfall(n / 2), kSmall)
          << n;
      EXPECT_NEAR(b.turn.z() / (side * 4 * kForce * arm * arm / (2.0 * kBeam.bending_z())), 1.0,
                  kSmall)
          << n;
    }
  }
}

TEST(CantileverStatics, A_beam_held_at_its_end_bends_as_one_held_at_its_begin) {
  for (int n = 1; n <= 8; ++n) {
    const Bent b = bend(cantilever(kBeam, n, kLength),
                        end_load(LoadType::link_force, Vector3d::UnitZ(), kForce, 0.0));
    const double whole = kForce * std::pow(kLength, 3) / (3.0 * kBeam.bending_y());
    EXPECT_NEAR(b.shift.z() / whole, shortfall(n), kSmall) << n;
    EXPECT_NEAR(b.turn.y() / (kForce * kLength * kLength / (2.0 * kBeam.bending_y())), 1.0, kSmall);
  }
}

}  // namespace linkstudy::testing::cantilever_statics_test
