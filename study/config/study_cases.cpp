#include "study/config/study_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "study/config/case_selection.h"
#include "study/config/precedence.h"
#include "study/design/design.h"
#include "study/record/sequence.h"

namespace linkstudy {
namespace {

// Models built and checked before anything runs.
constexpr std::size_t kMostTrials = 256;  // of all load cases together
constexpr std::size_t kLeastTrials = 16;  // of one load case

std::size_t most_trials(const StudyInput& input) {
  return std::max(kLeastTrials, kMostTrials / std::max<std::size_t>(1, input.load_case.size()));
}

// The entries whose values are written: [[vary]], [[refine]], [[tune]] or [[parameter]].
struct Entry {
  const std::string& path;
  const Location& at;
};

Entry entry_of(const StudyInput& input, std::size_t i) {
  if (has_design(input.kind)) return {input.vary[i].parameter.path, input.vary[i].at};
  if (input.kind == FileKind::tune) return {input.tune[i].parameter.path, input.tune[i].at};
  return {input.calibrated[i].parameter.path, input.calibrated[i].at};
}

std::string path_of(const StudyInput& input, std::size_t i) {
  return entry_of(input, i).path;
}

const Location& place_of(const StudyInput& input, std::size_t i) {
  return entry_of(input, i).at;
}

// Two spellings of one number differ by the rounding of their units at most.
std::string key_of(const Value& value) {
  const double* number = std::get_if<double>(&value);
  if (number == nullptr) return std::get<std::string>(value);
  return fmt::format("{:.12e}", *number == 0.0 ? 0.0 : *number);
}

std::string shown_row(const StudyInput& input, std::size_t first, std::size_t end,
                      std::size_t position) {
  std::vector<std::string> parts;
  for (std::size_t i = first; i < end; ++i) {
    const Value& value = input.vary[i].values[position];
    const double* number = std::get_if<double>(&value);
    const std::string text =
        number != nullptr ? fmt::format("{:.9g}", *number) : std::get<std::string>(value);
    const std::string& unit = input.vary[i].parameter.unit;
    parts.push_back(unit.empty() ? text : text + " " + unit);
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

template <class T>
void keep_positions(std::vector<T>& values, const std::vector<std::size_t>& kept) {
  std::vector<T> rest;
  for (const std::size_t i : kept) rest.push_back(std::move(values[i]));
  values = std::move(rest);
}

// The entries first .. end - 1 side by side.
void merge_rows(StudyInput& input, WrittenValues& written, std::size_t first, std::size_t end,
                Diagnostics& diagnostics) {
  struct Row {
    std::size_t position;
    std::size_t count = 1;
    std::size_t again = 0;  // where it comes for the second time
  };
  std::map<std::vector<std::string>, Row> rows;
  std::vector<std::size_t> kept;
  for (std::size_t k = 0; k < input.vary[first].values.size(); ++k) {
    std::vector<std::string> key;
    for (std::size_t i = first; i < end; ++i) key.push_back(key_of(input.vary[i].values[k]));
    const auto [row, is_new] = rows.emplace(std::move(key), Row{k});
    if (is_new) {
      kept.push_back(k);
    } else if (row->second.count++ == 1) {
      row->second.again = k;
    }
  }
  if (kept.size() == input.vary[first].values.size()) return;
  for (const auto& [key, row] : rows) {
    if (row.count == 1) continue;
    diagnostics.remark(
        Severity::note, written[first][row.again].at,
        fmt::format("{} of '{}' is given {} times and runs once",
                    shown_row(input, first, end, row.position), path_of(input, first), row.count),
        "cases are counted without the repetitions");
  }
  for (std::size_t i = first; i < end; ++i) {
    keep_positions(input.vary[i].values, kept);
    keep_positions(written[i], kept);
  }
}

// A value that is set, and whether it has been seen to act.
struct Watched {
  std::string path;
  Location at;
  bool acts = false;
  std::optional<Ineffective> why;

  void look(const Tree& model, const std::string& verb) {
    if (acts) return;
    std::optional<Ineffective> found = find_ineffective(model, model_schema(), path, verb);
    acts = !found;
    if (!why) why = std::move(found);
  }
};

std::vector<Watched> watch(std::span<const Override> set) {
  std::vector<Watched> watched;
  for (const Override& one : set) watched.push_back({one.path, one.origin, false, std::nullopt});
  return watched;
}

class CaseCheck {
 public:
  CaseCheck(const StudyInput& input, const WrittenValues& written,
            std::span<const Override> command_line, Diagnostics& diagnostics)
      : input_(input),
        written_(written),
        diagnostics_(diagnostics),
        verb_(name_of(input.kind)),
        options_(watch(command_line)) {
    for (std::size_t i = 0; i < written.size(); ++i) {
      varied_.push_back({path_of(input, i), place_of(input, i), false, std::nullopt});
    }
    for (const Override& one : input.base_set) {
      // What --set wrote there is watched as such.
      if (one.origin.line > 0) sets_.push_back({one.path, one.origin, false, std::nullopt});
    }
  }

  void run() {
    std::vector<LoadCaseInput> load_cases = input_.load_case;
    if (load_cases.empty()) load_cases.emplace_back();
    const std::vector<std::vector<Override>> cases = chosen_cases();
    for (const LoadCaseInput& load_case : load_cases) {
      try_reference(load_case);
      std::vector<Watched> own = watch(load_case.set);
      for (const std::vector<Override>& point : cases) try_case(load_case, point, own);
      sets_.insert(sets_.end(), own.begin(), own.end());
    }
    if (!diagnostics_.empty() || models_ == 0) return;
    report_varied();
    for (const Watched& one : sets_) report_set(one);
    for (const Watched& one : options_) report_set(one);
    report_written();
  }

 private:
  std::vector<std::vector<Override>> chosen_cases() const {
    std::vector<std::vector<Override>> cases;
    if (!combines_values(input_.design.type)) {
      const std::vector<Axis> axes = axes_of(input_);
      for (const std::uint64_t id : choose_ids(input_.design, axes, most_trials(input_))) {
        cases.push_back(sample(axes, id));
      }
      return cases;
    }
    std::vector<std::size_t> sizes;
    for (const std::vector<Tree>& values : written_) sizes.push_back(values.size());
    for (const CasePositions& positions :
         choose_cases(input_.design.type, sizes, most_trials(input_))) {
      std::vector<Override>& point = cases.emplace_back();
      for (std::size_t i = 0; i < positions.size(); ++i) {
        const Tree& value = written_[i][positions[i]];
        point.push_back({varied_[i].path, value, value.at});
      }
    }
    return cases;
  }

  std::vector<Override> sample(const std::vector<Axis>& axes, std::uint64_t id) const {
    std::vector<Override> point;
    const std::vector<Value> values = make_point(input_.design, axes, id).values;
    for (std::size_t i = 0; i < axes.size(); ++i) {
      point.push_back(make_override(axes[i].parameter.path, values[i]));
      point.back().value.at = point.back().origin = varied_[i].at;
    }
    return point;
  }

  // What one place is wrong about is said once, by the first case.
  void add_new(const Diagnostics& found) {
    for (const Diagnostic& d : found.sorted()) {
      if (places_.emplace(d.file, d.line, d.column).second) diagnostics_.add(d);
    }
  }

  std::optional<ModelInput> build(const ModelDocument& document,
                                  const std::vector<Override>& overrides) {
    Diagnostics found;
    std::optional<ModelInput> model = document.with(overrides, found);
    add_new(found);
    if (!model) return model;
    ++models_;
    for (const Ineffective& one : model->ineffective) {
      if (one.stands_by) continue;
      const auto [entry, is_new] = written_idle_.emplace(one.path, std::pair(one, std::size_t{0}));
      ++entry->second.second;
    }
    return model;
  }

  void try_case(const LoadCaseInput& load_case, const std::vector<Override>& point,
                std::vector<Watched>& own) {
    const auto model = build(*input_.model, case_overrides(input_, load_case, point));
    if (!model) return;
    for (std::vector<Watched>* all : {&varied_, &sets_, &options_, &own}) {
      for (Watched& one : *all) one.look(model->resolved, verb_);
    }
  }

  void try_reference(const LoadCaseInput& load_case) {
    const ReferenceInput* reference = reference_run_of(input_, load_case);
    if (reference == nullptr || !reference->model) return;
    const auto model = build(*reference->model, reference_overrides(input_, load_case));
    if (!model) return;
    for (Watched& one : options_) one.look(model->resolved, verb_);
    std::vector<Watched> own = watch(reference->set);
    for (Watched& one : own) {
      one.look(model->resolved, verb_);
      if (one.at.line > 0) sets_.push_back(one);
    }
  }

  void report_varied() {
    for (const Watched& one : varied_) {
      if (one.acts || !one.why) continue;
      diagnostics_.add(one.at,
                       fmt::format("'{}' has no effect on any case: {}", one.path, one.why->reason),
                       one.why->remedy);
    }
  }

  void report_set(const Watched& one) {
    if (one.acts || !one.why) return;
    diagnostics_.remark(Severity::warning, one.at, one.why->message(), one.why->remedy);
  }

  // What the model file states, in whatever case.
  void report_written() {
    for (const auto& [path, entry] : written_idle_) {
      const auto& [one, count] = entry;
      if (count == models_) {
        diagnostics_.remark(Severity::warning, one.at, one.message(), one.remedy);
      }
    }
  }

  const StudyInput& input_;
  const WrittenValues& written_;
  Diagnostics& diagnostics_;
  std::string verb_;
  std::vector<Watched> varied_, sets_, options_;
  std::map<std::string, std::pair<Ineffective, std::size_t>> written_idle_;
  std::set<std::tuple<std::string, int, int>> places_;
  std::size_t models_ = 0;
};

// The entry whose values make too many cases of those before it.
bool report_grid_size(const StudyInput& input, const WrittenValues& written,
                      Diagnostics& diagnostics) {
  std::vector<std::size_t> sizes;
  for (std::size_t i = 0; i < written.size(); ++i) {
    sizes.push_back(written[i].size());
    if (count_cases(input.design.type, sizes)) continue;
    diagnostics.add(place_of(input, i),
                    fmt::format("the grid of {} cases up to here has more than the {} allowed",
                                fmt::join(sizes, " x "), kMaxPoints),
                    "use fewer values, or design = { type = \"list\" }");
    return true;
  }
  return false;
}

// Of designs whose numbers of points are not those of values.
bool report_design(const StudyInput& input, Diagnostics& diagnostics) {
  if (is_sensitivity(input.design.type) && input.match.empty() && input.response.empty()) {
    diagnostics.add(
        locate(input.resolved, "design.type"),
        fmt::format("a design of type '{}' tells sensitivities, and no quantity is kept",
                    name_of(input.design.type)),
        "add a [[response]] or a [[match]]");
  }
  try {
    count_points(input.design, axes_of(input));
    return false;
  } catch (const std::invalid_argument& reason) {
    if (!diagnostics.empty()) return true;  // what an entry lacks has been said
    const std::string message = reason.what();
    const std::size_t cut = message.find("; ");
    diagnostics.add(locate(input.resolved, "design.type"), message.substr(0, cut),
                    cut == std::string::npos ? "use fewer" : message.substr(cut + 2));
    return true;
  }
}

}  // namespace

void merge_equal_values(StudyInput& input, WrittenValues& written, Diagnostics& diagnostics) {
  if (input.vary.size() != written.size()) return;
  if (!combines_values(input.design.type)) return;
  if (input.design.type != Design::grid) {
    if (!written.empty()) merge_rows(input, written, 0, written.size(), diagnostics);
    return;
  }
  for (std::size_t i = 0; i < written.size(); ++i)
    merge_rows(input, written, i, i + 1, diagnostics);
}

void check_cases(const StudyInput& input, const WrittenValues& written,
                 std::span<const Override> command_line, Diagnostics& diagnostics) {
  if (!input.model) return;
  if (has_design(input.kind)) {
    if (report_grid_size(input, written, diagnostics)) return;
    if (!combines_values(input.design.type) && report_design(input, diagnostics)) return;
  }
  CaseCheck(input, written, command_line, diagnostics).run();
}

}  // namespace linkstudy
