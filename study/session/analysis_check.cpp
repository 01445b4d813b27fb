#include "study/session/analysis_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "study/record/bytes.h"
#include "study/record/digest.h"
#include "study/session/model_results.h"
#include "study/session/stored_answer.h"
#include "study/session/stored_evaluator.h"
#include "study/session/stored_program.h"
#include "study/store/store_error.h"

namespace linkstudy {
namespace {

class AnalysisCheck {
 public:
  AnalysisCheck(const StudyResults& stored, const ModelResults& found)
      : stored_(stored), found_(found) {}

  Verification run() {
    const std::vector<Evaluation> evaluations = latest_by_id(stored_.evaluations);
    if (evaluations.empty()) {
      throw StoreError("there is nothing to verify: these results hold no evaluation");
    }
    result_.stored = 1;
    result_.rerun = {0};
    compare_program();
    compare_outcome(evaluations.front());
    compare_traces();
    const nlohmann::json answer = stored_answer(stored_);
    if (answer.is_object()) result_.answer = answer.value("status", "");
    if (result_.to_the_bit) compare_tables(answer);
    return std::move(result_);
  }

 private:
  void compare_program() {
    if (const auto warning = revision_warning(stored_)) result_.warnings.push_back(*warning);
    // Kinematics runs on no instruction set but that of all processors.
    if (found_.kind == AnswerKind::kinematics) return;
    const std::optional<std::string> warning = rounding_warning(stored_);
    result_.to_the_bit = !warning;
    if (!warning) return;
    result_.warnings.push_back(fmt::format(
        "{}: numbers are compared to {:g} of the greatest of their unit, tables are not", *warning,
        kOtherRounding));
  }

  void disagree(const std::string& column, std::string stored, std::string found) {
    result_.disagreements.push_back({0, column, std::move(stored), std::move(found)});
  }

  void compare_outcome(const Evaluation& stored) {
    const Evaluation& found = found_.evaluation;
    if (stored.status != found.status) {
      disagree("status", std::string(name_of(stored.status)), std::string(name_of(found.status)));
      return;
    }
    if (!std::ranges::equal(stored_.description.responses, found_.responses, {}, &Response::name,
                            &Response::name)) {
      throw_other_columns(stored_);
    }
    std::map<std::string, double> greatest;  // by unit
    for (std::size_t i = 0; i < found.responses.size(); ++i) {
      double& most = greatest[found_.responses[i].unit];
      most = std::fmax(most, std::abs(found.responses[i]));
    }
    for (std::size_t i = 0; i < found.responses.size(); ++i) {
      const Response& response = found_.responses[i];
      // Residuals and counts of iterations are made of rounding.
      if (!result_.to_the_bit && response.unit.empty()) continue;
      const double a = i < stored.responses.size() ? stored.responses[i] : std::nan("");
      compare(response.name, a, found.responses[i], greatest[response.unit]);
    }
  }

  void compare(const std::string& name, double a, double b, double scale) {
    if (std::isnan(a) && std::isnan(b)) return;
    const bool agrees =
        a == b || (!result_.to_the_bit && std::abs(a - b) <= kOtherRounding * scale);
    if (!agrees) disagree(name, shown_number(a), shown_number(b));
  }

  // Of each history the first place that differs says it.
  void compare_traces() {
    const std::vector<CaseTraces>& found = found_.evaluation.traces;
    if (found.size() != stored_.traces.size()) {
      disagree("histories", std::to_string(stored_.traces.size()), std::to_string(found.size()));
      return;
    }
    for (std::size_t i = 0; i < found.size(); ++i) {
      compare_set(stored_.traces[i].traces, found[i].traces);
    }
  }

  void compare_set(const std::vector<Trace>& stored, const std::vector<Trace>& found) {
    for (const Trace& trace : found) {
      const auto same = std::ranges::find(stored, trace.name, &Trace::name);
      if (same == stored.end() || same->values.size() != trace.values.size()) {
        disagree(trace.name, "other positions", fmt::format("{}", trace.values.size()));
        continue;
      }
      const std::size_t before = result_.disagreements.size();
      for (std::size_t row = 0; row < trace.values.size(); ++row) {
        compare(fmt::format("{}, position {}", trace.name, row), same->values[row],
                trace.values[row], 0.0);
        if (result_.disagreements.size() > before) break;
      }
    }
  }

  void compare_tables(const nlohmann::json& answer) {
    const nlohmann::json found = nlohmann::json::parse(found_.json);
    if (found != answer) {
      result_.refuted = fmt::format("found again the answer is another: {}",
                                    nlohmann::json::diff(answer, found).front().dump());
      return;
    }
    if (stored_.answers.empty()) return;
    const Table& stored = stored_.answers.front().tables;
    for (const Table& table : found_.tables) {
      const Table* same = find_part(stored, table.name);
      // Files of results leave the attributes and the forms of columns out.
      const bool agrees =
          same != nullptr && same->columns.size() == table.columns.size() &&
          std::ranges::equal(same->columns, table.columns, [](const Column& a, const Column& b) {
            return a.name == b.name && to_bytes(a.values) == to_bytes(b.values);
          });
      if (!agrees) disagree("table " + table.name, "another", "another");
    }
  }

  const StudyResults& stored_;
  const ModelResults& found_;
  Verification result_;
};

}  // namespace

Verification verify_analysis(const StudyResults& results, AnswerKind kind) {
  const ModelResults found = kind == AnswerKind::statics ? results_of(statics_again(results))
                                                         : results_of(course_again(results));
  return AnalysisCheck(results, found).run();
}

}  // namespace linkstudy
