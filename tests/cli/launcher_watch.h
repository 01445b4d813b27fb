// mpirun of Open MPI 4.1.4 on its way out of MPI_Abort, all being done: at times it crashes (139),
// at times it waits for itself for good (PMIx_server_finalize). The watch ends it then (137).
#pragma once

#include <gmock/gmock.h>

#include <chrono>
#include <filesystem>
#include <stop_token>
#include <thread>

namespace linkstudy::testing {

// Matches the exit codes that mpirun may have where the program calls MPI_Abort with `code`.
inline auto aborted_with(int code) {
  return ::testing::AnyOf(code, 137, 139);
}

// Kills an mpirun that was started in this directory once all its ranks have ended for `patience`.
class LauncherWatch {
 public:
  explicit LauncherWatch(const std::filesystem::path& directory,
                         std::chrono::milliseconds patience = std::chrono::seconds(10));

 private:
  void look(const std::stop_token& stop) const;

  std::filesystem::path directory_;
  std::chrono::milliseconds patience_;
  std::jthread thread_;
};

}  // namespace linkstudy::testing
