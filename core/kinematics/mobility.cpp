#include "core/kinematics/mobility.h"

#include <algorithm>
#include <random>

#include "core/numerics/dense.h"

namespace linkstudy {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kTrials = 12;
constexpr double kReach = 0.03;  // of a step to a neighbour, rad and extents
constexpr double kProbe = 1e-3;  // of a step that measures the motions of a neighbour
constexpr double kStays = 0.2;   // a step that keeps less of its length led back
constexpr double kLeaves = 3.0;  // one that grows beyond this led elsewhere
constexpr double kSpan = 0.05;   // singular values of displacements, relative

class Explorer {
 public:
  Explorer(const Model& closed, const ClosureScale& scale) : closed_(closed), scale_(scale) {}

  MatrixXd jacobian(const State<double>& s) const {
    return compute_scaled_closures(closed_, scale_, s).jacobian;
  }

  int rank(const State<double>& s) const {
    return numerical_rank(jacobian(s), kNeighbourTolerance, kLeastRowSize).rank;
  }

  // Closed pose reached by a step of the given length along a random motion of the null space;
  // nothing if there is none near. `moved` is the displacement over the length.
  bool step(const State<double>& s, const MatrixXd& null, double length, State<double>& reached,
            VectorXd& moved) {
    const VectorXd direction = (null * random_vector(null.cols())).normalized();
    reached = displaced(closed_.mechanism, s, length * scale_.velocity.cwiseProduct(direction));
    if (close_from(closed_, scale_, reached) > kClosedTolerance) return false;
    moved = scaled_difference(closed_.mechanism, scale_, s, reached) / length;
    return moved.norm() < kLeaves;
  }

  // Dimension of the motions that exist around a pose.
  int measure(const State<double>& s) {
    const MatrixXd null = null_space(jacobian(s), kNeighbourTolerance, kLeastRowSize);
    if (null.cols() == 0) return 0;
    const Eigen::Index trials = null.cols() + 2;
    MatrixXd moved = MatrixXd::Zero(closed_.mechanism.nv, trials);
    for (Eigen::Index i = 0; i < trials; ++i) {
      State<double> reached;
      VectorXd d;
      if (step(s, null, kProbe, reached, d)) moved.col(i) = d;
    }
    const VectorXd sizes = singular_values(moved);
    const auto spans = [](double size) { return size > kSpan; };
    return static_cast<int>(std::count_if(sizes.begin(), sizes.end(), spans));
  }

 private:
  VectorXd random_vector(Eigen::Index n) {
    VectorXd x(n);
    for (auto& value : x) value = static_cast<double>(random_() >> 11) * 0x1.0p-53 * 2.0 - 1.0;
    return x;
  }

  const Model& closed_;
  const ClosureScale& scale_;
  std::mt19937_64 random_{1};
};

void count_parts(const Model& closed, MobilityReport& r) {
  const Mechanism& m = closed.mechanism;
  r.links = m.body_count();
  r.loops = static_cast<int>(m.closures.size());
  r.joints = r.links - 1 + r.loops;
  r.velocities = m.nv;
  r.rows = m.cut_row_count();
  r.coordinates = m.nv + 6 * r.loops - (r.rows - static_cast<int>(m.couplings.size()));
  r.kutzbach = m.nv - r.rows;
}

// Neighbours, the rank there and what moves.
void explore(const Model& closed, const ClosureScale& scale, const State<double>& pose,
             MobilityReport& r) {
  Explorer explorer(closed, scale);
  const MatrixXd null = null_space(explorer.jacobian(pose), kMobilityTolerance, kLeastRowSize);
  r.regular_rank = r.rank.rank;
  r.mobility = 0;
  for (int i = 0; i < kTrials && null.cols() > 0; ++i) {
    State<double> reached;
    VectorXd moved;
    if (!explorer.step(pose, null, kReach, reached, moved) || moved.norm() < kStays) continue;
    r.neighbours.push_back(reached);
    r.regular_rank = std::max(r.regular_rank, explorer.rank(reached));
    if (r.mobility < r.instantaneous_mobility) {
      r.mobility = std::max(r.mobility, explorer.measure(reached));
    }
  }
}

// The neighbour with the largest rank, where nothing depends on the pose by chance.
const State<double>& regular_pose(const Model& closed, const ClosureScale& scale,
                                  const State<double>& pose, const MobilityReport& r) {
  if (r.rank.rank == r.regular_rank) return pose;
  const Explorer explorer(closed, scale);
  for (const State<double>& s : r.neighbours)
    if (explorer.rank(s) == r.regular_rank) return s;
  return pose;
}

SingularState state_of(const MobilityReport& r) {
  const bool is_shaky = r.mobility < r.instantaneous_mobility;
  if (r.rank.rank < r.regular_rank || (is_shaky && r.neighbours.empty())) {
    return SingularState::instantaneous;
  }
  return r.rank.rank < r.rows ? SingularState::permanent : SingularState::none;
}

}  // namespace

MobilityReport analyse_mobility(const Model& closed, const State<double>& pose) {
  const ClosureScale scale = find_closure_scale(closed, pose);
  MobilityReport r;
  count_parts(closed, r);
  const ScaledClosures c = compute_scaled_closures(closed, scale, pose);
  r.rank = numerical_rank(c.jacobian, kMobilityTolerance, kLeastRowSize);
  r.regular_rank = r.rank.rank;
  r.mobility = r.instantaneous_mobility = r.velocities - r.rank.rank;
  if (c.residual.norm() <= kClosedTolerance) {
    explore(closed, scale, pose, r);
    r.state = state_of(r);
  }
  r.redundant = r.rows - r.regular_rank;
  const State<double>& regular = regular_pose(closed, scale, pose, r);
  if (r.redundant > 0) r.redundant_joints = find_redundant_joints(closed, scale, regular);
  r.idle = find_idle_freedoms(closed, scale, regular);
  return r;
}

}  // namespace linkstudy
