// What a tuner found and how it got there.
#pragma once

#include <optional>

#include "study/tune/certificate.h"
#include "study/tune/confirm_nlopt.h"
#include "study/tune/scan_window.h"
#include "study/tune/step_reach.h"
#include "study/tune/suggest_step.h"

namespace linkstudy::tuning {

enum class TuningStatus { certified, refuted, inconclusive, infeasible };
TuningStatus status_of(Verdict verdict);
enum class HighLimit { accuracy, stability, range };

}  // namespace linkstudy::tuning

namespace linkstudy {

template <>
inline constexpr auto kWords<tuning::TuningStatus> =
    make_words<tuning::TuningStatus>({{tuning::TuningStatus::certified, "certified"},
                                      {tuning::TuningStatus::refuted, "refuted"},
                                      {tuning::TuningStatus::inconclusive, "inconclusive"},
                                      {tuning::TuningStatus::infeasible, "infeasible"}});
template <>
inline constexpr auto kWords<tuning::HighLimit> =
    make_words<tuning::HighLimit>({{tuning::HighLimit::accuracy, "accuracy"},
                                   {tuning::HighLimit::stability, "stability"},
                                   {tuning::HighLimit::range, "range"}});

}  // namespace linkstudy

namespace linkstudy::tuning {

// The feasible interval that starts at the point found; of several variables along the axis of one,
// the others being at the point. At an open end the range ended first.
struct Window {
  double low = 0.0;
  double high = 0.0;
  double margin = 0.0;  // log10(high / low), or of a linear range the part of it
  HighLimit high_limited_by = HighLimit::range;
  bool low_open = false;
};

struct TuningResult {
  TuningStatus status = TuningStatus::inconclusive;
  std::string reason;  // one line; empty when certified
  TuningProblem problem;
  std::vector<double> point;  // lowest that matches, or the lowest seen; empty when none
  double objective = 0.0;     // what was minimised
  // Of the point at the base step; when no point matches, of the one with the smallest ratio.
  Answer answer;
  double answer_value = 0.0;                 // where that is
  std::size_t binding = 0;                   // component closest to its tolerance
  std::optional<Observation> first_failure;  // lowest id that ended by a cause
  std::optional<Window> window;              // nothing when no point matches
  std::vector<Window> windows;               // of several variables, one each
  std::vector<Observation> staircase;        // the same, minimal points by their objective
  std::optional<Certificate> certificate;
  std::optional<StepSuggestion> suggestion;  // when no point matches
  std::optional<StepReach> step_reach;       // at the point
  NloptReport nlopt;
  std::vector<ScanPoint> points;          // every value tried at the base step, with its side
  std::vector<Observation> observations;  // every evaluation in the order asked
  std::size_t rounds = 0;                 // batches asked for
  std::vector<std::string> notes;         // what else the user should know
};

// Of a tune of one.
inline const TunedVariable& variable_of(const TuningResult& result) {
  return result.problem.variables.front();
}

// The worst of several.
TuningStatus worst_of(const std::vector<TuningResult>& results);

// Of the first match, and s; what tells the results of several targets apart.
double tolerance_of(const TuningResult& result);
double step_of(const TuningResult& result);
const std::string& binding_name(const TuningResult& result);
// log10(high / low); NaN of a linear range.
double decades_of(const TunedVariable& variable, const Window& window);
// What was minimised as it is written in the file: the largest value of a response, a tuned value,
// or the sum of log10.
double shown_objective(const TuningResult& result);

std::string budget_reason(const EvaluationLog& log);
// Where the budget or the machine ended the search, that nothing matches is not known.
void doubt_no_match(const EvaluationLog& log, TuningResult& result);
// Of the search; larger steps at the answer may end as they like.
std::optional<Observation> find_first_failure(const EvaluationLog& log);
// Of the answer.
void note_coarse_step(TuningResult& result);

}  // namespace linkstudy::tuning
