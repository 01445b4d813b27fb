// Warnings of many runs, each said when it comes up first. Those that differ in numbers only are
// alike: a study of a thousand cases says the same thing once.
#pragma once

#include <spdlog/logger.h>

#include <cstdint>
#include <map>
#include <string>

namespace linkstudy {

class Warnings {
 public:
  // Whether it is the first of its kind.
  bool add(const std::string& text);
  // "12 evaluations: TEXT" of every kind that came up more than once, to the log.
  void log_counts(spdlog::logger& log) const;

 private:
  struct Kind {
    std::string first;
    std::uint64_t count = 0;
  };
  std::map<std::string, Kind> kinds_;  // by the text without its numbers
};

// To standard error and the log.
void say_warning(const std::string& text, spdlog::logger& log);

}  // namespace linkstudy
