// What travels between ranks. A task is bytes with an index; the scheduler never looks inside.
// On the wire the header is a trailer, so that megabytes need not be moved to make room for it.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace linkstudy {

// Runs on a thread of its own on every rank, one task at a time. What it throws becomes the text of
// a failed result.
using Work = std::function<std::string(const std::string& task)>;

struct Task {
  std::uint64_t run = 0;    // which call of Pool::run
  std::uint64_t index = 0;  // position in its tasks
  std::string bytes;
};

struct TaskResult {
  std::uint64_t run = 0;
  std::uint64_t index = 0;
  std::string bytes;  // what Work returned; when failed, what it threw, as text
  bool failed = false;
  double seconds = 0.0;  // in Work
  int rank = 0;          // where
  bool lost = false;     // failed: three ranks that had it fell silent
};

std::string pack_task(Task task);
Task unpack_task(std::string bytes);
std::string pack_result(TaskResult result);
TaskResult unpack_result(std::string bytes, int rank);

}  // namespace linkstudy
