#include "tests/cli/launcher_watch.h"

#include <sys/types.h>

#include <condition_variable>
#include <csignal>
#include <fstream>
#include <mutex>
#include <string>
#include <system_error>
#include <vector>

namespace linkstudy::testing {
namespace {

namespace fs = std::filesystem;
using std::chrono::steady_clock;

constexpr auto kBetweenLooks = std::chrono::milliseconds(200);

struct Process {
  pid_t pid = 0, parent = 0;
  std::string name;
  char state = 0;
};

std::vector<Process> processes() {
  std::vector<Process> all;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator("/proc", ignored)) {
    std::ifstream file(entry.path() / "stat");
    std::string line;
    if (!std::getline(file, line)) continue;
    // pid (name) state parent ...
    const std::size_t open = line.find('('), close = line.rfind(')');
    if (open == std::string::npos || close == std::string::npos) continue;
    all.push_back({std::stoi(line), std::stoi(line.substr(close + 4)),
                   line.substr(open + 1, close - open - 1), line[close + 2]});
  }
  return all;
}

// The mpirun in this directory if it has ranks and all of them have ended, or 0.
pid_t left_alone(const fs::path& directory) {
  const std::vector<Process> all = processes();
  for (const Process& p : all) {
    std::error_code ignored;
    if (p.name != "mpirun" ||
        fs::read_symlink("/proc/" + std::to_string(p.pid) + "/cwd", ignored) != directory) {
      continue;
    }
    int ended = 0, alive = 0;
    for (const Process& rank : all)
      if (rank.parent == p.pid) ++(rank.state == 'Z' ? ended : alive);
    if (ended > 0 && alive == 0) return p.pid;
  }
  return 0;
}

}  // namespace

LauncherWatch::LauncherWatch(const fs::path& directory, std::chrono::milliseconds patience)
    : directory_(fs::canonical(directory)),
      patience_(patience),
      thread_([this](const std::stop_token& stop) { look(stop); }) {}

void LauncherWatch::look(const std::stop_token& stop) const {
  std::mutex mutex;
  std::unique_lock lock(mutex);
  std::condition_variable_any stopped;
  auto last_alive = steady_clock::now();
  while (!stop.stop_requested()) {
    const pid_t alone = left_alone(directory_);
    const auto now = steady_clock::now();
    if (alone == 0) {
      last_alive = now;
    } else if (now - last_alive >= patience_) {
      kill(alone, SIGKILL);
    }
    stopped.wait_for(lock, stop, kBetweenLooks, [] { return false; });
  }
}

}  // namespace linkstudy::testing
