#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/topology/nearest_name.h"
#include "study/cli/starter_files.h"
#include "study/cli/verb_table.h"
#include "study/report/console.h"
#include "study/session/exit_code.h"
#include "study/store/file.h"

namespace linkstudy {
namespace {

std::string kind_of(const CommandLine& line) {
  const std::string& kind = line.inputs.front();
  const std::vector<std::string> kinds = starter_kinds();
  if (std::ranges::find(kinds, kind) != kinds.end()) return kind;
  throw UsageError(fmt::format("init: there is no kind '{}'; {}", kind, suggest_name(kind, kinds)));
}

void require_sense(const CommandLine& line, const std::string& kind) {
  if (!line.slurm) return;
  if (kind == "model") {
    throw UsageError("init: --slurm goes with study, tune and converge; a model is one short run");
  }
  if (!line.output) {
    throw UsageError("init: --slurm writes a script beside the input; add --output FILE");
  }
}

}  // namespace

int run_init(const CommandLine& line) {
  const std::string kind = kind_of(line);
  require_sense(line, kind);
  if (!line.output) {
    print_out(make_starter(kind, starter_names(kind, std::nullopt)));
    if (kind == "model") return kDone;
    print_err(
        fmt::format("linkstudy: it refers to {0}: linkstudy init model -o {0}\n", kStarterModel));
    return kDone;
  }
  const std::vector<NewFile> files = starter_files(kind, *line.output, line.slurm);
  require_free(files, line.fresh);
  for (const NewFile& file : files) {
    write_file_atomically(file.path, file.text);
    print_out(file.path.string() + "\n");
  }
  return kDone;
}

}  // namespace linkstudy
