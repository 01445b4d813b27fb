#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "study/config/axis_reader.h"
#include "study/config/calibrate_reader.h"
#include "study/config/fill.h"
#include "study/config/measured_reader.h"
#include "study/config/named_parameter.h"
#include "study/config/point_file.h"
#include "study/config/precedence.h"
#include "study/config/refine_checks.h"
#include "study/config/study_cases.h"
#include "study/config/study_checks.h"
#include "study/config/study_input.h"
#include "study/config/toml_reader.h"
#include "study/config/validate.h"
#include "study/config/value_path.h"

namespace linkstudy {
namespace {

using Kind = Tree::Kind;
using Document = std::shared_ptr<const ModelDocument>;

// Where models and data come from: `texts`, where their files are not to be read, or null.
struct Sources {
  const ResolvedTexts* texts = nullptr;
  const ReadEarlierRun& earlier;
};

class StudyReader {
 public:
  StudyReader(Tree study, std::string file, std::span<const Override> model_set,
              const Sources& sources, Diagnostics& diagnostics)
      : study_(std::move(study)),
        model_set_(model_set),
        texts_(sources.texts),
        earlier_(sources.earlier),
        diagnostics_(diagnostics) {
    input_.file = std::move(file);
  }

  StudyInput read(FileKind kind) {
    input_.kind = kind;
    const KeyNode& schema = key_schema(kind);
    fill_record(&input_, study_, schema, diagnostics_);
    check_study(study_, kind, diagnostics_);
    load_models();
    write_command_line();
    if (input_.model) read_parameters();
    read_measured(input_, texts_ == nullptr ? nullptr : &texts_->data, earlier_, diagnostics_);
    require_one_source(model_set_, input_, diagnostics_);
    input_.resolved = study_;
    if (has_rows_) check_cases(input_, written_, model_set_, diagnostics_);
    return std::move(input_);
  }

 private:
  // A model file that cannot be opened is an error of the line that names it.
  Document load_model(const Tree& owner) {
    const Tree* name = owner.find("model");
    if (name == nullptr || !name->is(Kind::text)) return nullptr;
    const auto folder = std::filesystem::path(input_.file).parent_path();
    const std::string path = (folder / name->text).lexically_normal().string();
    Diagnostics found;
    const bool is_reference = &owner != &study_;
    std::optional<ModelDocument> document =
        texts_ == nullptr
            ? ModelDocument::load(path, found)
            : ModelDocument::parse(is_reference ? texts_->reference : texts_->model, path, found);
    for (const Diagnostic& d : found.sorted()) {
      if (d.line > 0) {
        diagnostics_.add(d);
      } else {
        diagnostics_.add(name->at, fmt::format("model '{}': {}", path, d.message), d.remedy);
      }
    }
    return document ? std::make_shared<const ModelDocument>(std::move(*document)) : nullptr;
  }

  // The reference is the same model where it names no other.
  void load_models() {
    input_.model = load_model(study_);
    for (LoadCaseInput& one : input_.load_case) {
      if (one.reference && one.reference->is_run()) one.reference->model = input_.model;
    }
    if (!input_.reference || !input_.reference->is_run()) return;
    const Tree& tree = *study_.find("reference");
    const bool has_own = tree.find("model") != nullptr;
    input_.reference->model = has_own ? load_model(tree) : input_.model;
  }

  void write_command_line() {
    if (model_set_.empty()) return;
    apply_command_line(model_set_, input_, diagnostics_);
    write_set(study_.find("base"), input_.base_set);
    if (input_.reference) write_set(study_.find("reference"), input_.reference->set);
    Tree* experiments = study_.find("experiment");
    for (std::size_t i = 0; i < input_.load_case.size() && experiments != nullptr; ++i) {
      if (!input_.load_case[i].reference) continue;
      write_set(experiments->items[i].find("reference"), input_.load_case[i].reference->set);
    }
  }

  // What --set replaced in a set of the file, so that resolved.toml says what was run.
  static void write_set(Tree* tree, const std::vector<Override>& set) {
    Tree* table = tree != nullptr && tree->is(Kind::table) ? tree->find("set") : nullptr;
    const auto is_option = [](const Override& one) { return one.origin.line == 0; };
    if (table == nullptr || std::ranges::none_of(set, is_option)) return;
    Tree written = Tree::make_table(table->at);
    for (const Override& one : set) written.set(one.path, one.value);
    *table = std::move(written);
  }

  // Paths are looked up in the model as base.set leaves it.
  ModelDocument base_document() {
    ModelDocument document = *input_.model;
    for (const Override& override : input_.base_set) {
      Diagnostics said_by_trials;
      if (auto edited = document.edited({&override, 1}, said_by_trials)) document = *edited;
    }
    return document;
  }

  void read_parameters() {
    const ModelDocument document = base_document();
    input_.design.seed = input_.run.seed;
    if (has_point_file(study_) && !read_point_file(study_, input_.file, document, diagnostics_)) {
      has_rows_ = false;
      return;
    }
    if (input_.kind == FileKind::calibrate) {
      written_ = read_calibrated(document, study_, input_, diagnostics_);
      check_experiments(input_, diagnostics_);
      return;
    }
    Tree* entries = study_.find(list_of(input_.kind));
    if (entries != nullptr && entries->is(Kind::array)) {
      for (Tree& entry : entries->items) read_entry(document, entry);
      has_rows_ = have_equal_lengths();
      if (has_rows_) merge_equal_values(input_, written_, diagnostics_);
      if (input_.kind == FileKind::converge) finish_refinement(input_, written_, diagnostics_);
    }
  }

