#include "study/report/results_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/topology/nearest_name.h"
#include "study/config/input_error.h"
#include "study/record/digest.h"
#include "study/report/choose_table.h"
#include "study/report/contacts_report.h"
#include "study/report/summary_table.h"
#include "study/store/results_tree.h"

namespace linkstudy {
namespace {

using Made = std::optional<Table>;

Table titled(Table table, const StudyResults& results) {
  table.name = results.description.name;
  table.attributes.clear();
  return table;
}

Made part_of(AnswerKind kind, const StudyResults& results, std::string_view name) {
  const Table* found = find_answer_table(results, kind, name);
  const bool is_there = found != nullptr && row_count(*found) > 0;
  return is_there ? Made(titled(*found, results)) : Made();
}

constexpr const char* kNotFitted = "only a calibration that has its answer holds it";
constexpr const char* kNotTuned = "only a tune that has its answer holds it";
constexpr const char* kNotConverged = "only a converge that has all its levels holds it";

constexpr const char* kNoSensitivity =
    "only a study of a design of type morris or saltelli that has all its points holds it";
constexpr const char* kNoStatics = "only results of statics hold it";
constexpr const char* kNoKinematics =
    "only results of kinematics hold it, of a course along which something is driven";

// Of an analysis of one model the findings are all there is to sum up.
Made summary_of(const StudyResults& results) {
  for (const AnswerKind kind : {AnswerKind::statics, AnswerKind::kinematics}) {
    if (Made findings = part_of(kind, results, "findings")) return findings;
  }
  return summary_table(results);
}

constexpr std::array<ResultsTable, 28> kTables = {{
    {"summary",
     "what varies, the worst errors in percent, responses, status; by load case. Of statics and "
     "kinematics what was found, in words",
     summary_of},
    {"evaluations", "every parameter and response of every evaluation, and why it ended",
     [](const StudyResults& r) { return Made(evaluations_table(r)); }},
    {"traces", "time histories, and their differences from the reference", traces_table,
     "these results hold no time histories; studies keep those of [[trace]]", true},
    {"contacts",
     "contacts of journals and of end stops, one by one: begin, end, speeds, restitution, force",
     contacts_table,
     "these results hold no contacts; studies keep those of the runs whose histories they keep "
     "([[trace]])"},
    {"tuning", "the answer, its damping, window, margin and verdict",
     [](const StudyResults& r) { return part_of(AnswerKind::tuning, r, "result"); }, kNotTuned},
    {"components", "errors and tolerances of the matched components at the answer",
     [](const StudyResults& r) { return part_of(AnswerKind::tuning, r, "components"); }, kNotTuned},
    {"scan", "every value tried at the base step, and on which side it fails",
     [](const StudyResults& r) { return part_of(AnswerKind::tuning, r, "scan"); }, kNotTuned},
    {"certificate", "the claims about the answer and what they rest on",
     [](const StudyResults& r) { return part_of(AnswerKind::tuning, r, "certificate"); },
     kNotTuned},
    {"staircase", "minimal points that match, of two or three tuned values",
     [](const StudyResults& r) { return part_of(AnswerKind::tuning, r, "staircase"); }, kNotTuned},
    {"calibration", "fitted values, their intervals, whether the data determine them",
     [](const StudyResults& r) { return part_of(AnswerKind::calibration, r, "estimates"); },
     kNotFitted},
    {"correlations", "of the fitted values, by pairs",
     [](const StudyResults& r) { return part_of(AnswerKind::calibration, r, "correlations"); },
     kNotFitted},
    {"data", "what was measured: samples, residuals, their autocorrelation",
     [](const StudyResults& r) { return part_of(AnswerKind::calibration, r, "data"); }, kNotFitted},
    {"starts", "where the fits begin and end, best first",
     [](const StudyResults& r) { return part_of(AnswerKind::calibration, r, "starts"); },
     kNotFitted},
    {"profiles", "the best fits with one value held",
     [](const StudyResults& r) { return part_of(AnswerKind::calibration, r, "profiles"); },
     kNotFitted},
    {"residuals", "measured and simulated samples of the best fit",
     [](const StudyResults& r) { return part_of(AnswerKind::calibration, r, "residuals"); },
     kNotFitted},
    {"convergence", "every level of every refined quantity: difference, order, GCI, error",
     [](const StudyResults& r) { return part_of(AnswerKind::convergence, r, "convergence"); },
     kNotConverged},
    {"orders", "of every refined quantity: class, orders, limit, and what the wanted error needs",
     [](const StudyResults& r) { return part_of(AnswerKind::convergence, r, "orders"); },
     kNotConverged},
    {"sensitivity", "effects or shares of the variance of every parameter, with their intervals",
     [](const StudyResults& r) { return part_of(AnswerKind::sensitivity, r, "sensitivity"); },
     kNoSensitivity},
    {"failures", "where in the ranges of the parameters evaluations failed, by cause",
     [](const StudyResults& r) { return part_of(AnswerKind::sensitivity, r, "failures"); },
     "nothing failed, or these are no results of a design of type morris or saltelli"},
    {"equilibrium", "coordinates, reactions, holds, closures and points at the equilibrium",
     [](const StudyResults& r) { return part_of(AnswerKind::statics, r, "equilibrium"); },
     kNoStatics},
    {"modes", "modes about the equilibrium: frequency, damping, shape by coordinates",
     [](const StudyResults& r) { return part_of(AnswerKind::statics, r, "modes"); }, kNoStatics},
    {"singular", "singular positions of the course: kind, place, ranks, joints that may move",
     [](const StudyResults& r) { return part_of(AnswerKind::kinematics, r, "singular"); },
     "no singular position was passed, or these are no results of kinematics"},
    {"loops", "basic loops: joints, proper equations, how well they are conditioned",
     [](const StudyResults& r) { return part_of(AnswerKind::kinematics, r, "loops"); },
     "these results hold no closed loop"},
    {"swings", "how far every joint coordinate swings along the course, and where its ends are",
     [](const StudyResults& r) { return part_of(AnswerKind::kinematics, r, "swings"); },
     kNoKinematics},
    {"transmission", "transmission angles at every position, of loops of four links on ground",
     [](const StudyResults& r) { return part_of(AnswerKind::kinematics, r, "transmission"); },
     "no loop has a transmission angle (core/kinematics/transmission_angle.h), or these are no "
     "results of kinematics",
     true},
    {"poses", "Euler parameters and position of every link at every position of the course",
     [](const StudyResults& r) { return part_of(AnswerKind::kinematics, r, "poses"); },
     kNoKinematics, true},
    {"runtime", "wall time, rank and host of every evaluation",
     [](const StudyResults& r) {
       return Made(titled(runtime_group(latest_by_id(r.evaluations)), r));
     }},
    {"provenance", "the starts and resumes: when, where, by which program",
     [](const StudyResults& r) { return Made(titled(provenance_group(r.provenance, {}), r)); }},
}};

bool has_parent(const Column& column) {
  const auto& ids = std::get<std::vector<std::int64_t>>(column.values);
  return std::ranges::any_of(ids, [](std::int64_t id) { return id >= 0; });
}

}  // namespace

std::span<const ResultsTable> results_tables() {
  return kTables;
}

const Table* find_answer_table(const StudyResults& results, AnswerKind kind,
                               std::string_view name) {
  const auto answer = std::ranges::find(results.answers, kind, &VerbAnswer::kind);
  return answer == results.answers.end() ? nullptr : find_part(answer->tables, name);
}

Table list_tables(const StudyResults& results) {
  std::vector<std::string> names;
  std::vector<std::string> holds;
  std::vector<std::int64_t> rows;
  for (const ResultsTable& table : kTables) {
    const Made made = table.make(results);
    if (!made) continue;
    names.emplace_back(table.name);
    rows.push_back(static_cast<std::int64_t>(row_count(*made)));
    holds.emplace_back(table.holds);
  }
  return {"",
          {{"table", "", "", "", names}, {"rows", "", "", "", rows}, {"holds", "", "", "", holds}}};
}

Table make_results_table(const StudyResults& results, std::string_view name) {
  std::vector<std::string> names;
  for (const ResultsTable& table : kTables) {
    const bool is_it = table.name == name;
    Made made = table.make(results);
    if (is_it && made) return std::move(*made);
    if (is_it) throw UsageError(fmt::format("there is no table '{}': {}", name, table.lacks));
    if (made) names.emplace_back(table.name);
  }
  throw UsageError(
      fmt::format("there is no table '{}'; {}", name, suggest_name(std::string(name), names)));
}

Table evaluations_table(const StudyResults& results) {
  const std::vector<Evaluation> evaluations = latest_by_id(results.evaluations);
  Table table = titled(study_group(results.description, evaluations), results);
  for (Column& column : table.columns) {
    const bool is_aside =
        column.role == "attempts" || (column.role == "parent" && !has_parent(column));
    if (is_aside) column.role = kOnDemand;
  }
  const Table runtime = runtime_group(evaluations);
  for (std::size_t i = 1; i < runtime.columns.size(); ++i) {
    table.columns.push_back(runtime.columns[i]);
    table.columns.back().role = kOnDemand;
  }
  return table;
}

}  // namespace linkstudy
