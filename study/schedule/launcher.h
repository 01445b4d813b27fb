// Who started this process, told by the environment, before MPI is asked. A launcher that does not
// fit the MPI library starts n serial copies that all do the whole study and overwrite each other:
// that is found here and explained.
#pragma once

#include <functional>
#include <optional>
#include <stdexcept>
#include <string>

namespace linkstudy {

struct Launcher {
  std::string name;       // "mpirun (Open MPI)"; "" when started by hand
  int size = 1;           // processes the launcher says it started
  int rank = 0;           // which of them this is
  bool connected = true;  // false: srun without a plugin through which ranks find each other
};

using Environment = std::function<std::optional<std::string>(const char* name)>;

std::optional<std::string> read_environment(const char* name);

Launcher find_launcher(const Environment& environment);

// A usage error (exit code 2). Every copy throws it; only the first needs to print it.
class LaunchError : public std::runtime_error {
 public:
  LaunchError(const std::string& message, int rank) : std::runtime_error(message), rank_(rank) {}
  bool is_first() const { return rank_ == 0; }

 private:
  int rank_;
};

// Throws LaunchError where MPI_Init itself would fail with a riddle.
void check_reachable(const Launcher& launcher);

// Throws LaunchError when the launcher started n > 1 but the communicator has another size.
// `library` is the MPI library in use.
void check_size(const Launcher& launcher, int communicator_size,
                const std::string& library = "Open MPI");

// Throws LaunchError when the launcher started n > 1 of a verb that works in one process.
void check_alone(const Launcher& launcher, const std::string& verb);

}  // namespace linkstudy
