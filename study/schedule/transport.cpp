#include "study/schedule/transport.h"

#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <stdexcept>
#include <utility>

#include "study/schedule/batch_job.h"
#include "study/schedule/launcher.h"
#include "study/schedule/mpi_session.h"

namespace linkstudy {

std::string find_host_name() {
  std::array<char, 256> name{};
  if (gethostname(name.data(), name.size() - 1) != 0) return "unknown";
  return name.data();
}

LocalTransport::LocalTransport() : host_(find_host_name()) {}

void LocalTransport::send(int, Tag, std::string) {
  throw std::logic_error("a process that is alone has nobody to send to");
}

void Transport::leave_now(int code) {
  std::cout.flush();
  std::fflush(nullptr);
  finalize();
  std::_Exit(code);
}

void Transport::abort_all(int code) {
  std::cout.flush();
  std::fflush(nullptr);
  kill_all(code);
  std::_Exit(code);
}

std::unique_ptr<Transport> make_transport() {
  const Launcher launcher = find_launcher(read_environment);
  check_batch_step(read_environment, launcher);
  if (launcher.size <= 1) return std::make_unique<LocalTransport>();
  check_reachable(launcher);
  auto session = std::make_unique<MpiSession>();
  check_size(launcher, session->size(), mpi_library_version());
  return session;
}

}  // namespace linkstudy
