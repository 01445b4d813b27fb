#include "study/evaluate/case_key.h"

#include <fmt/format.h>

#include <algorithm>

#include "study/config/precedence.h"
#include "study/config/tree_content.h"
#include "study/metrics/invalid_point.h"
#include "study/record/sha256.h"

namespace linkstudy {

void visit_members(auto& archive, Like<RunCaps> auto& caps) {
  archive(caps.steps, caps.drift);
}

namespace {

// Keys of a study that say which cases are run, or judge their results: what they mean for one
// evaluation is in its resolved model. Keys that are not here count.
constexpr const char* kOfOthers[] = {
    "kind",   "name",  "model",  "base",      "design",       "run", "vary",
    "refine", "tune",  "search", "objective", "limit",        "fit", "parameter",
    "series", "trace", "format", "rounding",  "wanted_error",
};

void erase_all(Tree& table, std::initializer_list<const char*> keys) {
  for (const char* key : keys) table.erase(key);
}

// Models and data stand in the key themselves.
void erase_sources(Tree& table) {
  erase_all(table, {"set", "model", "file", "results"});
}

void erase_sources_in(Tree& study, const char* list) {
  Tree* entries = study.find(list);
  if (entries == nullptr) return;
  for (Tree& entry : entries->items) {
    erase_sources(entry);
    if (Tree* reference = entry.find("reference")) erase_sources(*reference);
  }
}

// The text of what a load case is compared with, where that is data.
std::string data_of(const StudyInput& input, const LoadCaseInput& load_case) {
  const MeasuredInput* reference = reference_data_of(input, load_case);
  std::string text;
  if (reference != nullptr && reference->data) text += reference->data->text;
  text += '\0';
  if (load_case.measured && load_case.measured->data) text += load_case.measured->data->text;
  return text;
}

Tree signals_of(const std::vector<TraceInput>& traces) {
  Tree signals = Tree::make_array();
  for (const TraceInput& one : traces) signals.items.push_back(Tree::make_text(one.signal));
  return signals;
}

// Histories of a refinement are among the traces; both norms of every match are kept.
Tree find_kept(const Evaluator& evaluator) {
  const StudyInput& input = evaluator.input();
  Tree kept = input.resolved;
  for (const char* key : kOfOthers) kept.erase(key);
  erase_sources_in(kept, "load_case");
  erase_sources_in(kept, "experiment");
  if (Tree* reference = kept.find("reference")) erase_sources(*reference);
  if (Tree* matches = kept.find("match")) {
    for (Tree& match : matches->items) erase_all(match, {"tolerance", "norm"});
  }
  kept.set("histories", signals_of(input.trace));
  return kept;
}

// Constant steps are as many as the grid has.
RunCaps caps_of(const SimulationOptions& options) {
  const bool counts_steps = options.integrator != Integrator::rk4;
  return {counts_steps ? static_cast<double>(options.step_limit) : 0.0, options.drift_limit};
}

// Where the reference of a load case stands among all.
std::string reference_name(const std::string& load_case) {
  return load_case.empty() ? "reference" : load_case;
}

// What the name and the kinematics of a model say changes no run.
Tree counted_part(Tree model) {
  erase_all(model, {"name", "kinematics"});
  if (Tree* simulation = model.find("simulation")) {
    erase_all(*simulation, {"step_limit", "drift_limit"});
  }
  return model;
}

// Values of a point that are none of the model's: shifts of measured data.
void put_offsets(ByteWriter& out, const std::vector<Parameter>& parameters,
                 const std::vector<Value>& values) {
  for (std::size_t i = 0; i < parameters.size() && i < values.size(); ++i) {
    if (is_measured_offset(parameters[i].path)) out(parameters[i].path, values[i]);
  }
}

}  // namespace

std::string CaseKey::with_caps() const {
  ByteWriter out;
  out(std::string_view("linkstudy case with caps 1"), digest, caps);
  return sha256(out.bytes());
}

CapChange compare_caps(const CaseKey& before, const CaseKey& now) {
  if (before.caps.size() != now.caps.size()) return CapChange::narrower;
  CapChange change = CapChange::none;
  for (std::size_t i = 0; i < now.caps.size(); ++i) {
    const RunCaps& a = before.caps[i];
    const RunCaps& b = now.caps[i];
    if (b.steps < a.steps || b.drift < a.drift) return CapChange::narrower;
    if (a != b) change = CapChange::wider;
  }
  return change;
}

bool is_ended_by_caps(Cause cause, const CaseKey& before, const CaseKey& now) {
  const auto differs = [&](double RunCaps::*cap) {
    return !std::ranges::equal(before.caps, now.caps, {}, cap, cap);
  };
  return (cause == Cause::step_budget && differs(&RunCaps::steps)) ||
         (cause == Cause::constraint_drift && differs(&RunCaps::drift));
}

CaseKeys::CaseKeys(const Evaluator& evaluator)
    : evaluator_(evaluator), kept_(find_kept(evaluator)), references_(Tree::make_table()) {
  const StudyInput& input = evaluator.input();
  const std::vector<LoadCaseInput> load_cases = load_cases_of(input);
  ByteWriter out;
  out(std::string_view("linkstudy case 1"));
  put_content(out, kept_);
  for (const Response& column : evaluator.responses()) out(column.name);
  for (std::size_t i = 0; i < load_cases.size(); ++i) {
    const std::optional<ModelInput> model = evaluator.reference_model_at(i);
    reference_caps_.push_back(model ? std::optional(caps_of(model->options)) : std::nullopt);
    const std::string name = reference_name(load_cases[i].name);
    if (model) references_.set(name, counted_part(model->resolved));
    out(data_of(input, load_cases[i]));
  }
  put_content(out, references_);
  common_ = sha256(out.bytes());
}

std::optional<CaseKey> CaseKeys::of(const std::vector<Value>& values) const {
  CaseKey key;
  ByteWriter out;
  out(common_);
  put_offsets(out, evaluator_.parameters(), values);
  try {
    for (std::size_t i = 0; i < evaluator_.load_case_count(); ++i) {
      const ModelInput model = evaluator_.model_at(i, values);
      put_content(out, counted_part(model.resolved));
      key.caps.push_back(caps_of(model.options));
      if (reference_caps_[i]) key.caps.push_back(*reference_caps_[i]);
    }
  } catch (const InvalidPoint&) {
    return std::nullopt;
  }
  key.digest = sha256(out.bytes());
  return key;
}

// What is kept of all load cases tells more than the one needs, and never less.
CaseKey CaseKeys::of_reference(std::size_t load_case) const {
  const std::string& name = evaluator_.load_case_name(load_case);
  ByteWriter out;
  out(std::string_view("linkstudy reference 1"));
  put_content(out, kept_);
  out(name);
  put_content(out, *references_.find(reference_name(name)));
  return {sha256(out.bytes()), {*reference_caps_.at(load_case)}};
}

}  // namespace linkstudy
