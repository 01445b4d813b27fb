#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "study/cli/verb_table.h"
#include "study/report/console.h"
#include "study/session/check_input.h"
#include "study/session/exit_code.h"

namespace linkstudy {
namespace {

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
    check_input(file, found);
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
