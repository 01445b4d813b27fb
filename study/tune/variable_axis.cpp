#include "study/tune/variable_axis.h"

#include <algorithm>
#include <cmath>

namespace linkstudy::tuning {

namespace {

double span_of(const TunedVariable& variable) {
  return variable.high - variable.low;
}

}  // namespace

double position_of(const TunedVariable& variable, double x) {
  return variable.is_logarithmic ? std::log10(x) : x / span_of(variable);
}

double value_at(const TunedVariable& variable, double t) {
  return variable.is_logarithmic ? std::pow(10.0, t) : t * span_of(variable);
}

double distance(const TunedVariable& variable, double a, double b) {
  return variable.is_logarithmic ? std::log10(b / a) : (b - a) / span_of(variable);
}

double shifted(const TunedVariable& variable, double x, double distance) {
  return variable.is_logarithmic ? x * std::pow(10.0, distance) : x + distance * span_of(variable);
}

double midway(const TunedVariable& variable, double a, double b) {
  return variable.is_logarithmic ? std::sqrt(a) * std::sqrt(b) : a + 0.5 * (b - a);
}

double from_axis(const TunedVariable& variable, double t) {
  const double value = value_at(variable, t);
  // Powers of ten, and parts of a range, miss the ends by rounding.
  const double size = variable.is_logarithmic ? 0.0 : span_of(variable);
  for (const double end : {variable.low, variable.high}) {
    if (std::abs(value - end) <= 1e-12 * std::max(std::abs(end), size)) return end;
  }
  return std::clamp(value, variable.low, variable.high);
}

double move_along(const TunedVariable& variable, double value, double distance) {
  return std::clamp(shifted(variable, value, distance), variable.low, variable.high);
}

bool is_below(const std::vector<double>& a, const std::vector<double>& b) {
  for (std::size_t j = 0; j < a.size(); ++j)
    if (a[j] > b[j]) return false;
  return true;
}

}  // namespace linkstudy::tuning
