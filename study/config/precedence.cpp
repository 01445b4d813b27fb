#include "study/config/precedence.h"

#include <fmt/format.h>

#include <algorithm>

#include "study/config/value_path.h"

namespace linkstudy {
namespace {

using Document = std::shared_ptr<const ModelDocument>;

PathRelation relate(const Document& model, const std::string& first, const std::string& second) {
  return relation_of(model->tree(), model_schema(), first, second);
}

bool write_into(Document& model, const Override& override, Diagnostics& diagnostics) {
  const std::optional<ModelDocument> edited = model->edited({&override, 1}, diagnostics);
  if (!edited) return false;
  model = std::make_shared<const ModelDocument>(*edited);
  return true;
}

// Of a set that states the value, what the override covers goes, and the override stands last.
void replace_in_set(std::vector<Override>& set, const Document& model, const Override& override) {
  bool is_stated = false;
  std::erase_if(set, [&](const Override& stated) {
    const PathRelation relation = relate(model, stated.path, override.path);
    is_stated = is_stated || relation != PathRelation::apart;
    return relation != PathRelation::apart && relation != PathRelation::contains;
  });
  if (is_stated) set.push_back(override);
}

const Override* find_stated(const std::vector<Override>& set, const Document& model,
                            const std::string& path) {
  const auto found = std::ranges::find_if(set, [&](const Override& one) {
    return relate(model, one.path, path) == PathRelation::same;
  });
  return found == set.end() ? nullptr : &*found;
}

// Where the cases were meant to differ from their reference.
void warn_of_likeness(const StudyInput& input, const Override& override, Diagnostics& diagnostics) {
  const Override* own = find_stated(input.base_set, input.model, override.path);
  const Override* other = find_stated(input.reference->set, input.reference->model, override.path);
  if (own == nullptr || other == nullptr || equal_content(own->value, other->value)) return;
  diagnostics.remark(
      Severity::warning, override.origin,
      fmt::format("{} replaces {} of base.set and {} of reference.set: cases and reference agree "
                  "in it",
                  override.path, shown(own->value), shown(other->value)),
      "to change one of them only, edit the file");
}

std::vector<Override> join(std::vector<Override> set, const std::vector<Override>& more) {
  set.insert(set.end(), more.begin(), more.end());
  return set;
}

// One value that the study names, and where.
struct Source {
  std::string path;
  Location at;
  std::string name;  // "load case 'fast'", "[[vary]]"
};

std::vector<Source> sources_of(const std::vector<Override>& set, const std::string& name) {
  std::vector<Source> sources;
  for (const Override& one : set) sources.push_back({one.path, one.origin, name});
  return sources;
}

class SourceCheck {
 public:
  SourceCheck(const StudyInput& input, Diagnostics& diagnostics)
      : input_(input), diagnostics_(diagnostics) {
    const char* list = input.kind == FileKind::converge ? "[[refine]]" : "[[vary]]";
    for (const VaryInput& vary : input.vary) {
      varied_.push_back({vary.parameter.path, vary.at, list});
    }
    for (const TuneInput& tune : input.tune) {
      varied_.push_back({tune.parameter.path, tune.at, "[[tune]]"});
    }
    for (const CalibratedInput& one : input.calibrated) {
      varied_.push_back({one.parameter.path, one.at, "[[parameter]]"});
    }
  }

  void run(std::span<const Override> command_line) {
    check_set(input_.model, sources_of(input_.base_set, "base.set"));
    if (input_.reference && input_.reference->model) {
      check_set(input_.reference->model, sources_of(input_.reference->set, "reference.set"));
    }
    std::vector<std::vector<Source>> cases;
    for (const LoadCaseInput& one : input_.load_case) {
      const char* what = one.measured ? "experiment" : "load case";
      cases.push_back(sources_of(one.set, fmt::format("{} '{}'", what, one.name)));
      check_set(input_.model, cases.back());
      if (!one.reference || !one.reference->model) continue;
      check_set(one.reference->model, sources_of(one.reference->set, "reference.set"));
    }
    std::vector<Source> options;
    for (const Override& one : command_line) options.push_back({one.path, one.origin, "--set"});
    for (const std::vector<Source>& set : cases) {
      for (const Source& one : set) {
        compare(options, one);
        for (const Source& varied : varied_) compare({one}, varied);
      }
    }
    for (const Source& varied : varied_) compare(options, varied);
    for (std::size_t i = 1; i < varied_.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) compare({varied_[i]}, varied_[k]);
    }
  }

