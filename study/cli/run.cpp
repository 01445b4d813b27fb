#include "study/cli/run.h"

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <stdexcept>

#include "study/cli/exit_code.h"
#include "study/cli/output.h"
#include "study/cli/report_error.h"
#include "study/cli/verbs.h"
#include "study/cli/version.h"
#include "study/schedule/launcher.h"

namespace linkstudy {
namespace {

struct VerbEntry {
  const char* name;
  int (*run)(const CommandLine&);
};

constexpr VerbEntry kVerbs[] = {{"init", run_init},         {"check", run_check},
                                {"describe", run_describe}, {"simulate", run_simulate},
                                {"statics", run_statics},   {"kinematics", run_kinematics},
                                {"study", run_study},       {"tune", run_tune},
                                {"status", run_status},     {"export", run_export}};

// Copies of a verb that works in one process: the first says so, and its exit code becomes that of
// the launcher. The others leave without one, or the launcher might end the first before it speaks.
bool leaves_to_first(const CommandLine& line) {
  if (is_resumable({line.verb})) return false;
  const Launcher launcher = find_launcher(read_environment);
  if (launcher.size > 1 && launcher.rank > 0) return true;
  check_alone(launcher, line.verb);
  return false;
}

int run_verb(const std::vector<std::string>& arguments) {
  const CommandLine line = parse_command_line(arguments);
  if (line.verb == "version" || line.verb == "help" || line.help) {
    print_out(line.help ? usage_of(line.verb) : line.verb == "help" ? usage() : version_text());
    return kDone;
  }
  if (leaves_to_first(line)) return kDone;
  for (const VerbEntry& verb : kVerbs) {
    if (line.verb == verb.name) return verb.run(line);
  }
  throw std::logic_error("a verb without a function: " + line.verb);
}

}  // namespace

bool is_resumable(const std::vector<std::string>& arguments) {
  return !arguments.empty() && (arguments.front() == "study" || arguments.front() == "tune");
}

int run_program(const std::vector<std::string>& arguments) {
  try {
    return run_verb(arguments);
  } catch (...) {
    const Failure failure = describe_failure(std::current_exception());
    print_err(failure.text);
    return failure.code;
  }
}

}  // namespace linkstudy
