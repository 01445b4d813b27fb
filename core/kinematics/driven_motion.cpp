#include "core/kinematics/driven_motion.h"

#include <Eigen/SVD>
#include <algorithm>

namespace linkstudy {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Svd = Eigen::JacobiSVD<MatrixXd>;

constexpr int kMaxIterations = 15;
constexpr double kResidual = 1e-12;    // without dimensions
constexpr double kCorrection = 1e-10;  // of the last iteration
constexpr double kFarthest = 1.0;      // a longer correction leads elsewhere
constexpr double kCutoff = 1e-9;       // of singular values that a correction follows, relative

Svd decompose(const MatrixXd& a) {
  return Svd(a, Eigen::ComputeThinU | Eigen::ComputeThinV);
}

// Least-norm solution of a x = b in the first `rank` singular directions.
VectorXd solve_within(const Svd& svd, int rank, const VectorXd& b) {
  VectorXd x = VectorXd::Zero(svd.matrixV().rows());
  for (int i = 0; i < rank; ++i) {
    const double size = svd.singularValues()[i];
    if (size <= kCutoff * svd.singularValues()[0]) break;
    x += svd.matrixV().col(i) * (svd.matrixU().col(i).dot(b) / size);
  }
  return x;
}

std::string numbered(const std::string& name, int index, int count) {
  return count > 1 ? name + "." + std::to_string(index) : name;
}

}  // namespace

std::vector<Drive> list_drives(const Mechanism& m) {
  std::vector<Drive> drives;
  for (int b = 1; b < m.body_count(); ++b) {
    const Body& body = m.bodies[static_cast<std::size_t>(b)];
    for (int i = body.stage_begin; i < body.stage_end; ++i) {
      const Stage& stage = m.stages[static_cast<std::size_t>(i)];
      if (stage.motion == BasicMotion::ball) continue;
      const std::string name = "joint." + m.joint_names[static_cast<std::size_t>(b)];
      const auto kind = m.velocities[static_cast<std::size_t>(stage.v)].kind;
      drives.push_back({numbered(name, stage.v - body.v_begin, body.v_count), stage.q, stage.v,
                        kind != VelocityKind::translation});
    }
  }
  return drives;
}

DrivenLinkage::DrivenLinkage(const Model& closed, const State<double>& pose,
                             const MobilityReport& mobility, const Drive& drive)
    : closed_(&closed), scale_(find_closure_scale(closed, pose)), drive_(drive) {
  unit_ = scale_.velocity[drive.velocity];
  std::vector<const State<double>*> poses = {&pose};
  for (const State<double>& s : mobility.neighbours) poses.push_back(&s);
  choose_dependent(true);
  if (find_rank(poses) || closed.held.empty()) return;
  releases_holds_ = true;
  choose_dependent(false);
  find_rank(poses);
}

void DrivenLinkage::choose_dependent(bool keep_holds) {
  const std::vector<int>& held = closed_->held;
  dependent_.clear();
  for (int k = 0; k < closed_->mechanism.nv; ++k) {
    const bool rests = keep_holds && std::find(held.begin(), held.end(), k) != held.end();
    if (k != drive_.velocity && !rests) dependent_.push_back(k);
  }
}

bool DrivenLinkage::find_rank(const std::vector<const State<double>*>& poses) {
  std::vector<int> with_drive = dependent_;
  with_drive.push_back(drive_.velocity);
  bool can_move = false;
  rank_ = -1;
  for (const State<double>* s : poses) {
    const MatrixXd j = compute_scaled_closures(*closed_, scale_, *s).jacobian;
    const int rank = numerical_rank(take_columns(j, dependent_), kMobilityTolerance).rank;
    if (rank <= rank_) continue;
    rank_ = rank;
    can_move = numerical_rank(take_columns(j, with_drive), kMobilityTolerance).rank == rank;
  }
  return can_move;
}

MatrixXd DrivenLinkage::dependent_jacobian(const State<double>& s) const {
  return take_columns(compute_scaled_closures(*closed_, scale_, s).jacobian, dependent_);
}

