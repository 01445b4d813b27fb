// What a prepared model and its run look like to people and to programs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/dynamics/modes.h"
#include "core/simulation/prepare.h"
#include "core/simulation/simulate.h"
#include "study/evaluate/equilibrium.h"
#include "study/record/findings.h"

namespace linkstudy {

// Assembly, mobility, redundancy, equilibrium, eigenfrequency and step limit.
std::vector<Finding> preparation_findings(const Preparation& preparation,
                                          const SimulationOptions& options);

// The numbers of an equilibrium and of its search; NaN where there is none.
std::vector<FoundNumber> statics_numbers(const Preparation& preparation,
                                         const std::vector<StaticValue>& values);
// Columns quantity, value and unit.
Table equilibrium_table(const std::vector<StaticValue>& values);

// The findings below the model, as aligned lines.
std::string preparation_text(const std::string& file, const std::string& name,
                             const Preparation& preparation, const SimulationOptions& options);

// Warnings, one a line.
std::string warning_text(const Preparation& preparation);

// Why there was no run.
std::string failure_text(const Preparation& preparation);

// Values of an equilibrium, one a line.
std::string values_text(const std::vector<StaticValue>& values);

// How the run ended, with a note where contacts were too short for the step. `hardest`: of its
// contacts, or empty.
std::string outcome_text(const SimulationOutcome& outcome, const SimulationOptions& options,
                         const std::string& hardest, double wall_s);

// The object of `simulate --json`. Numbers that are not finite are null.
std::string outcome_json(const Preparation& preparation, const SimulationOutcome* outcome,
                         double wall_s);

// The object of `statics --json`: that of a run, the equilibrium, its values and units by name, and
// the modes about it.
std::string statics_json(const Preparation& preparation, const std::vector<StaticValue>& values,
                         const std::vector<Mode>& modes, double wall_s);

}  // namespace linkstudy
