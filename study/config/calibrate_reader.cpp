#include "study/config/calibrate_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/simulation/channel_kinds.h"
#include "study/config/measured_reader.h"
#include "study/config/named_parameter.h"
#include "study/config/value_list.h"

namespace linkstudy {
namespace {

using Kind = Tree::Kind;

class CalibratedReader {
 public:
  CalibratedReader(const ModelDocument& document, StudyInput& input, Diagnostics& diagnostics)
      : document_(document), input_(input), diagnostics_(diagnostics) {}

  WrittenValues run(Tree& list) {
    for (Tree& entry : list.items)
      if (entry.is(Kind::table)) read_entry(entry);
    for (const PendingTie& tie : ties_) settle(tie);
    const auto is_free = [](const CalibratedInput& one) { return one.role == ParameterRole::free; };
    if (diagnostics_.empty() && std::ranges::none_of(input_.calibrated, is_free)) {
      diagnostics_.add(list.at, "no [[parameter]] is fitted: all are fixed or tied",
                       "give one a range");
    }
    return std::move(written_);
  }

 private:
  struct PendingTie {
    std::size_t follower;
    const Tree* leader;  // its path
  };

  void read_entry(Tree& entry) {
    const Tree* path = entry.find("path");
    if (path == nullptr || !path->is(Kind::text)) return;
    const auto named = find_named_parameter(document_, *path, diagnostics_);
    if (!named) return wrong_.push_back(path->text);
    CalibratedInput one;
    one.parameter = named->parameter;
    one.at = path->at;
    std::vector<Tree> values;
    const Tree* tied = entry.find("tied_to");
    if (Tree* fixed = entry.find("fixed")) {
      one.role = ParameterRole::fixed;
      one.fixed = read_number(*fixed, *named);
      values = {*fixed};
    } else if (tied != nullptr && tied->is(Kind::text)) {
      one.role = ParameterRole::tied;
      const Tree* factor = entry.find("factor");
      if (factor != nullptr && factor->is_numeric()) one.factor = factor->as_number();
    } else if (!read_range(entry, *named, one, values)) {
      return wrong_.push_back(path->text);
    }
    refuse_idle(entry, one);
    if (one.role == ParameterRole::tied) ties_.push_back({input_.calibrated.size(), tied});
    input_.calibrated.push_back(std::move(one));
    written_.push_back(std::move(values));
  }

  bool read_range(Tree& entry, const NamedParameter& named, CalibratedInput& one,
                  std::vector<Tree>& values) {
    Tree* range = entry.find("range");
    if (range == nullptr || !range->is(Kind::table)) return false;
    const auto found = read_named_range(*range, named, one.at, "fitted", diagnostics_);
    if (!found) return false;
    one.is_logarithmic = found->is_logarithmic;
    one.low = found->low;
    one.high = found->high;
    values = found->limits;
    Tree* start = entry.find("start");
    if (start == nullptr) return true;
    one.start = read_number(*start, named);
    if (!start->is_valid() || (one.low <= *one.start && *one.start <= one.high)) return true;
    diagnostics_.add(
        start->at, fmt::format("start must lie within the range, got {}", shown(*start)),
        fmt::format("between {:g} and {:g} {}", one.low, one.high, named.parameter.unit));
    return true;
  }

  double read_number(Tree& value, const NamedParameter& named) {
    const bool is_right =
        validate_value(value, *named.row, named.parameter.unit, named.parameter.path, diagnostics_);
    return is_right ? value.as_number() : 0.0;
  }

  // What another role would read.
  void refuse_idle(const Tree& entry, const CalibratedInput& one) {
    const Tree* start = entry.find("start");
    if (start != nullptr && one.role != ParameterRole::free) {
      diagnostics_.add(start->at,
                       fmt::format("'{}' is not fitted and needs no start", one.parameter.path),
                       "take it out, or give a range");
    }
    const Tree* factor = entry.find("factor");
    if (factor != nullptr && one.role != ParameterRole::tied) {
      diagnostics_.add(factor->at,
                       fmt::format("'{}' is not tied and has no factor", one.parameter.path),
                       "take it out, or write tied_to");
    }
  }

