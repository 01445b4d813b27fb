// The points of a list from a CSV file: [design] file and columns, read as measured data are
// (measured_data.h), become a [[vary]] for every column. From then on the study holds the values:
// what is kept of it needs no file.
#pragma once

#include "study/config/model_document.h"

namespace linkstudy {

// Whether [design] of a validated study names a file.
bool has_point_file(const Tree& study);

// Puts the [[vary]] entries into the study, each value with its place in the file, in place of file
// and columns. `path`: of the study, which files are relative to. Columns are those that `columns`
// names, else all whose heads are not `evaluation`, the ids of `plan --csv`. False when something
// was reported.
bool read_point_file(Tree& study, const std::string& path, const ModelDocument& document,
                     Diagnostics& diagnostics);

}  // namespace linkstudy
