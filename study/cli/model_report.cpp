#include "study/cli/model_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "study/cli/output.h"

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

std::string statics_text(const StaticsReport& s) {
  if (!s.converged) return fmt::format("not found in {} iterations", s.iterations);
  return fmt::format("{}, smallest stiffness {:.4g}, force residual {:.3g} in {} iterations",
                     kStability[static_cast<int>(s.stability)], s.smallest_stiffness,
                     s.force_residual, s.iterations);
}

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

}  // namespace

std::string preparation_text(const std::string& file, const std::string& name,
                             const Preparation& preparation, const SimulationOptions& options) {
  const Spectrum& spectrum = preparation.spectrum;
  const double h = make_step_grid(options).h;
  std::string text = summary_line("model", fmt::format("{} ({})", name, file));
  text += summary_line("assembly", assembly_text(preparation.assembly));
  if (!preparation.assembly.closed) return text;
  text +=
      summary_line("mobility", mobility_text(preparation.assembly, preparation.model.mechanism.nv));
  if (preparation.statics) text += summary_line("equilibrium", statics_text(*preparation.statics));
  if (preparation.cause != Cause::ok) return text;
  text += summary_line("omega_max", fmt::format("{:.6g} rad/s at the start", spectrum.omega_max));
  text += summary_line("step", fmt::format("{:.6g} s, RK4 limit {:.4g} s, h omega_max {:.3g}", h,
                                           spectrum.step_limit, h * spectrum.omega_max));
  return text;
}

std::string warning_text(const Preparation& preparation) {
  std::string text;
  for (const std::string& warning : preparation.warnings) {
    text += fmt::format("linkstudy: warning: {}\n", warning);
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
                         double wall_s) {
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
  const bool ran = outcome != nullptr;
  const Cause cause = ran ? outcome->cause : preparation.cause;
  const bool is_prepared = preparation.cause == Cause::ok;
  const double nan = std::nan("");
  const StepLimit unknown{nan, nan, nan};
  const StepLimit limit =
      !ran ? is_prepared ? worse({}, preparation.spectrum, 0.0) : unknown : outcome->step_limit;
  const Json json = {{"status", cause == Cause::ok ? "done" : "failed"},
                     {"cause", name_of(cause)},
                     {"message", ran ? outcome->message : preparation.message},
                     {"end_time", number(ran ? outcome->end_time : 0.0)},
                     {"steps", ran ? outcome->steps : 0},
                     {"rejected", ran ? outcome->rejected : 0},
                     {"evaluations", ran ? outcome->evaluations : 0},
                     {"contacts", ran ? outcome->contacts : 0},
                     {"least_contact_steps", ran ? outcome->least_contact_steps : 0},
                     {"drift_max", number(ran ? outcome->drift_max : nan)},
                     {"energy_residual_max", number(ran ? outcome->energy_residual_max : nan)},
                     {"step_limit", number(limit.seconds)},
                     {"omega_max", number(limit.omega_max)},
                     {"wall_s", wall_s}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace linkstudy
