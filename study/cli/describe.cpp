#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/model/compile.h"
#include "study/cli/input.h"
#include "study/cli/manual.h"
#include "study/cli/verb_table.h"
#include "study/config/key_reference.h"
#include "study/config/unit_symbols.h"
#include "study/report/channels_text.h"
#include "study/report/console.h"
#include "study/session/exit_code.h"

namespace linkstudy {
namespace {

std::string channels_of(CommandLine line) {
  if (line.inputs.size() == 1) return channel_patterns_text();
  line.inputs.erase(line.inputs.begin());
  return channels_text(compile(read_model_input(line).linkage).mechanism);
}

// What is written whole.
std::optional<std::string> document_of(const CommandLine& line) {
  if (line.markdown) return key_reference_markdown();
  if (line.man) return manual_page(std::stoi(*line.man));
  if (line.completion) return bash_completion();
  return std::nullopt;
}

std::string text_of(const CommandLine& line, const std::string& path) {
  if (const std::optional<std::string> document = document_of(line)) {
    if (path.empty()) return *document;
    throw UsageError("--markdown, --man and --completion print the whole; leave PATH out");
  }
  if (path == "channels") return channels_of(line);
  if (line.inputs.size() > 1) {
    throw UsageError(fmt::format("describe takes one PATH, or channels and a MODEL, got '{}'",
                                 fmt::join(line.inputs, " ")));
  }
  if (path == "units") return describe_units();
  if (const std::optional<std::string> keys = describe(path)) return *keys;
  throw UsageError(
      fmt::format("there is no key under '{}'; nearest: {}; also: channels [MODEL], units", path,
                  fmt::join(nearest_keys(path), ", ")));
}

}  // namespace

int run_describe(const CommandLine& line) {
  print_out(text_of(line, line.inputs.empty() ? "" : line.inputs.front()));
  return kDone;
}

}  // namespace linkstudy
