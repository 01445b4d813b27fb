#include "study/calibrate/profile.h"

#include <algorithm>
#include <cmath>

namespace linkstudy::calibration {
namespace {

using Eigen::Index;

constexpr double kClose = 0.005;         // of sqrt(rise), where a side ends
constexpr double kFirstFlatStep = 0.05;  // of the cube, where the linear model says nothing
constexpr double kLeastStep = 1e-9;      // of the cube
constexpr double kMostGrowth = 4.0;
constexpr int kMostSteps = 16;

DescentSettings inner_settings(const FitLog& log) {
  DescentSettings settings;
  settings.difference = log.options().difference;
  settings.tolerance = 1e-8;  // of S: a profile need not be sharper than its crossing
  settings.max_iterations = 30;
  return settings;
}

// One side of one parameter.
class SideSearch {
 public:
  SideSearch(const FitLog& log, const ProfileCentre& centre, const Curvature& curvature,
             Index parameter, double direction)
      : log_(&log), centre_(&centre), i_(parameter), direction_(direction) {
    const double variance = curvature.covariance(i_, i_);
    const bool is_known = std::isfinite(variance) && variance > 0.0;
    slope_ = is_known ? Vector(curvature.covariance.col(i_) / variance) : flat_slope(curvature);
    slope_[i_] = 1.0;
    room_ = direction > 0.0 ? 1.0 - centre.point[i_] : centre.point[i_];
    if (room_ <= 0.0) {
      side_.end = ProfileEnd::bound;
      return;
    }
    const double step = is_known ? std::sqrt(centre.rise * variance) : kFirstFlatStep;
    begin(std::clamp(step, kLeastStep, room_));
  }

  bool is_done() const { return !descent_; }
  std::vector<Vector> wanted() const { return descent_->wanted(); }
  void take(std::vector<const FitSample*> answers) {
    descent_->take(std::move(answers));
    if (descent_->is_done()) judge();
  }

  const ProfileSide& side() const { return side_; }
  const std::vector<ProfilePoint>& points() const { return points_; }
  const FitSample* best() const { return best_; }

 private:
  Vector flat_slope(const Curvature& curvature) const {
    for (const FlatDirection& one : curvature.flat) {
      if (one.holds(i_)) return one.along / one.along[i_];
    }
    return Vector::Zero(centre_->point.size());
  }

  // At a distance from the best point, the others as the linear model says, or as they were.
  void begin(double distance) {
    distance_ = distance;
    Vector start = inside_point_ ? *inside_point_ : centre_->point;
    const double from = inside_point_ ? inside_ : 0.0;
    start += slope_ * (direction_ * (distance - from));
    start = start.cwiseMax(0.0).cwiseMin(1.0);
    start[i_] = distance >= room_ ? (direction_ > 0.0 ? 1.0 : 0.0)
                                  : centre_->point[i_] + direction_ * distance;
    std::vector<bool> held(static_cast<std::size_t>(start.size()), false);
    held[static_cast<std::size_t>(i_)] = true;
    descent_.emplace(log_->problem(), inner_settings(*log_), std::move(start), std::move(held));
  }

  void finish(ProfileEnd end, double distance = 0.0) {
    side_ = {end, centre_->point[i_] + direction_ * distance};
    descent_.reset();
  }

  void judge() {
    ++steps_;
    const FitSample* sample = descent_->sample();
    const bool is_ok = descent_->end() != DescentEnd::start_failed && sample != nullptr;
    if (!is_ok) {
      outside_ = distance_;
      outside_root_ = 0.0;
      return go_on();
    }
    points_.push_back({i_, descent_->point(), sample->sum});
    if (best_ == nullptr || sample->sum < best_->sum) best_ = sample;
    const double root = std::sqrt(std::max(0.0, sample->sum - centre_->sum) / centre_->rise);
    if (std::abs(root - 1.0) <= kClose) return finish(ProfileEnd::crossed, distance_ / root);
    if (root > 1.0) {
      outside_ = distance_;
      outside_root_ = root;
    } else if (distance_ >= room_) {
      return finish(ProfileEnd::bound);
    } else {
      inside_ = distance_;
      inside_root_ = root;
      inside_point_ = descent_->point();
    }
    go_on();
  }

  void go_on() {
    const bool has_outside = outside_ > 0.0;
    const bool is_cliff = has_outside && outside_root_ == 0.0;
    if (steps_ >= kMostSteps || (has_outside && outside_ - inside_ < 1e-3 * outside_)) {
      if (is_cliff) return finish(ProfileEnd::failed);
      return has_outside ? finish(ProfileEnd::crossed, crossing()) : finish(ProfileEnd::unknown);
    }
    if (is_cliff) return begin(0.5 * (inside_ + outside_));
    if (has_outside) return begin(crossing());
    const double growth = std::clamp(1.0 / std::max(inside_root_, 1e-9), 1.02, kMostGrowth);
    begin(std::min(growth * inside_, room_));
  }

  // Between a point inside and one outside, not too close to either.
  double crossing() const {
    const double share = (1.0 - inside_root_) / (outside_root_ - inside_root_);
    return inside_ + std::clamp(share, 0.02, 0.98) * (outside_ - inside_);
  }

  const FitLog* log_;
  const ProfileCentre* centre_;
  Index i_;
  double direction_;
  Vector slope_;       // of the others over this one
  double room_ = 0.0;  // to the bound
  double distance_ = 0.0, inside_ = 0.0, outside_ = 0.0;
  double inside_root_ = 0.0, outside_root_ = 0.0;  // sqrt of the rise in units of that wanted
  std::optional<Vector> inside_point_;
  int steps_ = 0;
  std::optional<Descent> descent_;
  ProfileSide side_;
  std::vector<ProfilePoint> points_;
  const FitSample* best_ = nullptr;
};

}  // namespace

Profiles trace_profiles(FitLog& log, const ProfileCentre& centre, const Curvature& curvature) {
  std::vector<SideSearch> searches;
  for (Index i = 0; i < centre.point.size(); ++i) {
    for (const double direction : {-1.0, 1.0}) {
      searches.emplace_back(log, centre, curvature, i, direction);
    }
  }
  run_together(log, searches);
  Profiles profiles;
  double least = centre.sum - 1e-3 * centre.rise;
  for (const SideSearch& search : searches) {
    const bool is_low = profiles.low.size() == profiles.high.size();
    (is_low ? profiles.low : profiles.high).push_back(search.side());
    profiles.points.insert(profiles.points.end(), search.points().begin(), search.points().end());
    if (search.best() == nullptr || search.best()->sum >= least) continue;
    least = search.best()->sum;
    profiles.better = search.best();
  }
  std::ranges::stable_sort(profiles.points, [](const ProfilePoint& a, const ProfilePoint& b) {
    const auto key = [](const ProfilePoint& p) {
      return std::pair(p.parameter, p.point[p.parameter]);
    };
    return key(a) < key(b);
  });
  return profiles;
}

}  // namespace linkstudy::calibration
