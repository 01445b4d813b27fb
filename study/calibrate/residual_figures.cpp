#include "study/calibrate/residual_figures.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "study/record/boost_policy.h"

namespace linkstudy::calibration {
namespace {

constexpr double kMostCorrelated = 0.9999;

using StudentsT = boost::math::students_t_distribution<double, IgnoreOverflow>;

double correlate(const Vector& e, double parameters) {
  const auto n = static_cast<double>(e.size());
  const double square = e.squaredNorm();
  if (e.size() < 3 || square == 0.0) return 0.0;
  const double raw = e.head(e.size() - 1).dot(e.tail(e.size() - 1)) / square;
  if (raw + parameters / n < 2.0 / std::sqrt(n)) return 0.0;
  const double corrected = raw + (parameters * (1.0 + raw) + 2.0 * raw) / n;
  return std::min(corrected, kMostCorrelated);
}

SeriesFigures figures_of(const Vector& e, double rho) {
  const auto n = static_cast<double>(e.size());
  return {n > 0.0 ? std::sqrt(e.squaredNorm() / n) : 0.0, rho, n * (1.0 - rho) / (1.0 + rho)};
}

}  // namespace

ResidualFigures compute_figures(const FitProblem& problem, const Vector& residuals,
                                std::size_t parameters, const FitOptions& options) {
  ResidualFigures figures;
  const auto p = static_cast<double>(parameters);
  const double share = p / static_cast<double>(std::max<std::size_t>(1, problem.series.size()));
  for (const ResidualSeries& one : problem.series) {
    const auto count = static_cast<Eigen::Index>(one.end - one.first);
    const Vector e = residuals.segment(static_cast<Eigen::Index>(one.first), count);
    const bool is_white = options.autocorrelation == Autocorrelation::none;
    figures.series.push_back(figures_of(e, is_white ? 0.0 : correlate(e, share)));
    figures.effective += figures.series.back().effective;
  }
  figures.samples = static_cast<double>(residuals.size());
  figures.freedom = figures.effective - p;
  if (!figures.is_usable()) return figures;
  figures.variance = residuals.squaredNorm() / figures.freedom;
  const StudentsT student(figures.freedom);
  figures.quantile = boost::math::quantile(student, 0.5 + 0.5 * options.confidence);
  figures.rise = figures.variance * figures.quantile * figures.quantile;
  return figures;
}

}  // namespace linkstudy::calibration
