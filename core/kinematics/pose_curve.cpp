#include "core/kinematics/pose_curve.h"

#include "core/numerics/continuation.h"

namespace linkstudy {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kIterations = 20;
constexpr double kSettled = 1e-13;  // of the last correction, rad and extents

}  // namespace

VectorXd PoseCurve::rising() const {
  return VectorXd::Unit(count() + 1, count());
}

VectorXd PoseCurve::tangent(const State<double>& s, const VectorXd& sense) const {
  return unit_tangent(jacobian(s), sense);
}

std::optional<State<double>> PoseCurve::at(const State<double>& s, const VectorXd& way) const {
  State<double> x = moved(s, way);
  for (int i = 0; i < kIterations; ++i) {
    const VectorXd residual =
        compute_scaled_closures(linkage_.model(), linkage_.scale(), x).residual;
    const VectorXd step = least_correction(jacobian(x), residual, linkage_.rank());
    if (!step.allFinite()) return std::nullopt;
    x = moved(x, step);
    if (step.norm() < kSettled) break;
  }
  return linkage_.residual(x) < kClosedTolerance ? std::optional(x) : std::nullopt;
}

double PoseCurve::way_between(const State<double>& a, const State<double>& b) const {
  const VectorXd way =
      linkage_.without_dimensions(linkage_.drive_position(b) - linkage_.drive_position(a));
  return way.dot(direction_) / direction_.norm();
}

MatrixXd PoseCurve::jacobian(const State<double>& s) const {
  const MatrixXd j = compute_scaled_closures(linkage_.model(), linkage_.scale(), s).jacobian;
  MatrixXd wide(j.rows(), count() + 1);
  VectorXd driven = VectorXd::Zero(j.rows());
  for (std::size_t i = 0; i < linkage_.drives().size(); ++i) {
    driven +=
        direction_[static_cast<Eigen::Index>(i)] * j.col(linkage_.drives()[i].velocity.value());
  }
  wide << take_columns(j, linkage_.dependent()), driven;
  return wide;
}

State<double> PoseCurve::moved(const State<double>& s, const VectorXd& way) const {
  const int nv = linkage_.model().mechanism.nv;
  const VectorXd dy = scatter_entries(way.head(count()), linkage_.dependent(), nv);
  VectorXd drives = linkage_.drive_position(s);
  for (std::size_t i = 0; i < linkage_.drives().size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const double unit = linkage_.scale().velocity[linkage_.drives()[i].velocity.value()];
    drives[k] += unit * direction_[k] * way[count()];
  }
  return linkage_.moved(s, dy, drives);
}

}  // namespace linkstudy
