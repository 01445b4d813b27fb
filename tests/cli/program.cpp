#include "tests/cli/program.h"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace linkstudy::testing {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProgram = LINKSTUDY_PROGRAM;

int code_of(int status) {
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

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
  Ended ended;
  ended.code = code_of(std::system(command.c_str()));
  ended.out = read_text(directory_ / ".streams/out");
  ended.err = read_text(directory_ / ".streams/err");
  return ended;
}

pid_t Program::start(const std::vector<std::string>& arguments) const {
  const pid_t child = fork();
  if (child != 0) return child;
  if (chdir(directory_.c_str()) != 0) _exit(99);
  const std::string log = (directory_ / ".streams/log").string();
  if (!std::freopen(log.c_str(), "w", stdout) || !std::freopen(log.c_str(), "w", stderr)) _exit(98);
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
  return R"(format = 1
kind = "model"
name = "short RSRRP"
gravity = [0.0, -9.81, 0.0]

[[link]]
name = "crank"
mass = 1.0
center_of_mass = [0.0, 0.05, 0.0]
inertia = [8.333333333333333e-4, 1.0e-4, 8.333333333333333e-4]

[[link]]
name = "slider"
mass = 2.0
inertia = [1.0e-3, 1.0e-3, 1.0e-3]

[[link]]
name = "yoke"
mass = 0.2
inertia = [1.0e-4, 1.0e-4, 1.0e-4]

[[link]]
name = "coupler"
mass = 1.5
center_of_mass = [0.0, 0.25, 0.0]
inertia = [0.03125, 1.0e-4, 0.03125]

[[joint]]
name = "A"
type = "revolute"
parent = "ground"
child = "crank"

[[joint]]
name = "P"
type = "prismatic"
parent = "ground"
child = "slider"
frame = { position = [0.0, -0.3830127018922193, 0.0], matrix = [[0, -1, 0], [1, 0, 0], [0, 0, 1]] }
initial = { position = [0.25] }

[[joint]]
name = "Q"
type = "revolute"
parent = "slider"
child = "yoke"
frame = { position = [0.05, 0.0, 0.0] }

[[joint]]
name = "R"
type = "revolute"
parent = "yoke"
child = "coupler"
frame = { rotation = { axis = [1, 0, 0], angle = "-90 deg" } }
initial = { position = ["-60 deg"] }

[[closure]]
name = "S"
type = "spherical"
first = { link = "crank", position = [0.0, 0.1, 0.0] }
second = { link = "coupler", position = [0.0, 0.5, 0.0] }
model = "cut"
sde = { stiffness = 1.0e6, damping_ratio = 0.7 }

[[load]]
name = "drive"
type = "torque"
joint = "A"
course = { shape = "ramp", value = 10.0, duration = 5.0 }

[[load]]
name = "resistance"
type = "resistance"
joint = "A"
law = { shape = "linear", value = 10.0, at_speed = 9.0 }

[simulation]
end_time = 0.2
step = 1.0e-3
start = "equilibrium"
output_interval = 1.0e-2
)";
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

std::string digest_in(const std::string& out) {
  const std::string label = "results digest: ";
  const std::size_t at = out.rfind(label);
  return at == std::string::npos ? "" : out.substr(at + label.size(), 64);
}

}  // namespace linkstudy::testing
