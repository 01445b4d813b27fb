#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "study/config/joint_units.h"
#include "study/config/read_value.h"
#include "study/config/study_input.h"
#include "study/config/study_records.h"
#include "study/config/toml_reader.h"
#include "study/config/validate.h"
#include "study/config/value_list.h"

namespace linkstudy {
namespace {

using Kind = Tree::Kind;
using Document = std::shared_ptr<const ModelDocument>;

// Cases of one parameter that are built and checked as whole models before anything runs.
constexpr std::size_t kMostTrials = 64;

class StudyReader {
 public:
  StudyReader(Tree study, std::string file, std::span<const Override> model_set,
              Diagnostics& diagnostics)
      : study_(std::move(study)), model_set_(model_set), diagnostics_(diagnostics) {
    input_.file = std::move(file);
  }

  StudyInput read(StudyKind kind) {
    input_.kind = kind;
    input_.name = word_of(study_, "name");
    read_records(study_, input_, diagnostics_);
    input_.model = load_model(study_);
    if (const Tree* base = study_.find("base")) input_.base_set = read_set(*base);
    read_reference();
    read_load_cases();
    if (kind == StudyKind::tune) require_match();
    if (input_.model) read_parameters();
    input_.resolved = study_;
    return std::move(input_);
  }

 private:
  static std::vector<Override> read_set(const Tree& owner) {
    const Tree* set = owner.find("set");
    return set != nullptr ? flatten_overrides(*set) : std::vector<Override>();
  }

  // A model file that cannot be opened is an error of the line that names it.
  Document load_model(const Tree& owner) {
    const Tree* name = owner.find("model");
    if (name == nullptr || !name->is(Kind::text)) return nullptr;
    const auto folder = std::filesystem::path(input_.file).parent_path();
    const std::string path = (folder / name->text).lexically_normal().string();
    Diagnostics found;
    std::optional<ModelDocument> document = ModelDocument::load(path, found);
    for (const Diagnostic& d : found.sorted()) {
      if (d.line > 0) {
        diagnostics_.add(d);
      } else {
        diagnostics_.add(name->at, fmt::format("model '{}': {}", path, d.message), d.remedy);
      }
    }
    if (document) document = document->edited(model_set_, diagnostics_);
    return document ? std::make_shared<const ModelDocument>(std::move(*document)) : nullptr;
  }

  void read_reference() {
    const Tree* tree = study_.find("reference");
    if (tree == nullptr || !tree->is(Kind::table)) return;
    ReferenceInput reference;
    reference.at = tree->at;
    reference.model = tree->find("model") != nullptr ? load_model(*tree) : input_.model;
    reference.set = read_set(*tree);
    if (reference.model) reference.model->with(reference.set, diagnostics_);
    input_.reference = std::move(reference);
  }

  void read_load_cases() {
    const Tree* cases = study_.find("load_case");
    if (cases == nullptr || !cases->is(Kind::array)) return;
    for (const Tree& tree : cases->items) {
      if (tree.is(Kind::table)) {
        input_.load_case.push_back({word_of(tree, "name"), read_set(tree), tree.at});
      }
    }
  }

  void require_match() {
    if (study_.find("match") != nullptr) return;
    diagnostics_.add(study_.at, "a tune needs at least one [[match]]",
                     "add [[match]] with signal and tolerance");
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
    const char* list = input_.kind == StudyKind::study ? "vary" : "tune";
    Tree* entries = study_.find(list);
    if (entries != nullptr && entries->is(Kind::array)) {
      for (Tree& entry : entries->items) read_entry(document, entry);
      require_equal_lengths();
    }
    try_cases();
  }

  void read_entry(const ModelDocument& document, Tree& entry) {
    const Tree* path = entry.find("parameter");
    if (!entry.is(Kind::table) || path == nullptr || !path->is(Kind::text)) return;
    const std::optional<Parameter> parameter = parameter_for(document, path->text);
    const KeyRow* row = find_row(document.tree(), model_schema(), path->text);
    if (row != nullptr && !parameter && path->text.find('*') != std::string::npos) {
      diagnostics_.add(path->at,
                       fmt::format("parameter '{}' names values of several units, or none that "
                                   "one number can have",
                                   path->text),
                       "give each its own entry");
      return;
    }
    if (!parameter || row == nullptr) {
      diagnostics_.add(
          path->at,
          fmt::format("parameter names no value of {}, got '{}'", document.file(), path->text),
          nearest_paths(document.tree(), model_schema(), path->text));
      return;
    }
    for (const std::string& known : paths_) {
      if (known != path->text) continue;
      diagnostics_.add(path->at, fmt::format("parameter '{}' is listed twice", known),
                       "give it one entry with all its values");
      return;
    }
    paths_.push_back(path->text);
    if (input_.kind == StudyKind::tune) return read_tune(entry, *parameter, *row);
    std::vector<Tree> values =
        read_value_list(entry, *row, parameter->unit, parameter->path, diagnostics_);
    if (values.empty()) return;
    VaryInput vary{*parameter, {}, path->at};
    for (const Tree& value : values) vary.values.push_back(to_value(value));
    input_.vary.push_back(std::move(vary));
    trials_.push_back(std::move(values));
  }

