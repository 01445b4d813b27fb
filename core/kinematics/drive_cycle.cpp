#include "core/kinematics/drive_cycle.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace linkstudy {
namespace {

using Eigen::VectorXd;

constexpr double kLongestStep = 0.03;    // norm of h t, rad and extents
constexpr double kShortestStep = 1e-12;  // of theta
constexpr double kCorrected = 0.2;       // largest correction, relative to the step
constexpr double kTurned = 0.3;          // largest change of t against its prediction, relative
constexpr double kRunaway = 300.0;       // norm of t where a stuck drive is locked
constexpr double kSuspect = 0.1;         // quality below which a minimum is looked into
constexpr double kCrossing = 1e-5;       // quality of a minimum that counts as zero
constexpr double kSamePosition = 1e-6;   // of theta
constexpr double kGolden = 0.6180339887498949;

// Quintic that meets positions 0 and d and the rates and second rates of both ends; 0 <= x <= 1.
VectorXd interpolate(const DrivenPose& a, const DrivenPose& b, const VectorXd& d, double x) {
  const double h = b.theta - a.theta;
  const VectorXd v0 = h * a.t, v1 = h * b.t, c0 = 0.5 * h * h * a.c, c1 = 0.5 * h * h * b.c;
  const VectorXd e = d - v0 - c0;
  const VectorXd f = v1 - v0 - 2.0 * c0;
  const VectorXd g = c1 - c0;
  const VectorXd k3 = 10.0 * e - 4.0 * f + g;
  const VectorXd k4 = -15.0 * e + 7.0 * f - 2.0 * g;
  const VectorXd k5 = 6.0 * e - 3.0 * f + g;
  return x * (v0 + x * (c0 + x * (k3 + x * (k4 + x * k5))));
}

class Follower {
 public:
  Follower(const DrivenLinkage& linkage, std::vector<SingularPosition>& singular)
      : linkage_(linkage), singular_(singular) {}

  void begin(const DrivenPose& start) {
    track_ = {start};
    stride_ = kLongestStep;
    if (start.is_singular) note(SingularKind::branch, start.theta, start.s, start.quality);
  }
  const DrivenPose& pose() const { return track_.back(); }

  // False if the drive is locked before `target`.
  bool advance(double target) {
    while (std::abs(target - pose().theta) > kSamePosition * 1e-3) {
      if (!step_towards(target) && !jump_towards(target)) {
        note(SingularKind::lock, pose().theta, pose().s, pose().quality);
        return false;
      }
    }
    return true;
  }

  // A pose that ends the course counts as singular without a step beyond it.
  void end() {
    if (pose().is_singular) note(SingularKind::branch, pose().theta, pose().s, pose().quality);
  }

 private:
  std::optional<DrivenPose> try_step(double h) const {
    const DrivenPose& a = pose();
    const VectorXd dy = h * a.t + 0.5 * h * h * a.c;
    const State<double> predicted = linkage_.moved(a.s, dy, a.theta + h);
    State<double> s = predicted;
    if (!linkage_.close(s)) return std::nullopt;
    const Mechanism& m = linkage_.model().mechanism;
    const double correction = scaled_difference(m, linkage_.scale(), predicted, s).norm();
    if (correction > kCorrected * (h * a.t).norm()) return std::nullopt;
    DrivenPose b = linkage_.evaluate(s);
    const VectorXd expected = a.t + h * a.c;
    if (b.is_singular) {
      b.t = expected;
      b.c = a.c;
      return b;
    }
    const bool turns_off = (b.t - expected).norm() > kTurned * std::max(a.t.norm(), b.t.norm());
    return turns_off && !is_lax(a) ? std::nullopt : std::optional(b);
  }

  // After a pose whose rates are only continued, those that follow may differ a little more.
  static bool is_lax(const DrivenPose& a) { return a.is_singular && a.c.isZero(); }

  bool step_towards(double target) {
    const double sense = target > pose().theta ? 1.0 : -1.0;
    for (double length = stride_;; length *= 0.5) {
      const double left = std::abs(target - pose().theta);
      const double h = std::min(left, length / pose().t.norm());
      if (h < kShortestStep) return false;
      std::optional<DrivenPose> next = try_step(sense * h);
      if (!next) continue;
      stride_ = std::min(kLongestStep, 2.0 * length);
      if (h == left) next->theta = target;
      add(std::move(*next));
      return true;
    }
  }

  // Over a crossing of branches that stops small steps.
  bool jump_towards(double target) {
    stride_ = kLongestStep;
    if (pose().t.norm() > kRunaway) return false;
    for (const double length : {0.01, 0.02, 0.05}) {
      const double h = std::min(std::abs(target - pose().theta), length / pose().t.norm());
      std::optional<DrivenPose> next = try_step(target > pose().theta ? h : -h);
      if (!next || next->is_singular) continue;
      add(std::move(*next));
      return true;
    }
    return false;
  }

