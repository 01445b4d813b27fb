#include "study/config/check_file.h"

#include "study/config/toml_reader.h"

namespace linkstudy {

std::vector<Diagnostic> check_file(const std::string& path) {
  Diagnostics diagnostics;
  check_file(path, diagnostics);
  return diagnostics.sorted();
}

void check_file(const std::string& path, Diagnostics& diagnostics, const ReadEarlierRun& earlier) {
  const std::optional<Tree> tree = read_toml_file(path, diagnostics);
  if (!tree) return;
  const std::optional<FileKind> kind = kind_of(*tree, diagnostics);
  if (!kind) return;
  if (*kind != FileKind::model) {
    read_study(path, {}, diagnostics, earlier);
    return;
  }
  const std::optional<ModelDocument> document = ModelDocument::load(path, diagnostics);
  if (document) read_model_file(*document, {}, {}, diagnostics);
}

}  // namespace linkstudy
