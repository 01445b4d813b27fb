#include "study/config/study_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "study/config/read_value.h"
#include "study/config/unit.h"

namespace linkstudy {
namespace {

using Kind = Tree::Kind;

void require_unique(const Tree& study, const char* list, Diagnostics& diagnostics) {
  const Tree* records = study.find(list);
  if (records == nullptr || !records->is(Kind::array)) return;
  for (std::size_t i = 0; i < records->items.size(); ++i) {
    const Tree* name = records->items[i].find("name");
    if (name == nullptr || !name->is(Kind::text)) continue;
    for (std::size_t k = 0; k < i; ++k) {
      if (word_of(records->items[k], "name") != name->text) continue;
      diagnostics.add(name->at, fmt::format("{}: the name '{}' is used twice", list, name->text),
                      fmt::format("give every {} its own name", list));
      break;
    }
  }
}

// Every load case is compared with its own reference or with the common one.
void check_references(const Tree& study, const Tree& match, Diagnostics& diagnostics) {
  const Tree* common = study.find("reference");
  const Tree* load_cases = study.find("load_case");
  const bool has_cases = load_cases != nullptr && load_cases->is(Kind::array);
  const std::vector<Tree> cases = has_cases ? load_cases->items : std::vector<Tree>();
  const auto lacks = [](const Tree& one) { return one.find("reference") == nullptr; };
  const auto bare = std::ranges::find_if(cases, lacks);
  if (common != nullptr && !cases.empty() && bare == cases.end()) {
    diagnostics.add(common->at, "nothing is compared with this: every load case has a reference",
                    "take it out, or the references of some load cases");
  }
  if (common != nullptr || (!cases.empty() && bare == cases.end())) return;
  const bool is_some = std::ranges::any_of(cases, [&](const Tree& one) { return !lacks(one); });
  if (is_some) {
    diagnostics.add(bare->at, "this load case has no reference to compare with",
                    "give it one, or the study a [reference] for all that have none");
    return;
  }
  diagnostics.add(match.at, "[[match]] needs a reference to compare with",
                  "add reference = { set = { \"closure.S.model\" = \"cut\" } }");
}

}  // namespace

std::optional<TimeWindow> read_window(Tree& value, const Reading& reading) {
  const TimeWindow window{value.items[0].as_number(), value.items[1].as_number(), value.at};
  if (window.first < window.last) return window;
  reading.diagnostics.add(value.at,
                          fmt::format("window must end after it begins, got {}", shown(value)),
                          "window = [first, last] in s");
  return std::nullopt;
}

void read_reference_signal(MatchInput& match, Tree& value, const Reading& reading) {
  const bool is_turned = value.text.starts_with('-');
  match.reference_sign = is_turned ? -1.0 : 1.0;
  match.reference_signal = value.text.substr(is_turned ? 1 : 0);
  match.reference_at = value.at;
  if (!match.reference_signal.empty()) return;
  reading.diagnostics.add(value.at, "reference_signal must name a channel, got '-'",
                          "write the channel after the sign");
}

void read_place(ResponseInput& response, Tree& value, const Reading& reading) {
  if (value.is(Kind::text) && !value.text.empty()) {
    response.where = PlaceInput{value.text, value.at};
  } else if (value.is(Kind::boolean)) {
    if (value.boolean) response.where = PlaceInput{"", value.at};
  } else {
    reading.report(value, fmt::format("where must be true or a channel, got {}", shown(value)),
                   "for example where = \"joint.crank.q\"");
  }
}

void check_place(const ResponseInput& response, Tree&, const Reading& reading) {
  const bool is_extreme = response.reduce == Reduction::max || response.reduce == Reduction::min ||
                          response.reduce == Reduction::max_abs;
  if (!response.where || is_extreme) return;
  reading.diagnostics.add(
      response.where->at,
      fmt::format("reduce = \"{}\" is reached nowhere in particular", name_of(response.reduce)),
      "take `where` out, or reduce = \"max\", \"min\" or \"max_abs\"");
}

void read_trace(StudyInput& study, Tree& value, const Reading& reading) {
  if (value.items.empty()) {
    reading.diagnostics.add(value.at, "signals must not be empty, got []", "name a channel");
  }
  for (const Tree& signal : value.items) study.trace.push_back({signal.text, signal.at});
}

void read_failure_limit(RunOptions& run, Tree& value, const Reading& reading) {
  const std::optional<WrittenQuantity> quantity =
      value.is(Kind::text) ? split_quantity(value.text) : std::nullopt;
  const bool is_percent = quantity && quantity->unit == "%";
  const double number = is_percent ? quantity->value : value.as_number();
  const bool is_count = value.is_numeric() && number >= 0.0 && number == std::floor(number);
  if (is_count || (is_percent && number >= 0.0 && number <= 100.0)) {
    run.max_failures = FailureLimit{number, is_percent};
    return;
  }
  reading.diagnostics.add(
      value.at, fmt::format("run.max_failures must be a count or a share, got {}", shown(value)),
      "for example 10, or \"5 %\"");
}

void check_study(const Tree& study, FileKind kind, Diagnostics& diagnostics) {
  require_unique(study, "response", diagnostics);
  require_unique(study, "load_case", diagnostics);
  require_unique(study, "experiment", diagnostics);
  const Tree* match = study.find("match");
  if (match == nullptr && kind == FileKind::tune) {
    diagnostics.add(study.at, "a tune needs at least one [[match]]",
                    "add [[match]] with signal and tolerance");
  }
  const bool has_quantity =
      match != nullptr || study.find("response") != nullptr || study.find("series") != nullptr;
  if (!has_quantity && kind == FileKind::converge) {
    diagnostics.add(study.at, "a refinement needs something to judge",
                    "add [[response]], [[series]] or [[match]]");
  }
  if (match != nullptr && match->is_valid()) check_references(study, *match, diagnostics);
}

}  // namespace linkstudy
