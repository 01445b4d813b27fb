// Parts of a results file: each record of StudyResults as a group of columns.
#pragma once

#include <string>
#include <vector>

#include "study/store/data_group.h"
#include "study/store/results.h"

namespace linkstudy {

// Evaluations are given by id, one per id.
DataGroup study_group(const StudyDescription& description,
                      const std::vector<Evaluation>& evaluations);
DataGroup runtime_group(const std::vector<Evaluation>& evaluations);
DataGroup provenance_group(const std::vector<ProvenanceRow>& rows,
                           const std::vector<NamedText>& texts);
DataGroup traces_group(const TraceSet& set);

}  // namespace linkstudy
