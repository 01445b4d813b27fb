#include "study/session/verification.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <set>

#include "core/base/isa.h"
#include "study/config/input_error.h"
#include "study/converge/judge_convergence.h"
#include "study/converge/write_convergence.h"
#include "study/evaluate/form_packs.h"
#include "study/metrics/response_list.h"
#include "study/record/digest.h"
#include "study/record/transient.h"
#include "study/record/version.h"
#include "study/sensitivity/judge_sensitivity.h"
#include "study/sensitivity/write_sensitivity.h"
#include "study/session/analysis_check.h"
#include "study/session/calibration_run.h"
#include "study/session/model_results.h"
#include "study/session/stored_answer.h"
#include "study/session/stored_evaluator.h"
#include "study/session/stored_program.h"
#include "study/session/study_record.h"
#include "study/session/tuning_run.h"
#include "study/store/store_error.h"
#include "study/tune/tune.h"
#include "study/tune/tuning_setup.h"
#include "study/tune/write_tuning.h"

namespace linkstudy {
namespace {

// Every list "evaluations" below a certificate.
void collect_evaluations(const nlohmann::json& json, std::vector<std::uint64_t>& ids) {
  if (json.is_object() && json.contains("evaluations") && json["evaluations"].is_array()) {
    for (const auto& id : json["evaluations"]) {
      if (id.is_number_unsigned()) ids.push_back(id.get<std::uint64_t>());
    }
  }
  if (!json.is_structured()) return;
  for (const auto& part : json) collect_evaluations(part, ids);
}

// The evaluation of an answer and those of its certificate; of one answer, or of several.
void collect_needed(const nlohmann::json& answer, std::vector<std::uint64_t>& ids) {
  if (!answer.is_object()) return;
  if (answer.contains("certificate")) collect_evaluations(answer["certificate"], ids);
  if (answer.contains("evaluation") && answer["evaluation"].is_number_unsigned()) {
    ids.push_back(answer["evaluation"].get<std::uint64_t>());
  }
  if (!answer.contains("answers")) return;
  for (const auto& one : answer["answers"]) collect_needed(one, ids);
}

// Responses that studies are about: errors and [[response]].
std::vector<std::size_t> compared_columns(const StudyDescription& description) {
  std::vector<std::size_t> columns;
  for (const StoredCase& one : split_responses(description.responses)) {
    const std::vector<std::size_t> errors = error_columns(one);
    columns.insert(columns.end(), errors.begin(), errors.end());
    columns.insert(columns.end(), one.responses.begin(), one.responses.end());
  }
  return columns;
}

class Verifier {
 public:
  Verifier(const StudyResults& results, const VerifyOptions& options)
      : results_(results), options_(options) {
    for (const Evaluation& one : latest_by_id(results.evaluations)) {
      evaluations_[one.point.id] = one;
    }
  }

  Verification run() {
    if (evaluations_.empty()) {
      throw StoreError("there is nothing to verify: these results hold no evaluation");
    }
    result_.stored = evaluations_.size();
    evaluator_ = make_stored_evaluator(results_);
    compare_program();
    const nlohmann::json answer = stored_answer(results_);
    std::vector<std::uint64_t> needed;
    collect_needed(answer, needed);
    collect_without_residuals(needed);
    result_.rerun = choose_evaluations(results_, needed, options_);
    run_again();
    if (answer.is_object()) judge_answer(answer);
    return std::move(result_);
  }

 private:
  // Of a fit; a file of results has them of the best alone.
  void collect_without_residuals(std::vector<std::uint64_t>& ids) const {
    if (evaluator_->input().kind != FileKind::calibrate) return;
    for (const auto& [id, one] : evaluations_) {
      if (one.status == Cause::ok && one.residuals.empty()) ids.push_back(id);
    }
  }

  void compare_program() {
    if (const auto warning = revision_warning(results_)) result_.warnings.push_back(*warning);
    for (std::size_t i = 0; i < evaluator_->responses().size(); ++i) columns_.push_back(i);
    const std::optional<std::string> warning = rounding_warning(results_);
    result_.to_the_bit = !warning;
    if (!warning) return;
    columns_ = compared_columns(results_.description);
    result_.warnings.push_back(fmt::format("{}: compared to {:g}", *warning, kOtherRounding));
  }

