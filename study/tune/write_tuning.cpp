#include "study/tune/write_tuning.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace linkstudy::tuning {
namespace {

using Json = nlohmann::ordered_json;

void add_line(std::string& text, const std::string& key, const std::string& value) {
  text += fmt::format("{:<12}{}\n", key, value);
}

Json make_number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

const TunedVariable& variable_of(const TuningResult& result) {
  return result.problem.variables.front();
}

void add_point(std::string& text, const TuningResult& result) {
  for (std::size_t i = 0; i < result.point.size(); ++i) {
    const TunedVariable& variable = result.problem.variables[i];
    add_line(text, i == 0 ? "point" : "",
             fmt::format("{} = {:.6g} {} (log10 {:.4f})", variable.path, result.point[i],
                         variable.unit, std::log10(result.point[i])));
  }
}

void add_damping(std::string& text, const TuningResult& result) {
  std::string key = "damping";
  if (result.point.empty()) return;
  for (const Trace& derived : result.answer.derived) {
    const std::string value = fmt::format("{} = {:.6g}", derived.name, derived.values.front());
    add_line(text, key, derived.unit.empty() ? value : value + " " + derived.unit);
    key.clear();
  }
}

void add_window(std::string& text, const TuningResult& result) {
  if (!result.window) {
    add_line(text, "window", "empty");
    return;
  }
  const Window& window = *result.window;
  add_line(text, "window",
           fmt::format("{:.6g} .. {:.6g} {}, {:.2f} decades, above limited by {}", window.low,
                       window.high, variable_of(result).unit, window.margin_decades,
                       name_of(window.high_limited_by)));
}

void add_answer(std::string& text, const TuningResult& result) {
  const Answer& answer = result.answer;
  if (answer.errors.empty()) {
    return;
  }
  const MatchComponent& component = result.problem.components[result.binding];
  std::string binding = fmt::format("{}: error {:.4g} of {:.4g}", component.name,
                                    answer.errors[result.binding], component.tolerance);
  if (result.point.empty()) {
    binding += fmt::format(" at {:.6g} {} (evaluation {})", result.answer_value,
                           variable_of(result).unit, answer.id);
  }
  add_line(text, "binding", binding);
  add_line(text, "step",
           fmt::format("{:.4g} s, limit {:.4g} s, h omega_max {:.3g}", answer.step,
                       answer.step_limit, answer.h_omega));
}

void add_first_failure(std::string& text, const TuningResult& result) {
  if (!result.first_failure) {
    return;
  }
  const Answer& answer = result.first_failure->answer;
  const std::string said = answer.message.empty() ? "" : ": " + answer.message;
  add_line(text, "first end",
           fmt::format("evaluation {} at {:.6g} {}: {}{}", answer.id,
                       result.first_failure->request.x.front(), variable_of(result).unit,
                       linkstudy::name_of(answer.status), said));
}

// By name, in the units of the model: {"closure.S.sde.damping": {"value", "unit"}}.
Json make_derived(const TuningResult& result) {
  Json derived = Json::object();
  if (result.point.empty()) return derived;
  for (const Trace& one : result.answer.derived) {
    derived[one.name] = {{"value", make_number(one.values.front())}, {"unit", one.unit}};
  }
  return derived;
}

Json make_first_failure(const TuningResult& result) {
  if (!result.first_failure) {
    return nullptr;
  }
  const Answer& answer = result.first_failure->answer;
  return {{"evaluation", answer.id},
          {"value", result.first_failure->request.x.front()},
          {"cause", linkstudy::name_of(answer.status)},
          {"message", answer.message}};
}

Json make_binding(const TuningResult& result) {
  if (result.answer.errors.empty()) {
    return nullptr;
  }
  const MatchComponent& component = result.problem.components[result.binding];
  return {{"component", component.name},
          {"value", result.answer_value},
          {"evaluation", result.answer.id},
          {"error", make_number(result.answer.errors[result.binding])},
          {"tolerance", component.tolerance}};
}

std::string describe_nlopt(const NloptReport& nlopt) {
  if (!nlopt.ran) {
    return nlopt.ended;
  }
  const std::string found = nlopt.found_lower ? fmt::format("a match at {:.6g}", nlopt.lowest)
                                              : std::string("nothing lower");
  return fmt::format("{}: {} in {} evaluations ({})", nlopt.algorithm, found, nlopt.evaluations,
                     nlopt.ended);
}

void add_certificate(std::string& text, const TuningResult& result) {
  if (!result.certificate) {
    return;
  }
  for (const Claim& claim : result.certificate->claims) {
    const bool few = !claim.evaluations.empty() && claim.evaluations.size() <= 4;
    const std::string ids =
        few ? fmt::format(" [{}]", fmt::join(claim.evaluations, ", ")) : std::string();
    add_line(
        text, claim.name,
        fmt::format("{:<13}{}: {}{}", name_of(claim.verdict), claim.statement, claim.reason, ids));
  }
}

void add_points(std::string& text, const TuningResult& result) {
  text += fmt::format("\n{:>14}  {:>15}  {:<16}{:>10}\n", "value", "error/tolerance", "side",
                      "evaluation");
  for (const ScanPoint& point : result.points) {
    if (!point.declared) {
      continue;
    }
    const bool ended = point.cause != Cause::ok;
    const std::string side = point.side == Side::failed && ended
                                 ? std::string(linkstudy::name_of(point.cause))
                                 : std::string(name_of(point.side));
    text += fmt::format("{:>14.6g}  {:>15.4g}  {:<16}{:>10}\n", point.value, point.ratio, side,
                        point.evaluation);
  }
}

Json make_window(const TuningResult& result) {
  if (!result.window) {
    return nullptr;
  }
  const Window& window = *result.window;
  return {{"low", window.low},
          {"high", window.high},
          {"margin_decades", window.margin_decades},
          {"high_limited_by", name_of(window.high_limited_by)}};
}

Json make_claims(const TuningResult& result) {
  if (!result.certificate) {
    return nullptr;
  }
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
  if (!result.suggestion) {
    return nullptr;
  }
  const StepSuggestion& suggestion = *result.suggestion;
  return {{"step", suggestion.step > 0.0 ? Json(suggestion.step) : Json(nullptr)},
          {"value", suggestion.step > 0.0 ? Json(suggestion.value) : Json(nullptr)},
          {"message", suggestion.message}};
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
  if (result.window) {
    add_line(text, "NLopt", describe_nlopt(result.nlopt));
  }
  add_certificate(text, result);
  for (const std::string& note : result.notes) {
    add_line(text, "note", note);
  }
  add_line(text, "cost",
           fmt::format("{} evaluations in {} rounds", result.observations.size(), result.rounds));
  add_points(text, result);
  return text;
}

std::string write_json(const TuningResult& result, const std::string& digest) {
  Json parameters = Json::object();
  for (std::size_t i = 0; i < result.point.size(); ++i) {
    parameters[result.problem.variables[i].path] = result.point[i];
  }
  Json errors = Json::object();
  for (std::size_t i = 0;
       i < std::min(result.answer.errors.size(), result.problem.components.size()); ++i) {
    errors[result.problem.components[i].name] = make_number(result.answer.errors[i]);
  }
  Json json = {{"status", name_of(result.status)},
               {"reason", result.reason},
               {"parameters", parameters},
               {"derived", make_derived(result)},
               {"objective", result.point.empty() ? Json(nullptr) : Json(result.objective)},
               {"error", errors},
               {"binding", make_binding(result)},
               {"first_failure", make_first_failure(result)},
               {"window", make_window(result)},
               {"certificate", make_claims(result)},
               {"suggestion", make_suggestion(result)},
               {"notes", result.notes},
               {"evaluations", result.observations.size()},
               {"rounds", result.rounds},
               {"digest", digest}};
  return json.dump();
}

}  // namespace linkstudy::tuning