 private:
  // Within one set a part may follow its whole: stiffness, then stiffness.x.
  void check_set(const Document& model, const std::vector<Source>& set) {
    for (std::size_t i = 1; i < set.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        const PathRelation relation = relate(model, set[k].path, set[i].path);
        if (relation == PathRelation::apart || relation == PathRelation::contains) continue;
        report(set[i], set[k]);
      }
    }
  }

  void compare(const std::vector<Source>& set, const Source& other) {
    for (const Source& one : set) {
      if (relate(input_.model, one.path, other.path) != PathRelation::apart) report(one, other);
    }
  }

  void report(const Source& one, const Source& other) {
    const std::string place = other.at.line > 0 ? fmt::format(" ({}:{}:{})", *other.at.file,
                                                              other.at.line, other.at.column)
                                                : std::string();
    const std::string spelling =
        one.path == other.path ? std::string() : fmt::format(" as '{}'", other.path);
    diagnostics_.add(one.at,
                     fmt::format("{} names '{}', which {} names{} too{}", one.name, one.path,
                                 other.name, spelling, place),
                     one.name == other.name
                         ? "name every value once"
                         : "neither of them is a default of the other: take the value out of one");
  }

  const StudyInput& input_;
  Diagnostics& diagnostics_;
  std::vector<Source> varied_;
};

}  // namespace

std::vector<Override> case_overrides(const StudyInput& input, const LoadCaseInput& load_case,
                                     std::vector<Override> point) {
  return join(join(input.base_set, load_case.set), point);
}

const ReferenceInput* reference_of(const StudyInput& input, const LoadCaseInput& load_case) {
  if (load_case.reference) return &*load_case.reference;
  return input.reference ? &*input.reference : nullptr;
}

const ReferenceInput* reference_run_of(const StudyInput& input, const LoadCaseInput& load_case) {
  const ReferenceInput* reference = reference_of(input, load_case);
  return reference != nullptr && reference->is_run() ? reference : nullptr;
}

const MeasuredInput* reference_data_of(const StudyInput& input, const LoadCaseInput& load_case) {
  const ReferenceInput* reference = reference_of(input, load_case);
  return reference == nullptr || reference->is_run() ? nullptr : &*reference->measured;
}

std::vector<Override> reference_overrides(const StudyInput& input, const LoadCaseInput& load_case) {
  return join(reference_run_of(input, load_case)->set, load_case.set);
}

void apply_command_line(std::span<const Override> command_line, StudyInput& input,
                        Diagnostics& diagnostics) {
  if (!input.model) return;
  const bool has_reference = input.reference && input.reference->model;
  const bool has_other = has_reference && input.reference->model != input.model;
  for (const Override& override : command_line) {
    Diagnostics of_model;
    Diagnostics of_reference;
    bool is_known = write_into(input.model, override, of_model);
    if (has_other) {
      is_known = write_into(input.reference->model, override, of_reference) || is_known;
    }
    if (!is_known) diagnostics.append(of_model);
    if (has_reference) warn_of_likeness(input, override, diagnostics);
    replace_in_set(input.base_set, input.model, override);
    for (LoadCaseInput& one : input.load_case) {
      if (!one.reference || !one.reference->is_run()) continue;
      one.reference->model = input.model;
      replace_in_set(one.reference->set, input.model, override);
    }
    if (!has_reference) continue;
    if (!has_other) input.reference->model = input.model;
    replace_in_set(input.reference->set, input.reference->model, override);
  }
}

void require_one_source(std::span<const Override> command_line, const StudyInput& input,
                        Diagnostics& diagnostics) {
  if (input.model) SourceCheck(input, diagnostics).run(command_line);
}

}  // namespace linkstudy