  void add(DrivenPose next) {
    track_.push_back(std::move(next));
    if (track_.size() < 3) return;
    if (track_.size() > 3) track_.erase(track_.begin());
    const bool is_lowest =
        track_[1].quality <= track_[0].quality && track_[1].quality < track_[2].quality;
    if (is_lowest && track_[1].quality < kSuspect) look_between(track_[0], track_[2]);
  }

  State<double> between(const DrivenPose& a, const DrivenPose& b, double x) const {
    const Mechanism& m = linkage_.model().mechanism;
    const VectorXd d = scaled_difference(m, linkage_.scale(), a.s, b.s);
    return linkage_.moved(a.s, interpolate(a, b, d, x), a.theta + x * (b.theta - a.theta));
  }

  // Golden section for the lowest quality between two poses.
  void look_between(const DrivenPose& a, const DrivenPose& b) {
    const auto quality = [&](double x) { return linkage_.evaluate(between(a, b, x)).quality; };
    double low = 0.0, high = 1.0;
    double x1 = high - kGolden * (high - low), x2 = low + kGolden * (high - low);
    double f1 = quality(x1), f2 = quality(x2);
    while (high - low > 1e-9) {
      if (f1 < f2) {
        high = x2, x2 = x1, f2 = f1;
        x1 = high - kGolden * (high - low);
        f1 = quality(x1);
      } else {
        low = x1, x1 = x2, f1 = f2;
        x2 = low + kGolden * (high - low);
        f2 = quality(x2);
      }
    }
    const double lowest = std::min(f1, f2);
    if (lowest > kCrossing) return;
    const double x = f1 < f2 ? x1 : x2;
    note(SingularKind::branch, a.theta + x * (b.theta - a.theta), between(a, b, x), lowest);
  }

  void note(SingularKind kind, double theta, const State<double>& s, double quality) {
    const double drive = linkage_.coordinate(theta);
    const bool is_known = std::any_of(singular_.begin(), singular_.end(), [&](const auto& known) {
      return std::abs(linkage_.theta(known.drive) - theta) < kSamePosition;
    });
    if (!is_known) singular_.push_back({kind, drive, quality, linkage_.loose_joints(s)});
  }

  const DrivenLinkage& linkage_;
  std::vector<SingularPosition>& singular_;
  std::vector<DrivenPose> track_;  // the last three
  double stride_ = kLongestStep;   // norm of the next h t
};

// At a singular start the linear solves do not tell the motion; the neighbour that turns the drive
// most does.
void continue_from_neighbours(const DrivenLinkage& linkage, const MobilityReport& mobility,
                              DrivenPose& start) {
  double best = 0.0;
  for (const State<double>& s : mobility.neighbours) {
    const VectorXd d = scaled_difference(linkage.model().mechanism, linkage.scale(), start.s, s);
    const double driven = d[linkage.drive().velocity];
    if (std::abs(driven) <= best * d.norm()) continue;
    best = std::abs(driven) / d.norm();
    start.t = d / driven;
    start.c.setZero();
  }
}

// Poses at from, from + step, ... as far as they can be reached, at most `count`.
std::vector<DrivenPose> visit(Follower& follower, double from, double step, int count) {
  std::vector<DrivenPose> poses;
  for (int i = 0; i < count && follower.advance(from + i * step); ++i) {
    poses.push_back(follower.pose());
  }
  if (static_cast<int>(poses.size()) == count) follower.end();
  return poses;
}

}  // namespace

DriveCycle follow_drive(const DrivenLinkage& linkage, const State<double>& start,
                        const MobilityReport& mobility, const CourseOptions& options) {
  DriveCycle cycle;
  DrivenPose first = linkage.evaluate(start);
  if (first.is_singular) continue_from_neighbours(linkage, mobility, first);
  Follower follower(linkage, cycle.singular);
  follower.begin(first);
  const double from = linkage.theta(options.from);
  cycle.is_reached = follower.advance(from);
  if (!cycle.is_reached) return cycle;
  const DrivenPose begin = follower.pose();
  cycle.singular.clear();  // of the way to `from`
  follower.begin(begin);
  const int count = std::max(options.positions, 2);
  const double step = (linkage.theta(options.to) - from) / (count - 1);
  cycle.poses = visit(follower, from, step, count);
  cycle.is_complete = static_cast<int>(cycle.poses.size()) == count;
  if (cycle.is_complete || !options.both_ways) return cycle;
  follower.begin(begin);
  std::vector<DrivenPose> back = visit(follower, from - step, -step, count - 1);
  std::reverse(back.begin(), back.end());
  cycle.poses.insert(cycle.poses.begin(), back.begin(), back.end());
  return cycle;
}

}  // namespace linkstudy
