#include "study/cli/input.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "study/config/input_error.h"
#include "study/config/toml_writer.h"
#include "study/config/unit.h"
#include "study/report/choose_table.h"
#include "study/report/console.h"
#include "study/session/earlier_run.h"
#include "study/session/single_run.h"
#include "study/store/results_file.h"

namespace linkstudy {
namespace {

std::vector<Override> parse_sets(const std::vector<std::string>& texts, Diagnostics& diagnostics) {
  std::vector<Override> set;
  for (const std::string& text : texts) {
    if (const std::optional<Override> one = parse_set(text, diagnostics)) set.push_back(*one);
  }
  return set;
}

FailureLimit parse_limit(const std::string& text) {
  const std::optional<WrittenQuantity> quantity = split_quantity(text);
  const bool is_percent = quantity && quantity->unit == "%";
  const bool is_right =
      quantity && quantity->value >= 0.0 &&
      (is_percent ? quantity->value <= 100.0
                  : quantity->unit.empty() && quantity->value == std::floor(quantity->value));
  if (!is_right) {
    throw UsageError(
        fmt::format("--max-failures must be a count or a share such as 5%, got '{}'", text));
  }
  return {quantity->value, is_percent};
}

void apply_run_options(const CommandLine& line, RunOptions& run) {
  if (line.timeout_s) run.timeout = line.timeout_s;
  if (line.max_failures) run.max_failures = parse_limit(*line.max_failures);
  if (line.on_failure) {
    run.on_failure = *line.on_failure == "abort" ? FailurePolicy::abort : FailurePolicy::record;
  }
}

// "closure.S" of "closure.S.force.x", "energy" of "energy.kinetic"; each once.
std::vector<std::string> groups_of(const Series& series) {
  std::vector<std::string> groups;
  for (const Channel& channel : series.channels) {
    if (channel.quantity == Quantity::time) continue;
    const std::size_t owner = channel.name.find('.');
    const bool is_energy = channel.name.starts_with("energy.");
    const std::string group =
        channel.name.substr(0, is_energy ? owner : channel.name.find('.', owner + 1));
    if (std::ranges::find(groups, group) == groups.end()) groups.push_back(group);
  }
  return groups;
}

}  // namespace

ReadModel read_model(const CommandLine& line) {
  Diagnostics diagnostics;
  const std::vector<Override> set = parse_sets(line.set, diagnostics);
  const auto document = ModelDocument::load(line.inputs.front(), diagnostics);
  throw_if_any(diagnostics);
  std::optional<ModelInput> model = read_model_file(*document, set, line.verb, diagnostics);
  throw_if_any(diagnostics);
  print_remarks(diagnostics.sorted_remarks());
  return {*document->edited(set, diagnostics), std::move(*model)};
}

ModelInput read_model_input(const CommandLine& line) {
  return read_model(line).input;
}

StudyResults read_results_input(const CommandLine& line) {
  StudyResults results = read_stored(line.inputs.front());
  warn_of_lost(results.dropped);
  return results;
}

void warn_of_lost(const std::string& dropped) {
  if (!dropped.empty()) print_err(fmt::format("linkstudy: warning: {}\n", dropped));
}

StudyInput read_study_input(const CommandLine& line) {
  Diagnostics diagnostics;
  std::vector<std::string> texts = line.set;
  if (line.seed) texts.push_back(fmt::format("run.seed={}", *line.seed));
  if (line.batch) texts.push_back(fmt::format("search.batch={}", *line.batch));
  const std::vector<Override> set = parse_sets(texts, diagnostics);
  std::optional<StudyInput> input =
      read_study(line.inputs.front(), set, diagnostics, earlier_run_reader());
  throw_if_any(diagnostics);
  apply_run_options(line, input->run);
  return std::move(*input);
}

StudyInput read_model_as_study(const CommandLine& line) {
  const ReadModel model = read_model(line);
  const Series series = choose_series(model.input, line.signals);
  Tree signals = Tree::make_array();
  for (const std::string& one : line.signals ? split_list(*line.signals) : groups_of(series)) {
    signals.items.push_back(Tree::make_text(one));
  }
  Tree trace = Tree::make_table();
  trace.set("signals", std::move(signals));
  Tree study = Tree::make_table();
  study.set("format", Tree::make_integer(1));
  study.set("kind", Tree::make_text(std::string(name_of(FileKind::study))));
  study.set("name", Tree::make_text(model.input.name));
  study.set("model", Tree::make_text(line.inputs.front()));
  study.set("trace", Tree::make_array({std::move(trace)}));
  Diagnostics diagnostics;
  std::optional<StudyInput> input =
      read_study({write_toml(study), write_toml(model.document.tree()), "", {}},
                 line.inputs.front(), diagnostics);
  throw_if_any(diagnostics);
  apply_run_options(line, input->run);
  return std::move(*input);
}

StudyInput read_study_input(const CommandLine& line, FileKind kind) {
  StudyInput input = read_study_input(line);
  if (input.kind == kind) return input;
  Diagnostics diagnostics;
  const std::string_view other = name_of(input.kind);
  diagnostics.add(make_location(input.file), fmt::format("this file has kind = \"{}\"", other),
                  fmt::format("run 'linkstudy {} {}'", other, input.file));
  throw InputError(diagnostics);
}

}  // namespace linkstudy
