// The matrix equation of basic loops and its proper elements; as a second way to positions and
// velocities, [Palcak] (4.99) and (4.102) with these elements alone.
#include "core/kinematics/loop_equations.h"

#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <cmath>

#include "core/kinematics/driven_motion.h"
#include "core/numerics/rank.h"
#include "core/spatial/euler_parameters.h"
#include "tests/mechanisms/bennett.h"
#include "tests/mechanisms/four_bar.h"
#include "tests/mechanisms/placed_linkage.h"
#include "tests/mechanisms/random_linkages.h"
#include "tests/mechanisms/rsrrp.h"
#include "tests/mechanisms/spatial_slider_crank.h"
#include "tests/support/near.h"
#include "tests/support/random.h"

namespace linkstudy::testing::loop_equations_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using ::testing::ElementsAre;

// A linkage with one loop at a closed pose.
class Loop {
 public:
  explicit Loop(const Linkage& linkage) : closed_(compile_closed(linkage)), pose_(closed_.start) {
    assemble_start(closed_, pose_);
    scale_ = find_closure_scale(closed_, pose_);
    loop_ = find_basic_loops(closed_.mechanism).front();
  }

  const Model& model() const { return closed_; }
  const Mechanism& mechanism() const { return closed_.mechanism; }
  const ClosureScale& scale() const { return scale_; }
  const State<double>& pose() const { return pose_; }
  LoopEquations equations() const { return {closed_, scale_, loop_}; }
  MatrixXd jacobian() const { return equations().jacobian(pose_, equations().cut_position(pose_)); }
  // Columns of everything but one driven coordinate.
  MatrixXd dependent_jacobian(int driven) const {
    return take_columns(jacobian(), all_but(driven));
  }
  std::vector<int> all_but(int driven) const {
    std::vector<int> columns;
    const int count = mechanism().nv + equations().cut_joint().velocity_count();
    for (int k = 0; k < count; ++k)
      if (k != driven) columns.push_back(k);
    return columns;
  }

  // Tree and cut joint moved by a displacement without dimensions (nv + velocities of the cut).
  void move(State<double>& s, VectorXd& cut, const VectorXd& by) const {
    const int nv = mechanism().nv;
    s = displaced(mechanism(), s, scale_.velocity.cwiseProduct(by.head(nv)));
    const CutJoint joint = equations().cut_joint();
    const auto shifts = static_cast<int>(joint.shifts.size());
    cut.head(shifts) += scale_.extent * by.segment(nv, shifts);
    if (joint.turns == 3) {
      const Eigen::Vector3d w = by.tail<3>();
      const Eigen::Vector4d turn(1.0, 0.5 * w.x(), 0.5 * w.y(), 0.5 * w.z());
      cut.tail<4>() = compose(cut.tail<4>(), turn.normalized());
    } else {
      cut.tail(joint.turns) += by.tail(joint.turns);
    }
  }

 private:
  Model closed_;
  State<double> pose_;
  ClosureScale scale_;
  BasicLoop loop_;
};

std::vector<Linkage> single_loops() {
  return {four_bar(),
          rsrrp(),
          rsrrp_revolute(),
          bennett(),
          spatial_slider_crank(),
          spatial_slider_crank_cut_at_universal(),
          rccc(),
          spherical_4r()};
}

MatrixXd rows_of(const MatrixXd& a, const std::vector<int>& rows) {
  MatrixXd b(static_cast<Eigen::Index>(rows.size()), a.cols());
  for (std::size_t i = 0; i < rows.size(); ++i)
    b.row(static_cast<Eigen::Index>(i)) = a.row(rows[i]);
  return b;
}

TEST(BasicLoops, Go_round_from_where_their_ways_meet) {
  const auto bar = find_basic_loops(compile_closed(four_bar()).mechanism);
  ASSERT_EQ(bar.size(), 1u);
  EXPECT_THAT(bar[0].joints, ElementsAre("joint.A", "joint.B", "closure.C", "joint.D"));
  EXPECT_EQ(bar[0].common, kGroundBody);
  const auto platform = find_basic_loops(compile_closed(stewart_platform()).mechanism);
  ASSERT_EQ(platform.size(), 5u);
  EXPECT_THAT(platform[1].joints, ElementsAre("joint.U3", "joint.P3", "closure.S3", "joint.S1",
                                              "joint.P1", "joint.U1"));
}

