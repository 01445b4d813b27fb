#include "study/cli/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>

#include "study/cli/verb_table.h"
#include "study/report/console.h"
#include "study/schedule/launcher.h"
#include "study/session/exit_code.h"
#include "study/session/failure.h"
#include "study/session/version_text.h"

namespace linkstudy {
namespace {

// Copies of a verb that works in one process: the first says so, and its exit code becomes that of
// the launcher. The others leave without one, or the launcher might end the first before it speaks.
bool leaves_to_first(const CommandLine& line) {
  if (find_verb(line.verb).is_resumable) return false;
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
  return find_verb(line.verb).run(line);
}

}  // namespace

bool is_resumable(const std::vector<std::string>& arguments) {
  return !arguments.empty() && std::ranges::any_of(verb_rows(), [&](const VerbRow& verb) {
    return verb.is_resumable && arguments.front() == verb.name;
  });
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
