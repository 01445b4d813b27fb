#include "study/session/check_input.h"

#include "study/config/check_file.h"
#include "study/config/toml_reader.h"
#include "study/session/earlier_run.h"
#include "study/session/study_points.h"

namespace linkstudy {

void check_input(const std::string& path, Diagnostics& diagnostics) {
  const ReadEarlierRun earlier = earlier_run_reader();
  check_file(path, diagnostics, earlier);
  if (!diagnostics.empty()) return;
  Diagnostics said_before;
  const std::optional<Tree> tree = read_toml_file(path, said_before);
  const std::optional<FileKind> kind = tree ? kind_of(*tree, said_before) : std::nullopt;
  if (!kind || *kind == FileKind::model) return;
  const std::optional<StudyInput> input = read_study(path, {}, said_before, earlier);
  if (input) make_evaluator(*input, diagnostics);
}

}  // namespace linkstudy
