// From a checked description to a model ready to run: assembly, statics if asked, damping from
// ratios, spectrum and step limit, and warnings about what a user should know first.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/dynamics/spectrum.h"
#include "core/dynamics/statics.h"
#include "core/kinematics/assembly.h"
#include "core/simulation/cause.h"
#include "core/simulation/options.h"

namespace linkstudy {

struct Preparation {
  Cause cause = Cause::ok;  // ok, assembly_failed, statics_failed
  std::string message;
  Model model;  // model.start is where the run begins
  AssemblyReport assembly;
  std::vector<VelocityIndex> found_velocities;  // not given, and not zero where the run begins
  std::optional<StaticsReport> statics;
  Spectrum spectrum;
  std::vector<std::string> warnings;  // about model and start
  std::string step_warning;           // about the step; empty: it is small enough
};

// h omega_max above which the accuracy of a step is doubtful long before it is unstable.
inline constexpr double kAccuracyLimit = 1.0;

Preparation prepare(const Linkage& linkage, const SimulationOptions& options);

}  // namespace linkstudy
