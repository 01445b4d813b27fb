#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "study/metrics/response_list.h"
#include "study/page/moving_run.h"
#include "study/record/digest.h"
#include "study/session/stored_answer.h"

namespace linkstudy {
namespace {

using Id = std::optional<std::uint64_t>;

Id id_in(const nlohmann::json& json) {
  const auto found = json.find("evaluation");
  const bool is_id = found != json.end() && found->is_number_unsigned();
  return is_id ? Id(found->get<std::uint64_t>()) : std::nullopt;
}

// Of a tune the binding one, of a fit the best; of several answers the first that has one.
Id id_of(const nlohmann::json& answer) {
  if (!answer.is_object()) return std::nullopt;
  if (const Id own = id_in(answer)) return own;
  if (answer.contains("binding") && answer["binding"].is_object()) return id_in(answer["binding"]);
  if (!answer.contains("answers")) return std::nullopt;
  for (const auto& one : answer["answers"])
    if (const Id found = id_of(one)) return found;
  return std::nullopt;
}

// Of all load cases.
std::vector<std::size_t> error_columns(const StudyDescription& description) {
  std::vector<std::size_t> columns;
  for (const StoredCase& one : split_responses(description.responses)) {
    std::ranges::copy(error_columns(one), std::back_inserter(columns));
  }
  return columns;
}

std::string shown(const Value& value) {
  const double* number = std::get_if<double>(&value);
  return number != nullptr ? fmt::format("{:.6g}", *number) : std::get<std::string>(value);
}

double largest_error(const Evaluation& evaluation, const std::vector<std::size_t>& columns) {
  double worst = 0.0;
  for (const std::size_t c : columns) {
    if (c < evaluation.responses.size()) {
      worst = std::fmax(worst, std::abs(evaluation.responses[c]));
    }
  }
  return worst;
}

}  // namespace

std::optional<std::uint64_t> choose_shown(const StudyResults& results) {
  if (const Id found = id_of(stored_answer(results))) return found;
  const std::vector<std::size_t> columns = error_columns(results.description);
  Id best;
  double least = std::numeric_limits<double>::infinity();
  for (const Evaluation& one : latest_by_id(results.evaluations)) {
    if (one.status != Cause::ok) continue;
    const double worst = largest_error(one, columns);
    // Without errors the last: of a refinement the finest.
    if (!best || worst < least || columns.empty()) {
      best = one.point.id;
      least = worst;
    }
  }
  return best;
}

std::string best_text(const StudyResults& results) {
  const Id best = choose_shown(results);
  const std::vector<Evaluation> evaluations = latest_by_id(results.evaluations);
  const auto found = std::ranges::find_if(
      evaluations, [&](const Evaluation& one) { return best && one.point.id == *best; });
  if (found == evaluations.end()) return "";
  std::string text = fmt::format("evaluation {}", *best);
  for (std::size_t i = 0; i < found->point.values.size(); ++i) {
    const Parameter& parameter = results.description.parameters.at(i);
    text += fmt::format(", {} = {}{}{}", parameter.path, shown(found->point.values[i]),
                        parameter.unit.empty() ? "" : " ", parameter.unit);
  }
  const std::vector<std::size_t> columns = error_columns(results.description);
  if (columns.empty()) return text;
  return text + fmt::format(", largest error {:.4g} %", 100.0 * largest_error(*found, columns));
}

}  // namespace linkstudy