  void run_again() {
    std::vector<Point> points;
    for (const std::uint64_t id : result_.rerun) points.push_back(evaluations_.at(id).point);
    if (points.empty()) return;
    const int width = pack_width(*evaluator_, points, simd_level().lanes, 1);
    for (const std::vector<Point>& pack : form_packs(points, evaluator_->parameters(), width, 1)) {
      for (Evaluation& found : evaluator_->evaluate(pack)) {
        Evaluation& stored = evaluations_.at(found.point.id);
        compare(stored, found);
        // Where roundings differ, the stored ones led the search.
        if (result_.to_the_bit || stored.residuals.empty()) stored = std::move(found);
      }
    }
  }

  void compare(const Evaluation& stored, const Evaluation& found) {
    const std::uint64_t id = stored.point.id;
    if (stored.status != found.status) {
      result_.disagreements.push_back(
          {id, "status", std::string(name_of(stored.status)), std::string(name_of(found.status))});
      return;
    }
    for (const std::size_t i : columns_) {
      const double a = i < stored.responses.size() ? stored.responses[i] : std::nan("");
      const double b = found.responses[i];
      if (agrees(a, b)) continue;
      result_.disagreements.push_back(
          {id, evaluator_->responses()[i].name, shown_number(a), shown_number(b)});
    }
    if (result_.to_the_bit && !stored.residuals.empty()) compare_residuals(stored, found);
  }

  // The first that differs says it.
  void compare_residuals(const Evaluation& stored, const Evaluation& found) {
    const auto [a, b] = std::ranges::mismatch(stored.residuals, found.residuals);
    if (a == stored.residuals.end() && b == found.residuals.end()) return;
    result_.disagreements.push_back({stored.point.id,
                                     fmt::format("residual {}", a - stored.residuals.begin()),
                                     a == stored.residuals.end() ? "nothing" : shown_number(*a),
                                     b == found.residuals.end() ? "nothing" : shown_number(*b)});
  }

  bool agrees(double a, double b) const {
    if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b);
    if (a == b) return true;
    const double size = std::max(std::abs(a), std::abs(b));
    return !result_.to_the_bit && std::abs(a - b) <= kOtherRounding * size;
  }

  // From what was run again, and the rest as stored.
  void judge_answer(const nlohmann::json& stored) {
    if (stored.contains("status")) result_.answer = stored["status"].get<std::string>();
    std::optional<nlohmann::json> found;
    const FileKind kind = evaluator_->input().kind;
    if (kind == FileKind::tune) found = tune_again();
    if (kind == FileKind::calibrate) found = calibrate_again();
    if (kind == FileKind::converge) found = converge_again();
    if (kind == FileKind::study) {
      found = nlohmann::json::parse(sensitivity::write_json(sensitivity::judge_sensitivity(
          evaluator_->input(), evaluator_->responses(), evaluations_)));
    }
    if (!found || result_.refuted || !result_.to_the_bit || *found == stored) return;
    result_.refuted = fmt::format("judged anew the answer is another: {}",
                                  nlohmann::json::diff(stored, *found).front().dump());
  }

  // Searches with their evaluations at hand.
  std::optional<nlohmann::json> tune_again() {
    return search_again([this](const EvaluationSource& stored) {
      TuningRun run(*evaluator_, stored);
      const std::vector<tuning::TuningResult> results = search_tuning(*evaluator_, run);
      for (const tuning::TuningResult& result : results) check_claims(result);
      return tuning::write_json(results, "");
    });
  }

  std::optional<nlohmann::json> calibrate_again() {
    return search_again([this](const EvaluationSource& stored) {
      return calibration::write_json(fit_calibration(*evaluator_, stored), "");
    });
  }

  // Nothing where the search asks for what is not stored.
  template <class Search>
  std::optional<nlohmann::json> search_again(const Search& search) {
    const auto require_stored = [&](const std::vector<Point>& points) {
      for (const Point& point : points) {
        const auto known = evaluations_.find(point.id);
        const bool is_it =
            known != evaluations_.end() && known->second.point.values == point.values;
        if (is_it) continue;
        throw StoreError(
            fmt::format("the search asks for another evaluation {} than is stored", point.id));
      }
    };
    const auto find = [&](std::uint64_t id) -> const Evaluation& { return evaluations_.at(id); };
    try {
      return nlohmann::json::parse(search({require_stored, find}));
    } catch (const StoreError& error) {
      result_.refuted = error.what();
      return std::nullopt;
    }
  }

  void check_claims(const tuning::TuningResult& result) {
    if (!result.certificate) return;
    const auto look_up = [&](std::uint64_t id) -> std::optional<tuning::Observation> {
      const auto seen = std::ranges::find(
          result.observations, id, [](const tuning::Observation& one) { return one.answer.id; });
      if (seen == result.observations.end() || !evaluations_.contains(id)) return std::nullopt;
      return tuning::Observation{seen->request, to_answer(*evaluator_, evaluations_.at(id))};
    };
    const tuning::Certificate checked = tuning::check_certificate(*result.certificate, look_up);
    if (checked.verdict == tuning::Verdict::refuted) result_.refuted = checked.reason;
  }

