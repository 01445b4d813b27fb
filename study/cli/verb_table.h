// The verbs: each is one row here, a function in the file of its name, and nothing else. A verb
// returns the exit code; errors of usage, input and results directories are thrown.
#pragma once

#include <string>
#include <vector>

#include "study/cli/command_line.h"

namespace linkstudy {

struct VerbRow {
  const char* name;
  const char* inputs;  // as in the usage line
  std::size_t fewest;  // inputs
  std::size_t most;
  const char* does;
  std::vector<std::string> options;  // names of rows of the option table
  int (*run)(const CommandLine& line);
  bool is_resumable = false;  // ranks share its work, a stop signal ends it in order
};

const std::vector<VerbRow>& verb_rows();

// Throws UsageError with the nearest.
const VerbRow& find_verb(const std::string& name);

int run_init(const CommandLine& line);
int run_check(const CommandLine& line);
int run_describe(const CommandLine& line);
int run_simulate(const CommandLine& line);
int run_statics(const CommandLine& line);
int run_kinematics(const CommandLine& line);
int run_plan(const CommandLine& line);
int run_study(const CommandLine& line);
int run_tune(const CommandLine& line);
int run_calibrate(const CommandLine& line);
int run_converge(const CommandLine& line);
int run_queue(const CommandLine& line);
int run_verify(const CommandLine& line);
int run_status(const CommandLine& line);
int run_export(const CommandLine& line);
int run_report(const CommandLine& line);

}  // namespace linkstudy
