#include "study/calibrate/starts.h"

#include <algorithm>
#include <boost/random/sobol.hpp>
#include <random>

namespace linkstudy::calibration {
namespace {

constexpr std::size_t kMostDrawn = 5;  // times the starts asked for

Vector declared_start(const FitProblem& problem) {
  std::vector<double> values = to_values(
      problem, Vector::Constant(static_cast<Eigen::Index>(problem.parameters.size()), 0.5));
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = problem.parameters[i].start.value_or(values[i]);
  }
  return to_cube(problem, values);
}

// In [0, 1).
double to_unit(std::uint64_t bits) {
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

}  // namespace

std::vector<Vector> list_starts(const FitProblem& problem, std::uint64_t seed, std::size_t count) {
  std::vector<Vector> starts = {declared_start(problem)};
  const auto n = static_cast<Eigen::Index>(problem.parameters.size());
  boost::random::sobol sequence(static_cast<std::size_t>(n));
  std::mt19937_64 random(seed);
  Vector shift(n);
  for (double& one : shift) one = to_unit(random());
  while (starts.size() < count) {
    Vector point(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const double sum = to_unit(sequence()) + shift[i];
      point[i] = sum < 1.0 ? sum : sum - 1.0;
    }
    starts.push_back(std::move(point));
  }
  return starts;
}

std::vector<Descent> run_starts(FitLog& log) {
  const auto wanted = static_cast<std::size_t>(log.options().starts);
  const std::vector<Vector> points =
      list_starts(log.problem(), log.options().seed, kMostDrawn * wanted);
  std::vector<Vector> chosen;
  std::size_t good = 0;
  while (good < wanted && chosen.size() < points.size() && !log.is_exhausted()) {
    const std::size_t more = std::min(wanted - good, points.size() - chosen.size());
    const auto first = points.begin() + static_cast<std::ptrdiff_t>(chosen.size());
    const std::vector<Vector> next(first, first + static_cast<std::ptrdiff_t>(more));
    for (const FitSample* sample : log.ask(next)) good += sample->is_ok() ? 1 : 0;
    chosen.insert(chosen.end(), next.begin(), next.end());
  }
  DescentSettings settings;
  settings.difference = log.options().difference;
  std::vector<Descent> descents;
  for (Vector& point : chosen) descents.emplace_back(log.problem(), settings, std::move(point));
  run_together(log, descents);
  return descents;
}

}  // namespace linkstudy::calibration