TEST(BasicLoops, Leave_out_what_both_ways_share) {
  Linkage linkage = PlacedLinkage("carried loop")
                        .add("base", JointType::revolute, kGround, "frame", {{1, 2, 0}})
                        .add("A", JointType::revolute, "frame", "crank", {{0, 0, 0}})
                        .add("B", JointType::revolute, "crank", "coupler", {{0.1, 0.05, 0}})
                        .add("D", JointType::revolute, "frame", "rocker", {{0.4, 0, 0}})
                        .close("C", JointType::revolute, "coupler", "rocker", {{0.35, 0.3, 0}})
                        .linkage();
  const Model closed = compile_closed(linkage);
  const BasicLoop loop = find_basic_loops(closed.mechanism).front();
  EXPECT_THAT(loop.joints, ElementsAre("joint.A", "joint.B", "closure.C", "joint.D"));
  EXPECT_EQ(closed.mechanism.link_names[loop.common], "frame");
  const ClosureScale scale = find_closure_scale(closed, closed.start);
  const LoopEquations equations(closed, scale, loop);
  State<double> turned = closed.start;
  turned.q[PositionIndex(0)] = 0.8;
  const VectorXd cut = equations.cut_position(closed.start);
  EXPECT_TRUE(near_absolute(equations.residual(turned, cut), VectorXd::Zero(kElements), 1e-14));
  EXPECT_TRUE(
      near_absolute(equations.jacobian(turned, cut), equations.jacobian(closed.start, cut), 1e-14));
}

TEST(LoopEquations, Hold_at_closed_poses) {
  for (const Linkage& linkage : single_loops()) {
    const Loop loop(linkage);
    const VectorXd cut = loop.equations().cut_position(loop.pose());
    EXPECT_LT(loop.equations().residual(loop.pose(), cut).norm(), 1e-9) << linkage.name;
  }
}

// In any pose, closed or not.
TEST(LoopEquations, Have_the_derivatives_of_their_elements) {
  const double h = 1e-5;
  for (const JointType type :
       {JointType::revolute, JointType::prismatic, JointType::cylindrical, JointType::universal,
        JointType::planar, JointType::spherical, JointType::fixed}) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      SCOPED_TRACE(::testing::Message() << static_cast<int>(type) << " seed " << seed);
      const Loop loop(random_closed_linkage(seed, type, ClosureModel::cut));
      const LoopEquations equations = loop.equations();
      State<double> s = loop.pose();
      VectorXd cut = equations.cut_position(s);
      const int count = loop.mechanism().nv + equations.cut_joint().velocity_count();
      loop.move(s, cut, 0.2 * Random(seed).vector(count, 1.0));
      const MatrixXd jacobian = equations.jacobian(s, cut);
      for (int k = 0; k < count; ++k) {
        const auto moved = [&](double step) {
          State<double> there = s;
          VectorXd cut_there = cut;
          loop.move(there, cut_there, step * VectorXd::Unit(count, k));
          return VectorXd(equations.residual(there, cut_there));
        };
        EXPECT_TRUE(near_absolute(jacobian.col(k), (moved(h) - moved(-h)) / (2 * h), 1e-8))
            << "coordinate " << k;
      }
    }
  }
}

TEST(ProperElements, Are_as_many_as_the_loop_has_independent_equations) {
  const auto count = [](const Linkage& linkage) {
    return choose_proper_elements(Loop(linkage).dependent_jacobian(0)).elements.size();
  };
  EXPECT_EQ(count(rsrrp()), 6u);
  EXPECT_EQ(count(spatial_slider_crank()), 6u);
  EXPECT_EQ(count(rccc()), 6u);
  EXPECT_EQ(count(four_bar()), 3u);
  EXPECT_EQ(count(spherical_4r()), 3u);
  EXPECT_EQ(count(bennett()), 3u);
}

// Three of one column, or four of nine direction cosines, would depend on each other.
TEST(ProperElements, Take_two_of_a_column_and_three_direction_cosines_at_most) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const Loop loop(random_closed_linkage(seed, JointType::revolute, ClosureModel::cut));
    const ProperElements proper = choose_proper_elements(loop.jacobian());
    std::array<int, 4> in_column{};
    for (const int element : proper.elements) ++in_column[static_cast<std::size_t>(element / 3)];
    for (int c = 0; c < 3; ++c) EXPECT_LE(in_column[static_cast<std::size_t>(c)], 2) << seed;
    EXPECT_LE(in_column[0] + in_column[1] + in_column[2], 3) << seed;
    EXPECT_GT(proper.conditioning, 1e-4) << seed;
  }
}

