#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "study/cli/exit_code.h"
#include "study/cli/input.h"
#include "study/cli/output.h"
#include "study/cli/verbs.h"
#include "study/config/check_file.h"
#include "study/config/toml_reader.h"

namespace linkstudy {
namespace {

// What check_file does not judge because it needs the compiled model: names of signals, windows.
void check_signals_of(const std::string& path, Diagnostics& diagnostics) {
  Diagnostics said_before;
  const std::optional<Tree> tree = read_toml_file(path, said_before);
  const std::optional<FileKind> kind = tree ? kind_of(*tree, said_before) : std::nullopt;
  if (!kind || *kind == FileKind::model) return;
  const std::optional<StudyInput> input = read_study(path, {}, said_before);
  if (input) make_evaluator(*input, diagnostics);
}

using Json = nlohmann::ordered_json;

Json to_json(const std::vector<Diagnostic>& diagnostics) {
  Json list = Json::array();
  for (const Diagnostic& d : diagnostics) {
    list.push_back({{"file", d.file},
                    {"line", d.line},
                    {"column", d.column},
                    {"message", d.message},
                    {"remedy", d.remedy}});
  }
  return list;
}

}  // namespace

int run_check(const CommandLine& line) {
  std::vector<Diagnostic> errors;
  std::vector<Diagnostic> remarks;
  for (const std::string& file : line.inputs) {
    Diagnostics found;
    check_file(file, found);
    if (found.empty()) check_signals_of(file, found);
    if (!line.json && found.empty()) print_out(fmt::format("{}: ok\n", file));
    for (const Diagnostic& d : found.sorted()) errors.push_back(d);
    for (const Diagnostic& d : found.sorted_remarks()) remarks.push_back(d);
  }
  if (line.json) {
    const Json json{{"errors", to_json(errors)}, {"remarks", to_json(remarks)}};
    print_out(json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
  } else {
    print_remarks(remarks);
    print_remarks(errors);
  }
  return errors.empty() ? kDone : kInputError;
}

}  // namespace linkstudy
