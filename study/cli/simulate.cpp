#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "core/base/isa.h"
#include "core/simulation/channel_kinds.h"
#include "core/topology/nearest_name.h"
#include "study/cli/exit_code.h"
#include "study/cli/input.h"
#include "study/cli/model_report.h"
#include "study/cli/output.h"
#include "study/cli/verbs.h"
#include "study/metrics/run_metrics.h"
#include "study/report/table.h"
#include "study/schedule/run_progress.h"
#include "study/store/file.h"

namespace linkstudy {
namespace {

using Clock = std::chrono::steady_clock;

std::vector<std::string> split_list(const std::string& text) {
  std::vector<std::string> parts;
  std::size_t at = 0;
  while (at <= text.size()) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    if (comma > at) parts.push_back(text.substr(at, comma - at));
    at = comma + 1;
  }
  return parts;
}

// Time first, then all channels or those of --signals in the order asked for.
std::vector<Channel> choose_channels(const std::vector<Channel>& all,
                                     const std::optional<std::string>& signals) {
  if (!signals) return all;
  std::vector<Channel> chosen = {time_channel()};
  for (const std::string& signal : split_list(*signals)) {
    const std::vector<Channel> found = find_channel_group(all, signal);
    if (found.empty()) {
      std::vector<std::string> names = signal_names(all);
      for (const Channel& channel : all) names.push_back(channel.name);
      throw UsageError(fmt::format("--signals: there is no '{}'; nearest: {}", signal,
                                   fmt::join(nearest_names(signal, names, 3), ", ")));
    }
    for (const Channel& channel : found) {
      const bool is_known = std::ranges::any_of(
          chosen, [&](const Channel& other) { return other.name == channel.name; });
      if (!is_known) chosen.push_back(channel);
    }
  }
  return chosen;
}

// The series of --csv, with every name checked before anything runs.
Observers choose_series(const CommandLine& line, const ModelInput& input) {
  Observers observers;
  if (!line.csv) return observers;
  const std::vector<Channel> all = list_channels(compile(input.linkage).mechanism);
  const Sampling sampling =
      sample_output(make_step_grid(input.options), input.options.output_interval);
  observers.series.push_back({choose_channels(all, line.signals), sampling, {}});
  return observers;
}

std::string to_csv(const Series& series) {
  Table table;
  for (const Channel& channel : series.channels) {
    table.columns.push_back({channel.name, channel.unit});
  }
  const std::size_t n = series.channels.size();
  for (std::size_t row = 0; row < series.rows(); ++row) {
    std::vector<Cell> cells(n);
    for (std::size_t c = 0; c < n; ++c) cells[c] = series.values[row * n + c];
    table.rows.push_back(std::move(cells));
  }
  return csv_of(table);
}

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

// The summary goes to standard output unless a table or an object is wanted there.
void print_text(const CommandLine& line, const std::string& text) {
  if (line.json || line.csv == "-") {
    fmt::print(stderr, "{}", text);
  } else {
    print_out(text);
  }
}

int report_unprepared(const CommandLine& line, const Preparation& preparation, double wall_s) {
  print_err(
      fmt::format("linkstudy: error: {}: {}\n", name_of(preparation.cause), preparation.message));
  if (line.json) print_out(outcome_json(preparation, nullptr, wall_s) + "\n");
  return kTooManyFailed;
}

SimulationOutcome run_model(const CommandLine& line, const Preparation& preparation,
                            const SimulationOptions& options, Observers& observers) {
  const Model& model = preparation.model;
  std::atomic<double> reached{0.0};
  const RunWatch watch(*find_word<ProgressMode>(line.progress), options.end_time, reached);
  RunLimits limits;
  limits.timeout_s = line.timeout_s.value_or(0.0);
  limits.reached = &reached;
  const SimulationOutcome outcome =
      simulate(model.mechanism, model.parameters, model.start, options, observers, limits,
               worse({}, preparation.spectrum, model.start.t));
  reached = outcome.end_time;
  return outcome;
}

void write_csv(const CommandLine& line, const Observers& observers) {
  if (!line.csv) return;
  const std::string csv = to_csv(observers.series.front());
  if (line.csv == "-") {
    print_out(csv);
  } else {
    write_file_atomically(*line.csv, csv);
  }
}

}  // namespace

int run_simulate(const CommandLine& line) {
  simd_level();  // a wrong LINKSTUDY_SIMD or LINKSTUDY_LANES ends the program here
  if (line.csv) require_writable(*line.csv);
  const ModelInput input = read_model_input(line);
  const auto begin = Clock::now();
  Observers observers = choose_series(line, input);
  remove_old(line.csv);
  const Preparation preparation = prepare(input.linkage, input.options);
  print_err(warning_text(preparation));
  print_text(line, preparation_text(line.inputs.front(), input.name, preparation, input.options));
  if (preparation.cause != Cause::ok) {
    return report_unprepared(line, preparation, seconds_since(begin));
  }
  const SimulationOutcome outcome = run_model(line, preparation, input.options, observers);
  const double wall_s = seconds_since(begin);
  write_csv(line, observers);
  if (!outcome.warning.empty()) {
    print_err(fmt::format("linkstudy: warning: {}\n", outcome.warning));
  }
  print_text(line, outcome_text(outcome, input.options, wall_s));
  if (line.json) print_out(outcome_json(preparation, &outcome, wall_s) + "\n");
  return outcome.cause == Cause::ok ? kDone : kTooManyFailed;
}

}  // namespace linkstudy