// Determinants by another factorization, of random choices.
TEST(ProperElements, Have_the_largest_determinant) {
  const Loop loop(rsrrp());
  const MatrixXd m = loop.dependent_jacobian(0);
  ASSERT_EQ(m.cols(), 6);
  const ProperElements proper = choose_proper_elements(m);
  const double best = std::abs(rows_of(m, proper.elements).fullPivLu().determinant());
  EXPECT_GT(best, 0.0);
  std::vector<int> all(kElements);
  std::iota(all.begin(), all.end(), 0);
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i) {
    std::shuffle(all.begin(), all.end(), random);
    const std::vector<int> choice(all.begin(), all.begin() + 6);
    EXPECT_LE(std::abs(rows_of(m, choice).fullPivLu().determinant()), best * (1.0 + 1e-9));
  }
}

// (4.99) in all coordinates of the loop but the driven one: the poses that the cut rows give.
TEST(ProperElements, Close_the_loop_by_Newton_Raphson) {
  for (const Linkage& linkage : single_loops()) {
    SCOPED_TRACE(linkage.name);
    const Loop loop(linkage);
    const LoopEquations equations = loop.equations();
    const std::vector<int> columns = loop.all_but(0);
    const int count = loop.mechanism().nv + equations.cut_joint().velocity_count();
    const ProperElements proper = choose_proper_elements(loop.dependent_jacobian(0));
    const bool is_determined = proper.elements.size() == columns.size();
    State<double> s = loop.pose();
    s.q[PositionIndex(0)] += 0.05;
    State<double> fast = s;
    VectorXd cut = equations.cut_position(loop.pose());
    for (int i = 0; i < 10; ++i) {
      const MatrixXd m =
          rows_of(take_columns(equations.jacobian(s, cut), columns), proper.elements);
      const VectorXd r = rows_of(equations.residual(s, cut), proper.elements);
      const VectorXd x = -m.completeOrthogonalDecomposition().solve(r);
      loop.move(s, cut, scatter_entries(x, columns, count));
    }
    EXPECT_LT(equations.residual(s, cut).norm(), 1e-12);
    if (!is_determined) continue;  // other closed poses may be nearer
    const MobilityReport mobility = analyse_mobility(loop.model(), loop.pose());
    const Drive drive = list_drives(loop.mechanism()).front();
    ASSERT_TRUE(DrivenLinkage(loop.model(), loop.pose(), mobility, {drive}).close(fast));
    const VectorXd apart = scaled_difference(loop.mechanism(), loop.scale(), s, fast);
    EXPECT_LT(apart.norm(), 1e-11);
  }
}

// (4.102) with the proper elements: rates of the tree's joints and of the cut one.
TEST(ProperElements, Give_the_velocities_of_the_driven_linkage) {
  int determined = 0;
  for (const Linkage& linkage : single_loops()) {
    SCOPED_TRACE(linkage.name);
    const Loop loop(linkage);
    const MatrixXd m = loop.dependent_jacobian(0);
    const ProperElements proper = choose_proper_elements(m);
    if (static_cast<Eigen::Index>(proper.elements.size()) != m.cols()) continue;
    ++determined;
    const VectorXd n = rows_of(loop.jacobian().col(0), proper.elements);
    const VectorXd rates = -rows_of(m, proper.elements).partialPivLu().solve(n);
    const MobilityReport mobility = analyse_mobility(loop.model(), loop.pose());
    const DrivenLinkage driven(loop.model(), loop.pose(), mobility,
                               {list_drives(loop.mechanism()).front()});
    const VectorXd one = VectorXd::Ones(1), none = VectorXd::Zero(1);
    const DrivenRates fast = driven.rates(loop.pose(), one, none);
    const int nv = loop.mechanism().nv;
    EXPECT_TRUE(near_absolute(rates.head(nv - 1), fast.first.tail(nv - 1), 1e-11));
    const VectorXd v = loop.scale().velocity.cwiseProduct(fast.first);
    const VectorXd a = loop.scale().velocity.cwiseProduct(fast.second);
    VectorXd cut = cut_joint_motions(loop.mechanism(), loop.model().parameters,
                                     loop.pose().q.data(), v.data(), a.data())
                       .front()
                       .velocity;
    const CutJoint joint = loop.equations().cut_joint();
    cut.head(static_cast<Eigen::Index>(joint.shifts.size())) /= loop.scale().extent;
    EXPECT_TRUE(near_absolute(rates.tail(joint.velocity_count()), cut, 1e-11));
  }
  EXPECT_GE(determined, 6);
}

}  // namespace
}  // namespace linkstudy::testing::loop_equations_test
