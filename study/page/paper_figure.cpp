#include "study/page/paper_figure.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/topology/nearest_name.h"
#include "study/config/input_error.h"
#include "study/metrics/response_list.h"
#include "study/page/map_figure.h"
#include "study/page/rows_along.h"
#include "study/record/digest.h"
#include "study/report/results_tables.h"
#include "study/session/stored_answer.h"

#include <nlohmann/json.hpp>

namespace linkstudy {
namespace {

using Numbers = std::vector<double>;
using Figure = std::optional<PaperFigure>;

const Numbers& numbers_of(const Table& table, std::string_view name) {
  return std::get<Numbers>(find_column(table, name)->values);
}

const std::vector<std::string>& words_of(const Table& table, std::string_view name) {
  return std::get<std::vector<std::string>>(find_column(table, name)->values);
}

bool spreads(const Numbers& values) {
  const auto [least, greatest] = std::ranges::minmax_element(values);
  return least != values.end() && *least > 0.0 && *greatest > 20.0 * *least;
}

// Of the first parameter with more than two values in a row.
Figure error_figure(const StudyResults& results) {
  const std::vector<Evaluation> rows = latest_by_id(results.evaluations);
  const std::vector<StoredCase> cases = split_responses(results.description.responses);
  for (std::size_t p = 0; p < results.description.parameters.size() && !rows.empty(); ++p) {
    const Parameter& parameter = results.description.parameters[p];
    const std::optional<Numbers> own = parameter_numbers(rows, p);
    if (!own) continue;
    const std::vector<std::size_t> along = rows_along(rows, p);
    if (along.size() < 3) continue;
    PaperFigure figure;
    Numbers x;
    for (const std::size_t row : along) x.push_back((*own)[row]);
    figure.x = {with_unit(parameter.path, parameter.unit), spreads(x)};
    figure.y = {"error, of the reference's largest", true};
    for (const StoredCase& one : cases) {
      for (const StoredErrors& errors : one.matches) {
        for (std::size_t c = 0; c < errors.channels.size(); ++c) {
          Numbers y;
          for (const std::size_t row : along) y.push_back(rows[row].responses.at(errors.max + c));
          const std::string name = one.load_case.empty() ? "" : one.load_case + ": ";
          const std::size_t i = figure.series.size();
          figure.series.push_back({name + errors.channels[c], x, std::move(y), true, i, i});
        }
      }
    }
    if (figure.series.empty()) return std::nullopt;
    if (const Table* components = find_answer_table(results, AnswerKind::tuning, "components")) {
      const double tolerance = numbers_of(*components, "tolerance").front();
      figure.marks.push_back({fmt::format("tolerance {:.3g}", tolerance), tolerance, false});
    }
    const nlohmann::json answer = stored_answer(results);
    const nlohmann::json::json_pointer value("/parameters/" + parameter.path);
    if (answer.is_object() && answer.contains(value) && answer[value].is_number()) {
      figure.marks.push_back({"answer", answer[value].get<double>(), true});
    }
    return figure;
  }
  return std::nullopt;
}

// What was matched, or the forces of closures: of the shown evaluation and its reference.
Figure history_figure(const StudyResults& results) {
  const MovingRuns again = run_again(results, std::nullopt, kLongestAgain);
  if (again.runs.empty()) return std::nullopt;
  std::vector<std::string> channels;
  for (const StoredCase& one : split_responses(results.description.responses)) {
    for (const StoredErrors& errors : one.matches) {
      for (const std::string& name : errors.channels) {
        if (std::ranges::find(channels, name) == channels.end()) channels.push_back(name);
      }
    }
  }
  PaperFigure figure;
  figure.x = {"time [s]"};
  for (const MovingRun& run : again.runs) {
    const std::vector<Trace>& traces = run.histories.traces;
    const auto time = std::ranges::find(traces, "time", &Trace::name);
    std::size_t colour = 0;
    for (const Trace& trace : traces) {
      const bool is_force =
          trace.name.starts_with("closure.") && trace.name.find(".force.") != std::string::npos;
      const bool is_matched = std::ranges::find(channels, trace.name) != channels.end();
      if (channels.empty() ? !is_force : !is_matched) continue;
      const std::string group = trace.name.substr(0, trace.name.rfind('.'));
      figure.y.label = with_unit(group, trace.unit);
      const std::size_t dash = run.histories.evaluation < 0 ? 1 : 0;
      figure.series.push_back(
          {trace.name + ", " + run.title, time->values, trace.values, false, colour++, dash});
    }
  }
  return figure.series.empty() ? std::nullopt : Figure(figure);
}

// One series for each word of a column, or of two together.
PaperFigure grouped(const Table& table, const std::vector<std::string>& keys, std::string_view x,
                    std::string_view y, bool has_points) {
  PaperFigure figure;
  for (const std::string& key : keys) {
    const bool is_known =
        std::ranges::find(figure.series, key, &PaperSeries::title) != figure.series.end();
    if (is_known) continue;
    const std::size_t i = figure.series.size();
    PaperSeries series{key, {}, {}, has_points, i, i};
    for (std::size_t row = 0; row < keys.size(); ++row) {
      if (keys[row] != key) continue;
      series.x.push_back(numbers_of(table, x)[row]);
      series.y.push_back(numbers_of(table, y)[row]);
    }
    figure.series.push_back(std::move(series));
  }
  return figure;
}

Figure convergence_figure(const StudyResults& results) {
  const Table* table = find_answer_table(results, AnswerKind::convergence, "convergence");
  if (table == nullptr || row_count(*table) == 0) return std::nullopt;
  PaperFigure figure = grouped(*table, words_of(*table, "quantity"), "size", "difference", true);
  for (PaperSeries& series : figure.series)
    for (double& y : series.y) y = std::abs(y);
  const std::string& over = words_of(*table, "over").front();
  const auto refined = std::ranges::find(results.description.parameters, over, &Parameter::path);
  const bool is_known = refined != results.description.parameters.end();
  figure.x = {with_unit(over, is_known ? refined->unit : ""), true};
  figure.y = {"difference from the next level", true};
  return figure;
}

Figure residual_figure(const StudyResults& results) {
  const Table* table = find_answer_table(results, AnswerKind::calibration, "residuals");
  if (table == nullptr || row_count(*table) == 0) return std::nullopt;
  std::vector<std::string> keys = words_of(*table, "experiment");
  for (std::size_t i = 0; i < keys.size(); ++i) keys[i] += ": " + words_of(*table, "channel")[i];
  PaperFigure figure = grouped(*table, keys, "time", "residual", true);
  figure.x = {"time [s]"};
  figure.y = {"residual / standard deviation"};
  return figure;
}

constexpr std::array<PaperKind, 5> kPaperKinds = {{
    {"errors", "errors against a reference over what was varied", error_figure},
    {"map", "largest error over its tolerance over two values that vary", map_figure},
    {"histories", "what was matched over time, evaluation and reference", history_figure},
    {"convergence", "differences over the refined value", convergence_figure},
    {"residuals", "residuals of a fit, over time", residual_figure},
}};

}  // namespace

std::string with_unit(const std::string& label, const std::string& unit) {
  return unit.empty() || unit == "1" ? label : fmt::format("{} [{}]", label, unit);
}

std::span<const PaperKind> paper_kinds() {
  return kPaperKinds;
}

PaperFigure make_paper_figure(const StudyResults& results, std::string_view name) {
  std::vector<std::string> names;
  for (const PaperKind& kind : kPaperKinds) {
    names.emplace_back(kind.name);
    if (kind.name != name) continue;
    if (Figure figure = kind.make(results)) return std::move(*figure);
    throw UsageError(
        fmt::format("--figure {}: these results have nothing of it ({})", name, kind.holds));
  }
  throw UsageError(
      fmt::format("there is no figure '{}'; {}", name, suggest_name(std::string(name), names)));
}

}  // namespace linkstudy
