#include "study/metrics/judged_errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/topology/nearest_name.h"
#include "study/config/validate.h"

namespace linkstudy {
namespace {

std::string prefix_of(const LoadCaseInput& load_case, const char* separator) {
  return load_case.name.empty() ? "" : load_case.name + separator;
}

// The responses of an evaluation by the names that users give them.
class NamedResponses {
 public:
  NamedResponses(const StudyInput& input, const StudySignals& signals)
      : input_(input),
        signals_(signals),
        width_(layout_of(input, signals).width),
        responses_(list_responses(input, signals)) {}

  const Response& at(std::size_t i) const { return responses_[i]; }

  // In the first load case; those of the others follow at multiples of the width. Empty where there
  // is no such name.
  std::vector<std::size_t> find(const std::string& name) const {
    const std::string prefix = prefix_of(load_cases_of(input_).front(), "_");
    std::vector<std::string> names = {prefix + name};
    for (std::size_t i = 0; i < input_.response.size(); ++i) {
      if (input_.response[i].name != name) continue;
      for (const Channel& channel : signals_.response[i]) {
        names.push_back(prefix + response_name(input_.response[i], channel));
      }
    }
    std::vector<std::size_t> found;
    for (std::size_t i = first_of_responses(); i < width_; ++i) {
      if (std::ranges::count(names, responses_[i].name) > 0) found.push_back(i);
    }
    return found;
  }

  std::size_t width() const { return width_; }

  // Without the load case.
  std::string own_name(std::size_t i) const {
    const std::string prefix = prefix_of(load_cases_of(input_).front(), "_");
    return responses_[i].name.substr(prefix.size());
  }

  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (std::size_t i = first_of_responses(); i < width_; ++i) names.push_back(own_name(i));
    return names;
  }

 private:
  // Errors are for [[match]].
  std::size_t first_of_responses() const {
    std::size_t first = 0;
    for (const auto& channels : signals_.match) first += 2 * channels.size();
    return first;
  }

  const StudyInput& input_;
  const StudySignals& signals_;
  std::size_t width_;
  std::vector<Response> responses_;
};

// Nothing when it was reported.
std::optional<Bound> read_bound(const LimitInput& limit, const Response& response,
                                Diagnostics& diagnostics) {
  Bound bound{0.0, limit.at_most.has_value(), response.unit};
  Tree value = bound.is_upper ? *limit.at_most : *limit.at_least;
  const KeyRow row{.unit = response.unit};
  const std::string subject = fmt::format("limit of {}", limit.response);
  if (!validate_number(value, row, subject, diagnostics)) return std::nullopt;
  bound.value = value.as_number();
  return bound;
}

void add_matches(const StudyInput& input, const StudySignals& signals,
                 std::vector<JudgedError>& errors) {
  const ResponseLayout layout = layout_of(input, signals);
  std::size_t first = 0;
  for (const LoadCaseInput& load_case : load_cases_of(input)) {
    for (std::size_t i = 0; i < input.match.size(); ++i) {
      const std::size_t n = signals.match[i].size();
      const std::size_t skip = input.match[i].norm == ErrorNorm::rms ? n : 0;
      for (std::size_t c = 0; c < n; ++c) {
        errors.push_back({prefix_of(load_case, ".") + signals.match[i][c].name,
                          first + layout.match[i] + skip + c,
                          input.match[i].tolerance,
                          {}});
      }
    }
    first += layout.width;
  }
}

void add_limit(const StudyInput& input, const NamedResponses& responses, const LimitInput& limit,
               std::vector<JudgedError>& errors, Diagnostics& diagnostics) {
  const std::vector<std::size_t> found = responses.find(limit.response);
  if (found.empty()) {
    diagnostics.add(limit.at, fmt::format("limit names no response, got '{}'", limit.response),
                    suggest_name(limit.response, responses.names()));
    return;
  }
  const std::optional<Bound> bound = read_bound(limit, responses.at(found.front()), diagnostics);
  if (!bound) return;
  std::size_t first = 0;
  for (const LoadCaseInput& load_case : load_cases_of(input)) {
    for (const std::size_t i : found) {
      errors.push_back({fmt::format("{}{}.{}", prefix_of(load_case, "."), responses.own_name(i),
                                    bound->is_upper ? "at_most" : "at_least"),
                        first + i,
                        {1.0},
                        bound});
    }
    first += responses.width();
  }
}

}  // namespace

double error_of(const JudgedError& judged, double value) {
  if (!judged.bound) return value;
  const Bound& bound = *judged.bound;
  const double scale = bound.value == 0.0 ? 1.0 : std::abs(bound.value);
  const double miss = bound.is_upper ? value - bound.value : bound.value - value;
  const double error = 1.0 + miss / scale;
  return error < 0.0 ? 0.0 : error;  // NaN stays
}

std::vector<JudgedError> list_judged_errors(const StudyInput& input, const StudySignals& signals,
                                            Diagnostics& diagnostics) {
  std::vector<JudgedError> errors;
  add_matches(input, signals, errors);
  if (input.limit.empty()) return errors;
  const NamedResponses responses(input, signals);
  for (const LimitInput& limit : input.limit) {
    add_limit(input, responses, limit, errors, diagnostics);
  }
  return errors;
}

std::vector<std::size_t> list_objective_responses(const StudyInput& input,
                                                  const StudySignals& signals,
                                                  Diagnostics& diagnostics) {
  if (!input.objective) return {};
  const std::string& name = input.objective->of;
  std::vector<std::string> names;
  for (const TuneInput& tune : input.tune) {
    if (tune.parameter.path == name) return {};
    names.push_back(tune.parameter.path);
  }
  const NamedResponses responses(input, signals);
  std::vector<std::size_t> all;
  for (const std::size_t i : responses.find(name)) {
    for (std::size_t k = 0; k < load_cases_of(input).size(); ++k) {
      all.push_back(k * responses.width() + i);
    }
  }
  if (!all.empty()) return all;
  std::ranges::copy(responses.names(), std::back_inserter(names));
  diagnostics.add(
      input.objective->at,
      fmt::format("objective names neither a tuned value nor a response, got '{}'", name),
      suggest_name(name, names));
  return {};
}

}  // namespace linkstudy