  // Values of a tied one are those of its leader times the factor, in the units of the model.
  void settle(const PendingTie& tie) {
    if (std::ranges::count(wrong_, tie.leader->text) > 0) return;
    CalibratedInput& one = input_.calibrated[tie.follower];
    for (std::size_t i = 0; i < input_.calibrated.size(); ++i) {
      const CalibratedInput& leader = input_.calibrated[i];
      if (leader.parameter.path != tie.leader->text || leader.role != ParameterRole::free) continue;
      one.leader = i;
      for (const double end : {leader.low, leader.high}) {
        written_[tie.follower].push_back(Tree::make_number(one.factor * end, tie.leader->at));
      }
      return;
    }
    std::vector<std::string> paths;
    for (const CalibratedInput& leader : input_.calibrated) {
      if (leader.role == ParameterRole::free) paths.push_back(leader.parameter.path);
    }
    diagnostics_.add(
        tie.leader->at,
        fmt::format("tied_to must name a [[parameter]] with a range, got '{}'", tie.leader->text),
        fmt::format("there are: {}", fmt::join(paths, ", ")));
  }

  const ModelDocument& document_;
  StudyInput& input_;
  Diagnostics& diagnostics_;
  WrittenValues written_;
  std::vector<PendingTie> ties_;
  std::vector<std::string> wrong_;  // paths of entries that were reported
};

void check_sigma(const MeasuredInput& measured, Diagnostics& diagnostics) {
  if (measured.columns.size() < 2 && measured.signals.empty()) return;  // said already
  for (const SigmaInput& sigma : measured.sigma) {
    const auto is_meant = [&](const auto& name) {
      return is_in_group(name, sigma.signal) || is_in_group(sigma.signal, name);
    };
    bool is_known = false;
    for (const WantedColumn& one : measured.columns) is_known = is_known || is_meant(one.channel);
    for (const TraceInput& one : measured.signals) is_known = is_known || is_meant(one.signal);
    if (is_known) continue;
    diagnostics.add(sigma.at, fmt::format("sigma names '{}', which is not compared", sigma.signal),
                    "name a channel of this experiment, or a vector of them");
  }
}

// A file has columns, a reference run signals, results either.
void check_signals_and_columns(const LoadCaseInput& experiment, bool takes_signals,
                               bool takes_columns, const char* what, Diagnostics& diagnostics) {
  const MeasuredInput& measured = *experiment.measured;
  if (!takes_signals && !measured.signals.empty()) {
    diagnostics.add(
        measured.signals.front().at,
        fmt::format("signals belong to a run or to results, and this experiment has {}", what),
        "write columns = { ... } in place of signals");
  }
  if (!takes_columns && !measured.columns.empty()) {
    diagnostics.add(measured.columns.front().channel_at,
                    fmt::format("columns belong to a file or to results, and this experiment has "
                                "{}",
                                what),
                    "write signals = [...] in place of columns");
  }
  if (takes_signals && measured.signals.empty() && (!takes_columns || measured.columns.empty())) {
    diagnostics.add(experiment.at,
                    fmt::format("experiment '{}' names nothing to compare", experiment.name),
                    "signals = [\"closure.S.force\"]");
  }
}

void check_source(const LoadCaseInput& experiment, Diagnostics& diagnostics) {
  const MeasuredInput& measured = *experiment.measured;
  const bool has_results = measured.results && !measured.results->directory.empty();
  // Which of them it should have is said already.
  if (!experiment.reference && !measured.results && measured.file.empty()) return;
  if (measured.results && !has_results) {
    diagnostics.add(experiment.at,
                    fmt::format("experiment '{}' names an evaluation or a load case of no results",
                                experiment.name),
                    "results = \"results/first\"");
    return;
  }
  if (experiment.reference) {
    check_signals_and_columns(experiment, true, false, "a reference run", diagnostics);
    return;
  }
  if (has_results) {
    const bool has_signals = !measured.signals.empty();
    check_signals_and_columns(experiment, true, !has_signals, "signals of results", diagnostics);
  } else {
    check_signals_and_columns(experiment, false, true, "a file", diagnostics);
  }
  check_data(measured, fmt::format("experiment '{}'", experiment.name), experiment.at, diagnostics);
}

}  // namespace

WrittenValues read_calibrated(const ModelDocument& document, Tree& study, StudyInput& input,
                              Diagnostics& diagnostics) {
  Tree* list = study.find("parameter");
  if (list == nullptr || !list->is(Kind::array)) return {};
  return CalibratedReader(document, input, diagnostics).run(*list);
}

void check_experiments(const StudyInput& input, Diagnostics& diagnostics) {
  for (const LoadCaseInput& experiment : input.load_case) {
    if (!experiment.measured) continue;
    check_sigma(*experiment.measured, diagnostics);
    check_source(experiment, diagnostics);
  }
}

}  // namespace linkstudy
