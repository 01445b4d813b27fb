#include "study/config/study_records.h"

#include <fmt/format.h>

#include <cmath>

#include "study/config/joint_units.h"
#include "study/config/read_value.h"
#include "study/config/unit.h"

namespace linkstudy {
namespace {

using Kind = Tree::Kind;

Location place_of(const Tree& table, std::string_view key) {
  const Tree* value = table.find(key);
  return value != nullptr ? value->at : table.at;
}

class RecordReader {
 public:
  RecordReader(const Tree& study, StudyInput& input, Diagnostics& diagnostics)
      : study_(study), input_(input), diagnostics_(diagnostics) {}

  void read() {
    for_each("match", [&](const Tree& tree) { input_.match.push_back(read_match(tree)); });
    for_each("response", [&](const Tree& tree) { input_.response.push_back(read_response(tree)); });
    for_each("trace", [&](const Tree& tree) { read_trace(tree); });
    require_unique("response");
    require_unique("load_case");
    const Tree* match = study_.find("match");
    if (match != nullptr && match->is_valid() && study_.find("reference") == nullptr) {
      diagnostics_.add(match->at, "[[match]] needs a reference to compare with",
                       "add reference = { set = { \"closure.S.model\" = \"cut\" } }");
    }
    if (const Tree* search = study_.find("search")) read_search(*search);
    if (const Tree* run = study_.find("run")) read_run(*run);
    const Tree* design = study_.find("design");
    if (design != nullptr && word_of(*design, "type") == "list") input_.design = DesignType::list;
  }

 private:
  template <class Action>
  void for_each(const char* list, Action action) {
    const Tree* records = study_.find(list);
    if (records == nullptr || !records->is(Kind::array)) return;
    for (const Tree& record : records->items) {
      if (record.is(Kind::table)) action(record);
    }
  }

  std::optional<TimeWindow> read_window(const Tree& tree) {
    const Tree* value = tree.find("window");
    if (value == nullptr || !value->is(Kind::array)) return std::nullopt;
    const TimeWindow window{value->items[0].as_number(), value->items[1].as_number(), value->at};
    if (window.first < window.last) return window;
    diagnostics_.add(value->at,
                     fmt::format("window must end after it begins, got {}", shown(*value)),
                     "window = [first, last] in s");
    return std::nullopt;
  }

  MatchInput read_match(const Tree& tree) {
    MatchInput match;
    match.signal = word_of(tree, "signal");
    match.at = place_of(tree, "signal");
    match.reference_signal = match.signal;
    match.reference_at = match.at;
    if (const Tree* other = tree.find("reference_signal"); other != nullptr && other->is_valid()) {
      const bool is_turned = other->text.starts_with('-');
      match.reference_sign = is_turned ? -1.0 : 1.0;
      match.reference_signal = other->text.substr(is_turned ? 1 : 0);
      match.reference_at = other->at;
      if (match.reference_signal.empty()) {
        diagnostics_.add(other->at, "reference_signal must name a channel, got '-'",
                         "write the channel after the sign");
      }
    }
    if (word_of(tree, "norm") == "rms") match.norm = ErrorNorm::rms;
    if (word_of(tree, "scale") == "vector") match.scale = ErrorScale::vector;
    match.tolerance = number_of(tree, "tolerance", 0.0);
    match.window = read_window(tree);
    match.floor = number_of(tree, "floor", match.floor);
    return match;
  }

  ResponseInput read_response(const Tree& tree) {
    ResponseInput response;
    response.name = word_of(tree, "name");
    response.signal = word_of(tree, "signal");
    response.at = place_of(tree, "signal");
    response.name_at = place_of(tree, "name");
    const std::vector<std::string> words = {"max", "min", "max_abs", "rms", "mean", "last"};
    const std::optional<std::size_t> index = word_index(words, word_of(tree, "reduce"));
    if (index) response.reduce = static_cast<Reduction>(*index);
    response.window = read_window(tree);
    return response;
  }

  void read_trace(const Tree& tree) {
    const Tree* signals = tree.find("signals");
    if (signals == nullptr || !signals->is(Kind::array)) return;
    if (signals->items.empty()) {
      diagnostics_.add(signals->at, "signals must not be empty, got []", "name a channel");
    }
    for (const Tree& signal : signals->items) input_.trace.push_back({signal.text, signal.at});
  }

  void require_unique(const char* list) {
    const Tree* records = study_.find(list);
    if (records == nullptr || !records->is(Kind::array)) return;
    for (std::size_t i = 0; i < records->items.size(); ++i) {
      const Tree* name = records->items[i].find("name");
      if (name == nullptr || !name->is(Kind::text)) continue;
      for (std::size_t k = 0; k < i; ++k) {
        if (word_of(records->items[k], "name") != name->text) continue;
        diagnostics_.add(name->at, fmt::format("{}: the name '{}' is used twice", list, name->text),
                         fmt::format("give every {} its own name", list));
        break;
      }
    }
  }

  void read_search(const Tree& tree) {
    SearchOptions& search = input_.search;
    search.scan = static_cast<int>(integer_of(tree, "scan", search.scan));
    search.batch = static_cast<int>(integer_of(tree, "batch", search.batch));
    search.resolution = number_of(tree, "resolution", search.resolution);
    search.max_evaluations =
        static_cast<int>(integer_of(tree, "max_evaluations", search.max_evaluations));
    search.delta = number_of(tree, "delta", search.delta);
  }

  void read_run(const Tree& tree) {
    RunOptions& run = input_.run;
    run.seed = static_cast<std::uint64_t>(integer_of(tree, "seed", 1));
    if (word_of(tree, "on_failure") == "abort") run.on_failure = FailurePolicy::abort;
    const Tree* timeout = tree.find("timeout");
    if (timeout != nullptr && timeout->is_numeric()) run.timeout = timeout->as_number();
    const Tree* limit = tree.find("max_failures");
    if (limit != nullptr && limit->is_valid()) run.max_failures = read_limit(*limit);
  }

  std::optional<FailureLimit> read_limit(const Tree& value) {
    const std::optional<WrittenQuantity> quantity =
        value.is(Kind::text) ? split_quantity(value.text) : std::nullopt;
    const bool is_percent = quantity && quantity->unit == "%";
    const double number = is_percent ? quantity->value : value.as_number();
    const bool is_count = value.is_numeric() && number >= 0.0 && number == std::floor(number);
    if (is_count || (is_percent && number >= 0.0 && number <= 100.0)) {
      return FailureLimit{number, is_percent};
    }
    diagnostics_.add(
        value.at, fmt::format("run.max_failures must be a count or a share, got {}", shown(value)),
        "for example 10, or \"5 %\"");
    return std::nullopt;
  }

  const Tree& study_;
  StudyInput& input_;
  Diagnostics& diagnostics_;
};

}  // namespace

void read_records(const Tree& study, StudyInput& input, Diagnostics& diagnostics) {
  RecordReader(study, input, diagnostics).read();
}

}  // namespace linkstudy