  static Value to_value(const Tree& value) {
    if (value.is(Kind::boolean)) return value.boolean ? "true" : "false";
    if (value.is(Kind::text)) return value.text;
    return value.as_number();
  }

  void read_tune(Tree& entry, const Parameter& parameter, const KeyRow& row) {
    Tree* range = entry.find("range");
    if (range == nullptr || !range->is(Kind::table)) return;
    if (!is_numeric_row(row) || row.type == KeyType::integer) {
      diagnostics_.add(entry.find("parameter")->at,
                       fmt::format("'{}' is no real number and cannot be tuned", parameter.path),
                       "vary it in a study instead");
      return;
    }
    Tree* log = range->find("log");
    Tree* limits = log != nullptr ? log : range->find("lin");
    if (limits == nullptr || !limits->is(Kind::array)) return;
    bool is_right = true;
    for (Tree& limit : limits->items) {
      is_right =
          validate_value(limit, row, parameter.unit, parameter.path, diagnostics_) && is_right;
    }
    if (!is_right) return;
    const double low = limits->items[0].as_number();
    const double high = limits->items[1].as_number();
    if (!(low < high) || (log != nullptr && !(low > 0.0))) {
      diagnostics_.add(limits->at,
                       fmt::format("range must rise{}, got {}",
                                   log != nullptr ? " from a positive number" : "", shown(*limits)),
                       "range = { log = [lowest, highest] }");
      return;
    }
    input_.tune.push_back({parameter, log != nullptr, low, high, entry.find("parameter")->at});
    trials_.push_back(limits->items);
  }

  void require_equal_lengths() {
    if (input_.design != DesignType::list) return;
    for (const VaryInput& vary : input_.vary) {
      const std::size_t first = input_.vary.front().values.size();
      if (vary.values.size() == first) continue;
      diagnostics_.add(vary.at,
                       fmt::format("design list needs as many values of each parameter, got {} of "
                                   "'{}' and {} of '{}'",
                                   vary.values.size(), vary.parameter.path, first,
                                   input_.vary.front().parameter.path),
                       "give every [[vary]] the same number of values, or use type = \"grid\"");
    }
  }

  std::string trial_path(std::size_t i) const {
    return input_.kind == StudyKind::study ? input_.vary[i].parameter.path
                                           : input_.tune[i].parameter.path;
  }

  // Builds whole models: every parameter at its first value, then one after the other at its
  // others, then the load cases. The first failing case of a parameter speaks for it.
  void try_cases() {
    std::vector<Override> first = input_.base_set;
    const std::size_t fixed = first.size();
    for (std::size_t i = 0; i < trials_.size(); ++i) {
      first.push_back({trial_path(i), trials_[i].front(), trials_[i].front().at});
    }
    if (!input_.model->with(first, diagnostics_)) return;
    for (std::size_t i = 0; i < trials_.size(); ++i) {
      const std::size_t stride = 1 + (trials_[i].size() - 1) / kMostTrials;
      std::vector<Override> other = first;
      for (std::size_t k = trials_[i].size(); k > 1; k -= std::min(k - 1, stride)) {
        other[fixed + i].value = trials_[i][k - 1];
        if (!input_.model->with(other, diagnostics_)) break;
      }
    }
    for (const LoadCaseInput& load_case : input_.load_case) {
      std::vector<Override> other = input_.base_set;
      other.insert(other.end(), load_case.set.begin(), load_case.set.end());
      other.insert(other.end(), first.begin() + static_cast<std::ptrdiff_t>(fixed), first.end());
      input_.model->with(other, diagnostics_);
    }
  }

  Tree study_;
  std::span<const Override> model_set_;
  Diagnostics& diagnostics_;
  StudyInput input_;
  std::vector<std::string> paths_;
  std::vector<std::vector<Tree>> trials_;  // one list for each entry of vary or tune
};

// The study's own keys; everything else belongs to the model.
bool is_study_path(const std::string& path) {
  const std::string first = split_path(path).front();
  return first == "name" || model_schema().find(first) == nullptr;
}

}  // namespace

std::optional<StudyInput> read_study(const std::string& path, std::span<const Override> set,
                                     Diagnostics& diagnostics) {
  Diagnostics found;
  std::optional<Tree> tree = read_toml_file(path, found);
  const std::optional<std::string> kind = tree ? kind_of(*tree, found) : std::nullopt;
  if (kind && *kind == "model") {
    found.add(tree->find("kind")->at, "a study or tune is expected here, got kind = 'model'",
              "name a file with kind = \"study\" or kind = \"tune\"");
  }
  if (!found.empty()) {
    diagnostics.append(found);
    return std::nullopt;
  }
  const bool is_tune = *kind == "tune";
  const KeyNode& schema = is_tune ? tune_schema() : study_schema();
  std::vector<Override> model_set;
  for (const Override& override : set) {
    if (is_study_path(override.path)) {
      set_value(*tree, schema, override, found);
    } else {
      model_set.push_back(override);
    }
  }
  validate(*tree, schema, found);
  StudyReader reader(std::move(*tree), path, model_set, found);
  StudyInput input = reader.read(is_tune ? StudyKind::tune : StudyKind::study);
  diagnostics.append(found);
  if (!found.empty()) return std::nullopt;
  return input;
}

}  // namespace linkstudy
