// Parts of a results file: each record of StudyResults as a group of columns.
#pragma once

#include <string>
#include <vector>

#include "study/record/table.h"
#include "study/store/results.h"

namespace linkstudy {

// Evaluations are given by id, one per id.
Table study_group(const StudyDescription& description, const std::vector<Evaluation>& evaluations);
Table runtime_group(const std::vector<Evaluation>& evaluations);
Table provenance_group(const std::vector<ProvenanceRow>& rows, const std::vector<NamedText>& texts);
Table traces_group(const TraceSet& set);

}  // namespace linkstudy
