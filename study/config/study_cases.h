// What a study runs, judged as whole models before anything runs.
#pragma once

#include "study/config/study_input.h"

namespace linkstudy {

// Values of each [[vary]], or the ends of each [[tune]], with the places they were written at.
using WrittenValues = std::vector<std::vector<Tree>>;

// Values (of a list: rows) that agree to 12 digits are kept once, with a note.
void merge_equal_values(StudyInput& input, WrittenValues& written, Diagnostics& diagnostics);

// Too many cases; models that are wrong, of the cases that occur (a selection of many); values that
// have no effect on any case: errors where they are varied or tuned, else warnings.
void check_cases(const StudyInput& input, const WrittenValues& written,
                 std::span<const Override> command_line, Diagnostics& diagnostics);

}  // namespace linkstudy
