// Inputs of the verbs: files and --set texts to checked records, or an InputError with everything
// that is wrong.
#pragma once

#include "study/cli/command_line.h"
#include "study/config/study_input.h"
#include "study/store/results.h"

namespace linkstudy {

struct ReadModel {
  ModelDocument document;  // with --set written into it
  ModelInput input;
};
// A model with the --set values in it; remarks are printed.
ReadModel read_model(const CommandLine& line);
ModelInput read_model_input(const CommandLine& line);

// Stored results, of a directory or a file; what they have lost is said.
StudyResults read_results_input(const CommandLine& line);
// What a journal has lost, where that is anything.
void warn_of_lost(const std::string& dropped);

// A study or tune file with --set, --seed, --batch in it; --timeout, --max-failures and
// --on-failure replace what its [run] says.
StudyInput read_study_input(const CommandLine& line, FileKind kind);

// A model as a study of one evaluation that keeps the histories of --signals, or of all channels.
StudyInput read_model_as_study(const CommandLine& line);

// The same of a file of any kind but model.
StudyInput read_study_input(const CommandLine& line);

}  // namespace linkstudy
