#include "core/kinematics/driven_motion.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "core/kinematics/three_turns.h"
#include "core/model/walk.h"

namespace linkstudy {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMostCorrections = 15;
constexpr double kResidual = 1e-12;         // without dimensions
constexpr double kCorrection = 1e-10;       // of the last iteration
constexpr double kLongestCorrection = 1.0;  // a longer correction leads elsewhere
constexpr double kCutoff = 1e-9;  // of singular values that a correction follows, relative

SingularValues decompose(const MatrixXd& a) {
  return decompose_singular(a, SingularVectors::thin);
}

// Singular directions, of the first `rank`, that a correction follows.
int followed(const SingularValues& svd, int rank) {
  int count = 0;
  const double least = kCutoff * std::max(svd.values[0], kLeastRowSize);
  while (count < rank && svd.values[count] > least) ++count;
  return count;
}

// Least-norm solution of a x = b in the first `rank` singular directions.
VectorXd solve_within(const SingularValues& svd, int rank, const VectorXd& b) {
  const int n = followed(svd, rank);
  const VectorXd parts = (svd.u.leftCols(n).transpose() * b).cwiseQuotient(svd.values.head(n));
  return svd.v.leftCols(n) * parts;
}

// J_dot(v) u from bias(v) = J_dot(v) v, which is quadratic: half of bias(v + u) - bias(v) -
// bias(u), and half of J (v x u) for the angular velocities of balls, which are no derivatives of
// positions.
class JacobianRate {
 public:
  JacobianRate(const Model& closed, const ClosureScale& scale, const State<double>& s,
               const MatrixXd& jacobian, const VectorXd& v)
      : closed_(closed), scale_(scale), s_(s), jacobian_(jacobian), v_(v), bias_v_(bias(v)) {}

  VectorXd times(const VectorXd& u) {
    return 0.5 * (bias(v_ + u) - bias_v_ - bias(u) + jacobian_ * bracket(u));
  }

 private:
  VectorXd bias(const VectorXd& v) {
    const VectorXd rates = scale_.velocity.cwiseProduct(v);
    s_.v.assign(rates.begin(), rates.end());
    return compute_scaled_closures(closed_, scale_, s_).bias;
  }
  VectorXd bracket(const VectorXd& u) const {
    VectorXd x = VectorXd::Zero(u.size());
    for (const Stage& stage : closed_.mechanism.stages) {
      if (stage.motion != BasicMotion::ball) continue;
      const int v = stage.v.value();
      const Eigen::Vector3d a = v_.segment<3>(v), b = u.segment<3>(v);
      x.segment<3>(v) = a.cross(b);
    }
    return x;
  }

  const Model& closed_;
  const ClosureScale& scale_;
  State<double> s_;
  const MatrixXd& jacobian_;
  VectorXd v_, bias_v_;
};

std::string numbered(const std::string& name, int index, int count) {
  return count > 1 ? name + "." + std::to_string(index) : name;
}

}  // namespace

std::vector<Drive> list_drives(const Mechanism& m) {
  std::vector<Drive> drives;
  for (const BodyIndex b : bodies_outwards(m)) {
    const Body& body = m.bodies[b];
    for (const StageIndex i : stages_of(body)) {
      const Stage& stage = m.stages[i];
      if (stage.motion == BasicMotion::ball) continue;
      const std::string& joint = m.joint_names[b];
      const int coordinate = stage.v - body.v_begin;
      const auto kind = m.velocities[stage.v].kind;
      drives.push_back({numbered("joint." + joint, coordinate, body.v_count), joint, coordinate,
                        stage.q, stage.v, kind != VelocityKind::translation});
    }
  }
  return drives;
}

DrivenLinkage::DrivenLinkage(const Model& closed, const State<double>& pose,
                             const MobilityReport& mobility, std::vector<Drive> drives)
    : closed_(&closed), scale_(find_closure_scale(closed, pose)), drives_(std::move(drives)) {
  for (const Drive& drive : drives_) driven_.push_back(drive.velocity.value());
  std::vector<const State<double>*> poses = {&pose};
  for (const State<double>& s : mobility.neighbours) poses.push_back(&s);
  choose_dependent(true);
  if (!find_rank(poses)) {
    releases_holds_ = !closed.held.empty();
    choose_dependent(false);
    is_overdriven_ = !find_rank(poses);
  }
  find_size(pose);
  find_branch_rows(poses);
}

