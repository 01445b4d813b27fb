// Where the values of a run come from, the weakest first:
//   default of the key < model file < base.set < set of the load case < [[vary]], [[tune]]
// and of the reference: default < its model file < reference.set < set of the load case.
// --set replaces a value wherever the files state it: in both models, in base.set and in
// reference.set. A value that two of --set, a load case and [[vary]] or [[tune]] name, under
// whatever spelling, is an error: neither of them is a default of the other.
#pragma once

#include "study/config/study_input.h"

namespace linkstudy {

// What is set in the model of the cases, in this order. `point`: values varied or tuned.
std::vector<Override> case_overrides(const StudyInput& input, const LoadCaseInput& load_case,
                                     std::vector<Override> point);

// What a load case is compared with: its own reference, else that of all; or null.
const ReferenceInput* reference_of(const StudyInput& input, const LoadCaseInput& load_case);
// The same where it is a run, and where it is measured data; else null.
const ReferenceInput* reference_run_of(const StudyInput& input, const LoadCaseInput& load_case);
const MeasuredInput* reference_data_of(const StudyInput& input, const LoadCaseInput& load_case);

// What is set in the model of the reference run.
std::vector<Override> reference_overrides(const StudyInput& input, const LoadCaseInput& load_case);

// Writes --set into the models and sets of the study. A path that no model has is reported; that a
// value in which base.set and reference.set differed is now the same in both is remarked.
void apply_command_line(std::span<const Override> command_line, StudyInput& input,
                        Diagnostics& diagnostics);

// Reports values with more than one source of equal rank.
void require_one_source(std::span<const Override> command_line, const StudyInput& input,
                        Diagnostics& diagnostics);

}  // namespace linkstudy
