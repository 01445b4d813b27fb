#include <fmt/format.h>

#include "study/cli/exit_code.h"
#include "study/cli/output.h"
#include "study/cli/verbs.h"
#include "study/config/key_reference.h"

namespace linkstudy {

int run_describe(const CommandLine& line) {
  const std::string path = line.inputs.empty() ? "" : line.inputs.front();
  if (line.markdown) {
    if (!path.empty()) throw UsageError("--markdown prints the whole reference; leave PATH out");
    print_out(key_reference_markdown());
    return kDone;
  }
  const std::optional<std::string> text = describe(path);
  if (!text) {
    throw UsageError(fmt::format("there is no key under '{}'; nearest: {}", path,
                                 fmt::join(nearest_keys(path), ", ")));
  }
  print_out(*text);
  return kDone;
}

}  // namespace linkstudy
