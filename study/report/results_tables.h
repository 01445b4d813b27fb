// The tables of stored results by name; a further one is a further row of the list in
// results_tables.cpp.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "study/store/results.h"

namespace linkstudy {

struct ResultsTable {
  std::string_view name;
  std::string_view holds;
  // Nothing where these results have none.
  std::optional<Table> (*make)(const StudyResults& results);
  const char* lacks = "";   // why it is missing
  bool is_history = false;  // a row an instant: what reports draw
};

std::span<const ResultsTable> results_tables();

// name, rows and what it holds, of each that these results have.
Table list_tables(const StudyResults& results);

// Throws UsageError with the nearest names, or the reason why these results lack it.
Table make_results_table(const StudyResults& results, std::string_view name);

// One row an evaluation: number, parameters, responses, status, message, what is derived. Columns
// for those who ask (choose_table.h): attempts, wall_s, rank, host, and parent_evaluation where no
// row has one.
Table evaluations_table(const StudyResults& results);

// A table of what a verb concluded, as it is stored ("result", "estimates"), or null.
const Table* find_answer_table(const StudyResults& results, AnswerKind kind, std::string_view name);

// Time histories below each other: run, time, channels, and their differences from the reference
// where that has a value at the same time.
std::optional<Table> traces_table(const StudyResults& results);

}  // namespace linkstudy