  static const char* list_of(FileKind kind) {
    return kind == FileKind::tune ? "tune" : kind == FileKind::converge ? "refine" : "vary";
  }

  void read_entry(const ModelDocument& document, Tree& entry) {
    const Tree* path = entry.find("parameter");
    if (!entry.is(Kind::table) || path == nullptr || !path->is(Kind::text)) return;
    const auto named = find_named_parameter(document, *path, diagnostics_);
    if (!named) return;
    const Parameter& parameter = named->parameter;
    for (const std::string& known : paths_) {
      if (known != path->text) continue;
      diagnostics_.add(path->at, fmt::format("parameter '{}' is listed twice", known),
                       "give it one entry with all its values");
      return;
    }
    paths_.push_back(path->text);
    if (input_.kind == FileKind::tune) return read_tune(entry, *named);
    std::optional<ReadAxis> axis = read_axis(entry, *named, input_.design, document, diagnostics_);
    if (!axis) return;
    VaryInput vary{{parameter, {}, axis->center, axis->distribution}, path->at};
    if (!axis->distribution) {
      for (const Tree& value : axis->values) vary.values.push_back(to_value(value));
    }
    input_.vary.push_back(std::move(vary));
    written_.push_back(std::move(axis->values));
  }

  static Value to_value(const Tree& value) {
    if (value.is(Kind::boolean)) return value.boolean ? "true" : "false";
    if (value.is(Kind::text)) return value.text;
    return value.as_number();
  }

  void read_tune(Tree& entry, const NamedParameter& named) {
    Tree* range = entry.find("range");
    if (range == nullptr || !range->is(Kind::table)) return;
    const Location& at = entry.find("parameter")->at;
    const auto found = read_named_range(*range, named, at, "tuned", diagnostics_);
    if (!found) return;
    input_.tune.push_back({named.parameter, found->is_logarithmic, found->low, found->high, at});
    written_.push_back(found->limits);
  }

  bool have_equal_lengths() {
    if (input_.design.type != Design::list) return true;
    bool are_equal = true;
    for (const VaryInput& vary : input_.vary) {
      const std::size_t first = input_.vary.front().values.size();
      if (vary.values.size() == first) continue;
      are_equal = false;
      diagnostics_.add(vary.at,
                       fmt::format("design list needs as many values of each parameter, got {} of "
                                   "'{}' and {} of '{}'",
                                   vary.values.size(), vary.parameter.path, first,
                                   input_.vary.front().parameter.path),
                       "give every [[vary]] the same number of values, or use type = \"grid\"");
    }
    return are_equal;
  }

  Tree study_;
  std::span<const Override> model_set_;
  const ResolvedTexts* texts_;
  const ReadEarlierRun& earlier_;
  Diagnostics& diagnostics_;
  StudyInput input_;
  std::vector<std::string> paths_;
  WrittenValues written_;  // one list for each entry of vary or tune
  bool has_rows_ = true;   // false: a list whose values do not pair, or a file that was reported
};

// The study's own keys; everything else belongs to the model.
bool is_study_path(const std::string& path) {
  const std::string first = split_path(path).front();
  return first == "name" || model_schema().find(first) == nullptr;
}

std::optional<StudyInput> read_tree(std::optional<Tree> tree, const std::string& path,
                                    std::span<const Override> set, const Sources& sources,
                                    Diagnostics& found, Diagnostics& diagnostics) {
  const std::optional<FileKind> kind = tree ? kind_of(*tree, found) : std::nullopt;
  if (kind && *kind == FileKind::model) {
    found.add(tree->find("kind")->at, "a study or tune is expected here, got kind = 'model'",
              "name a file with kind = \"study\" or kind = \"tune\"");
  }
  if (!kind || !found.empty()) {
    diagnostics.append(found);
    return std::nullopt;
  }
  const KeyNode& schema = key_schema(*kind);
  std::vector<Override> model_set;
  for (const Override& override : set) {
    if (is_study_path(override.path)) {
      set_value(*tree, schema, override, found);
    } else {
      model_set.push_back(override);
    }
  }
  validate(*tree, schema, found);
  StudyReader reader(std::move(*tree), path, model_set, sources, found);
  StudyInput input = reader.read(*kind);
  diagnostics.append(found);
  if (!found.empty()) return std::nullopt;
  input.remarks = found.sorted_remarks();
  return input;
}

}  // namespace

std::optional<StudyInput> read_study(const std::string& path, std::span<const Override> set,
                                     Diagnostics& diagnostics, const ReadEarlierRun& earlier) {
  Diagnostics found;
  std::optional<Tree> tree = read_toml_file(path, found);
  return read_tree(std::move(tree), path, set, {nullptr, earlier}, found, diagnostics);
}

std::optional<StudyInput> read_study(const ResolvedTexts& texts, const std::string& file,
                                     Diagnostics& diagnostics) {
  Diagnostics found;
  std::optional<Tree> tree = parse_toml(texts.study, file, found);
  return read_tree(std::move(tree), file, {}, {&texts, {}}, found, diagnostics);
}

}  // namespace linkstudy