State<double> DrivenLinkage::moved(const State<double>& s, const VectorXd& dy, double theta) const {
  State<double> next = displaced(closed_->mechanism, s, scale_.velocity.cwiseProduct(dy));
  next.q[static_cast<std::size_t>(drive_.position)] = coordinate(theta);
  return next;
}

bool DrivenLinkage::close(State<double>& s) const {
  const Mechanism& m = closed_->mechanism;
  double residual = compute_scaled_closures(*closed_, scale_, s).residual.norm();
  for (int i = 0; i < kMaxIterations && rank_ > 0; ++i) {
    const ScaledClosures c = compute_scaled_closures(*closed_, scale_, s);
    const VectorXd x =
        solve_within(decompose(take_columns(c.jacobian, dependent_)), rank_, -c.residual);
    if (!(x.norm() < kFarthest)) return false;
    s = displaced(m, s, scale_.velocity.cwiseProduct(scatter_entries(x, dependent_, m.nv)));
    residual = compute_scaled_closures(*closed_, scale_, s).residual.norm();
    if (residual < kResidual && x.norm() < kCorrection) return true;
  }
  return rank_ == 0 && residual < kResidual;
}

DrivenPose DrivenLinkage::evaluate(const State<double>& given) const {
  const int nv = closed_->mechanism.nv;
  DrivenPose pose{given, theta(given.q[static_cast<std::size_t>(drive_.position)]), {}, {}};
  pose.t = pose.c = VectorXd::Zero(nv);
  pose.t[drive_.velocity] = 1.0;
  const ScaledClosures c = compute_scaled_closures(*closed_, scale_, pose.s);
  pose.residual = c.residual.norm();
  pose.quality = 1.0;
  const auto set_rates = [&] {
    for (int k = 0; k < nv; ++k) {
      pose.s.v[static_cast<std::size_t>(k)] = scale_.velocity[k] * pose.t[k];
    }
  };
  if (rank_ > 0) {
    const Svd svd = decompose(take_columns(c.jacobian, dependent_));
    pose.quality = svd.singularValues()[rank_ - 1] / svd.singularValues()[0];
    pose.is_singular = pose.quality < kSingularQuality;
    pose.t +=
        scatter_entries(solve_within(svd, rank_, -c.jacobian.col(drive_.velocity)), dependent_, nv);
    set_rates();
    const VectorXd bias = compute_scaled_closures(*closed_, scale_, pose.s).bias;
    pose.c = scatter_entries(solve_within(svd, rank_, -bias), dependent_, nv);
  }
  set_rates();
  return pose;
}

VectorXd DrivenLinkage::velocity(const DrivenPose& pose, double rate) const {
  return scale_.velocity.cwiseProduct(pose.t * (rate / unit_));
}

VectorXd DrivenLinkage::acceleration(const DrivenPose& pose, double rate, double rate_dot) const {
  const double theta_dot = rate / unit_;
  return scale_.velocity.cwiseProduct(pose.c * (theta_dot * theta_dot) +
                                      pose.t * (rate_dot / unit_));
}

std::vector<std::string> DrivenLinkage::loose_joints(const State<double>& s) const {
  constexpr double kShare = 0.05;  // of the joint that moves most
  std::vector<std::string> names;
  if (rank_ == 0) return names;
  const Mechanism& m = closed_->mechanism;
  const Svd svd = decompose(dependent_jacobian(s));
  VectorXd moves = VectorXd::Zero(static_cast<Eigen::Index>(dependent_.size()));
  const double weakest = svd.singularValues()[rank_ - 1];
  for (int i = 0; i < rank_; ++i) {
    const bool is_weak = svd.singularValues()[i] <= 10.0 * weakest + 1e-7;
    if (is_weak) moves += svd.matrixV().col(i).cwiseAbs();
  }
  const double most = moves.maxCoeff();
  for (std::size_t i = 0; i < dependent_.size(); ++i) {
    if (moves[static_cast<Eigen::Index>(i)] < kShare * most) continue;
    const auto body =
        static_cast<std::size_t>(m.velocities[static_cast<std::size_t>(dependent_[i])].body);
    const std::string name = "joint." + m.joint_names[body];
    if (names.empty() || names.back() != name) names.push_back(name);
  }
  return names;
}

}  // namespace linkstudy