void DrivenLinkage::choose_dependent(bool keep_holds) {
  const auto has = [](const auto& list, auto k) {
    return std::find(list.begin(), list.end(), k) != list.end();
  };
  dependent_.clear();
  for (const VelocityIndex k : velocities(closed_->mechanism)) {
    const bool rests = keep_holds && has(closed_->held, k);
    if (!has(driven_, k.value()) && !rests) dependent_.push_back(k.value());
  }
}

bool DrivenLinkage::find_rank(const std::vector<const State<double>*>& poses) {
  bool can_move = false;
  rank_ = -1;
  for (const State<double>* s : poses) {
    const DriveRanks r = ranks(*s, s == poses.front() ? kMobilityTolerance : kNeighbourTolerance);
    if (r.h <= rank_) continue;
    rank_ = r.h;
    can_move = r.h_r == r.h;
  }
  return can_move;
}

void DrivenLinkage::find_branch_rows(const std::vector<const State<double>*>& poses) {
  if (undetermined() > 0) return;
  VectorXd largest = VectorXd::Zero(closed_->mechanism.cut_row_count());
  for (const State<double>* s : poses) {
    largest = largest.cwiseMax(dependent_jacobian(*s).rowwise().norm());
  }
  for (int r = 0; r < largest.size(); ++r) {
    if (largest[r] > kMobilityTolerance) branch_rows_.push_back(r);
  }
  if (static_cast<int>(branch_rows_.size()) != rank_) branch_rows_.clear();
}

std::vector<int> DrivenLinkage::columns_of_m_and_n() const {
  std::vector<int> all = dependent_;
  all.insert(all.end(), driven_.begin(), driven_.end());
  return all;
}

void DrivenLinkage::find_size(const State<double>& pose) {
  const MatrixXd r =
      take_columns(compute_scaled_closures(*closed_, scale_, pose).jacobian, columns_of_m_and_n());
  size_ = r.size() == 0 ? 1.0 : std::max(singular_values(r)[0], kLeastRowSize);
}

MatrixXd DrivenLinkage::dependent_jacobian(const State<double>& s) const {
  return take_columns(compute_scaled_closures(*closed_, scale_, s).jacobian, dependent_);
}

DriveRanks DrivenLinkage::ranks(const State<double>& s, double tolerance) const {
  const MatrixXd j = compute_scaled_closures(*closed_, scale_, s).jacobian;
  const int z = static_cast<int>(dependent_.size());
  const double least = std::max(kLeastRowSize, size_);
  return {z, numerical_rank(take_columns(j, dependent_), tolerance, least).rank,
          numerical_rank(take_columns(j, columns_of_m_and_n()), tolerance, least).rank};
}

VectorXd DrivenLinkage::drive_position(const State<double>& s) const {
  VectorXd position(static_cast<Eigen::Index>(drives_.size()));
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    position[static_cast<Eigen::Index>(i)] = s.q[drives_[i].position];
  }
  return position;
}

VectorXd DrivenLinkage::without_dimensions(const VectorXd& of_drives) const {
  VectorXd x = of_drives;
  for (std::size_t i = 0; i < driven_.size(); ++i) {
    x[static_cast<Eigen::Index>(i)] /= scale_.velocity[driven_[i]];
  }
  return x;
}

VectorXd DrivenLinkage::scatter_drives(const VectorXd& of_drives) const {
  return scatter_entries(of_drives, driven_, closed_->mechanism.nv);
}

State<double> DrivenLinkage::moved(const State<double>& s, const VectorXd& dy,
                                   const VectorXd& drive_position) const {
  State<double> next = displaced(closed_->mechanism, s, scale_.velocity.cwiseProduct(dy));
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    next.q[drives_[i].position] = drive_position[static_cast<Eigen::Index>(i)];
  }
  return next;
}

bool DrivenLinkage::close(State<double>& s) const {
  const Mechanism& m = closed_->mechanism;
  if (rank_ == 0) return residual(s) < kClosedTolerance;
  for (int i = 0; i < kMostCorrections; ++i) {
    const ScaledClosures c = compute_scaled_closures(*closed_, scale_, s);
    const SingularValues svd = decompose(take_columns(c.jacobian, dependent_));
    const VectorXd x = solve_within(svd, rank_, -c.residual);
    if (!(x.norm() < kLongestCorrection)) return false;
    s = displaced(m, s, scale_.velocity.cwiseProduct(scatter_entries(x, dependent_, m.nv)));
    if (x.norm() >= kCorrection) continue;
    // What redundant rows leave open by their rounding no correction can close.
    const VectorXd left = compute_scaled_closures(*closed_, scale_, s).residual;
    const double independent = (svd.u.leftCols(rank_).transpose() * left).norm();
    if (independent < kResidual && left.norm() < kClosedTolerance) return true;
  }
  return false;
}

