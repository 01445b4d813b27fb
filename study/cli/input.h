// Inputs of the verbs: files and --set texts to checked records, or an InputError with everything
// that is wrong.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "study/cli/command_line.h"
#include "study/config/study_input.h"
#include "study/evaluate/evaluator.h"

namespace linkstudy {

class InputError : public std::runtime_error {
 public:
  explicit InputError(Diagnostics diagnostics);
  const Diagnostics& diagnostics() const { return diagnostics_; }

 private:
  Diagnostics diagnostics_;
};

void throw_if_any(const Diagnostics& diagnostics);

// To standard error.
void print_remarks(const std::vector<Diagnostic>& remarks);

// A model with the --set values in it; remarks are printed.
ModelInput read_model_input(const CommandLine& line);

// A study or tune file with --set, --seed, --batch in it; --timeout, --max-failures and
// --on-failure replace what its [run] says.
StudyInput read_study_input(const CommandLine& line, StudyKind kind);

// The points of a study in the order of their ids, and what runs one of them. A tune has a second
// parameter, simulation.step, because its certificate halves it.
std::vector<Parameter> parameters_of(const StudyInput& input);
std::vector<Point> points_of(const StudyInput& input);
std::unique_ptr<Evaluator> make_evaluator(const StudyInput& input, Diagnostics& diagnostics);

// simulation.step of the model of a tune, s.
double base_step_of(const StudyInput& input);

}  // namespace linkstudy
