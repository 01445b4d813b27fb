// The recursions against the matrix method of [Palcak]: products of basic motions Z1 .. Z6 with
// derivative operators (tests/support/trace_kinematics.h) for bodies of trees (4.76)-(4.81), and
// the matrix equations of loops (4.83)-(4.85), (4.102), (4.103) for driven linkages.
#include <gtest/gtest.h>

#include <cmath>

#include "core/kinematics/drive_cycle.h"
#include "core/kinematics/forward_kinematics.h"
#include "tests/mechanisms/bennett.h"
#include "tests/mechanisms/four_bar.h"
#include "tests/mechanisms/n_four_bar.h"
#include "tests/mechanisms/random_linkages.h"
#include "tests/mechanisms/rsrrp.h"
#include "tests/mechanisms/spatial_slider_crank.h"
#include "tests/support/engine_probe.h"
#include "tests/support/near.h"
#include "tests/support/random.h"
#include "tests/support/trace_formulas.h"
#include "tests/support/zyx_equivalent.h"

namespace linkstudy::testing::matrix_products_test {
namespace {

using Eigen::Matrix4d;
using Eigen::Vector3d;

constexpr double kTolerance = 1e-12;

Vector3d to_vector(const Vec3<double>& a) {
  return {a.x, a.y, a.z};
}

Eigen::Matrix3d cross_matrix(const Vector3d& w) {
  Eigen::Matrix3d W;
  W << 0.0, -w.z(), w.y(), w.z(), 0.0, -w.x(), -w.y(), w.x(), 0.0;
  return W;
}

// A body of the engine, as the transform of its own frame with both time derivatives.
struct MovingFrame {
  Matrix4d T = Matrix4d::Identity(), T_dot = Matrix4d::Zero(), T_ddot = Matrix4d::Zero();
};

// The recursion without accelerations of the coordinates: T_ddot is sum_ik U_ik v_i v_k.
class Recursion {
 public:
  explicit Recursion(const Linkage& linkage)
      : model_(compile(linkage)), w_(make_workspace<double>(model_.mechanism)) {}

  const Mechanism& mechanism() const { return model_.mechanism; }
  std::vector<MovingFrame> bodies(const Vector& q, const Vector& v) {
    update_kinematics(model_.mechanism, model_.parameters, q.data(), v.data(), w_);
    std::vector<MovingFrame> frames;
    for (const BodyState<double>& body : w_.bodies) frames.push_back(frame_of(body));
    return frames;
  }

 private:
  MovingFrame frame_of(const BodyState<double>& body) const {
    MovingFrame frame;
    const Eigen::Matrix3d W = cross_matrix(to_vector(body.w_WB));
    Eigen::Matrix3d R;
    R << to_vector(body.R_WB.x), to_vector(body.R_WB.y), to_vector(body.R_WB.z);
    frame.T.topLeftCorner<3, 3>() = R;
    frame.T.topRightCorner<3, 1>() = to_vector(body.p_WB);
    frame.T_dot.topLeftCorner<3, 3>() = W * R;
    frame.T_dot.topRightCorner<3, 1>() = to_vector(body.v_WB);
    frame.T_ddot.topLeftCorner<3, 3>() = (cross_matrix(to_vector(body.alpha_WB)) + W * W) * R;
    frame.T_ddot.topRightCorner<3, 1>() =
        to_vector(body.a_WB) + to_vector(model_.parameters.gravity);
    return frame;
  }

  Model model_;
  Workspace<double> w_;
};

const Joint& joint_named(const Linkage& linkage, const std::string& name) {
  return *std::find_if(linkage.joints.begin(), linkage.joints.end(),
                       [&](const Joint& joint) { return joint.name == name; });
}

// The same frames by products: a body's frame is its joint's frame in the child.
class Products {
 public:
  Products(const Linkage& linkage, const Mechanism& m)
      : trace_(make_trace_model(linkage)), map_(oracle_coordinates(m, trace_)) {
    for (std::size_t b = 1; b < m.bodies.size(); ++b) {
      const Joint& joint = joint_named(linkage, m.joint_names[BodyIndex(b)]);
      frames_.push_back({link_index(trace_, joint.child), transform(joint.child_frame)});
    }
  }

  const TraceModel& trace() const { return trace_; }
  const std::vector<int>& map() const { return map_; }
  // q and v in the order of the products.
  std::vector<CarriedFrame> bodies(const Vector& q, const Vector& v) const {
    const auto transforms = link_transforms(trace_, q);
    std::vector<CarriedFrame> all;
    for (const TraceClosureEnd& body : frames_) {
      all.push_back(carried_frame(trace_, transforms, body.link, body.frame, v));
    }
    return all;
  }

