#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "study/calibrate/fit_report.h"

namespace linkstudy::calibration {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// One column a fitted value.
template <class Row, class Field>
void add_values(TableOf<Row>& table, const FitProblem& problem, const char* meaning, Field values) {
  for (std::size_t i = 0; i < problem.parameters.size(); ++i) {
    table.add(problem.parameters[i].name, problem.parameters[i].unit, meaning,
              [&, i](const Row& row) { return values(row).at(i); });
  }
}

struct ValueRow {
  std::string name;
  std::string unit;
  std::string role;
  Estimate estimate;
  bool is_fitted = false;
};

std::vector<ValueRow> value_rows(const FitReport& report) {
  std::vector<ValueRow> rows;
  const FitResult& fit = report.fit;
  for (std::size_t i = 0; i < fit.estimates.size(); ++i) {
    const FitParameter& one = fit.problem.parameters[i];
    rows.push_back({one.name, one.unit, "fitted", fit.estimates[i], true});
  }
  for (const OtherValue& one : report.others) {
    Estimate estimate;
    estimate.value = one.value;
    estimate.standard_error = kNone;
    estimate.linear = estimate.profile = {kNone, kNone};
    rows.push_back({one.name, one.unit, one.role, estimate});
  }
  return rows;
}

std::string note_of(const ValueRow& row) {
  const Estimate& one = row.estimate;
  if (!row.is_fitted) return "";
  if (!one.combination.empty()) return one.combination;
  if (one.at_bound != AtBound::no) return fmt::format("at its {} bound", name_of(one.at_bound));
  std::vector<std::string> notes;
  for (const auto& [side, end] : {std::pair("below", one.low_end), {"above", one.high_end}}) {
    const bool is_odd = end == ProfileEnd::bound || end == ProfileEnd::failed;
    if (is_odd) notes.push_back(fmt::format("{}: {}", side, name_of(end)));
  }
  return fmt::format("{}", fmt::join(notes, "; "));
}

Table estimates_table(const FitReport& report) {
  using Row = ValueRow;
  TableOf table("estimates", "calibration", value_rows(report));
  table.add("parameter", "", "path in the model", [](const Row& r) { return r.name; });
  table.add("value", "", "best fit", [](const Row& r) { return r.estimate.value; });
  table.add("low", "", "lower end of the interval, by profile",
            [](const Row& r) { return r.estimate.profile.low; });
  table.add("high", "", "upper end", [](const Row& r) { return r.estimate.profile.high; });
  table.add("unit", "", "of the four", [](const Row& r) { return r.unit; });
  table.add("verdict", "", "whether the data determine it", [](const Row& r) {
    return r.is_fitted ? std::string(name_of(r.estimate.identifiability)) : r.role;
  });
  table.add("note", "", "bounds, and what changes together", note_of);
  table.add("linear_low", "", "lower end of the interval of the linear model",
            [](const Row& r) { return r.estimate.linear.low; });
  table.add("linear_high", "", "upper end", [](const Row& r) { return r.estimate.linear.high; });
  table.add("standard_error", "", "of the linear model",
            [](const Row& r) { return r.estimate.standard_error; });
  return table.take();
}

struct PairRow {
  std::string one, other;
  double correlation;
};

Table correlations_table(const FitResult& fit) {
  std::vector<PairRow> rows;
  for (Eigen::Index i = 0; i < fit.correlation.rows(); ++i) {
    for (Eigen::Index k = i + 1; k < fit.correlation.cols(); ++k) {
      rows.push_back({fit.problem.parameters[static_cast<std::size_t>(i)].name,
                      fit.problem.parameters[static_cast<std::size_t>(k)].name,
                      fit.correlation(i, k)});
    }
  }
  TableOf table("correlations", "calibration", std::move(rows));
  table.add("parameter", "", "", [](const PairRow& r) { return r.one; });
  table.add("with", "", "", [](const PairRow& r) { return r.other; });
  table.add("correlation", "", "of the estimates, by the linear model",
            [](const PairRow& r) { return r.correlation; });
  return table.take();
}

struct SeriesRow {
  const MeasuredSeries* data;
  const ResidualSeries* series;
  SeriesFigures figures;
};

Table data_table(const FitReport& report) {
  const FitResult& fit = report.fit;
  std::vector<SeriesRow> rows;
  for (std::size_t i = 0; i < fit.figures.series.size(); ++i) {
    rows.push_back({&report.data.at(i), &fit.problem.series[i], fit.figures.series[i]});
  }
  using Row = SeriesRow;
  TableOf table("data", "calibration", std::move(rows));
  table.add("experiment", "", "", [](const Row& r) { return r.data->experiment; });
  table.add("channel", "", "", [](const Row& r) { return r.data->channel; });
  table.add("samples", "", "that count",
            [](const Row& r) { return static_cast<std::int64_t>(r.data->times.size()); });
  table.add("rms", "", "root mean square of the residuals",
            [](const Row& r) { return r.figures.rms * r.series->sigma; });
  table.add("unit", "", "of rms", [](const Row& r) { return r.series->unit; });
  table.add("weighted_rms", "", "of the residuals over sigma",
            [](const Row& r) { return r.figures.rms; });
  table.add("autocorrelation", "", "of neighbouring residuals",
            [](const Row& r) { return r.figures.autocorrelation; });
  table.add("effective_samples", "", "independent ones that say as much",
            [](const Row& r) { return r.figures.effective; });
  return table.take();
}

struct WaterfallRow {
  std::int64_t start;
  const StartReport* report;
};

// Best first; those that failed last.
Table starts_table(const FitResult& fit) {
  std::vector<WaterfallRow> rows;
  for (std::size_t i = 0; i < fit.starts.size(); ++i) {
    rows.push_back({static_cast<std::int64_t>(i), &fit.starts[i]});
  }
  std::ranges::stable_sort(rows, {}, [](const WaterfallRow& row) {
    const double sum = row.report->to_sum;
    return std::isfinite(sum) ? sum : std::numeric_limits<double>::infinity();
  });
  using Row = WaterfallRow;
  TableOf table("starts", "calibration", std::move(rows));
  const auto finite = [](double sum) { return std::isfinite(sum) ? sum : kNone; };
  table.add("start", "", "its number; 0 is the declared one", [](const Row& r) { return r.start; });
  table.add("sum_before", "", "sum of squares where it begins",
            [&](const Row& r) { return finite(r.report->from_sum); });
  table.add("sum", "", "sum of squares where it ends",
            [&](const Row& r) { return finite(r.report->to_sum); });
  table.add("iterations", "", "of the descent",
            [](const Row& r) { return std::int64_t{r.report->iterations}; });
  table.add("end", "", "why it ended",
            [](const Row& r) { return std::string(name_of(r.report->end)); });
  table.add("best", "", "it ends at the best sum",
            [](const Row& r) { return std::string(r.report->is_best ? "yes" : "no"); });
  add_values(table, fit.problem, "where it ends",
             [](const Row& r) -> const std::vector<double>& { return r.report->to; });
  return table.take();
}

Table profiles_table(const FitResult& fit) {
  using Row = ProfileRow;
  TableOf table("profiles", "calibration", fit.profiles);
  table.add("profile", "", "parameter that is held",
            [&](const Row& r) { return fit.problem.parameters[r.parameter].name; });
  table.add("rise", "", "of the sum of squares, in units of that at the end of an interval",
            [](const Row& r) { return r.rise; });
  add_values(table, fit.problem, "best with it held",
             [](const Row& r) -> const std::vector<double>& { return r.others; });
  return table.take();
}

struct SampleRow {
  const MeasuredSeries* data;
  const ResidualSeries* series;
  std::size_t i;
  double residual;
};

Table residuals_table(const FitReport& report) {
  std::vector<SampleRow> rows;
  for (std::size_t k = 0; k < report.data.size() && !report.fit.residuals.empty(); ++k) {
    const ResidualSeries& series = report.fit.problem.series[k];
    for (std::size_t i = 0; i < report.data[k].times.size(); ++i) {
      rows.push_back({&report.data[k], &series, i, report.fit.residuals.at(series.first + i)});
    }
  }
  using Row = SampleRow;
  TableOf table("residuals", "calibration", std::move(rows));
  table.add("experiment", "", "", [](const Row& r) { return r.data->experiment; });
  table.add("channel", "", "", [](const Row& r) { return r.data->channel; });
  table.add("time", "s", "of the run", [](const Row& r) { return r.data->times[r.i]; });
  table.add("measured", "", "", [](const Row& r) { return r.data->values[r.i]; });
  table.add("simulated", "", "best fit",
            [](const Row& r) { return r.data->values[r.i] + r.residual * r.series->sigma; });
  table.add("unit", "", "of the two", [](const Row& r) { return r.series->unit; });
  table.add("residual", "", "simulated less measured, over sigma",
            [](const Row& r) { return r.residual; });
  return table.take();
}

}  // namespace

std::vector<Table> make_tables(const FitReport& report) {
  return {estimates_table(report),  correlations_table(report.fit), data_table(report),
          starts_table(report.fit), profiles_table(report.fit),     residuals_table(report)};
}

}  // namespace linkstudy::calibration
