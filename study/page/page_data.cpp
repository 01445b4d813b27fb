#include "study/page/page_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <numeric>

#include "study/config/file_kind.h"
#include "study/metrics/response_list.h"
#include "study/page/history_panels.h"
#include "study/page/judged_ratios.h"
#include "study/page/map_figure.h"
#include "study/page/mechanism_json.h"
#include "study/page/rows_along.h"
#include "study/page/thin.h"
#include "study/record/base64.h"
#include "study/record/digest.h"
#include "study/report/results_tables.h"
#include "study/report/table_cells.h"
#include "study/session/model_results.h"
#include "study/session/stored_answer.h"

namespace linkstudy {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kSamples = 600000;     // of all histories together: some 3 MB
constexpr std::size_t kFewestSamples = 400;  // of one history; rather fewer histories than less
constexpr std::size_t kMostHistories = 200;

Json cells_of(const Column& column) {
  Json cells = Json::array();
  for (std::size_t row = 0; row < row_count(column); ++row) cells.push_back(json_cell(column, row));
  return cells;
}

Json tables_of(const StudyResults& results) {
  Json all = Json::array();
  for (const ResultsTable& row : results_tables()) {
    if (row.is_history) continue;
    const std::optional<Table> table = row.make(results);
    if (!table) continue;
    Json columns = Json::array();
    for (const Column& column : table->columns) {
      columns.push_back({{"name", column.name},
                         {"unit", column.unit},
                         {"meaning", column.meaning},
                         {"role", column.role},
                         {"values", cells_of(column)}});
    }
    all.push_back({{"name", row.name}, {"holds", row.holds}, {"columns", columns}});
  }
  return all;
}

Json matches_of(const StudyResults& results) {
  Json all = Json::array();
  for (const StoredCase& one : split_responses(results.description.responses)) {
    for (const StoredErrors& errors : one.matches) {
      Json columns = Json::array();
      for (std::size_t c = 0; c < errors.channels.size(); ++c) {
        columns.push_back(results.description.responses[errors.max + c].name);
      }
      all.push_back(
          {{"load_case", one.load_case}, {"channels", errors.channels}, {"columns", columns}});
    }
  }
  return all;
}

Json counts_of(const std::vector<Evaluation>& evaluations) {
  Json failed = Json::object();
  std::size_t ok = 0;
  for (const Evaluation& one : evaluations) {
    if (one.status == Cause::ok) {
      ++ok;
    } else {
      const std::string cause(name_of(one.status));
      failed[cause] = failed.value(cause, 0) + 1;
    }
  }
  return {{"evaluations", evaluations.size()}, {"ok", ok}, {"failed", failed}};
}

// Of what has no answer: the journal does not say whether anything runs.
std::string status_of(const StudyResults& results, std::size_t evaluations) {
  const std::uint64_t total = results.provenance.empty() ? 0 : results.provenance.back().total;
  const std::optional<FileKind> kind = find_word<FileKind>(results.description.kind);
  if (!kind || !has_design(*kind)) return "no answer yet";
  if (evaluations >= total) return std::string(name_of(RunStatus::complete));
  return fmt::format("{} of {} evaluations", evaluations, total);
}

Json channel_of(const Trace& trace, std::size_t count) {
  if (is_coordinate(trace.name) || trace.values.size() <= count) {
    return {{"name", trace.name},
            {"group", channel_group(trace.name)},
            {"unit", trace.unit},
            {"rows", nullptr},
            {"values", base64_floats(trace.values)}};
  }
  const std::vector<std::uint32_t> rows = thin_rows(trace.values, count);
  std::vector<double> values;
  for (const std::uint32_t row : rows) values.push_back(trace.values[row]);
  return {{"name", trace.name},
          {"group", channel_group(trace.name)},
          {"unit", trace.unit},
          {"rows", base64_indices(rows)},
          {"values", base64_floats(values)}};
}

struct Shown {
  const TraceSet* set;
  bool is_again;
};

Json history_of(const Shown& shown, std::size_t count) {
  const auto time = std::ranges::find(shown.set->traces, "time", &Trace::name);
  Json channels = Json::array();
  for (const Trace& trace : shown.set->traces) {
    if (trace.name != "time") channels.push_back(channel_of(trace, count));
  }
  return {{"name", shown.set->name},
          {"evaluation", shown.set->evaluation},
          {"is_again", shown.is_again},
          {"time", base64_floats(time->values)},
          {"channels", channels}};
}

// Runs that were made again stand first, then what is stored of others.
std::vector<Shown> histories_of(const StudyResults& results, const MovingRuns& again) {
  std::vector<Shown> all;
  const auto add = [&](const TraceSet& set, bool is_again) {
    const bool has_time = std::ranges::find(set.traces, "time", &Trace::name) != set.traces.end();
    if (has_time && set.traces.size() > 1) all.push_back({&set, is_again});
  };
  for (const MovingRun& run : again.runs) add(run.histories, true);
  const auto is_stored_too = [&](const TraceSet& set) {
    return std::ranges::any_of(again.runs, [&](const MovingRun& run) {
      return run.histories.name == set.name && !run.histories.traces.empty();
    });
  };
  for (const std::vector<TraceSet>* sets : {&results.references, &results.traces}) {
    for (const TraceSet& set : *sets)
      if (!is_stored_too(set)) add(set, false);
  }
  return all;
}

void add_histories(Json& page, const StudyResults& results, const MovingRuns& again) {
  std::vector<Shown> shown = histories_of(results, again);
  if (shown.size() > kMostHistories) {
    page["notes"].push_back(
        fmt::format("time histories of {} of {} runs are shown; the results "
                    "hold all (linkstudy export --table traces)",
                    kMostHistories, shown.size()));
    shown.resize(kMostHistories);
  }
  std::size_t channels = 1;
  for (const Shown& one : shown) channels += one.set->traces.size() - 1;
  const std::size_t count = std::max(kFewestSamples, kSamples / channels);
  page["histories"] = Json::array();
  for (const Shown& one : shown) page["histories"].push_back(history_of(one, count));
  std::vector<const TraceSet*> sets;
  for (const Shown& one : shown) sets.push_back(one.set);
  page.update(history_panels(results, again, sets));
}

// Evaluations along each parameter of numbers.
Json along_of(const StudyResults& results, const std::vector<Evaluation>& evaluations) {
  Json all = Json::object();
  for (std::size_t i = 0; i < results.description.parameters.size(); ++i) {
    all[results.description.parameters[i].path] = rows_along(evaluations, i);
  }
  return all;
}

// What a map of two values can have as axes, and for each two the rows at the usual values of all
// others; log: spaced by ratios, of all rows and of those.
Json map_of(const StudyResults& results, const std::vector<Evaluation>& evaluations) {
  const std::vector<std::size_t> axes = map_parameters(results, evaluations);
  const auto path = [&](std::size_t i) { return results.description.parameters[axes[i]].path; };
  std::vector<std::size_t> all(evaluations.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  Json map = {{"axes", Json::array()}, {"pairs", Json::array()}};
  for (std::size_t i = 0; i < axes.size(); ++i) {
    map["axes"].push_back({{"name", path(i)}, {"log", is_by_ratios(evaluations, all, axes[i])}});
    for (std::size_t j = 0; j < i; ++j) {
      const std::vector<std::size_t> rows = usual_rows(evaluations, {axes[j], axes[i]});
      map["pairs"].push_back({{"log",
                               {{path(j), is_by_ratios(evaluations, rows, axes[j])},
                                {path(i), is_by_ratios(evaluations, rows, axes[i])}}},
                              {"rows", rows}});
    }
  }
  return map;
}

constexpr std::array<std::string_view, 5> kGoodWords = {"certified", "fitted", "converged",
                                                        "complete", "done"};
constexpr std::array<std::string_view, 3> kBadWords = {"refuted", "infeasible", "failed"};

std::string_view tone_of(std::string_view status) {
  if (std::ranges::find(kGoodWords, status) != kGoodWords.end()) return "good";
  return std::ranges::find(kBadWords, status) != kBadWords.end() ? "bad" : "doubt";
}

void add_verdict(Json& page, const StudyResults& results, std::size_t evaluations) {
  const nlohmann::json answer = stored_answer(results);
  const bool has_answer = answer.is_object() && answer.contains("status");
  const std::string status =
      has_answer ? answer["status"].get<std::string>() : status_of(results, evaluations);
  std::string reason;
  for (const char* key : {"verdict", "message", "reason"}) {
    const bool is_text = has_answer && answer.contains(key) && answer[key].is_string();
    if (is_text && !answer[key].get<std::string>().empty()) reason = answer[key];
  }
  page["status"] = status;
  page["tone"] = tone_of(status);
  page["reason"] = reason;
  page["is_in_words"] = analysed_kind(results).has_value();
}

std::string escaped(std::string_view text) {
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text) safe += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return safe;
}

}  // namespace

std::string page_json(const StudyResults& results, const MovingRuns& again) {
  const std::vector<Evaluation> evaluations = latest_by_id(results.evaluations);
  Json page = {{"format", 1},
               {"name", results.description.name},
               {"kind", results.description.kind},
               {"digest", results_digest(results.description.parameters,
                                         results.description.responses, evaluations)},
               {"program", results.program_version},
               {"revision", results.git_revision},
               {"input", results.input_sha256},
               {"seed", results.description.seed},
               {"dropped", results.dropped},
               {"counts", counts_of(evaluations)},
               {"answer", stored_answer(results)},
               {"tables", tables_of(results)},
               {"matches", matches_of(results)},
               {"ratios", judged_ratios(results, evaluations)},
               {"along", along_of(results, evaluations)},
               {"map", map_of(results, evaluations)},
               {"texts", Json::array()},
               {"notes", again.notes},
               {"mechanisms", Json::array()}};
  for (const NamedText& text : results.texts) {
    page["texts"].push_back({{"name", text.name}, {"text", text.text}});
  }
  add_verdict(page, results, evaluations.size());
  add_histories(page, results, again);
  for (const MovingRun& run : again.runs) page["mechanisms"].push_back(mechanism_json(run));
  return escaped(page.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace linkstudy
