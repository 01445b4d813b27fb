// The verbs; each returns the exit code. Errors of usage, input and results directories are thrown.
#pragma once

#include "study/cli/command_line.h"

namespace linkstudy {

int run_init(const CommandLine& line);
int run_check(const CommandLine& line);
int run_describe(const CommandLine& line);
int run_simulate(const CommandLine& line);
int run_statics(const CommandLine& line);
int run_kinematics(const CommandLine& line);
int run_study(const CommandLine& line);
int run_tune(const CommandLine& line);
int run_status(const CommandLine& line);
int run_export(const CommandLine& line);

}  // namespace linkstudy
