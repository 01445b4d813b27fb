// Open MPI between construction and destruction (MPI_THREAD_FUNNELED: only the main thread calls).
//
// A rank that dies ends the whole job: the survivors get SIGCONT, one second later SIGTERM, and one
// more second later SIGKILL (odls_base_sigkill_timeout). So the journal is synced in that second
// (PoolOptions::on_terminate) and the next start resumes. mpirun does the same when it is sent
// SIGTERM or SIGINT itself, and exits with 1 whatever its ranks say; SIGUSR1 and SIGUSR2 it passes
// on, leaves the ranks their time and exits with their 75: those are the signals for scripts. With
// a frozen rank only MPI_Abort ends the job; mpirun then exits with its code, 0 included.
#pragma once

#include <mpi.h>

#include <list>
#include <memory>
#include <optional>
#include <string>

#include "study/schedule/stop_signals.h"
#include "study/schedule/transport.h"

namespace linkstudy {

class MpiSession final : public Transport {
 public:
  MpiSession();
  ~MpiSession() override;
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;

  int rank() const override { return rank_; }
  int size() const override { return size_; }
  int nodes() const override { return nodes_; }
  const std::string& host() const override { return host_; }
  void send(int to, Tag tag, std::string bytes) override;
  std::optional<Message> receive() override;
  bool all_sent() override;
  void broadcast(std::string& bytes) override;
  int agree_exit_code(int code) override;
  std::unique_ptr<Transport> split(int colour) override;

 private:
  // Ranks of the session that `part` was split from.
  MpiSession(MPI_Comm part, std::string host);

  void find_place();
  void finalize() override;
  void kill_all(int code) override;

  struct Pending;  // a message and its request; the bytes must stay where they are

  std::string host_;
  const bool is_part_;  // of another, which ends MPI
  MPI_Comm ranks_;
  int rank_ = 0;
  int size_ = 1;
  int nodes_ = 1;
  int agreed_code_ = kExitResumable;
  std::list<std::unique_ptr<Pending>> pending_;
};

// Name and version of the MPI library, for --version; needs no MPI_Init.
std::string mpi_library_version();

}  // namespace linkstudy
