#include "study/config/check_file.h"

#include "study/config/toml_reader.h"

namespace linkstudy {

std::vector<Diagnostic> check_file(const std::string& path) {
  Diagnostics diagnostics;
  const std::optional<Tree> tree = read_toml_file(path, diagnostics);
  if (!tree) return diagnostics.sorted();
  const std::optional<std::string> kind = kind_of(*tree, diagnostics);
  if (!kind) return diagnostics.sorted();
  if (*kind == "model") {
    const std::optional<ModelDocument> document = ModelDocument::load(path, diagnostics);
    if (document) document->with({}, diagnostics);
  } else {
    read_study(path, {}, diagnostics);
  }
  return diagnostics.sorted();
}

}  // namespace linkstudy
