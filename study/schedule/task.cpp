#include "study/schedule/task.h"

#include <stdexcept>
#include <utility>

#include "study/record/bytes.h"

namespace linkstudy {
namespace {

// Takes the numbers at the end off the bytes.
template <class... Numbers>
void take_trailer(std::string& bytes, Numbers&... numbers) {
  constexpr std::size_t kSize = (sizeof(Numbers) + ...);
  if (bytes.size() < kSize) throw std::logic_error("a message without its trailer");
  const std::size_t length = bytes.size() - kSize;
  ByteReader in(std::string_view(bytes).substr(length));
  in(numbers...);
  bytes.resize(length);
}

}  // namespace

std::string pack_task(Task task) {
  ByteWriter out(std::move(task.bytes));
  out(task.run, task.index);
  return out.take();
}

Task unpack_task(std::string bytes) {
  Task task;
  take_trailer(bytes, task.run, task.index);
  task.bytes = std::move(bytes);
  return task;
}

std::string pack_result(TaskResult result) {
  ByteWriter out(std::move(result.bytes));
  out(result.run, result.index, result.seconds, result.failed);
  return out.take();
}

TaskResult unpack_result(std::string bytes, int rank) {
  TaskResult result;
  result.rank = rank;
  take_trailer(bytes, result.run, result.index, result.seconds, result.failed);
  result.bytes = std::move(bytes);
  return result;
}

}  // namespace linkstudy
