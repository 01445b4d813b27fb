#include "study/schedule/task.h"

#include <cstring>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace linkstudy {
namespace {

struct TaskTrailer {
  std::uint64_t run;
  std::uint64_t index;
};

struct ResultTrailer {
  std::uint64_t run;
  std::uint64_t index;
  double seconds;
  std::uint64_t failed;
};

template <class Trailer>
void append_trailer(std::string& bytes, const Trailer& trailer) {
  static_assert(std::is_trivially_copyable_v<Trailer>);
  bytes.append(reinterpret_cast<const char*>(&trailer), sizeof trailer);
}

template <class Trailer>
Trailer take_trailer(std::string& bytes) {
  if (bytes.size() < sizeof(Trailer)) throw std::logic_error("a message without its trailer");
  Trailer trailer;
  const std::size_t length = bytes.size() - sizeof trailer;
  std::memcpy(&trailer, bytes.data() + length, sizeof trailer);
  bytes.resize(length);
  return trailer;
}

}  // namespace

std::string pack_task(Task task) {
  append_trailer(task.bytes, TaskTrailer{task.run, task.index});
  return std::move(task.bytes);
}

Task unpack_task(std::string bytes) {
  const auto trailer = take_trailer<TaskTrailer>(bytes);
  return {trailer.run, trailer.index, std::move(bytes)};
}

std::string pack_result(TaskResult result) {
  append_trailer(result.bytes,
                 ResultTrailer{result.run, result.index, result.seconds, result.failed ? 1u : 0u});
  return std::move(result.bytes);
}

TaskResult unpack_result(std::string bytes, int rank) {
  const auto trailer = take_trailer<ResultTrailer>(bytes);
  return {trailer.run, trailer.index, std::move(bytes), trailer.failed != 0, trailer.seconds, rank};
}

}  // namespace linkstudy
