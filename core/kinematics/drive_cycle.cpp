#include "core/kinematics/drive_cycle.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/kinematics/pose_curve.h"

namespace linkstudy {
namespace {

using Eigen::VectorXd;

constexpr double kLongestStride = 0.03;  // norm of the rates over a step, rad and extents
constexpr double kShortestStep = 1e-12;  // of the drives, rad and extents
constexpr double kCorrected = 0.2;       // largest correction, relative to the step
constexpr double kTurned = 0.3;          // largest change of the rates against their prediction
constexpr double kRunaway = 300.0;  // of dependent to driven rates where a stuck drive is locked
constexpr double kSuspect = 0.1;    // quality below which a minimum is looked into
constexpr double kCrossing = 1e-5;  // quality of a minimum that counts as zero
constexpr double kApproach = 0.5;   // of the way to where the quality would be zero
constexpr double kNearest = 1e-5;   // steps near there, rad and extents
constexpr double kSamePosition = 1e-4;  // of all coordinates, rad and extents
constexpr double kArrived = 1e-9;       // of the drives at a lock that ends the course
constexpr double kGolden = 0.6180339887498949;

// A closed pose on the course.
struct Place {
  double time;
  State<double> s;
  double quality;
  bool is_singular;
  DrivenRates continued;  // rates there if it is singular
  VectorXd leave;         // at a lock: the sense in which the curve of poses is left; else empty
};

// What is left of rates where nothing moves yet.
DrivenRates no_rates(const DrivenLinkage& linkage) {
  const auto n = static_cast<Eigen::Index>(linkage.drives().size());
  const int nv = linkage.model().mechanism.nv;
  return {VectorXd::Zero(n), VectorXd::Zero(nv), VectorXd::Zero(nv), 0.0, true};
}

// Rates for other rates of the drives, as far as these have the direction of the given ones.
DrivenRates rescaled(const DrivenRates& r, const VectorXd& rate, const VectorXd& second_rate) {
  const double square = std::max(r.drive.squaredNorm(), 1e-300);
  const double first = rate.dot(r.drive) / square, second = second_rate.dot(r.drive) / square;
  DrivenRates scaled = r;
  scaled.drive = rate;
  scaled.first = first * r.first;
  scaled.second = first * first * r.second + second * r.first;
  return scaled;
}

// Quintic that meets positions 0 and d and the rates and second rates of both ends, h apart;
// 0 <= x <= 1.
VectorXd interpolate(const DrivenRates& a, const DrivenRates& b, const VectorXd& d, double h,
                     double x) {
  const VectorXd v0 = h * a.first, v1 = h * b.first;
  const VectorXd c0 = 0.5 * h * h * a.second, c1 = 0.5 * h * h * b.second;
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
  Follower(const DrivenLinkage& linkage, const DrivePath& path,
           std::vector<SingularPosition>& singular)
      : linkage_(linkage), path_(path), singular_(singular) {}

  void begin(const Place& start) {
    track_ = {start};
    stride_ = kLongestStride;
    see_quality();
    if (start.is_singular) note(start.time, start.s);
  }
  const Place& place() const { return track_.back(); }
  const Transmission& worst() const { return worst_; }

  // False if the drives cannot get to `target`.
  bool advance(double target) {
    while (place().time != target) {
      const bool leaves = place().leave.size() > 0;
      const bool is_taken =
          leaves ? leave_lock(target) : step_towards(target) || jump_towards(target);
      if (!is_taken) return stop_at_lock(target);
    }
    return true;
  }

  // A pose that ends the course counts as singular without a step beyond it.
  void end() {
    if (place().quality < kCrossing) note(place().time, place().s);
  }

  DrivenPose pose() const {
    const DriveMotion motion = path_.at(place().time);
    const DrivenRates r = rates_at(place());
    const VectorXd v = linkage_.scale().velocity.cwiseProduct(r.first);
    const VectorXd a = linkage_.scale().velocity.cwiseProduct(r.second);
    DrivenPose pose{place().time,         place().s,       motion.position,
                    {a.begin(), a.end()}, place().quality, linkage_.residual(place().s),
                    place().is_singular};
    pose.s.v.assign(v.begin(), v.end());
    return pose;
  }

 private:
  struct Step {
    double h;            // s
    DrivenRates motion;  // over a unit of time, to the drives' next place
  };

  // What the drives do between now and now + h, straight.
  DrivenRates motion_over(double h) const {
    const Place& a = place();
    const VectorXd delta =
        linkage_.without_dimensions(path_.position(a.time + h) - path_.position(a.time));
    const VectorXd none = VectorXd::Zero(delta.size());
    return a.is_singular ? rescaled(a.continued, delta, none) : linkage_.rates(a.s, delta, none);
  }

  // Towards `target`, as far as the course can be taken for straight.
  double longest_time(double target) const {
    const double left = target - place().time;
    return std::copysign(std::min(std::abs(left), path_.longest_step()), left);
  }

  // The step towards `target` over which the rates have this norm at most.
  Step choose_step(double length, double target) const {
    double h = longest_time(target);
    for (;;) {
      Step step{h, motion_over(h)};
      const double norm = step.motion.first.norm();
      const bool is_short = step.motion.drive.norm() < kShortestStep;
      if (norm <= length * (1.0 + 1e-9) || is_short) return step;
      h *= norm < 100.0 * length ? length / norm : 0.01;
    }
  }

  std::optional<Place> try_step(const Step& step) const {
    const Place& a = place();
    const DrivenRates& r = step.motion;
    const double time = a.time + step.h;
    const State<double> predicted =
        linkage_.moved(a.s, r.first + 0.5 * r.second, path_.position(time));
    State<double> s = predicted;
    if (!linkage_.close(s)) return std::nullopt;
    const double correction = linkage_.difference(predicted, s).norm();
    if (correction > kCorrected * r.first.norm()) return std::nullopt;
    const DrivenRates b = linkage_.rates(s, r.drive, VectorXd::Zero(r.drive.size()));
    const VectorXd expected = r.first + r.second;
    if (b.is_singular) {
      return Place{time, s, b.quality, true, {r.drive, expected, r.second}, {}};
    }
    const double larger = std::max(r.first.norm(), b.first.norm());
    const bool turns_off = (b.first - expected).norm() > kTurned * larger;
    if (turns_off && !is_lax(a)) return std::nullopt;
    return Place{time, s, b.quality, false, {}, {}};
  }

  // After a pose whose rates are only continued, those that follow may differ a little more.
  static bool is_lax(const Place& a) { return a.is_singular && a.continued.second.isZero(); }

  // Towards a singular position steps shorten as its distance does: a branch is crossed, and a gap
  // between branches that only nearly meet is followed round, not leapt over.
  double longest_step_here() const {
    const Place& b = place();
    if (b.is_singular) return kLongestStride;
    if (track_.size() < 2) return std::max(0.5 * kApproach * b.quality, kNearest);
    const Place& a = track_[track_.size() - 2];
    const double apart = linkage_.difference(a.s, b.s).norm();
    const double fall = a.quality - b.quality;
    if (!(fall > 0.0)) return kLongestStride;
    return std::max(kApproach * b.quality * apart / fall, kNearest);
  }

  bool step_towards(double target) {
    stride_ = std::min(stride_, longest_step_here());
    for (double length = stride_;; length *= 0.5) {
      const Step step = choose_step(length, target);
      if (step.motion.drive.norm() < kShortestStep) return rest(step, target);
      std::optional<Place> next = try_step(step);
      if (!next) continue;
      stride_ = std::min(kLongestStride, 2.0 * length);
      add(std::move(*next), step, target);
      return true;
    }
  }

  // A course that stands still for a while; false where steps have become too short.
  bool rest(const Step& step, double target) {
    if (step.h != longest_time(target)) return false;
    track_.back().time = time_after(step, target);
    return true;
  }

  // Over a crossing of branches that stops small steps.
  bool jump_towards(double target) {
    stride_ = kLongestStride;
    const Step least = choose_step(kNearest, target);
    if (least.motion.first.norm() > kRunaway * least.motion.drive.norm()) return false;
    for (const double length : {3e-5, 3e-4, 3e-3}) {
      const Step step = choose_step(length, target);
      std::optional<Place> next = try_step(step);
      if (!next || next->is_singular) continue;
      add(std::move(*next), step, target);
      return true;
    }
    return false;
  }

  // The target itself, to the bit, where the step leads there.
  double time_after(const Step& step, double target) const {
    return step.h == target - place().time ? target : place().time + step.h;
  }

  void add(Place next, const Step& step, double target) {
    next.time = time_after(step, target);
    track_.push_back(std::move(next));
    see_quality();
    if (track_.size() < 3) return;
    if (track_.size() > 3) track_.erase(track_.begin());
    const bool is_lowest =
        track_[1].quality <= track_[0].quality && track_[1].quality < track_[2].quality;
    if (is_lowest && track_[1].quality < kSuspect) look_between(track_[0], track_[2]);
  }

  DrivenRates rates_at(const Place& a) const {
    const DriveMotion motion = path_.at(a.time);
    const VectorXd rate = linkage_.without_dimensions(motion.rate);
    const VectorXd second = linkage_.without_dimensions(motion.second_rate);
    return a.is_singular ? rescaled(a.continued, rate, second) : linkage_.rates(a.s, rate, second);
  }

  // Golden section for the lowest quality between two poses.
  void look_between(const Place& a, const Place& b) {
    const DrivenRates at_a = rates_at(a), at_b = rates_at(b);
    const VectorXd d = linkage_.difference(a.s, b.s);
    const double h = b.time - a.time;
    const auto between = [&](double x) {
      return linkage_.moved(a.s, interpolate(at_a, at_b, d, h, x), path_.position(a.time + x * h));
    };
    const auto quality = [&](double x) { return linkage_.quality(between(x)); };
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
    const double x = f1 < f2 ? x1 : x2;
    if (std::min(f1, f2) < kCrossing) note(a.time + x * h, between(x));
  }

  // Where the drives go from here, a unit vector.
  VectorXd direction_to(double target) const {
    const double later = place().time + longest_time(target);
    const VectorXd way = path_.position(later) - path_.position(place().time);
    return linkage_.without_dimensions(way).normalized();
  }

  // True where the lock is the target itself.
  bool stop_at_lock(double target) {
    const VectorXd direction = direction_to(target);
    const auto turning = find_turning_pose(linkage_, place().s, direction);
    note(place().time, turning.value_or(place().s));
    if (!turning) return false;
    const VectorXd missing = path_.position(target) - linkage_.drive_position(*turning);
    if (linkage_.without_dimensions(missing).norm() > kArrived) return false;
    const PoseCurve curve(linkage_, direction);
    const VectorXd onwards = curve.tangent(place().s, curve.rising());
    const VectorXd back = -curve.tangent(*turning, onwards);
    track_.push_back(
        {target, *turning, linkage_.quality(*turning), true, no_rates(linkage_), back});
    see_quality();
    return true;
  }

  // Away from a lock, along the curve of closed poses; the drives then are where the path has them.
  bool leave_lock(double target) {
    const VectorXd direction = direction_to(target);
    const PoseCurve curve(linkage_, direction);
    const VectorXd tangent = curve.tangent(place().s, place().leave);
    for (double length = 0.6 * kLongestStride; length > kShortestStep; length *= 0.5) {
      const auto reached = curve.at(place().s, length * tangent);
      const double way = reached ? curve.way_between(place().s, *reached) : -1.0;
      if (way <= 0.0) return false;
      const std::optional<double> time = time_of(way, direction, target);
      if (!time) continue;
      State<double> s =
          linkage_.moved(*reached, VectorXd::Zero(reached->v.size()), path_.position(*time));
      if (!linkage_.close(s)) continue;
      track_.push_back({*time, s, linkage_.quality(s), false, {}, {}});
      stride_ = length;
      return true;
    }
    return false;
  }

  // When the drives have gone a way along a direction; nothing if that is beyond `target`.
  std::optional<double> time_of(double way, const VectorXd& direction, double target) const {
    const VectorXd from = path_.position(place().time);
    const auto left = [&](double time) {
      return linkage_.without_dimensions(path_.position(time) - from).dot(direction) - way;
    };
    double low = place().time, high = target;
    if (left(high) < 0.0) return std::nullopt;
    for (int i = 0; i < 100; ++i) {
      const double middle = 0.5 * (low + high);
      (left(middle) < 0.0 ? low : high) = middle;
    }
    return high;
  }

  void see_quality() {
    if (place().quality > worst_.quality) return;
    worst_ = {place().quality, place().time, linkage_.drive_position(place().s)};
  }

  void note(double time, const State<double>& s) {
    SingularPosition p = describe_singular(linkage_, time, s);
    const auto is_same = [&](const SingularPosition& known) {
      return linkage_.difference(known.s, s).norm() < kSamePosition;
    };
    if (std::none_of(singular_.begin(), singular_.end(), is_same)) {
      singular_.push_back(std::move(p));
    }
  }

  const DrivenLinkage& linkage_;
  const DrivePath& path_;
  std::vector<SingularPosition>& singular_;
  std::vector<Place> track_;  // the last three
  Transmission worst_{1.0, 0.0, {}};
  double stride_ = kLongestStride;  // norm of the rates over the next step
};

// At a singular start the linear solves do not tell the motion; the neighbour that moves the drives
// most along `direction` does.
DrivenRates continue_from_neighbours(const DrivenLinkage& linkage, const MobilityReport& mobility,
                                     const State<double>& start, const VectorXd& direction) {
  DrivenRates rates = linkage.rates(start, direction, VectorXd::Zero(direction.size()));
  double best = 0.0;
  for (const State<double>& s : mobility.neighbours) {
    const VectorXd d = linkage.difference(start, s);
    const VectorXd driven =
        linkage.without_dimensions(linkage.drive_position(s) - linkage.drive_position(start));
    const double along = driven.dot(direction) / direction.norm();
    if (std::abs(along) <= best * d.norm()) continue;
    best = std::abs(along) / d.norm();
    rates.first = d * (direction.norm() / along);
    rates.second.setZero();
  }
  return rates;
}

Place place_at(const DrivenLinkage& linkage, const State<double>& start,
               const MobilityReport& mobility, const DrivePath& path) {
  VectorXd direction =
      linkage.without_dimensions(path.position(path.duration()) - path.position(0.0));
  if (direction.isZero()) direction = linkage.without_dimensions(path.at(0.0).rate);
  if (direction.isZero()) direction.setOnes();
  const double quality = linkage.quality(start);
  if (quality >= kSingularQuality) return {0.0, start, quality, false, {}, {}};
  const bool is_lock = describe_singular(linkage, 0.0, start).kind == SingularKind::lock;
  if (is_lock && PoseCurve::exists(linkage)) {
    const PoseCurve curve(linkage, direction.normalized());
    return {0.0, start, quality, true, no_rates(linkage), curve.tangent(start, curve.rising())};
  }
  return {0.0, start, quality, true, continue_from_neighbours(linkage, mobility, start, direction),
          {}};
}

// Poses at times from, from + step, ... as far as they can be reached, at most `count`.
std::vector<DrivenPose> visit(Follower& follower, double from, double step, int count) {
  std::vector<DrivenPose> poses;
  for (int i = 0; i < count && follower.advance(from + i * step); ++i) {
    poses.push_back(follower.pose());
  }
  if (static_cast<int>(poses.size()) == count) follower.end();
  return poses;
}

// The begin of the course, reached straight from the start.
std::optional<Place> go_to_begin(const DrivenLinkage& linkage, const State<double>& start,
                                 const MobilityReport& mobility, const DrivePath& path,
                                 std::vector<SingularPosition>& singular) {
  const VectorXd from = linkage.drive_position(start), to = path.position(0.0);
  if (linkage.without_dimensions(to - from).norm() < kShortestStep) {
    return place_at(linkage, linkage.moved(start, VectorXd::Zero(start.v.size()), to), mobility,
                    path);
  }
  const DrivePath way = DrivePath::straight(from, to);
  Follower follower(linkage, way, singular);
  follower.begin(place_at(linkage, start, mobility, way));
  if (!follower.advance(way.duration())) return std::nullopt;
  Place place = follower.place();
  place.time = 0.0;
  return place;
}

}  // namespace

DriveCycle follow_drives(const DrivenLinkage& linkage, const State<double>& start,
                         const MobilityReport& mobility, const DrivePath& path,
                         const CourseOptions& options) {
  DriveCycle cycle;
  const std::optional<Place> begin = go_to_begin(linkage, start, mobility, path, cycle.singular);
  cycle.is_reached = begin.has_value();
  if (!begin) return cycle;
  cycle.singular.clear();  // of the way to the begin
  Follower follower(linkage, path, cycle.singular);
  follower.begin(*begin);
  const int count = std::max(options.positions, 2);
  const double step = path.duration() / (count - 1);
  cycle.poses = visit(follower, 0.0, step, count);
  cycle.is_complete = static_cast<int>(cycle.poses.size()) == count;
  cycle.worst = follower.worst();
  if (cycle.is_complete || !options.both_ways) return cycle;
  follower.begin(*begin);
  std::vector<DrivenPose> back = visit(follower, -step, -step, count - 1);
  cycle.worst = follower.worst();
  std::reverse(back.begin(), back.end());
  cycle.poses.insert(cycle.poses.begin(), back.begin(), back.end());
  return cycle;
}

}  // namespace linkstudy