 private:
  TraceModel trace_;
  std::vector<int> map_;
  std::vector<TraceClosureEnd> frames_;
};

void expect_same_bodies(const std::vector<CarriedFrame>& products,
                        const std::vector<MovingFrame>& recursion) {
  ASSERT_EQ(recursion.size(), products.size() + 1);
  for (std::size_t b = 0; b < products.size(); ++b) {
    const MovingFrame& body = recursion[b + 1];
    const double fast = 1.0 + products[b].T_vv.norm();
    EXPECT_TRUE(near_absolute(body.T, products[b].T, kTolerance)) << "body " << b;
    EXPECT_TRUE(near_absolute(body.T_dot, products[b].T_dot, kTolerance)) << "body " << b;
    EXPECT_TRUE(near_absolute(body.T_ddot, products[b].T_vv, kTolerance * fast)) << "body " << b;
  }
}

constexpr std::uint64_t kTrees = 100;

Vector to_vector(const std::vector<double>& x) {
  return Eigen::Map<const Vector>(x.data(), static_cast<Eigen::Index>(x.size()));
}

// Inverse of reordered().
Vector of_products(const Vector& of_engine, const std::vector<int>& map) {
  Vector x(of_engine.size());
  x(map) = of_engine;
  return x;
}

// In angles, all closures cut. Mobility 1 each; rows are redundant in three of them.
std::vector<Linkage> driven_linkages() {
  std::vector<Linkage> all = {four_bar(), rsrrp(),       rsrrp_revolute(),
                              bennett(),  n_four_bar(2), spatial_slider_crank()};
  for (Linkage& linkage : all) {
    linkage = with_zyx(linkage);
    for (Closure& closure : linkage.closures) closure.model = ClosureModel::cut;
  }
  return all;
}

// The first joint driven once around, from a place of its own: at its start a linkage may be
// singular.
struct FullTurn {
  explicit FullTurn(const Linkage& linkage)
      : model(compile(linkage)),
        start(assembled(model)),
        mobility(analyse_mobility(model, start)),
        drive(list_drives(model.mechanism).front()),
        driven(model, start, mobility, {drive}),
        cycle(follow()) {}

  static State<double> assembled(const Model& model) {
    State<double> s = model.start;
    assemble_start(model, s);
    return s;
  }
  DriveCycle follow() const {
    DriveCourse course;
    course.from = driven.drive_position(start)[0] + 0.1;
    course.to = *course.from + 2.0 * M_PI;
    return follow_drives(driven, start, mobility, DrivePath({course}, 1.0), {25});
  }

  Model model;
  State<double> start;
  MobilityReport mobility;
  Drive drive;
  DrivenLinkage driven;
  DriveCycle cycle;
};

// x with J x + terms = 0 and x[n] given.
Vector solve_driven(const Matrix& J, const Vector& terms, int n, double given) {
  Matrix M = J;
  M.col(n).setZero();
  Eigen::CompleteOrthogonalDecomposition<Matrix> solver;
  solver.setThreshold(1e-9);  // redundant rows are zero but for roundings
  solver.compute(M);
  Vector x = solver.solve(-terms - given * J.col(n));
  x[n] = given;
  return x;
}

}  // namespace

TEST(MatrixProducts, Move_the_bodies_of_random_trees_as_the_recursion_does) {
  for (std::uint64_t seed = 0; seed < kTrees; ++seed) {
    SCOPED_TRACE(seed);
    const Linkage linkage = random_tree(seed);
    Recursion recursion(linkage);
    const Products products(linkage, recursion.mechanism());
    Random random(seed);
    for (int state = 0; state < 3; ++state) {  // any orientation, also far from the start
      const Vector q = random.vector(products.trace().dof, 3.0);
      const Vector v = random.vector(products.trace().dof, 2.0);
      expect_same_bodies(products.bodies(q, v), recursion.bodies(reordered(q, products.map()),
                                                                 reordered(v, products.map())));
    }
  }
}

// U_i at a unit rate of one coordinate; U_ii from it, U_ik + U_ki from two.
TEST(MatrixProducts, Of_each_operator_and_each_pair_are_those_of_the_recursion) {
  for (std::uint64_t seed = 0; seed < kTrees / 5; ++seed) {
    SCOPED_TRACE(seed);
    const Linkage linkage = random_tree(seed);
    Recursion recursion(linkage);
    const Products products(linkage, recursion.mechanism());
    const int n = products.trace().dof;
    const Vector q = Random(seed).vector(n, 3.0);
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k <= i; ++k) {
        Vector v = Vector::Unit(n, i);
        v[k] = 1.0;
        expect_same_bodies(products.bodies(q, v), recursion.bodies(reordered(q, products.map()),
                                                                   reordered(v, products.map())));
      }
    }
  }
}

