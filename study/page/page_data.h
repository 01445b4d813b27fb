// Everything a report page shows, as one JSON object: the page itself only draws.
#pragma once

#include <string>

#include "study/page/moving_run.h"

namespace linkstudy {

// {"format": 1, "name", "kind", "status", "tone": good, doubt or bad, "reason", "is_in_words": the
//  table summary tells what was found, "digest", "program", "revision", "input", "seed", "dropped",
//  "counts": {"evaluations", "ok", "failed": {cause: count}}, "answer": object or null,
//  "tables": [{"name", "holds", "columns": [{"name", "unit", "meaning", "role", "values"}]}],
//  "matches": [{"load_case", "channels", "columns": names of their largest errors}],
//  "ratios": of every evaluation the largest error over its tolerance (judged_ratios.h), or [],
//  "along": {parameter: rows of evaluations with all others as usual, ascending (rows_along.h)},
//  "texts": [{"name", "text"}], "notes": [...],
//  "histories": [{"name", "evaluation", "is_again", "time", "channels": [{"name", "group",
//                 "unit", "rows", "values"}]}], and what history_panels.h adds,
//  "mechanisms": [mechanism_json]}
// Tables are those of `export` but for the traces, numbers with all digits, missing ones null; the
// histories are the traces, thinned (thin.h) where they are long: "values" belong to "rows" of
// "time" (null: all), 32-bit numbers in base64. The joint coordinates keep every row: other
// channels are drawn over them. Safe inside <script>: '<' is escaped.
std::string page_json(const StudyResults& results, const MovingRuns& again);

}  // namespace linkstudy
