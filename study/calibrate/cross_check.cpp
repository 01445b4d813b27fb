#include "study/calibrate/cross_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "study/tune/nlopt_guard.h"

namespace linkstudy::calibration {
namespace {

constexpr double kAside = 0.02;        // of the cube, where it begins
constexpr double kFirstRadius = 0.05;  // of the cube
constexpr double kPenalty = 1e3;       // times S at the begin
constexpr std::size_t kCallsPerParameter = 40;

class CheckRun {
 public:
  CheckRun(FitLog& log, nlopt::opt& opt, std::size_t budget, double worst)
      : log_(log), guard_(opt), budget_(budget), worst_(worst) {}

  static double objective(unsigned n, const double* u, double* /*gradient*/, void* run) noexcept {
    auto& check = *static_cast<CheckRun*>(run);
    double sum = check.worst_;
    check.guard_.run(
        [&] { sum = check.value(Eigen::Map<const Vector>(u, static_cast<Eigen::Index>(n))); });
    return sum;
  }

  void rethrow() const { guard_.rethrow(); }
  std::size_t calls() const { return calls_; }
  bool is_spent() const { return calls_ >= budget_ || log_.is_exhausted(); }
  const Vector& best() const { return best_; }
  double best_sum() const { return best_sum_; }

 private:
  double value(const Vector& u) {
    if (is_spent()) guard_.stop();
    if (is_spent() || guard_.has_failed()) return worst_;
    ++calls_;
    const FitSample& sample = *log_.ask({u}).front();
    if (!sample.is_ok()) return worst_;
    if (sample.sum < best_sum_) {
      best_sum_ = sample.sum;
      best_ = u;
    }
    return std::min(sample.sum, worst_);
  }

  FitLog& log_;
  NloptGuard guard_;
  std::size_t budget_;
  double worst_;
  std::size_t calls_ = 0;
  Vector best_;
  double best_sum_ = std::numeric_limits<double>::infinity();
};

// Towards the middle, so that no bound hides it.
Vector point_aside(const Vector& point) {
  Vector aside = point;
  for (double& u : aside) u += u < 0.5 ? kAside : -kAside;
  return aside;
}

}  // namespace

CrossCheck cross_check(FitLog& log, const CrossCheckCentre& centre) {
  CrossCheck check;
  const auto n = static_cast<unsigned>(centre.point.size());
  check.algorithm = n > 1 ? "BOBYQA" : "COBYLA";
  const Vector start = point_aside(centre.point);
  const FitSample& first = *log.ask({start}).front();
  if (!first.is_ok()) {
    check.ended = "the point beside the best one fails";
    return check;
  }
  nlopt::opt opt(n > 1 ? nlopt::LN_BOBYQA : nlopt::LN_COBYLA, n);
  CheckRun run(log, opt, kCallsPerParameter * n + 20, kPenalty * (first.sum + 1e-300));
  opt.set_min_objective(&CheckRun::objective, &run);
  opt.set_lower_bounds(std::vector<double>(n, 0.0));
  opt.set_upper_bounds(std::vector<double>(n, 1.0));
  opt.set_initial_step(kFirstRadius);
  opt.set_xtol_abs(1e-6);
  opt.set_maxeval(static_cast<int>(4 * (kCallsPerParameter * n + 20)));
  std::vector<double> u(start.begin(), start.end());
  double value = 0.0;
  check.ran = true;
  try {
    opt.optimize(u, value);
    check.ended = "ended by itself";
  } catch (const std::exception& error) {
    check.ended = error.what();
  }
  run.rethrow();
  if (run.is_spent()) check.ended = "its budget is used up";
  check.calls = run.calls();
  check.point = run.best();
  check.sum = run.best_sum();
  check.confirms = check.sum <= centre.sum + centre.slack;
  return check;
}

}  // namespace linkstudy::calibration