// T_ddot = sum_i U_i a_i + sum_ik U_ik v_i v_k: in quaternion coordinates v and a are others, the
// motion is the same. U_i of the recursion are its T_dot at unit rates.
TEST(MatrixProducts, Accelerate_bodies_as_the_recursion_does_with_quaternions) {
  for (std::uint64_t seed = 0; seed < kTrees; ++seed) {
    SCOPED_TRACE(seed);
    const Linkage angles = random_tree(seed);
    const Linkage linkage = with_quaternions(angles);
    Recursion recursion(linkage);
    const Products products(angles, recursion.mechanism());
    const TraceModel& trace = products.trace();
    const Vector rates = Random(seed).vector(trace.dof, 5.0);
    const QuaternionMotion moved = quaternion_motion(linkage, trace.q0, trace.v0, rates);
    const Vector q = to_vector(compile(linkage).start.q);
    const Vector v = reordered(moved.v, products.map()), a = reordered(moved.a, products.map());
    std::vector<MovingFrame> bodies = recursion.bodies(q, v);
    for (int i = 0; i < trace.dof; ++i) {
      const auto partial = recursion.bodies(q, Vector::Unit(trace.dof, i));
      for (std::size_t b = 0; b < bodies.size(); ++b) bodies[b].T_ddot += a[i] * partial[b].T_dot;
    }
    std::vector<CarriedFrame> expected = products.bodies(trace.q0, trace.v0);
    for (CarriedFrame& body : expected) {
      for (int i = 0; i < trace.dof; ++i) body.T_vv += rates[i] * body.T_i[i];
    }
    expect_same_bodies(expected, bodies);
  }
}

// A cut through a link: both halves carry the same frame, (4.83), (4.84), (4.85). Velocities and
// accelerations are those of the equations of motion, whose cut holds by multipliers.
TEST(MatrixProducts, Of_both_halves_of_a_loop_stay_equal) {
  int moving = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const Linkage linkage = random_closed_linkage(seed, JointType::fixed, ClosureModel::cut);
    const EngineProbe engine(linkage);
    const TraceModel trace = make_trace_model(linkage);
    const auto map = oracle_coordinates(engine.model().mechanism, trace);
    const Vector a = of_products(engine.qdd(), map);
    const auto transforms = link_transforms(trace, trace.q0);
    const auto half = [&](const TraceClosureEnd& end) {
      CarriedFrame frame = carried_frame(trace, transforms, end.link, end.frame, trace.v0);
      for (int i = 0; i < trace.dof; ++i) frame.T_vv += a[i] * frame.T_i[i];
      return frame;
    };
    const TraceClosure& cut = trace.closures.front();
    const CarriedFrame one = half(cut.first), other = half(cut.second);
    EXPECT_TRUE(near_absolute(one.T, other.T, kTolerance));
    EXPECT_TRUE(near_absolute(one.T_dot, other.T_dot, kTolerance));
    EXPECT_TRUE(near_absolute(one.T_vv, other.T_vv, 1e-9 * (1.0 + one.T_vv.norm())));
    if (one.T_dot.norm() > 1e-3) ++moving;
  }
  EXPECT_GE(moving, 15);  // loops that are structures rest
}

// M qd_z = N qd_n and its derivative with M and N from the products, solved by themselves: what the
// driven motion says all around.
TEST(MatrixProducts, Give_velocities_and_accelerations_of_driven_linkages) {
  const double rate = 5.0, rate_dot = 7.0;
  for (const Linkage& linkage : driven_linkages()) {
    SCOPED_TRACE(linkage.name);
    const FullTurn turn(linkage);
    ASSERT_EQ(turn.cycle.poses.size(), 25u);
    const TraceModel trace = make_trace_model(linkage);
    const auto map = oracle_coordinates(turn.model.mechanism, trace);
    const int n = map[static_cast<std::size_t>(turn.drive.velocity.value())];
    for (const DrivenPose& pose : turn.cycle.poses) {
      const Vector q = of_products(to_vector(pose.s.q), map);
      const DrivenRates rates =
          turn.driven.rates(pose.s, Vector::Constant(1, rate), Vector::Constant(1, rate_dot));
      const Vector& unit = turn.driven.scale().velocity;
      const Vector v = of_products(unit.cwiseProduct(rates.first), map);
      const Vector a = of_products(unit.cwiseProduct(rates.second), map);
      const Constraints loop = cut_constraints(trace, q, v);
      const Vector none = Vector::Zero(loop.value.size());
      EXPECT_TRUE(near_absolute(loop.value, none, 1e-11));
      EXPECT_TRUE(near_relative(v, solve_driven(loop.jacobian, none, n, rate), 1e-10));
      EXPECT_TRUE(
          near_relative(a, solve_driven(loop.jacobian, loop.velocity_terms, n, rate_dot), 1e-10));
    }
  }
}

}  // namespace linkstudy::testing::matrix_products_test
