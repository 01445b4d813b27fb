// A model file read once and kept as written; every case of a study is the document with some
// values set, checked again as a whole by the same rows. No text is parsed again.
#pragma once

#include <memory>

#include "study/config/file_kind.h"
#include "study/config/model_reader.h"
#include "study/config/override.h"

namespace linkstudy {

class ModelDocument {
 public:
  // Reads the text and the files of its tables: whether the values are right is said by with().
  static std::optional<ModelDocument> load(const std::string& path, Diagnostics& diagnostics);
  static std::optional<ModelDocument> parse(std::string_view text, const std::string& file,
                                            Diagnostics& diagnostics);

  // The model with these values set, in their order, its flexible links as chains of rigid finite
  // elements: what everything else works on. Nothing when anything was reported.
  std::optional<ModelInput> with(std::span<const Override> overrides,
                                 Diagnostics& diagnostics) const;

  // The document with these values written into it (--set). Nothing when a path names nothing.
  std::optional<ModelDocument> edited(std::span<const Override> overrides,
                                      Diagnostics& diagnostics) const;

  const std::string& file() const { return file_; }
  const Tree& tree() const { return tree_; }  // as written, not validated

 private:
  ModelDocument(Tree tree, std::string file) : tree_(std::move(tree)), file_(std::move(file)) {}

  Tree tree_;
  std::string file_;
};

// The model of a verb other than study and tune: with(set), and warnings about values of the file
// or of --set that have no effect on it.
std::optional<ModelInput> read_model_file(const ModelDocument& document,
                                          std::span<const Override> set, const std::string& verb,
                                          Diagnostics& diagnostics);

// Unit and meaning of a path of the model; nothing when the path names no single value.
std::optional<Parameter> parameter_for(const ModelDocument& document, const std::string& path);

// The kind of an input. Nothing, and a report, when the kind is absent, wrong or of a later
// version, or the format is not 1.
std::optional<FileKind> kind_of(const Tree& document, Diagnostics& diagnostics);

}  // namespace linkstudy
