#include "core/kinematics/singular_position.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "core/numerics/bracketed_root.h"

namespace linkstudy {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kFirstStep = 1e-6;  // of the arc length, rad and extents
constexpr double kFarthest = 0.3;
constexpr int kIterations = 12;
constexpr double kClosed = 1e-13;  // of the scaled rows

// Closed poses as a curve: the dependent coordinates y and the way x of the drives along a
// direction, J = (M, N direction).
class Curve {
 public:
  Curve(const DrivenLinkage& linkage, const VectorXd& direction)
      : linkage_(linkage), direction_(direction) {}

  // Unit tangent (nv, and x last), with x rising unless it turns.
  VectorXd tangent(const State<double>& s, const VectorXd& sense) const {
    const VectorXd t = decompose(s).matrixV().rightCols<1>();
    return t.dot(sense) < 0.0 ? VectorXd(-t) : t;
  }
  VectorXd rising() const { return VectorXd::Unit(count() + 1, count()); }

  // The closed pose nearest to the one a way along a tangent.
  std::optional<State<double>> at(const State<double>& s, const VectorXd& way) const {
    State<double> x = moved(s, way);
    for (int i = 0; i < kIterations; ++i) {
      const VectorXd residual =
          compute_scaled_closures(linkage_.model(), linkage_.scale(), x).residual;
      if (residual.norm() < kClosed) return x;
      x = moved(x, correction(x, residual));
    }
    return linkage_.residual(x) < 10.0 * kClosed ? std::optional(x) : std::nullopt;
  }

 private:
  using Svd = Eigen::JacobiSVD<MatrixXd>;

  Index count() const { return static_cast<Index>(linkage_.dependent().size()); }

  Svd decompose(const State<double>& s) const {
    const MatrixXd j = compute_scaled_closures(linkage_.model(), linkage_.scale(), s).jacobian;
    MatrixXd wide(j.rows(), count() + 1);
    VectorXd driven = VectorXd::Zero(j.rows());
    for (std::size_t i = 0; i < linkage_.drives().size(); ++i) {
      driven += direction_[static_cast<Index>(i)] * j.col(linkage_.drives()[i].velocity);
    }
    wide << take_columns(j, linkage_.dependent()), driven;
    return Svd(wide, Eigen::ComputeFullU | Eigen::ComputeFullV);
  }

  // Of least norm, in the directions that the equations decide at regular poses.
  VectorXd correction(const State<double>& s, const VectorXd& residual) const {
    const Svd svd = decompose(s);
    VectorXd x = VectorXd::Zero(count() + 1);
    for (Index i = 0; i < linkage_.rank(); ++i) {
      x -= svd.matrixV().col(i) * (svd.matrixU().col(i).dot(residual) / svd.singularValues()[i]);
    }
    return x;
  }

  State<double> moved(const State<double>& s, const VectorXd& way) const {
    const int nv = linkage_.model().mechanism.nv;
    const VectorXd dy = scatter_entries(way.head(count()), linkage_.dependent(), nv);
    VectorXd drives = linkage_.drive_position(s);
    for (std::size_t i = 0; i < linkage_.drives().size(); ++i) {
      const double unit = linkage_.scale().velocity[linkage_.drives()[i].velocity];
      drives[static_cast<Index>(i)] += unit * direction_[static_cast<Index>(i)] * way[count()];
    }
    return linkage_.moved(s, dy, drives);
  }

  const DrivenLinkage& linkage_;
  VectorXd direction_;
};

}  // namespace

SingularPosition describe_singular(const DrivenLinkage& linkage, SingularKind kind, double time,
                                   const State<double>& s) {
  SingularPosition p;
  p.kind = kind;
  p.time = time;
  p.drive = linkage.drive_position(s);
  p.quality = linkage.quality(s);
  // As far as the position is known, and well below the next singular value.
  p.ranks = linkage.ranks(s, std::clamp(10.0 * p.quality, kMobilityTolerance, 1e-4));
  p.regular_rank = linkage.rank();
  p.joints = linkage.loose_joints(s);
  return p;
}

std::optional<State<double>> find_turning_pose(const DrivenLinkage& linkage, const State<double>& s,
                                               const VectorXd& direction) {
  if (linkage.undetermined() > 0 || linkage.rank() == 0) return std::nullopt;
  const Curve curve(linkage, direction);
  const VectorXd first = curve.tangent(s, curve.rising());
  State<double> best = s;
  bool is_lost = false;
  // Rate of the drives a length further on.
  const auto rate = [&](double length) {
    const auto reached = curve.at(s, length * first);
    is_lost = is_lost || !reached;
    if (!reached) return 0.0;
    best = *reached;
    return curve.tangent(best, first)[first.size() - 1];
  };
  double low = 0.0, at_low = first[first.size() - 1];
  for (double high = kFirstStep; high < kFarthest; high *= 2.0) {
    const double at_high = rate(high);
    if (is_lost) return std::nullopt;
    if (at_high <= 0.0) {
      const Bracket found = bracket_root(rate, low, high, at_low, at_high);
      rate(found.first);
      return is_lost ? std::nullopt : std::optional(best);
    }
    low = high;
    at_low = at_high;
  }
  return std::nullopt;
}

}  // namespace linkstudy
