#include "core/kinematics/singular_position.h"

#include <algorithm>

#include "core/kinematics/pose_curve.h"
#include "core/kinematics/three_turns.h"
#include "core/numerics/bracketed_root.h"

namespace linkstudy {
namespace {

using Eigen::VectorXd;

constexpr double kFirstStep = 1e-7;  // of the arc length, rad and extents
constexpr double kFarthest = 0.3;

SingularKind kind_of(const SingularPosition& p) {
  if (p.ranks.h < p.ranks.h_r) return SingularKind::lock;
  return p.ranks.h < p.regular_rank ? SingularKind::branch : SingularKind::stop;
}

}  // namespace

SingularPosition describe_singular(const DrivenLinkage& linkage, double time,
                                   const State<double>& s) {
  SingularPosition p;
  p.time = time;
  p.s = s;
  p.drive = linkage.drive_position(s);
  p.quality = linkage.quality(s);
  // As far as the position is known, and well below the next singular value.
  p.ranks = linkage.ranks(s, std::clamp(10.0 * p.quality, kMobilityTolerance, 1e-4));
  p.regular_rank = linkage.rank();
  p.joints = linkage.loose_joints(s);
  p.kind = kind_of(p);
  p.angles = singular_angles(linkage.model().mechanism, s.q);
  return p;
}

std::optional<State<double>> find_turning_pose(const DrivenLinkage& linkage, const State<double>& s,
                                               const VectorXd& direction) {
  if (!PoseCurve::exists(linkage)) return std::nullopt;
  const PoseCurve curve(linkage, direction);
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
