#include "tests/cli/program.h"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <regex>
#include <sstream>

#include "tests/cli/launcher_watch.h"
#include "tests/support/rsrrp_text.h"

namespace linkstudy::testing {
namespace {

namespace fs = std::filesystem;

int exit_code(int status) {
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

const char* const kProgram = LINKSTUDY_PROGRAM;

std::string read_text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

Program::Program() {
  std::string pattern = (fs::temp_directory_path() / "linkstudy_cli.XXXXXX").string();
  directory_ = mkdtemp(pattern.data());
  fs::create_directory(directory_ / ".streams");
}

Program::~Program() {
  std::error_code ignored;
  fs::remove_all(directory_, ignored);
}

Ended Program::run(const std::string& arguments, const std::string& before) const {
  const std::string command = "cd " + directory_.string() + " && " + before + " " + kProgram + " " +
                              arguments + " >.streams/out 2>.streams/err </dev/null";
  std::optional<LauncherWatch> watch;
  if (before.find("mpirun") != std::string::npos) watch.emplace(directory_);
  Ended ended;
  ended.code = exit_code(std::system(command.c_str()));
  ended.out = read_text(directory_ / ".streams/out");
  ended.err = read_text(directory_ / ".streams/err");
  return ended;
}

double Program::seconds_of(const std::string& arguments) const {
  const auto begin = std::chrono::steady_clock::now();
  const Ended ended = run(arguments);
  EXPECT_EQ(ended.code, 0) << ended.err;
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

int Program::code_of(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return exit_code(status);
}

pid_t Program::start(const std::vector<std::string>& arguments) const {
  const pid_t child = fork();
  if (child != 0) return child;
  if (chdir(directory_.c_str()) != 0) _exit(99);
  const std::string log = (directory_ / ".streams/log").string();
  std::filesystem::remove(log);
  if (!std::freopen(log.c_str(), "a", stdout) || !std::freopen(log.c_str(), "a", stderr)) _exit(98);
  std::vector<std::string> words = {kProgram};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  execv(kProgram, pointers.data());
  _exit(97);
}

void Program::write(const std::string& name, const std::string& text) const {
  std::ofstream(directory_ / name, std::ios::binary) << text;
  inputs_.push_back(name);
}

std::vector<std::string> Program::left_behind() const {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory_)) {
    const std::string name = entry.path().filename().string();
    if (name != ".streams" && std::ranges::find(inputs_, name) == inputs_.end()) {
      names.push_back(name);
    }
  }
  std::ranges::sort(names);
  return names;
}

void Program::write_inputs() const {
  write("model.toml", model_text());
  write("study.toml", study_text());
  write("tune.toml", tune_text());
}

std::string model_text() {
  using test::replaced;
  std::string text = replaced(test::rsrrp_text(), "end_time = 15.0", "end_time = 0.2");
  text = replaced(text, "step = 1.0e-4", "step = 1.0e-3");
  return replaced(text, "damping = 1.0e3", "damping_ratio = 0.7");
}

std::string study_text() {
  return R"(format = 1
kind = "study"
name = "Short study"
model = "model.toml"
reference = { set = { "closure.S.model" = "cut", "simulation.step" = 1.0e-4 } }
base = { set = { "closure.S.model" = "sde" } }

[[vary]]
parameter = "closure.S.sde.stiffness"
values = ["1e4 N/m", 3e4, 1e5, 1e9]

[[vary]]
parameter = "simulation.step"
values = [1e-3, 5e-4, 1e-4]

[[match]]
signal = "closure.S.force"
tolerance = 0.02
window = [0.05, 0.2]

[[response]]
name = "crank_speed"
signal = "joint.A.v"
reduce = "last"

[[trace]]
signals = ["closure.S.force"]
)";
}

const char* const kForceData = R"(
[reference]
file = "cut.csv"
[reference.columns]
time = "time"
"closure.S.force.x" = "closure.S.force.x"
"closure.S.force.y" = "closure.S.force.y"
"closure.S.force.z" = "closure.S.force.z"
)";

std::string tune_text() {
  return R"(format = 1
kind = "tune"
name = "Short tune"
model = "model.toml"
reference = { set = { "closure.S.model" = "cut" } }
base = { set = { "closure.S.model" = "sde", "simulation.step" = 2.0e-4 } }

[[tune]]
parameter = "closure.S.sde.stiffness"
range = { log = [1e3, 1e7] }

[[match]]
signal = "closure.S.force"
norm = "rms"
scale = "vector"
tolerance = 0.001
window = [0.05, 0.2]
)";
}

std::string on_one_line(const std::string& out) {
  static const std::regex next("\n {13}");
  return std::regex_replace(out, next, " ");
}

std::string digest_in(const std::string& out) {
  const std::string label = "results digest: ";
  const std::size_t at = out.rfind(label);
  return at == std::string::npos ? "" : out.substr(at + label.size(), 64);
}

}  // namespace linkstudy::testing
