#include "study/schedule/mpi_session.h"

#include <fmt/core.h>
#include <mpi.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <climits>
#include <cstdint>
#include <stdexcept>
#include <thread>
#include <utility>

namespace linkstudy {
namespace {

// Collectives of Open MPI spin; this wait leaves the processor to the rank that still computes.
void wait_asleep(MPI_Request& request) {
  for (int tries = 0;; ++tries) {
    int done = 0;
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (done) return;
    std::this_thread::sleep_for(std::chrono::microseconds(tries < 1000 ? 50 : 1000));
  }
}

int count_nodes(MPI_Comm ranks, int rank) {
  MPI_Comm node = MPI_COMM_NULL;
  MPI_Comm_split_type(ranks, MPI_COMM_TYPE_SHARED, rank, MPI_INFO_NULL, &node);
  int rank_on_node = 0, count = 0;
  MPI_Comm_rank(node, &rank_on_node);
  MPI_Comm_free(&node);
  const int is_first = rank_on_node == 0 ? 1 : 0;
  MPI_Allreduce(&is_first, &count, 1, MPI_INT, MPI_SUM, ranks);
  return count;
}

}  // namespace

struct MpiSession::Pending {
  std::string bytes;
  MPI_Request request = MPI_REQUEST_NULL;

  bool done() {
    int flag = 0;
    MPI_Test(&request, &flag, MPI_STATUS_IGNORE);
    return flag != 0;
  }
};

MpiSession::MpiSession() : host_(find_host_name()), is_part_(false), ranks_(MPI_COMM_WORLD) {
  int provided = MPI_THREAD_SINGLE;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  if (provided < MPI_THREAD_FUNNELED) {
    MPI_Finalize();
    throw std::runtime_error(
        "this MPI library does not allow a second thread (MPI_THREAD_FUNNELED)");
  }
  find_place();
}

MpiSession::MpiSession(MPI_Comm part, std::string host)
    : host_(std::move(host)), is_part_(true), ranks_(part) {
  find_place();
}

void MpiSession::find_place() {
  MPI_Comm_rank(ranks_, &rank_);
  MPI_Comm_size(ranks_, &size_);
  nodes_ = count_nodes(ranks_, rank_);
}

MpiSession::~MpiSession() {
  // Nobody would answer MPI_Finalize any more.
  if (job_is_dying()) leave_now(agreed_code_);
  if (is_part_)
    MPI_Comm_free(&ranks_);
  else
    MPI_Finalize();
}

std::unique_ptr<Transport> MpiSession::split(int colour) {
  MPI_Comm part = MPI_COMM_NULL;
  MPI_Comm_split(ranks_, colour, rank_, &part);
  return std::unique_ptr<Transport>(new MpiSession(part, host_));
}

void MpiSession::send(int to, Tag tag, std::string bytes) {
  if (bytes.size() > static_cast<std::size_t>(INT_MAX))
    throw std::length_error(fmt::format("a message of {} bytes is over 2 GiB", bytes.size()));
  auto message = std::make_unique<Pending>();
  message->bytes = std::move(bytes);
  MPI_Isend(message->bytes.data(), static_cast<int>(message->bytes.size()), MPI_BYTE, to,
            static_cast<int>(tag), ranks_, &message->request);
  if (!message->done()) pending_.push_back(std::move(message));
}

std::optional<Message> MpiSession::receive() {
  all_sent();
  int arrived = 0, length = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, ranks_, &arrived, &status);
  if (!arrived) return std::nullopt;
  MPI_Get_count(&status, MPI_BYTE, &length);
  Message message{status.MPI_SOURCE, static_cast<Tag>(status.MPI_TAG), {}};
  message.bytes.resize(static_cast<std::size_t>(length));
  MPI_Recv(message.bytes.data(), length, MPI_BYTE, status.MPI_SOURCE, status.MPI_TAG, ranks_,
           MPI_STATUS_IGNORE);
  return message;
}

bool MpiSession::all_sent() {
  pending_.remove_if([](const std::unique_ptr<Pending>& message) { return message->done(); });
  return pending_.empty();
}

void MpiSession::broadcast(std::string& bytes) {
  constexpr std::size_t kChunk = std::size_t{1} << 30;
  MPI_Request request = MPI_REQUEST_NULL;
  std::uint64_t length = bytes.size();
  MPI_Ibcast(&length, 1, MPI_UINT64_T, 0, ranks_, &request);
  wait_asleep(request);
  bytes.resize(length);
  for (std::size_t begin = 0; begin < length; begin += kChunk) {
    const auto part = static_cast<int>(std::min<std::size_t>(kChunk, length - begin));
    MPI_Ibcast(bytes.data() + begin, part, MPI_BYTE, 0, ranks_, &request);
    wait_asleep(request);
  }
}

int MpiSession::agree_exit_code(int code) {
  int highest = code;
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Iallreduce(&code, &highest, 1, MPI_INT, MPI_MAX, ranks_, &request);
  wait_asleep(request);
  agreed_code_ = highest;
  return highest;
}

void MpiSession::finalize() {
  if (!job_is_dying()) MPI_Finalize();
}

void MpiSession::kill_all(int code) {
  MPI_Abort(MPI_COMM_WORLD, code);
}

std::string mpi_library_version() {
  std::array<char, MPI_MAX_LIBRARY_VERSION_STRING> text{};
  int length = 0;
  MPI_Get_library_version(text.data(), &length);
  const std::string version(text.data(), static_cast<std::size_t>(std::max(length, 0)));
  return version.substr(0, version.find(','));
}

}  // namespace linkstudy
