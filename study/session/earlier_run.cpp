#include "study/session/earlier_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "study/config/input_error.h"
#include "study/config/measured_reader.h"
#include "study/record/counted.h"
#include "study/record/digest.h"
#include "study/session/study_record.h"
#include "study/store/results_file.h"
#include "study/store/store_error.h"

namespace linkstudy {
namespace {

// The evaluation that an input names, in results that are there.
class EarlierRunFinder {
 public:
  EarlierRunFinder(const StudyResults& results, const MeasuredInput& measured,
                   Diagnostics& diagnostics)
      : evaluations_(latest_by_id(results.evaluations)),
        results_(results),
        measured_(measured),
        diagnostics_(diagnostics) {}

  std::optional<EarlierRun> find() {
    const Evaluation* one = find_evaluation();
    if (one == nullptr) return std::nullopt;
    const std::string& load_case = measured_.results->load_case;
    const std::vector<Trace>* traces = find_traces(results_, one->point.id, load_case);
    const auto is_time = [](const Trace& trace) { return trace.name == "time"; };
    if (traces == nullptr || std::ranges::none_of(*traces, is_time)) {
      report_no_traces(*one);
      return std::nullopt;
    }
    const StudyDescription& description = results_.description;
    return EarlierRun{*traces,
                      results_digest(description.parameters, description.responses, evaluations_)};
  }

 private:
  void report(const std::string& message, const std::string& remedy) {
    diagnostics_.add(measured_.file_at, message, remedy);
  }

  const Evaluation* find_evaluation() {
    const ResultsInput& asked = *measured_.results;
    if (evaluations_.empty()) {
      report(fmt::format("'{}' has no evaluation that has ended", asked.directory), "finish it");
      return nullptr;
    }
    if (!asked.evaluation && evaluations_.size() > 1) {
      report(fmt::format("'{}' has {} evaluations, and it is not said which is meant",
                         asked.directory, evaluations_.size()),
             fmt::format("evaluation = one of {}", listed(ended_ok())));
      return nullptr;
    }
    const std::uint64_t id = asked.evaluation.value_or(evaluations_.front().point.id);
    const auto found = std::ranges::find_if(
        evaluations_, [id](const Evaluation& one) { return one.point.id == id; });
    if (found == evaluations_.end()) {
      report(fmt::format("'{}' has no evaluation {} that has ended", asked.directory, id),
             fmt::format("there are {}", listed(ended_ok())));
      return nullptr;
    }
    if (found->status == Cause::ok) return &*found;
    report(fmt::format("evaluation {} of '{}' failed ({}): {}", id, asked.directory,
                       name_of(found->status), found->message),
           ended_ok().empty() ? "no evaluation there ended ok"
                              : fmt::format("evaluation = one of {}", listed(ended_ok())));
    return nullptr;
  }

  std::vector<std::uint64_t> ended_ok() const {
    std::vector<std::uint64_t> ids;
    for (const Evaluation& one : evaluations_)
      if (one.status == Cause::ok) ids.push_back(one.point.id);
    return ids;
  }

  void report_no_traces(const Evaluation& evaluation) {
    const ResultsInput& asked = *measured_.results;
    const std::vector<std::string> kept = load_cases_with_traces(results_, evaluation.point.id);
    const std::string of =
        fmt::format("evaluation {} of '{}'", evaluation.point.id, asked.directory);
    if (kept.empty()) {
      report(fmt::format("{} has no histories", of),
             "a study keeps those that [[trace]] names, simulate -o all channels");
    } else if (kept.front().empty()) {
      report(fmt::format("{} has no load cases, and '{}' is asked for", of, asked.load_case),
             "take load_case out");
    } else {
      report(asked.load_case.empty()
                 ? fmt::format("{} has several load cases, and it is not said which is meant", of)
                 : fmt::format("{} has no load case '{}'", of, asked.load_case),
             fmt::format("load_case = one of {}", fmt::join(kept, ", ")));
    }
  }

  std::vector<Evaluation> evaluations_;
  const StudyResults& results_;
  const MeasuredInput& measured_;
  Diagnostics& diagnostics_;
};

}  // namespace

ReadEarlierRun earlier_run_reader() {
  return [known = std::map<std::string, StudyResults>()](
             const std::string& path, const MeasuredInput& measured,
             Diagnostics& diagnostics) mutable -> std::optional<EarlierRun> {
    try {
      if (!known.contains(path)) known.emplace(path, read_stored(path));
      return EarlierRunFinder(known.at(path), measured, diagnostics).find();
    } catch (const StoreError& error) {
      diagnostics.add(measured.file_at, fmt::format("earlier results: {}", error.what()),
                      "name a directory of results, or its results.h5");
      return std::nullopt;
    }
  };
}

void refuse_own_results(const StudyInput& input, const std::string& output) {
  namespace fs = std::filesystem;
  Diagnostics found;
  for (const MeasuredInput* one : measured_inputs(input)) {
    if (!one->results) continue;
    fs::path source = fs::path(input.file).parent_path() / one->results->directory;
    if (fs::is_regular_file(source)) source = source.parent_path();
    std::error_code ignored;  // an output that is not there yet is no source
    if (!fs::equivalent(source, output, ignored)) continue;
    found.add(one->file_at,
              fmt::format("'{}' is where the results of this file go", one->results->directory),
              "choose another directory with -o");
  }
  throw_if_any(found);
}

}  // namespace linkstudy
