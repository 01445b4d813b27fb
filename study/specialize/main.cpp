// Writes the structure of a model as C++ source, for a step loop made for it alone. Run by the
// build, for the models that LINKSTUDY_FIXED_MODELS lists.
//
// usage: linkstudy_specialize NAME MODEL.toml [PATH=VALUE...] > NAME.h
#include <fmt/core.h>

#include "core/kinematics/idle_rows.h"
#include "core/model/compile.h"
#include "core/model/fixed_structure.h"
#include "study/config/model_document.h"

namespace linkstudy {
namespace {

std::optional<ModelInput> read(int count, char** arguments, Diagnostics& diagnostics) {
  std::vector<Override> set;
  for (int i = 1; i < count; ++i) {
    if (auto override = parse_set(arguments[i], diagnostics)) set.push_back(*override);
  }
  const auto document = ModelDocument::load(arguments[0], diagnostics);
  if (!document || !diagnostics.empty()) return std::nullopt;
  return document->with(set, diagnostics);
}

int write(const std::string& name, int count, char** arguments) {
  Diagnostics diagnostics;
  const std::optional<ModelInput> model = read(count, arguments, diagnostics);
  if (!model) {
    fmt::print(stderr, "{}", to_string(diagnostics));
    return 2;
  }
  fmt::print(
      "#pragma once\n\n#include <array>\n\n#include \"core/model/mechanism.h\"\n\n"
      "namespace linkstudy {{\n\n{}\n}}  // namespace linkstudy\n",
      write_fixed_structure(compile(model->linkage, find_idle_directions(model->linkage)).mechanism,
                            name));
  return 0;
}

}  // namespace
}  // namespace linkstudy

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "usage: linkstudy_specialize NAME MODEL.toml [PATH=VALUE...]\n");
    return 2;
  }
  return linkstudy::write(argv[1], argc - 2, argv + 2);
}
