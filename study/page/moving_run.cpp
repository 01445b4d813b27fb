#include "study/page/moving_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/kinematics/link_poses.h"
#include "study/config/input_error.h"
#include "study/page/thin.h"
#include "study/record/digest.h"
#include "study/session/model_results.h"
#include "study/session/stored_answer.h"
#include "study/session/stored_evaluator.h"

namespace linkstudy {
namespace {

Series all_channels(const Mechanism& mechanism, const SimulationOptions& options) {
  Sampling sampling = sample_output(make_step_grid(options), options.output_interval);
  constexpr long kMost = kMostRows;
  sampling.stride *= std::max(1L, (sampling.count() + kMost - 1) / kMost);
  return {list_channels(mechanism), sampling, {}};
}

void add_poses(MovingRun& run, const Model& model, const Series& series) {
  for (const std::size_t row : even_rows(series.rows(), kMostPoses)) {
    const State<double> state = state_at(series, model.mechanism, row);
    run.times.push_back(state.t);
    const auto poses = link_poses(run.linkage, model, state);
    run.poses.insert(run.poses.end(), poses.begin(), poses.end());
  }
}

MovingRun move(const ModelInput& input, double timeout_s) {
  MovingRun run;
  run.linkage = input.linkage;
  const Preparation preparation = prepare(input.linkage, input.options);
  const Model& model = preparation.model;
  run.links = model.mechanism.link_names;
  if (preparation.cause != Cause::ok) {
    run.ended = fmt::format("{}: {}", name_of(preparation.cause), preparation.message);
    return run;
  }
  Observers observers;
  observers.series.push_back(all_channels(model.mechanism, input.options));
  RunLimits limits;
  limits.timeout_s = timeout_s;
  const SimulationOutcome outcome =
      simulate(model.mechanism, model.parameters, model.start, input.options, observers, limits,
               worse({}, preparation.spectrum, model.start.t));
  if (outcome.cause != Cause::ok) {
    run.ended = fmt::format("{}: {}", name_of(outcome.cause), outcome.message);
  }
  run.histories.traces = to_traces(observers.series.front());
  add_poses(run, model, observers.series.front());
  return run;
}

// The one whose component binds a tune ("fast_closure.S.force.x"), or the first.
std::size_t shown_load_case(const Evaluator& evaluator, const StudyResults& results) {
  const nlohmann::json answer = stored_answer(results);
  const auto component = nlohmann::json::json_pointer("/binding/component");
  if (!answer.is_object() || !answer.contains(component)) return 0;
  const auto text = answer[component].get<std::string>();
  for (std::size_t i = 0; i < evaluator.load_case_count(); ++i) {
    const std::string& name = evaluator.load_case_name(i);
    if (!name.empty() && text.starts_with(name)) return i;
  }
  return 0;
}

class Again {
 public:
  Again(const StudyResults& results, double timeout_s) : results_(results), timeout_s_(timeout_s) {}

  MovingRuns run(std::uint64_t id) {
    const std::vector<Evaluation> evaluations = latest_by_id(results_.evaluations);
    const auto stored =
        std::ranges::find(evaluations, id, [](const Evaluation& one) { return one.point.id; });
    if (stored == evaluations.end()) {
      throw UsageError(fmt::format("--evaluation {}: these results hold no such evaluation", id));
    }
    const std::unique_ptr<Evaluator> evaluator = make_stored_evaluator(results_);
    const std::size_t load_case = shown_load_case(*evaluator, results_);
    const std::string name = evaluator->load_case_name(load_case);
    add(fmt::format("evaluation {}", id), name, static_cast<std::int64_t>(id),
        evaluator->model_at(load_case, stored->point.values));
    if (const auto reference = evaluator->reference_model_at(load_case)) {
      add("reference", name, -1, *reference);
    }
    return std::move(found_);
  }

 private:
  void add(std::string title, const std::string& load_case, std::int64_t evaluation,
           const ModelInput& input) {
    MovingRun run = move(input, timeout_s_);
    run.title = std::move(title);
    run.load_case = load_case;
    run.histories.name = evaluation < 0 ? "reference" : fmt::format("evaluation_{}", evaluation);
    if (!load_case.empty()) run.histories.name += "_" + load_case;
    run.histories.evaluation = evaluation;
    if (!run.ended.empty()) {
      found_.notes.push_back(fmt::format("{} run again ended early: {}", run.title, run.ended));
    }
    found_.runs.push_back(std::move(run));
  }

  const StudyResults& results_;
  double timeout_s_;
  MovingRuns found_;
};

}  // namespace

MovingRuns run_again(const StudyResults& results, std::optional<std::uint64_t> evaluation,
                     double timeout_s) {
  const std::optional<std::uint64_t> id = evaluation ? evaluation : choose_shown(results);
  const std::optional<AnswerKind> analysis = analysed_kind(results);
  if (analysis && evaluation.value_or(0) == 0) return show_analysis(results, *analysis);
  if (!id) return {{}, {"no evaluation ended well: there is no motion to show"}};
  try {
    return Again(results, timeout_s).run(*id);
  } catch (const UsageError&) {
    throw;
  } catch (const std::exception& error) {
    return {{}, {fmt::format("evaluation {} could not be run again: {}", *id, error.what())}};
  }
}

}  // namespace linkstudy
