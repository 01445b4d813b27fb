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
std::vector<Diagnostic> check_signals_of(const std::string& path) {
  Diagnostics diagnostics;
  const std::optional<Tree> tree = read_toml_file(path, diagnostics);
  const std::optional<std::string> kind = tree ? kind_of(*tree, diagnostics) : std::nullopt;
  if (!kind || *kind == "model") return {};
  const std::optional<StudyInput> input = read_study(path, {}, diagnostics);
  if (input) make_evaluator(*input, diagnostics);
  return diagnostics.sorted();
}

std::string to_json(const std::vector<Diagnostic>& diagnostics) {
  nlohmann::ordered_json errors = nlohmann::ordered_json::array();
  for (const Diagnostic& d : diagnostics) {
    errors.push_back({{"file", d.file},
                      {"line", d.line},
                      {"column", d.column},
                      {"message", d.message},
                      {"remedy", d.remedy}});
  }
  using Json = nlohmann::ordered_json;
  return Json{{"errors", errors}}.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

int run_check(const CommandLine& line) {
  std::vector<Diagnostic> all;
  for (const std::string& file : line.inputs) {
    std::vector<Diagnostic> found = check_file(file);
    if (found.empty()) found = check_signals_of(file);
    all.insert(all.end(), found.begin(), found.end());
    if (!line.json && found.empty()) print_out(fmt::format("{}: ok\n", file));
  }
  if (line.json) print_out(to_json(all));
  for (const Diagnostic& diagnostic : all) {
    if (!line.json) print_err(to_string(diagnostic) + "\n");
  }
  return all.empty() ? kDone : kInputError;
}

}  // namespace linkstudy
