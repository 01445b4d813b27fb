#include <fmt/format.h>

#include "core/model/compile.h"
#include "study/cli/describe_channels.h"
#include "study/cli/exit_code.h"
#include "study/cli/input.h"
#include "study/cli/output.h"
#include "study/cli/verbs.h"
#include "study/config/key_reference.h"
#include "study/config/unit_symbols.h"

namespace linkstudy {
namespace {

int print_channels(const CommandLine& line) {
  if (line.inputs.size() == 1) {
    print_out(channel_patterns_text());
    return kDone;
  }
  CommandLine of_model = line;
  of_model.inputs.erase(of_model.inputs.begin());
  print_out(channels_text(compile(read_model_input(of_model).linkage).mechanism));
  return kDone;
}

}  // namespace

int run_describe(const CommandLine& line) {
  const std::string path = line.inputs.empty() ? "" : line.inputs.front();
  if (path == "channels" && !line.markdown) return print_channels(line);
  if (line.inputs.size() > 1) {
    throw UsageError(fmt::format("describe takes one PATH, or channels and a MODEL, got '{}'",
                                 fmt::join(line.inputs, " ")));
  }
  if (path == "units" && !line.markdown) {
    print_out(describe_units());
    return kDone;
  }
  if (line.markdown) {
    if (!path.empty()) throw UsageError("--markdown prints the whole reference; leave PATH out");
    print_out(key_reference_markdown());
    return kDone;
  }
  const std::optional<std::string> text = describe(path);
  if (!text) {
    throw UsageError(
        fmt::format("there is no key under '{}'; nearest: {}; also: channels "
                    "[MODEL], units",
                    path, fmt::join(nearest_keys(path), ", ")));
  }
  print_out(*text);
  return kDone;
}

}  // namespace linkstudy
