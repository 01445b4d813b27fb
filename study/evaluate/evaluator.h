// From points of the parameter space to their numbers; the only caller of the engine in study/.
//   point -> overrides on the base model -> ModelInput -> prepare -> simulate -> responses
// in every load case; the first that fails, in their order, ends the evaluation with its cause.
// Points, and load cases where points alone do not fill the lanes, run side by side where they can
// share step loops (prepared_case.h); what a point gets is, to the last bit, what it gets alone. An
// invalid model is Cause::invalid_point with the first diagnostic as message, an exception
// Cause::exception after three attempts, the second and third alone. The reference of a load case
// is run when first needed, or given, and kept. cancel() ends what runs between two blocks of
// steps; what has no answer by then is Cause::cancelled: nobody's result, to be asked for again.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "study/evaluate/check_times.h"
#include "study/evaluate/prepared_case.h"
#include "study/evaluate/reference_run.h"
#include "study/metrics/judged_errors.h"
#include "study/record/evaluation.h"

namespace linkstudy {

// The parameter that shifts the data of an experiment in time.
std::string measured_offset_path(const std::string& experiment);
bool is_measured_offset(const std::string& path);

class Evaluator {
 public:
  // `first` is a valid point (parameters of time offsets, measured_offset_path, are none of the
  // model's): its model says which signals there are. Problems with signals are
  // reported at their places; nothing is returned then.
  static std::unique_ptr<Evaluator> make(StudyInput input, std::vector<Parameter> parameters,
                                         const std::vector<Value>& first, Diagnostics& diagnostics);

  const StudyInput& input() const { return input_; }
  const std::vector<Parameter>& parameters() const { return parameters_; }
  const std::vector<Response>& responses() const { return responses_; }
  // In the mechanism of the first point.
  const StudySignals& signals() const { return signals_; }
  const std::vector<JudgedError>& judged_errors() const { return judged_; }
  // Of the objective of a tune; empty where that is none of responses.
  const std::vector<std::size_t>& objective_responses() const { return objective_; }
  // Largest (or, of step_limit, smallest) value of a run number over the load cases.
  double worst(RunNumber number, const std::vector<double>& responses) const;

  std::size_t load_case_count() const { return load_cases_.size(); }
  const std::string& load_case_name(std::size_t i) const { return load_cases_.at(i).name; }
  // What a point is in a load case. Throws InvalidPoint.
  ModelInput model_at(std::size_t load_case, const std::vector<Value>& point) const;
  // What the reference is there; nothing where it is no run. Throws ReferenceFailure.
  std::optional<ModelInput> reference_model_at(std::size_t load_case) const;
  // Whether a load case is compared with a run.
  bool has_reference(std::size_t i) const;
  // Runs the reference of a load case where it is missing. Throws ReferenceFailure; of
  // Cause::cancelled after cancel().
  const ReferenceRecord& run_reference(std::size_t load_case);
  void run_references();
  // Those that are missing of these, side by side. Throws as run_reference.
  void run_references(std::span<const std::size_t> load_cases);
  // Null where it has not been run yet.
  const ReferenceRecord* known_reference(std::size_t load_case) const;
  // As another start or another rank ran it. Throws std::out_of_range where it is none of this
  // study's.
  void set_reference(std::size_t load_case, ReferenceRecord record);
  // Histories of the references, runs and data, by load case; empty without a reference.
  std::vector<CaseTraces> reference_traces() const;

  // What residuals of a load case are taken against; null where it is no experiment. Runs its
  // reference where that stands for measurements. Throws as run_reference, and InvalidPoint.
  std::shared_ptr<const MeasuredSet> measured_set(std::size_t load_case);

  // Longest time of one evaluation, s; 0: no limit. Cases side by side end together: their run
  // counts in full for each.
  void set_timeout(double seconds) { timeout_s_ = seconds; }

  // Where, for how long, and on which rank they ran is for the caller to say. Any thread, one at a
  // time.
  std::vector<Evaluation> evaluate(std::span<const Point> points);

  // Any thread; for good.
  void cancel() { cancelled_.store(true); }
  // Model time that the latest run has reached, s: what changes is alive.
  double reached() const { return reached_.load(std::memory_order_relaxed); }

 private:
  Evaluator(StudyInput input, std::vector<Parameter> parameters, StudySignals signals,
            Diagnostics& diagnostics);

  MeasuredRun measured_run(std::size_t load_case, const Point& point);

  const ReferenceRecord* reference(std::size_t load_case);
  struct Attempt;
  void attempt(std::span<Attempt> attempts);
  void attempt(std::size_t first, std::size_t last, std::span<Attempt> attempts);
  void prepare_cases(std::size_t load_case, std::span<Attempt> attempts,
                     std::vector<std::unique_ptr<PreparedCase>>& cases);
  std::unique_ptr<PreparedCase> prepare_case(std::size_t load_case, std::size_t point,
                                             Attempt& attempt, const RunMetrics* like);
  bool end_if_late(Attempt& attempt) const;
  RunLimits limits_of(double timeout_s);
  void run_group(const CaseGroup& group, std::span<Attempt> attempts);
  void store(const PreparedCase& item, Evaluation& part) const;
  void join(Attempt& attempt) const;
  double time_left(const CaseGroup& group, std::span<Attempt> attempts) const;

  StudyInput input_;
  std::vector<Parameter> parameters_;
  std::vector<LoadCaseInput> load_cases_;
  StudySignals signals_;
  ResponseLayout layout_;
  std::vector<Response> responses_;
  std::vector<JudgedError> judged_;
  std::vector<std::size_t> objective_;
  double timeout_s_ = 0.0;
  std::atomic<bool> cancelled_{false};
  std::atomic<double> reached_{0.0};
  mutable std::mutex mutex_;
  std::vector<std::optional<ReferenceRecord>> references_;    // by load case
  std::vector<std::shared_ptr<const MeasuredSet>> measured_;  // by load case
  MeasuredReferences measured_references_;
};

}  // namespace linkstudy