  // References of a refinement are run again, too.
  nlohmann::json converge_again() {
    evaluator_->run_references();
    const auto find_histories = [&](std::uint64_t id,
                                    const std::string& load_case) -> const std::vector<Trace>* {
      for (const CaseTraces& set : evaluations_.at(id).traces) {
        if (set.load_case == load_case) return &set.traces;
      }
      return find_traces(results_, id, load_case);
    };
    return nlohmann::json::parse(convergence::write_json(
        convergence::judge_convergence(*evaluator_, evaluations_, find_histories), ""));
  }

  const StudyResults& results_;
  const VerifyOptions& options_;
  std::map<std::uint64_t, Evaluation> evaluations_;  // as stored, then as run again
  std::unique_ptr<Evaluator> evaluator_;
  // All; but residuals, drifts and gaps are made of rounding, and other sets have others.
  std::vector<std::size_t> columns_;
  Verification result_;
};

// In the order of their weight, each once.
class Selection {
 public:
  explicit Selection(const std::vector<Evaluation>& evaluations) : evaluations_(evaluations) {
    for (const Evaluation& one : evaluations) {
      if (!is_transient(one.status)) comparable_.insert(one.point.id);
    }
  }

  void add(std::uint64_t id) {
    if (comparable_.contains(id) && chosen_.insert(id).second) order_.push_back(id);
  }

  void add_ends() {
    if (comparable_.empty()) return;
    add(*comparable_.begin());
    add(*comparable_.rbegin());
  }

  void add_failures() {
    std::set<Cause> causes;
    for (const Evaluation& one : evaluations_) {
      if (one.status != Cause::ok && causes.insert(one.status).second) add(one.point.id);
    }
  }

  void add_extremes(std::size_t column) {
    const Evaluation* least = nullptr;
    const Evaluation* greatest = nullptr;
    for (const Evaluation& one : evaluations_) {
      const bool counts = one.status == Cause::ok && column < one.responses.size() &&
                          !std::isnan(one.responses[column]);
      if (!counts) continue;
      const double value = one.responses[column];
      if (least == nullptr || value < least->responses[column]) least = &one;
      if (greatest == nullptr || value > greatest->responses[column]) greatest = &one;
    }
    if (least != nullptr) add(least->point.id);
    if (greatest != nullptr) add(greatest->point.id);
  }

  void add_random(std::uint64_t seed, std::size_t count) {
    std::vector<std::uint64_t> rest;
    std::ranges::set_difference(comparable_, chosen_, std::back_inserter(rest));
    std::mt19937_64 generator(seed);
    while (order_.size() < count && !rest.empty()) {
      const auto at = static_cast<std::ptrdiff_t>(generator() % rest.size());
      add(rest[static_cast<std::size_t>(at)]);
      rest.erase(rest.begin() + at);
    }
  }

  void add_all() {
    for (const std::uint64_t id : comparable_) add(id);
  }

  std::size_t size() const { return order_.size(); }

  std::vector<std::uint64_t> take(std::size_t count) {
    order_.resize(std::min(order_.size(), count));
    std::ranges::sort(order_);
    return std::move(order_);
  }

 private:
  const std::vector<Evaluation>& evaluations_;
  std::set<std::uint64_t> comparable_, chosen_;
  std::vector<std::uint64_t> order_;
};

}  // namespace

std::vector<std::uint64_t> choose_evaluations(const StudyResults& results,
                                              const std::vector<std::uint64_t>& needed,
                                              const VerifyOptions& options) {
  const std::vector<Evaluation> evaluations = latest_by_id(results.evaluations);
  Selection selection(evaluations);
  for (const std::uint64_t id : needed) selection.add(id);
  const std::size_t count = std::max(options.count, selection.size());
  selection.add_ends();
  selection.add_failures();
  for (const std::size_t column : compared_columns(results.description)) {
    selection.add_extremes(column);
  }
  selection.add_random(results.description.seed, count);
  if (options.all) selection.add_all();
  return selection.take(options.all ? evaluations.size() : count);
}

Verification verify_results(const StudyResults& results, const VerifyOptions& options) {
  if (const auto kind = analysed_kind(results)) return verify_analysis(results, *kind);
  return Verifier(results, options).run();
}

}  // namespace linkstudy
