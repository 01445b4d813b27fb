#include "study/plan/sizes.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "core/model/compile.h"
#include "study/config/input_error.h"
#include "study/config/precedence.h"

namespace linkstudy::plan {
namespace {

constexpr double kNumber = 8.0;
// Beside its numbers: id, cause, wall time, host, lengths; as nodes and strings in memory.
constexpr double kOfEvaluation = 150.0;
constexpr double kInMemory = 400.0;
// Texts of the inputs and the names of the numbers, once in the journal.
constexpr double kOfTexts = 1e4;
// Of MPI, which does not run here: Open MPI 4.1 on one computer.
constexpr double kOfMpi = 18e6;
// Groups, attributes and texts of results.h5, and what a dataset of it takes at least.
constexpr double kOfFile = 30e3;
constexpr double kOfDataset = 1200.0;

struct RunSizes {
  double compared = 0.0;  // what the cases of a pack share
  double watched = 0.0;   // while a case runs
  double traces = 0.0;    // histories that it leaves
};

std::size_t total_size(const std::vector<std::vector<Channel>>& lists) {
  std::size_t size = 0;
  for (const std::vector<Channel>& one : lists) size += one.size();
  return size;
}

double history_bytes(std::size_t channels, const StepGrid& grid, double output_interval) {
  if (channels == 0) return 0.0;
  const double rows = static_cast<double>(sample_output(grid, output_interval).count());
  return kNumber * rows * static_cast<double>(channels + 1);
}

RunSizes sizes_of(const Evaluator& study, const RunKind& kind) {
  const StudySignals& signals = study.signals();
  const double rows = static_cast<double>(kind.grid.count + 1);
  const double gap = signals.gaps.empty() ? 0.0 : 3.0;
  RunSizes sizes;
  sizes.compared = kNumber * rows * (static_cast<double>(total_size(signals.match)) + gap);
  sizes.traces = history_bytes(signals.trace.size(), kind.grid, kind.options.output_interval);
  const auto cases = load_cases_of(study.input());
  const auto& measured = cases[kind.load_case].measured;
  double watched = measured ? 3.0 * static_cast<double>(measured->signals.size()) : 0.0;
  for (std::size_t i = 0; i < signals.response.size(); ++i) {
    if (!study.input().response[i].cycle) continue;
    watched +=
        static_cast<double>(signals.response[i].size() + signals.response_place[i].size() + 1);
  }
  sizes.watched = sizes.traces + kNumber * rows * watched;
  return sizes;
}

// What is kept of a reference run: matched signals at every step, and histories.
struct ReferenceSizes {
  double match = 0.0;
  double histories = 0.0;
};

ReferenceSizes reference_sizes(const Evaluator& study, std::size_t load_case) {
  const LoadCaseInput one = load_cases_of(study.input())[load_case];
  const StudyInput view = reference_view(study.input(), one);
  Diagnostics diagnostics;
  const auto model =
      reference_run_of(view, one)->model->with(reference_overrides(view, one), diagnostics);
  throw_if_any(diagnostics);
  const StudySignals signals =
      find_reference_signals(view, list_channels(compile(model->linkage).mechanism), diagnostics);
  throw_if_any(diagnostics);
  const StepGrid grid = make_step_grid(model->options);
  return {kNumber * static_cast<double>(grid.count + 1) *
              static_cast<double>(total_size(signals.match)),
          history_bytes(signals.trace.size(), grid, model->options.output_interval)};
}

// Of this process, now.
double resident_bytes() {
  std::ifstream file("/proc/self/statm");
  double size = 0.0;
  double resident = 0.0;
  file >> size >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

}  // namespace

Sizes find_sizes(Evaluator& study, const RunKinds& kinds, std::uint64_t evaluations,
                 std::size_t widest) {
  const bool is_fit = study.input().kind == FileKind::calibrate;
  ReferenceSizes reference;
  double residuals = 0.0;
  for (std::size_t i = 0; i < study.load_case_count(); ++i) {
    if (study.has_reference(i)) {
      const ReferenceSizes one = reference_sizes(study, i);
      reference.match += one.match;
      reference.histories += one.histories;
    }
    if (!is_fit) continue;  // else this would run the reference
    residuals += kNumber * static_cast<double>(study.measured_set(i)->sample_count());
  }
  double pack = 0.0;
  std::vector<double> traces(study.load_case_count(), 0.0);
  for (const RunKind& kind : kinds.all()) {
    const RunSizes one = sizes_of(study, kind);
    const auto side_by_side = static_cast<double>(std::min(widest, kind.points.size()));
    pack = std::max(pack, one.compared + side_by_side * one.watched);
    traces[kind.load_case] = std::max(traces[kind.load_case], one.traces);
  }
  const double references = reference.match + reference.histories;
  double histories = 0.0;
  for (const double one : traces) histories += one;
  const auto numbers = static_cast<double>(study.responses().size() + study.parameters().size());
  const double evaluation = kNumber * numbers + residuals + histories;
  const auto count = static_cast<double>(evaluations);
  Sizes sizes;
  // Histories once more as the message that takes them to rank 0, references as the one they come
  // by.
  sizes.rank = resident_bytes() + kOfMpi + 2.0 * references + pack +
               static_cast<double>(widest) * 2.0 * histories;
  sizes.first_rank = sizes.rank + references + count * (evaluation + kInMemory);
  sizes.journal = kOfTexts + references + count * (evaluation + kOfEvaluation);
  const double datasets = numbers + (histories > 0.0 ? count : 0.0);
  sizes.results = kOfFile + kOfDataset * datasets + count * kNumber * (numbers + 8.0) +
                  count * histories + reference.histories;
  return sizes;
}

}  // namespace linkstudy::plan
