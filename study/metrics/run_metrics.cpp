#include "study/metrics/run_metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "study/metrics/common_grid.h"
#include "study/metrics/contact_table.h"

namespace linkstudy {
namespace {

constexpr double kShut[] = {0.0, 0.0, 0.0};  // what gaps are compared with
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

Channel time_channel() {
  return {"time", "s", Quantity::time, 0, 0};
}

Series make_histories(const std::vector<Channel>& channels, const StepGrid& grid,
                      double output_interval) {
  Series series{channels, sample_output(grid, output_interval), {}};
  series.channels.insert(series.channels.begin(), time_channel());
  return series;
}

RunMetrics::RunMetrics(const StudyInput& input, const StudySignals& signals,
                       const SimulationOptions& options, const ReferenceRecord* reference,
                       const RunMetrics* like, const MeasuredRun& measured)
    : grid_(make_step_grid(options)) {
  const bool has_same =
      like != nullptr && like->compares_alike(signals, grid_, reference, measured);
  compared_ = has_same ? like->compared_ : compare(input, signals, grid_, reference, measured);
  for (const MatchError& match : compared_->matches) {
    observers_.comparisons.push_back(match.make_comparison());
  }
  add_gaps(signals);
  if (!signals.trace.empty()) {
    has_traces_ = true;
    observers_.contacts.most = kMostContactsListed;
    observers_.series.push_back(make_histories(signals.trace, grid_, options.output_interval));
  }
  responses_.emplace(input, signals, grid_, observers_);
  first_match_ = observers_.series.size();
  for (std::size_t i = 0; i < compared_->measured_matches.size(); ++i) {
    observers_.series.push_back({signals.match[i], compared_->measured_matches[i].sampling(), {}});
  }
  if (!measured.set) return;
  measured_ = measured.set;
  sampler_.emplace(*measured_, measured.offset, grid_, measured.varies);
  observers_.series.push_back({signals.measured, sampler_->sampling(), {}});
}

std::vector<double> RunMetrics::residuals(const SimulationOutcome& outcome) const {
  if (!sampler_ || outcome.cause != Cause::ok) return {};
  return sampler_->residuals(*measured_, observers_.series.back());
}

std::shared_ptr<const RunMetrics::Compared> RunMetrics::compare(const StudyInput& input,
                                                                const StudySignals& signals,
                                                                const StepGrid& grid,
                                                                const ReferenceRecord* reference,
                                                                const MeasuredRun& measured) {
  Compared compared{grid, reference, measured.reference, signals.match, {}, {}};
  for (std::size_t i = 0; i < input.match.size(); ++i) {
    if (measured.reference) {
      compared.measured_matches.emplace_back(*measured.reference, i, grid);
      continue;
    }
    MatchInput match = input.match[i];
    if (match.cycle) match.window = reference->cycles.at(i);
    compared.matches.emplace_back(match, signals.match[i], grid, reference->match[i],
                                  reference->grid);
  }
  return std::make_shared<const Compared>(std::move(compared));
}

bool RunMetrics::compares_alike(const StudySignals& signals, const StepGrid& grid,
                                const ReferenceRecord* reference,
                                const MeasuredRun& measured) const {
  const Compared& own = *compared_;
  return own.grid.count == grid.count && own.grid.h == grid.h && own.reference == reference &&
         own.measured == measured.reference &&
         std::ranges::equal(own.channels, signals.match, same_channels);
}

void RunMetrics::add_gaps(const StudySignals& signals) {
  for (const std::vector<Channel>& gap : signals.gaps) {
    Comparison comparison;
    comparison.channels = gap;
    comparison.sampling = {0, grid_.count, 1};
    comparison.reference = kShut;
    comparison.is_constant = true;
    comparison.sign.assign(gap.size(), 1.0);
    observers_.comparisons.push_back(std::move(comparison));
  }
}

double RunMetrics::find_gap() const {
  double gap = 0.0;
  for (std::size_t i = compared_->matches.size(); i < observers_.comparisons.size(); ++i) {
    gap = std::max(gap, observers_.comparisons[i].max_vector_error);
  }
  return gap;
}

SimulationOutcome RunMetrics::judged(const SimulationOutcome& outcome) const {
  if (outcome.cause != Cause::ok) return outcome;
  const std::optional<std::string> missing = responses_->missing_turn(observers_);
  if (!missing) return outcome;
  SimulationOutcome failed = outcome;
  failed.cause = Cause::no_full_turn;
  failed.message = *missing;
  return failed;
}

std::vector<double> RunMetrics::reduce(const SimulationOutcome& outcome) const {
  const bool is_ok = outcome.cause == Cause::ok;
  std::vector<double> numbers;
  for (std::size_t i = 0; i < compared_->matches.size(); ++i) {
    const std::vector<double> errors = compared_->matches[i].reduce(observers_.comparisons[i]);
    numbers.insert(numbers.end(), errors.begin(), errors.end());
  }
  for (std::size_t i = 0; i < compared_->measured_matches.size(); ++i) {
    // A run that failed has no samples after its end.
    const std::vector<double> errors =
        is_ok ? compared_->measured_matches[i].reduce(observers_.series[first_match_ + i])
              : std::vector<double>(2 * compared_->channels[i].size(), kNan);
    numbers.insert(numbers.end(), errors.begin(), errors.end());
  }
  if (sampler_) {
    const std::vector<double> all = residuals(outcome);
    double square = 0.0;
    for (const double one : all) square += one * one;
    numbers.push_back(std::sqrt(square / static_cast<double>(all.size())));
  }
  for (const std::vector<double>& one : responses_->reduce(observers_)) {
    numbers.insert(numbers.end(), one.begin(), one.end());
  }
  numbers.push_back(find_gap());
  numbers.push_back(outcome.drift_max);
  numbers.push_back(outcome.energy_residual_max);
  if (!is_ok) std::ranges::fill(numbers, kNan);
  numbers.push_back(outcome.step_limit.omega_max);
  numbers.push_back(outcome.step_limit.seconds);
  numbers.push_back(grid_.h * outcome.step_limit.omega_max);
  numbers.push_back(static_cast<double>(outcome.steps));
  numbers.push_back(outcome.end_time);
  numbers.push_back(static_cast<double>(outcome.contacts));
  numbers.push_back(static_cast<double>(outcome.least_contact_steps));
  return numbers;
}

std::vector<Trace> RunMetrics::traces() const {
  return has_traces_ ? to_traces(observers_.series.front()) : std::vector<Trace>();
}

std::optional<Table> RunMetrics::contacts(const Mechanism& mechanism) const {
  if (observers_.contacts.records.empty()) return std::nullopt;
  return make_contact_table(mechanism, observers_.contacts);
}

std::vector<Trace> to_traces(const Series& series) {
  std::vector<Trace> traces;
  const std::size_t n = series.channels.size();
  for (std::size_t c = 0; c < n; ++c) {
    Trace trace{series.channels[c].name, series.channels[c].unit, {}};
    trace.values.reserve(series.rows());
    for (std::size_t row = 0; row < series.rows(); ++row) {
      trace.values.push_back(series.values[row * n + c]);
    }
    traces.push_back(std::move(trace));
  }
  return traces;
}

State<double> state_at(const Series& series, const Mechanism& mechanism, std::size_t row) {
  State<double> state = make_state<double>(mechanism);
  const std::size_t n = series.channels.size();
  for (std::size_t c = 0; c < n; ++c) {
    const Channel& channel = series.channels[c];
    const double value = series.values[row * n + c];
    const auto index = static_cast<std::size_t>(channel.index);
    if (channel.quantity == Quantity::time) state.t = value;
    if (channel.quantity == Quantity::q) state.q[PositionIndex(index)] = value;
    if (channel.quantity == Quantity::v) state.v[VelocityIndex(index)] = value;
  }
  return state;
}

}  // namespace linkstudy
