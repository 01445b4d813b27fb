// How ranks talk: bytes with a tag, never blocking, so that no rank spins while it waits (busy
// waiting halves the throughput of a machine that is full of ranks). All calls come from the main
// thread. Two kinds exist: MpiSession, and LocalTransport for a process that is alone.
#pragma once

#include <memory>
#include <optional>
#include <string>

namespace linkstudy {

enum class Tag : int { task = 1, result, stop, cancel, abandon, bye, signal, call, going, stuck };

struct Message {
  int from = 0;
  Tag tag = Tag::task;
  std::string bytes;
};

class Transport {
 public:
  virtual ~Transport() = default;

  virtual int rank() const = 0;
  virtual int size() const = 0;
  virtual int nodes() const = 0;
  virtual const std::string& host() const = 0;

  // Takes the bytes over and returns at once; at most 2 GiB.
  virtual void send(int to, Tag tag, std::string bytes) = 0;
  // The next message that has arrived, if any.
  virtual std::optional<Message> receive() = 0;
  // True when every message sent has left this rank.
  virtual bool all_sent() = 0;

  // Collective: every rank ends with rank 0's bytes.
  virtual void broadcast(std::string& bytes) = 0;
  // Collective: the highest code of all ranks (0 done .. 5, 75 resumable: the graver one wins), so
  // that every rank exits alike. Also a gate: ranks leave together when one found an input error.
  virtual int agree_exit_code(int code) = 0;

  // Collective: the ranks with the same colour among themselves, in their order. This transport
  // must outlive it; leave_now and abort_all are still those of the process and of all ranks.
  virtual std::unique_ptr<Transport> split(int colour) = 0;

  // Flushes, finalizes and exits without running destructors, for when a thread is still computing.
  [[noreturn]] void leave_now(int code);
  // Ends all ranks at once with this code: the last resort of a rank that cannot go on.
  [[noreturn]] void abort_all(int code);

 private:
  virtual void finalize() = 0;
  virtual void kill_all(int code) = 0;
};

class LocalTransport final : public Transport {
 public:
  LocalTransport();
  int rank() const override { return 0; }
  int size() const override { return 1; }
  int nodes() const override { return 1; }
  const std::string& host() const override { return host_; }
  void send(int to, Tag tag, std::string bytes) override;
  std::optional<Message> receive() override { return std::nullopt; }
  bool all_sent() override { return true; }
  void broadcast(std::string&) override {}
  int agree_exit_code(int code) override { return code; }
  std::unique_ptr<Transport> split(int) override { return std::make_unique<LocalTransport>(); }

 private:
  void finalize() override {}
  void kill_all(int) override {}

  std::string host_;
};

// MPI when a launcher started more than one process, else local without the 0.3 s of MPI_Init.
// Throws LaunchError (launcher.h) when the launcher's processes do not find each other.
std::unique_ptr<Transport> make_transport();

std::string find_host_name();

}  // namespace linkstudy
