#include <optional>

#include "study/cli/run.h"
#include "study/schedule/stop_signals.h"

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  // Before anything slow: a signal that comes while a large input is read ends in order, too.
  std::optional<linkstudy::StopSignals> signals;
  if (linkstudy::is_resumable(arguments)) signals.emplace();
  return linkstudy::run_program(arguments);
}
