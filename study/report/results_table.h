// Tables made of stored results, and of nothing else.
#pragma once

#include <string>
#include <vector>

#include "study/report/table.h"
#include "study/store/results.h"

namespace linkstudy {

struct ResultsTableOptions {
  // Names in the wanted order: paths of parameters, names of responses, evaluation, status,
  // message, attempts, parent_evaluation, wall_s, rank, host. Empty: evaluation, all parameters
  // and responses, status, message; parent_evaluation where any row has one.
  std::vector<std::string> columns;
};

// One row per evaluation, by id. Throws std::invalid_argument with the names there are when a
// wanted one is not among them.
Table results_table(const StudyResults& results, const ResultsTableOptions& options = {});

// Columns of a stored group (the scan of a tuning, a convergence table); flags as their meanings.
// Empty `columns`: all of them.
Table table_of(const DataGroup& group, const std::vector<std::string>& columns = {});

// One row per start or resume.
Table provenance_table(const StudyResults& results);

}  // namespace linkstudy
