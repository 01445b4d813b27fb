// Bounded nonlinear least squares from one start: Levenberg-Marquardt as in MINPACK (More 1978; the
// damping is Eigen's lmpar), scaled by the largest column norms D seen,
//   min |r + J s|   subject to |D s| <= delta,
// with an active set: a coordinate at its bound whose gradient points outwards is held; one that
// the step would carry over its bound ends there and the rest is solved anew. A step into a failing
// region is shortened to a quarter.
// The work is cut at every evaluation, so that many descents share batches (fit_log.h).
#pragma once

#include <span>
#include <string_view>

#include "core/base/words.h"
#include "study/calibrate/differences.h"

namespace linkstudy::calibration {

enum class DescentEnd { running, converged, exact, stuck, iterations, start_failed };

}  // namespace linkstudy::calibration

namespace linkstudy {

template <>
inline constexpr auto kWords<calibration::DescentEnd> = make_words<calibration::DescentEnd>(
    {{calibration::DescentEnd::running, "budget used up"},
     {calibration::DescentEnd::converged, "converged"},
     {calibration::DescentEnd::exact, "no residual left"},
     {calibration::DescentEnd::stuck, "stuck beside failing points"},
     {calibration::DescentEnd::iterations, "iterations used up"},
     {calibration::DescentEnd::start_failed, "start failed"}});

}  // namespace linkstudy

namespace linkstudy::calibration {

struct DescentSettings {
  double difference = 1.0e-3;    // relative, of central differences
  double tolerance = 1.0e-12;    // relative change of S that ends it
  double step_tolerance = 1e-9;  // length of a step in the cube that ends it
  int max_iterations = 100;
};

class Descent {
 public:
  // Coordinates that are held stay at their start.
  Descent(const FitProblem& problem, const DescentSettings& settings, Vector start,
          std::vector<bool> held = {});

  bool is_done() const { return end_ != DescentEnd::running; }
  std::vector<Vector> wanted() const;
  void take(std::vector<const FitSample*> answers);

  DescentEnd end() const { return end_; }
  const Vector& point() const { return plan_.point; }
  const FitSample* sample() const { return sample_; }  // at the point; null before the first answer
  double start_sum() const { return start_sum_; }
  int iterations() const { return iterations_; }

 private:
  enum class Phase { start, differences, trial };

  void take_start(const FitSample& sample);
  void take_differences(std::span<const FitSample* const> answers);
  void take_trial(const FitSample& sample);
  void begin_iteration();
  bool is_stationary() const;
  void find_step();
  void want_trial();
  bool pushes_out(Eigen::Index i, const Vector& residuals) const;
  Vector moved() const;
  void resize_region(double ratio, double length);

  const FitProblem* problem_;
  DescentSettings settings_;
  DifferencePlan plan_;
  Phase phase_ = Phase::start;
  DescentEnd end_ = DescentEnd::running;
  const FitSample* sample_ = nullptr;
  double start_sum_ = 0.0;
  Matrix jacobian_;
  Vector scale_;  // D
  Vector step_;   // s
  double delta_ = 0.0;
  double damping_ = 0.0;
  double predicted_ = 0.0;  // relative fall of S by the linear model
  bool meets_failures_ = false;
  int iterations_ = 0;
};

}  // namespace linkstudy::calibration
