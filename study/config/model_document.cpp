#include "study/config/model_document.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/flexible/rigid_finite_elements.h"
#include "core/topology/nearest_name.h"
#include "study/config/table_files.h"
#include "study/config/toml_reader.h"
#include "study/config/validate.h"
#include "study/config/value_path.h"

namespace linkstudy {
namespace {

std::vector<std::string> kind_words() {
  std::vector<std::string> words;
  for (const Word<FileKind>& known : kWords<FileKind>) words.emplace_back(known.text);
  return words;
}

// The model with its tables, of which some stand in files. What else is wrong is said too.
std::optional<Tree> with_tables(std::optional<Tree> tree, const std::string& file,
                                Diagnostics& diagnostics) {
  if (!tree || read_table_files(*tree, model_schema(), file, diagnostics)) return tree;
  validate(*tree, model_schema(), diagnostics);
  read_model(std::move(*tree), diagnostics);
  return std::nullopt;
}

std::optional<Tree> require_model(std::optional<Tree> tree, Diagnostics& diagnostics) {
  if (!tree) return std::nullopt;
  const std::optional<FileKind> kind = kind_of(*tree, diagnostics);
  if (!kind) return std::nullopt;
  if (*kind == FileKind::model) return tree;
  diagnostics.add(tree->find("kind")->at,
                  fmt::format("a model is expected here, got kind = '{}'", name_of(*kind)),
                  "name a file with kind = \"model\"");
  return std::nullopt;
}

void report_lost(const std::vector<Ineffective>& ineffective, Diagnostics& diagnostics) {
  for (const Ineffective& one : ineffective) {
    if (one.is_lost) diagnostics.add(one.at, one.message(), one.remedy);
  }
}

bool is_single_value(KeyType type) {
  return type == KeyType::number || type == KeyType::number_or_table || type == KeyType::integer ||
         type == KeyType::boolean || type == KeyType::word || type == KeyType::numbers ||
         type == KeyType::name;
}

}  // namespace

std::optional<FileKind> kind_of(const Tree& document, Diagnostics& diagnostics) {
  const Tree* format = document.find("format");
  if (format != nullptr && format->is_numeric() && format->as_number() != 1.0) {
    diagnostics.add(format->at, fmt::format("format must be 1, got {}", shown(*format)),
                    "this version reads format = 1 only");
    return std::nullopt;
  }
  const std::string kinds = fmt::format("supported: {}", fmt::join(kind_words(), ", "));
  const Tree* kind = document.find("kind");
  if (kind == nullptr) {
    diagnostics.add(document.at, "kind is missing", kinds);
    return std::nullopt;
  }
  const std::string word = kind->is(Tree::Kind::text) ? kind->text : std::string();
  if (const std::optional<FileKind> known = find_word<FileKind>(word)) return known;
  const std::string near = nearest_name(word, kind_words());
  diagnostics.add(kind->at, fmt::format("there is no kind {} of files", shown(*kind)),
                  near.empty() ? kinds : fmt::format("did you mean '{}'?", near));
  return std::nullopt;
}

std::optional<ModelDocument> ModelDocument::load(const std::string& path,
                                                 Diagnostics& diagnostics) {
  std::optional<Tree> tree =
      with_tables(require_model(read_toml_file(path, diagnostics), diagnostics), path, diagnostics);
  if (!tree) return std::nullopt;
  return ModelDocument(std::move(*tree), path);
}

std::optional<ModelDocument> ModelDocument::parse(std::string_view text, const std::string& file,
                                                  Diagnostics& diagnostics) {
  std::optional<Tree> tree = with_tables(
      require_model(parse_toml(text, file, diagnostics), diagnostics), file, diagnostics);
  if (!tree) return std::nullopt;
  return ModelDocument(std::move(*tree), file);
}

std::optional<ModelInput> ModelDocument::with(std::span<const Override> overrides,
                                              Diagnostics& diagnostics) const {
  Diagnostics found;
  Tree tree = tree_;
  for (const Override& override : overrides) set_value(tree, model_schema(), override, found);
  std::vector<Ineffective> ineffective = find_ineffective(tree, model_schema(), {});
  validate(tree, model_schema(), found);
  ModelInput input = read_model(std::move(tree), found);
  if (found.empty()) report_lost(ineffective, found);
  input.ineffective = std::move(ineffective);
  diagnostics.append(found);
  if (!found.empty()) return std::nullopt;
  input.rigid = input.linkage;
  for (Link& link : input.rigid.links) link.flexible.reset();
  input.linkage = expand_flexible_links(input.linkage);
  return input;
}

std::optional<ModelDocument> ModelDocument::edited(std::span<const Override> overrides,
                                                   Diagnostics& diagnostics) const {
  ModelDocument result = *this;
  bool is_done = true;
  for (const Override& override : overrides) {
    is_done = set_value(result.tree_, model_schema(), override, diagnostics) && is_done;
  }
  if (!is_done) return std::nullopt;
  return result;
}

std::optional<ModelInput> read_model_file(const ModelDocument& document,
                                          std::span<const Override> set, const std::string& verb,
                                          Diagnostics& diagnostics) {
  std::optional<ModelInput> input = document.with(set, diagnostics);
  // Kinematics takes all closures as exact and knows neither forces nor steps.
  if (!input || verb == "kinematics") return input;
  Diagnostics said;
  const std::optional<ModelDocument> edited = document.edited(set, said);
  if (!edited) return input;
  const Tree& tree = edited->tree();
  for (const Override& one : set) {
    const auto found = find_ineffective(tree, model_schema(), one.path, verb);
    if (found) diagnostics.remark(Severity::warning, one.origin, found->message(), found->remedy);
  }
  for (const Ineffective& one : find_ineffective(tree, model_schema(), verb)) {
    if (one.stands_by || one.at.line == 0) continue;
    diagnostics.remark(Severity::warning, one.at, one.message(), one.remedy);
  }
  return input;
}

std::optional<Parameter> parameter_for(const ModelDocument& document, const std::string& path) {
  const KeyRow* row = find_row(document.tree(), model_schema(), path);
  if (row == nullptr || !is_single_value(row->type)) return std::nullopt;
  std::optional<std::string> unit;
  for (const std::string& one : expand_path(document.tree(), model_schema(), path)) {
    const auto own =
        unit_of_path(document.tree(), model_schema(), *row, one).value_or(std::string());
    if (unit.value_or(own) != own) return std::nullopt;
    unit = own;
  }
  return Parameter{path, unit == "1" ? std::string() : *unit, row->meaning};
}

}  // namespace linkstudy
