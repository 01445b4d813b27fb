#include "study/session/stored_evaluator.h"

#include <fmt/format.h>

#include <algorithm>

#include "study/config/input_error.h"
#include "study/session/identity.h"
#include "study/session/study_points.h"
#include "study/store/store_error.h"

namespace linkstudy {

void throw_other_columns(const StudyResults& results) {
  throw StoreError(
      fmt::format("these results have other columns than this program gives their input (they "
                  "are of version {} {}); verify them with that one",
                  results.program_version, results.git_revision));
}

std::unique_ptr<Evaluator> make_stored_evaluator(const StudyResults& results) {
  Diagnostics diagnostics;
  const std::string file = "the input that these results hold";
  const std::optional<StudyInput> input = read_study(resolved_texts(results), file, diagnostics);
  throw_if_any(diagnostics);
  std::unique_ptr<Evaluator> evaluator = make_evaluator(*input, diagnostics);
  throw_if_any(diagnostics);
  const bool fits = std::ranges::equal(evaluator->responses(), results.description.responses, {},
                                       &Response::name, &Response::name);
  if (!fits) throw_other_columns(results);
  return evaluator;
}

}  // namespace linkstudy
