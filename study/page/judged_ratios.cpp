#include "study/page/judged_ratios.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "study/session/model_results.h"
#include "study/session/stored_evaluator.h"

namespace linkstudy {
namespace {

constexpr double kUnjudged = std::numeric_limits<double>::quiet_NaN();

double largest_ratio(const std::vector<JudgedError>& judged, const Evaluation& evaluation) {
  if (evaluation.status != Cause::ok) return kUnjudged;
  double largest = 0.0;
  for (const JudgedError& one : judged) {
    if (one.response >= evaluation.responses.size()) return kUnjudged;
    const double error = error_of(one, evaluation.responses[one.response]);
    if (std::isnan(error)) return kUnjudged;
    largest = std::max(largest, error / std::ranges::min(one.tolerance));
  }
  return largest;
}

}  // namespace

std::vector<double> judged_ratios(const StudyResults& results,
                                  const std::vector<Evaluation>& rows) {
  if (analysed_kind(results)) return {};
  std::vector<JudgedError> judged;
  try {
    judged = make_stored_evaluator(results)->judged_errors();
    std::erase_if(judged, [](const JudgedError& one) { return one.tolerance.empty(); });
  } catch (const std::exception&) {
    return {};  // the runs that are made again say why
  }
  if (judged.empty()) return {};
  std::vector<double> ratios;
  for (const Evaluation& row : rows) ratios.push_back(largest_ratio(judged, row));
  return ratios;
}

}  // namespace linkstudy
