#include "study/tune/write_tuning.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "study/record/json_number.h"

namespace linkstudy::tuning {
namespace {

using Json = nlohmann::ordered_json;

void add_line(std::string& text, const std::string& key, const std::string& value) {
  text += fmt::format("{:<12}{}\n", key, value);
}

void add_point(std::string& text, const TuningResult& result) {
  for (std::size_t i = 0; i < result.point.size(); ++i) {
    const TunedVariable& variable = result.problem.variables[i];
    add_line(
        text, i == 0 ? "point" : "",
        fmt::format("{} = {:.6g} {}", variable.path, result.point[i], variable.unit) +
            (variable.is_logarithmic ? fmt::format(" (log10 {:.4f})", std::log10(result.point[i]))
                                     : ""));
  }
}

// Without the load case: "closure.S.sde.damping" of "fast_closure.S.sde.damping".
std::string own_name(const Trace& derived) {
  const std::size_t at = derived.name.find("closure.");
  return at == std::string::npos ? derived.name : derived.name.substr(at);
}

void add_damping(std::string& text, const TuningResult& result) {
  std::string key = "damping";
  if (result.point.empty()) return;
  std::set<std::string> said;  // load cases mostly agree
  for (const Trace& derived : result.answer.derived) {
    const std::string value = fmt::format("{} = {:.6g}", own_name(derived), derived.values.front());
    if (!said.insert(value).second) continue;
    add_line(text, key, derived.unit.empty() ? value : value + " " + derived.unit);
    key.clear();
  }
}

std::string format_margin(const TunedVariable& variable, const Window& window) {
  return variable.is_logarithmic ? fmt::format("{:.2f} decades", window.margin)
                                 : fmt::format("{:.3g} % of the range", 100.0 * window.margin);
}

std::string format_window(const TunedVariable& variable, const Window& window) {
  return fmt::format("{:.6g} .. {:.6g} {}, {}, above limited by {}", window.low, window.high,
                     variable.unit, format_margin(variable, window),
                     name_of(window.high_limited_by));
}

void add_window(std::string& text, const TuningResult& result) {
  for (std::size_t i = 0; i < result.windows.size(); ++i) {
    const TunedVariable& variable = result.problem.variables[i];
    add_line(text, i == 0 ? "window" : "",
             variable.path + ": " + format_window(variable, result.windows[i]));
  }
  if (!result.windows.empty()) return;
  if (!result.window) {
    add_line(text, "window", "empty");
    return;
  }
  add_line(text, "window", format_window(variable_of(result), *result.window));
}

std::string describe_binding(const TuningResult& result) {
  const MatchComponent& component = result.problem.components[result.binding];
  const double error = result.answer.errors[result.binding];
  if (component.bound.empty()) {
    return fmt::format("{}: error {:.4g} of {:.4g}", component.name, error, component.tolerance);
  }
  return fmt::format("{}: {}, reached to {:.4g} of 1", component.name, component.bound, error);
}

std::string describe_reach(const StepReach& reach) {
  if (reach.fails_at <= 0.0) {
    return fmt::format("matches up to {:.4g} s, the largest tried", reach.step);
  }
  const std::string why = reach.cause == Cause::ok ? fmt::format("{:.5g} of tolerance", reach.ratio)
                                                   : std::string(linkstudy::name_of(reach.cause));
  return fmt::format("matches up to {:.4g} s; {:.4g} s: {} (evaluation {})", reach.step,
                     reach.fails_at, why, reach.evaluation);
}

void add_answer(std::string& text, const TuningResult& result) {
  const Answer& answer = result.answer;
  if (answer.errors.empty()) return;
  std::string binding = describe_binding(result);
  if (result.point.empty() && result.problem.variables.size() == 1) {
    binding += fmt::format(" at {:.6g} {} (evaluation {})", result.answer_value,
                           variable_of(result).unit, answer.id);
  }
  add_line(text, "binding", binding);
  add_line(text, "step",
           fmt::format("{:.4g} s, limit {:.4g} s, h omega_max {:.3g}", answer.step,
                       answer.step_limit, answer.h_omega));
  if (result.step_reach) add_line(text, "", describe_reach(*result.step_reach));
}

void add_first_failure(std::string& text, const TuningResult& result) {
  if (!result.first_failure) return;
  const Answer& answer = result.first_failure->answer;
  const std::string said = answer.message.empty() ? "" : ": " + answer.message;
  add_line(text, "first end",
           fmt::format("evaluation {} at {:.6g} {}: {}{}", answer.id,
                       fmt::join(result.first_failure->request.x, ", "), variable_of(result).unit,
                       linkstudy::name_of(answer.status), said));
}

// By name, in the units of the model: {"closure.S.sde.damping": {"value", "unit"}}.
Json make_derived(const TuningResult& result) {
  Json derived = Json::object();
  if (result.point.empty()) return derived;
  for (const Trace& one : result.answer.derived) {
    derived[one.name] = {{"value", json_number(one.values.front())}, {"unit", one.unit}};
  }
  return derived;
}

Json make_first_failure(const TuningResult& result) {
  if (!result.first_failure) return nullptr;
  const Answer& answer = result.first_failure->answer;
  return {{"evaluation", answer.id},
          {"value", result.first_failure->request.x.front()},
          {"cause", linkstudy::name_of(answer.status)},
          {"message", answer.message}};
}

Json make_binding(const TuningResult& result) {
  if (result.answer.errors.empty()) return nullptr;
  const MatchComponent& component = result.problem.components[result.binding];
  const Json bound = component.bound.empty() ? Json(nullptr) : Json(component.bound);
  return {{"component", component.name},
          {"bound", bound},
          {"value", result.answer_value},
          {"evaluation", result.answer.id},
          {"error", json_number(result.answer.errors[result.binding])},
          {"tolerance", component.tolerance}};
}

std::string describe_nlopt(const TuningResult& result) {
  const NloptReport& nlopt = result.nlopt;
  if (!nlopt.ran) return nlopt.ended;
  if (!result.windows.empty()) {
    return fmt::format("{}: {} evaluations ({})", nlopt.algorithm, nlopt.evaluations, nlopt.ended);
  }
  const std::string found = nlopt.found_lower ? fmt::format("a match at {:.6g}", nlopt.lowest)
                                              : std::string("nothing lower");
  return fmt::format("{}: {} in {} evaluations ({})", nlopt.algorithm, found, nlopt.evaluations,
                     nlopt.ended);
}

void add_certificate(std::string& text, const TuningResult& result) {
  if (!result.certificate) return;
  for (const Claim& claim : result.certificate->claims) {
    const bool few = !claim.evaluations.empty() && claim.evaluations.size() <= 4;
    const std::string ids =
        few ? fmt::format(" [{}]", fmt::join(claim.evaluations, ", ")) : std::string();
    add_line(
        text, claim.name,
        fmt::format("{:<13}{}: {}{}", name_of(claim.verdict), claim.statement, claim.reason, ids));
  }
}

// Minimal points that match: nothing found that matches is nowhere above one of them.
void add_staircase(std::string& text, const TuningResult& result) {
  constexpr std::size_t kShown = 5;
  const std::size_t count = std::min(kShown, result.staircase.size());
  for (std::size_t i = 0; i < count; ++i) {
    const Observation& one = result.staircase[i];
    add_line(
        text, i == 0 ? "minimal" : "",
        fmt::format("{:.6g}: sum of log10 {:.4f} (evaluation {})", fmt::join(one.request.x, ", "),
                    compute_objective(one.request.x), one.answer.id));
  }
}

void add_points(std::string& text, const TuningResult& result) {
  const std::size_t width = 14 * result.problem.variables.size();
  const char* head = result.problem.variables.size() == 1 ? "value" : "values";
  text += fmt::format("\n{:>{}}  {:>15}  {:<16}{:>10}\n", head, width, "error/tolerance", "side",
                      "evaluation");
  for (const ScanPoint& point : result.points) {
    if (!point.declared) continue;
    const bool ended = point.cause != Cause::ok;
    const std::string side = point.side == Side::failed && ended
                                 ? std::string(linkstudy::name_of(point.cause))
                                 : std::string(name_of(point.side));
    const std::string value = point.x.empty() ? fmt::format("{:>14.6g}", point.value)
                                              : fmt::format("{:>14.6g}", fmt::join(point.x, ""));
    text += fmt::format("{:>{}}  {:>15.4g}  {:<16}{:>10}\n", value, width, point.ratio, side,
                        point.evaluation);
  }
}

Json describe_window(const TunedVariable& variable, const Window& window) {
  return {{"low", window.low},
          {"high", window.high},
          {"margin_decades", json_number(decades_of(variable, window))},
          {"high_limited_by", name_of(window.high_limited_by)}};
}

Json make_window(const TuningResult& result) {
  const bool has_one = result.window && result.windows.empty();
  return has_one ? describe_window(variable_of(result), *result.window) : Json(nullptr);
}

Json make_largest_step(const TuningResult& result) {
  if (result.point.empty()) return nullptr;
  Json largest = {{"by_stability", json_number(result.answer.step_limit)}};
  if (!result.step_reach) return largest;
  const StepReach& reach = *result.step_reach;
  largest["by_accuracy"] = reach.step;
  largest["fails_at"] = reach.fails_at > 0.0 ? Json(reach.fails_at) : Json(nullptr);
  largest["ratio_there"] = reach.fails_at > 0.0 ? json_number(reach.ratio) : Json(nullptr);
  return largest;
}

// By path; of no point: {}.
Json parameters_at(const TuningResult& result, const std::vector<double>& x) {
  Json parameters = Json::object();
  for (std::size_t i = 0; i < x.size(); ++i) parameters[result.problem.variables[i].path] = x[i];
  return parameters;
}

// What only several variables have.
void add_box_keys(Json& json, const TuningResult& result) {
  if (result.problem.variables.size() == 1) return;
  Json windows = Json::object();
  for (std::size_t i = 0; i < result.windows.size(); ++i) {
    const TunedVariable& variable = result.problem.variables[i];
    windows[variable.path] = describe_window(variable, result.windows[i]);
  }
  Json staircase = Json::array();
  for (const Observation& one : result.staircase) {
    Json step = {{"evaluation", one.answer.id},
                 {"objective", compute_objective(one.request.x)},
                 {"parameters", parameters_at(result, one.request.x)}};
    staircase.push_back(std::move(step));
  }
  json["windows"] = std::move(windows);
  json["staircase"] = std::move(staircase);
}

Json make_claims(const TuningResult& result) {
  if (!result.certificate) return nullptr;
  Json claims = Json::object();
  for (const Claim& claim : result.certificate->claims) {
    claims[claim.name] = {{"verdict", name_of(claim.verdict)},
                          {"statement", claim.statement},
                          {"reason", claim.reason},
                          {"evaluations", claim.evaluations}};
  }
  return claims;
}

Json make_suggestion(const TuningResult& result) {
  if (!result.suggestion) return nullptr;
  const StepSuggestion& suggestion = *result.suggestion;
  return {{"step", suggestion.step > 0.0 ? Json(suggestion.step) : Json(nullptr)},
          {"value", suggestion.step > 0.0 ? Json(suggestion.value) : Json(nullptr)},
          {"message", suggestion.message}};
}

Json make_json(const TuningResult& result) {
  Json errors = Json::object();
  for (std::size_t i = 0;
       i < std::min(result.answer.errors.size(), result.problem.components.size()); ++i) {
    errors[result.problem.components[i].name] = json_number(result.answer.errors[i]);
  }
  Json json = {
      {"status", name_of(result.status)},
      {"reason", result.reason},
      {"parameters", parameters_at(result, result.point)},
      {"derived", make_derived(result)},
      {"objective", result.point.empty() ? Json(nullptr) : json_number(shown_objective(result))},
      {"error", errors},
      {"binding", make_binding(result)},
      {"first_failure", make_first_failure(result)},
      {"window", make_window(result)},
      {"certificate", make_claims(result)},
      {"suggestion", make_suggestion(result)},
      {"largest_step", make_largest_step(result)},
      {"notes", result.notes},
      {"evaluations", result.observations.size()},
      {"rounds", result.rounds}};
  add_box_keys(json, result);
  return json;
}

std::size_t count_own(const std::vector<TuningResult>& results) {
  std::set<std::uint64_t> ids;  // several may have asked for one evaluation
  for (const TuningResult& one : results) {
    for (const Observation& seen : one.observations) ids.insert(seen.answer.id);
  }
  return ids.size();
}

std::size_t count_rounds(const std::vector<TuningResult>& results) {
  std::size_t count = 0;  // side by side
  for (const TuningResult& one : results) count = std::max(count, one.rounds);
  return count;
}

// Of several steps: for every tolerance the answer at the largest step that has one.
std::vector<const TuningResult*> find_cheapest(const std::vector<TuningResult>& results) {
  std::map<double, const TuningResult*> best;
  std::set<double> steps;
  for (const TuningResult& one : results) {
    steps.insert(step_of(one));
    if (one.point.empty()) continue;
    const TuningResult*& known = best[tolerance_of(one)];
    if (known == nullptr || step_of(one) > step_of(*known)) known = &one;
  }
  std::vector<const TuningResult*> cheapest;
  for (const auto& [tolerance, one] : best) cheapest.push_back(one);
  return steps.size() > 1 ? cheapest : std::vector<const TuningResult*>();
}

std::string describe_best(const TuningResult& result) {
  if (result.point.empty()) return "-";
  std::string text = fmt::format("{:.6g}", fmt::join(result.point, ", "));
  return result.problem.variables.size() == 1 ? text + " " + variable_of(result).unit : text;
}

std::string describe_span(const TuningResult& result) {
  if (!result.window || !variable_of(result).is_logarithmic) return "-";
  return fmt::format("{:.2f}", result.window->margin);
}

}  // namespace

std::string write_text(const TuningResult& result) {
  std::string text;
  add_line(
      text, "status",
      std::string(name_of(result.status)) + (result.reason.empty() ? "" : ": " + result.reason));
  add_point(text, result);
  add_damping(text, result);
  add_window(text, result);
  add_answer(text, result);
  add_first_failure(text, result);
  if (result.window) add_line(text, "NLopt", describe_nlopt(result));
  add_certificate(text, result);
  add_staircase(text, result);
  for (const std::string& note : result.notes) add_line(text, "note", note);
  add_line(text, "cost",
           fmt::format("{} evaluations in {} rounds", result.observations.size(), result.rounds));
  add_points(text, result);
  return text;
}

std::string write_json(const TuningResult& result, const std::string& digest) {
  Json json = make_json(result);
  json["digest"] = digest;
  return json.dump();
}

std::string write_json(const std::vector<TuningResult>& results, const std::string& digest) {
  if (results.size() == 1) return write_json(results.front(), digest);
  Json answers = Json::array();
  for (const TuningResult& one : results) {
    Json answer = {{"tolerance", tolerance_of(one)}, {"step", json_number(step_of(one))}};
    answer.update(make_json(one));
    answers.push_back(std::move(answer));
  }
  Json cheapest = Json::array();
  for (const TuningResult* one : find_cheapest(results)) {
    cheapest.push_back({{"tolerance", tolerance_of(*one)},
                        {"step", step_of(*one)},
                        {"parameters", parameters_at(*one, one->point)}});
  }
  const Json json = {{"status", name_of(worst_of(results))}, {"answers", std::move(answers)},
                     {"cheapest", std::move(cheapest)},      {"evaluations", count_own(results)},
                     {"rounds", count_rounds(results)},      {"digest", digest}};
  return json.dump();
}

std::string write_text(const std::vector<TuningResult>& results) {
  if (results.size() == 1) return write_text(results.front());
  std::size_t width = 5;
  for (const TuningResult& one : results) width = std::max(width, describe_best(one).size());
  std::string text = fmt::format("{:>9}  {:>9}  {:>{}}  {:>7}  {:<12}  {}\n", "tolerance",
                                 "step, s", "value", width, "decades", "verdict", "binding");
  for (const TuningResult& one : results) {
    text += fmt::format("{:>9.4g}  {:>9.4g}  {:>{}}  {:>7}  {:<12}  {}\n", tolerance_of(one),
                        step_of(one), describe_best(one), width, describe_span(one),
                        name_of(one.status), one.answer.errors.empty() ? "-" : binding_name(one));
  }
  text += "\n";
  for (const TuningResult& one : results) {
    if (one.reason.empty()) continue;
    text += fmt::format("tolerance {:.4g}, step {:.4g} s: {}\n", tolerance_of(one), step_of(one),
                        one.reason);
  }
  for (const TuningResult* one : find_cheapest(results)) {
    text += fmt::format(
        "tolerance {:.4g}: the largest of these steps that matches is {:.4g} s, at {}\n",
        tolerance_of(*one), step_of(*one), describe_best(*one));
  }
  add_line(text, "cost",
           fmt::format("{} evaluations in {} rounds", count_own(results), count_rounds(results)));
  return text;
}

std::string write_verdict(const std::vector<TuningResult>& results) {
  const std::string status(name_of(worst_of(results)));
  if (results.size() > 1) return fmt::format("{}, {} answers", status, results.size());
  if (results.front().point.empty()) return status;
  return fmt::format("{}: {}", status, describe_best(results.front()));
}

}  // namespace linkstudy::tuning