DrivenRates DrivenLinkage::rates(const State<double>& given, const VectorXd& rate,
                                 const VectorXd& second_rate) const {
  const int nv = closed_->mechanism.nv;
  DrivenRates r{rate, scatter_drives(rate), scatter_drives(second_rate)};
  if (rank_ == 0) return r;
  State<double> s = given;
  const MatrixXd j = compute_scaled_closures(*closed_, scale_, s).jacobian;
  const SingularValues svd = decompose(take_columns(j, dependent_));
  r.quality = svd.values[rank_ - 1] / size_;
  r.is_singular = r.quality < kSingularQuality;
  r.first += scatter_entries(solve_within(svd, rank_, -j * r.first), dependent_, nv);
  for (const VelocityIndex k : indices_of(s.v)) {
    s.v[k] = scale_.velocity[k.value()] * r.first[k.value()];
  }
  const VectorXd bias = compute_scaled_closures(*closed_, scale_, s).bias;
  r.second += scatter_entries(solve_within(svd, rank_, -bias - j * r.second), dependent_, nv);
  if (undetermined() > 0) r.second += turning_of_least_norm(s, j, svd, r.first);
  return r;
}

// With y_dot = M^+ b: (1 - M^+ M) M_dot^T (M^+)^T y_dot, because the null space of M turns.
VectorXd DrivenLinkage::turning_of_least_norm(const State<double>& s, const MatrixXd& jacobian,
                                              const SingularValues& svd,
                                              const VectorXd& rates) const {
  const int nv = closed_->mechanism.nv, n = followed(svd, rank_);
  const auto V = svd.v.leftCols(n);
  const VectorXd y = take_columns(rates.transpose(), dependent_).transpose();
  const VectorXd w = svd.u.leftCols(n) * (V.transpose() * y).cwiseQuotient(svd.values.head(n));
  JacobianRate jacobian_rate(*closed_, scale_, s, jacobian, rates);
  VectorXd turned(y.size());
  for (std::size_t i = 0; i < dependent_.size(); ++i) {
    turned[static_cast<Eigen::Index>(i)] =
        w.dot(jacobian_rate.times(VectorXd::Unit(nv, dependent_[i])));
  }
  return scatter_entries(turned - V * (V.transpose() * turned), dependent_, nv);
}

double DrivenLinkage::quality(const State<double>& s) const {
  if (rank_ == 0) return 1.0;
  return singular_values(dependent_jacobian(s))[rank_ - 1] / size_;
}

int DrivenLinkage::branch(const State<double>& s) const {
  if (branch_rows_.empty() || quality(s) < kSingularQuality) return 0;
  const MatrixXd j = compute_scaled_closures(*closed_, scale_, s).jacobian;
  const MatrixXd m = take_columns_by_turns(*closed_, s, j, dependent_);
  return determinant(take_columns(m.transpose(), branch_rows_)) > 0.0 ? 1 : -1;
}

double DrivenLinkage::residual(const State<double>& s) const {
  return compute_scaled_closures(*closed_, scale_, s).residual.norm();
}

VectorXd DrivenLinkage::difference(const State<double>& a, const State<double>& b) const {
  return scaled_difference(closed_->mechanism, scale_, a, b);
}

std::vector<std::string> DrivenLinkage::loose_joints(const State<double>& s) const {
  constexpr double kShare = 0.05;  // of the joint that moves most
  std::vector<std::string> names;
  if (rank_ == 0) return names;
  const Mechanism& m = closed_->mechanism;
  const SingularValues svd = decompose(dependent_jacobian(s));
  VectorXd moves = VectorXd::Zero(static_cast<Eigen::Index>(dependent_.size()));
  const double weakest = svd.values[rank_ - 1];
  for (int i = 0; i < rank_; ++i) {
    const bool is_weak = svd.values[i] <= 10.0 * weakest + 1e-7;
    if (is_weak) moves += svd.v.col(i).cwiseAbs();
  }
  const double most = moves.maxCoeff();
  for (std::size_t i = 0; i < dependent_.size(); ++i) {
    if (moves[static_cast<Eigen::Index>(i)] < kShare * most) continue;
    const BodyIndex body = m.velocities[VelocityIndex(dependent_[i])].body;
    const std::string name = "joint." + m.joint_names[body];
    if (names.empty() || names.back() != name) names.push_back(name);
  }
  return names;
}

}  // namespace linkstudy
