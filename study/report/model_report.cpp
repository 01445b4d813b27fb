#include "study/report/model_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/dynamics/static_balance.h"
#include "study/record/json_number.h"
#include "study/report/modes_report.h"

namespace linkstudy {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kStability[] = {"stable", "neutral", "unstable"};

std::string assembly_text(const AssemblyReport& a) {
  std::string text = fmt::format("{}, residual {:.3g}", a.closed ? "closed" : "open", a.residual);
  if (a.displacement > 0.0) {
    text += fmt::format(" (given {:.3g}, moved {:.3g} in {} iterations)", a.residual_given,
                        a.displacement, a.iterations);
  }
  if (a.restarts > 0) text += fmt::format(", restart {}", a.restarts);
  if (a.rows > 0) {
    text += a.branch == 0 ? ", branch not defined" : fmt::format(", branch {:+d}", a.branch);
  }
  return text;
}

std::string mobility_text(const AssemblyReport& a, int velocities) {
  std::string text = fmt::format("{} ({} velocities, {} closure equations of rank {}", a.mobility,
                                 velocities, a.rows, a.rank);
  if (a.rank < a.rows) text += fmt::format(", {} redundant", a.rows - a.rank);
  return text + ")";
}

constexpr const char* kStiffnessUnits[] = {"N/m", "N m/rad", "N m/rad"};

std::string stiffness_unit(const StaticsReport& s) {
  return kStiffnessUnits[static_cast<int>(s.unit)];
}

// What the number is: the least eigenvalue on the free directions, translations in extents.
std::string stiffness_text(const StaticsReport& s) {
  if (s.directions == 0) return "a structure: nothing can move";
  std::string text;
  if (s.neutral > 0) text = fmt::format("no stiffness in {} of {} ", s.neutral, s.directions);
  if (s.neutral > 0) text += s.directions == 1 ? "direction" : "directions";
  if (s.neutral < s.directions) {
    text += fmt::format("{}smallest stiffness {:.4g} {}", s.neutral > 0 ? ", beside them " : "",
                        s.smallest_beyond, stiffness_unit(s));
  }
  if (s.unit == StiffnessUnit::mixed) {
    text += fmt::format(" (translations count over {:.3g} m)", s.extent);
  }
  return text;
}

std::string statics_text(const StaticsReport& s) {
  if (!s.converged) return fmt::format("not found in {} iterations", s.iterations);
  return fmt::format("{}, {}, loads of t = {:.6g} s, force residual {:.3g} in {} iterations",
                     kStability[static_cast<int>(s.stability)], stiffness_text(s), s.time,
                     s.force_residual, s.iterations);
}

// Joints whose friction statics leaves out.
std::vector<std::string> joints_with_friction(const Mechanism& m) {
  std::vector<std::string> names;
  for (const JointFrictionStructure& f : m.frictions) names.push_back(m.joint_names[f.body]);
  for (const ConstantFrictionStructure& f : m.constant_frictions) {
    const std::string& name = m.joint_names[f.body];
    if (names.empty() || names.back() != name) names.push_back(name);
  }
  return names;
}

void add_equilibrium(const Preparation& preparation, std::vector<Finding>& findings) {
  findings.push_back({"equilibrium", statics_text(*preparation.statics)});
  const std::vector<std::string> joints = joints_with_friction(preparation.model.mechanism);
  if (joints.empty()) return;
  findings.push_back({"left out", fmt::format("friction of joint {} (statics has none)",
                                              fmt::join(joints, ", "))});
}

Json equilibrium_json(const Preparation& preparation) {
  const StaticsReport& s = *preparation.statics;
  return {
      {"time", s.time},
      {"stability", kStability[static_cast<int>(s.stability)]},
      {"free_directions", s.directions},
      {"without_stiffness", s.neutral},
      {"smallest_stiffness",
       s.directions > s.neutral ? json_number(s.smallest_beyond) : Json(nullptr)},
      {"stiffness_unit", stiffness_unit(s)},
      {"stiffness_extent", s.unit == StiffnessUnit::mixed ? json_number(s.extent) : Json(nullptr)},
      {"force_residual", json_number(s.force_residual)},
      {"closure_residual", json_number(s.closure_residual)},
      {"displacement", json_number(s.displacement)},
      {"iterations", s.iterations},
      {"friction_left_out", joints_with_friction(preparation.model.mechanism)}};
}

Json outcome_object(const Preparation& preparation, const SimulationOutcome* outcome,
                    double wall_s) {
  const bool ran = outcome != nullptr;
  const Cause cause = ran ? outcome->cause : preparation.cause;
  const bool is_prepared = preparation.cause == Cause::ok;
  const double nan = std::nan("");
  const StepLimit unknown{nan, nan, nan};
  const StepLimit limit =
      !ran ? is_prepared ? worse({}, preparation.spectrum, 0.0) : unknown : outcome->step_limit;
  return {{"status", cause == Cause::ok ? "done" : "failed"},
          {"cause", name_of(cause)},
          {"message", ran ? outcome->message : preparation.message},
          {"end_time", json_number(ran ? outcome->end_time : 0.0)},
          {"steps", ran ? outcome->steps : 0},
          {"rejected", ran ? outcome->rejected : 0},
          {"evaluations", ran ? outcome->evaluations : 0},
          {"contacts", ran ? outcome->contacts : 0},
          {"least_contact_steps", ran ? outcome->least_contact_steps : 0},
          {"drift_max", json_number(ran ? outcome->drift_max : nan)},
          {"energy_residual_max", json_number(ran ? outcome->energy_residual_max : nan)},
          {"step_limit", json_number(limit.seconds)},
          {"omega_max", json_number(limit.omega_max)},
          {"wall_s", wall_s}};
}

std::string json_text(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// What the closures make of the velocities that are given; all of them: simulate --write-start.
std::string velocities_text(const Preparation& preparation) {
  constexpr std::size_t most = 4;
  const Model& model = preparation.model;
  const std::vector<VelocityIndex>& found = preparation.found_velocities;
  std::vector<std::string> parts;
  for (const VelocityIndex k : found) {
    if (parts.size() == most) break;
    const bool shifts = model.mechanism.velocities[k].kind == VelocityKind::translation;
    parts.push_back(fmt::format("{} = {:.6g} {}", velocity_name(model.mechanism, k),
                                model.start.v[k], shifts ? "m/s" : "rad/s"));
  }
  if (found.size() > most) parts.push_back(fmt::format("{} more", found.size() - most));
  return fmt::format("follow from those given: {}", fmt::join(parts, ", "));
}

}  // namespace

std::vector<Finding> preparation_findings(const Preparation& preparation,
                                          const SimulationOptions& options) {
  const Spectrum& spectrum = preparation.spectrum;
  const double h = make_step_grid(options).h;
  std::vector<Finding> findings = {{"assembly", assembly_text(preparation.assembly)}};
  if (!preparation.assembly.closed) return findings;
  findings.push_back(
      {"mobility", mobility_text(preparation.assembly, preparation.model.mechanism.nv)});
  if (!preparation.found_velocities.empty()) {
    findings.push_back({"velocities", velocities_text(preparation)});
  }
  if (preparation.statics) add_equilibrium(preparation, findings);
  if (preparation.cause != Cause::ok) return findings;
  findings.push_back({"omega_max", fmt::format("{:.6g} rad/s at the start", spectrum.omega_max)});
  findings.push_back({"step", fmt::format("{:.6g} s, RK4 limit {:.4g} s, h omega_max {:.3g}", h,
                                          spectrum.step_limit, h * spectrum.omega_max)});
  return findings;
}

std::vector<FoundNumber> statics_numbers(const Preparation& preparation,
                                         const std::vector<StaticValue>& values) {
  const bool is_found = preparation.cause == Cause::ok && preparation.statics;
  const StaticsReport s = is_found ? *preparation.statics : StaticsReport{};
  const auto found = [&](double value) { return is_found ? value : std::nan(""); };
  const bool has_stiffness = s.directions > s.neutral;
  std::vector<FoundNumber> numbers = {
      {{"smallest_stiffness", is_found ? stiffness_unit(s) : "",
        "least eigenvalue that is not zero"},
       has_stiffness ? found(s.smallest_beyond) : std::nan("")},
      {{"free_directions", "", "in which the mechanism can move"}, found(s.directions)},
      {{"without_stiffness", "", "of them"}, found(s.neutral)},
      {{"redundant_equations", "", "closure equations less their rank"},
       found(preparation.assembly.rows - preparation.assembly.rank)},
      {{"force_residual", "", "largest force left, N or N m"}, found(s.force_residual)},
      {{"closure_residual", "", "largest opening left, m or 1"}, found(s.closure_residual)},
      {{"displacement", "", "largest change of a coordinate from the start, m or rad"},
       found(s.displacement)},
      {{"iterations", "", "of Newton's method"}, found(s.iterations)}};
  for (const StaticValue& value : values) {
    numbers.push_back({{value.name, value.unit, "at the equilibrium"}, value.value});
  }
  return numbers;
}

Table equilibrium_table(const std::vector<StaticValue>& values) {
  TableOf<StaticValue> table("equilibrium", "response", values);
  table.add("quantity", "", "channel", [](const StaticValue& v) { return v.name; });
  table.add(
      "value", "", "at the equilibrium, in its unit", [](const StaticValue& v) { return v.value; },
      "{:.9g}");
  table.add("unit", "", "of the value", [](const StaticValue& v) { return v.unit; });
  return table.take();
}

std::string preparation_text(const std::string& file, const std::string& name,
                             const Preparation& preparation, const SimulationOptions& options) {
  return summary_line("model", fmt::format("{} ({})", name, file)) +
         text_of(preparation_findings(preparation, options));
}

std::string failure_text(const Preparation& preparation) {
  return fmt::format("linkstudy: error: {}: {}\n", name_of(preparation.cause), preparation.message);
}

std::string values_text(const std::vector<StaticValue>& values) {
  std::string text = "\n";
  for (const StaticValue& value : values) {
    text += fmt::format("{:<28}{:>16.9g} {}\n", value.name, value.value, value.unit);
  }
  return text;
}

std::string warning_text(const Preparation& preparation) {
  std::string text;
  for (const std::string& warning : preparation.warnings) {
    text += fmt::format("linkstudy: warning: {}\n", warning);
  }
  if (!preparation.step_warning.empty()) {
    text += fmt::format("linkstudy: warning: {}\n", preparation.step_warning);
  }
  return text;
}

namespace {

// Fewer equal steps in a contact do not follow its force.
constexpr long kStepsOfContact = 20;

std::string contacts_text(const SimulationOutcome& outcome) {
  std::string text = fmt::format("{} begun", outcome.contacts);
  const long least = outcome.least_contact_steps;
  if (least > 0) text += fmt::format(", the shortest that ended took {} steps", least);
  return text;
}

std::string limit_text(const StepLimit& limit) {
  return fmt::format("least of RK4 {:.4g} s at t = {:.4g} s, omega_max {:.6g} rad/s", limit.seconds,
                     limit.t, limit.omega_max);
}

std::vector<std::string> outcome_notes(const SimulationOutcome& outcome,
                                       const SimulationOptions& options) {
  std::vector<std::string> notes;
  const long least = outcome.least_contact_steps;
  if (options.integrator == Integrator::rk4 && least > 0 && least < kStepsOfContact) {
    notes.push_back(
        fmt::format("a contact took {} steps; {} follow its force: shorten simulation.step, or use "
                    "simulation.integrator = \"adaptive\"",
                    least, kStepsOfContact));
  }
  if (options.integrator == Integrator::rk4 && outcome.contacts > 0 &&
      outcome.cause == Cause::diverged) {
    notes.push_back(
        "constant steps are unstable where friction damps fast (sigma1 times normal force over "
        "mass): "
        "use simulation.integrator = \"adaptive\", or friction.damping_speed");
  }
  if (outcome.greatest_rank > outcome.least_rank) {
    notes.push_back(
        fmt::format("the rank of the closure equations changed between {} and {}: a singular pose "
                    "was passed, or "
                    "the steps are coarse",
                    outcome.least_rank, outcome.greatest_rank));
  } else if (outcome.redundant) {
    notes.push_back(
        fmt::format("closure equations are redundant: their rank is {}", outcome.least_rank));
  }
  if (!energy_balances(outcome)) {
    notes.push_back("energy does not balance within 1 %: the step is too long");
  }
  return notes;
}

}  // namespace

std::string outcome_text(const SimulationOutcome& outcome, const SimulationOptions& options,
                         const std::string& hardest, double wall_s) {
  std::string text =
      summary_line("status", outcome.cause == Cause::ok
                                 ? std::string("ok")
                                 : fmt::format("{}: {}", name_of(outcome.cause), outcome.message));
  std::string reached = fmt::format("{:.6g} s in {} steps", outcome.end_time, outcome.steps);
  if (options.integrator != Integrator::rk4) {
    reached +=
        fmt::format(", {} more tried again, {} evaluations", outcome.rejected, outcome.evaluations);
  }
  text += summary_line("reached", reached);
  if (options.integrator == Integrator::rk4) {
    text += summary_line("limit", limit_text(outcome.step_limit));
  }
  if (outcome.contacts > 0) text += summary_line("contacts", contacts_text(outcome));
  if (!hardest.empty()) text += summary_line("hardest", hardest);
  text += summary_line("drift_max", fmt::format("{:.4g}", outcome.drift_max));
  text += summary_line("energy", fmt::format("residual at most {:.4g} J of {:.4g} J",
                                             outcome.energy_residual_max, outcome.energy_scale));
  for (const std::string& note : outcome_notes(outcome, options)) {
    text += summary_line("note", note);
  }
  return text + summary_line("wall", fmt::format("{:.3g} s", wall_s));
}

std::string outcome_json(const Preparation& preparation, const SimulationOutcome* outcome,
                         double wall_s) {
  return json_text(outcome_object(preparation, outcome, wall_s));
}

std::string statics_json(const Preparation& preparation, const std::vector<StaticValue>& values,
                         const std::vector<Mode>& modes, double wall_s) {
  Json json = outcome_object(preparation, nullptr, wall_s);
  if (preparation.cause != Cause::ok) return json_text(json);
  json["verdict"] = statics_text(*preparation.statics);
  json["equilibrium"] = equilibrium_json(preparation);
  json["values"] = json["units"] = Json::object();
  for (const StaticValue& value : values) {
    json["values"][value.name] = json_number(value.value);
    json["units"][value.name] = value.unit;
  }
  json["modes"] = Json::parse(modes_json(preparation.model.mechanism, modes));
  return json_text(json);
}

}  // namespace linkstudy
