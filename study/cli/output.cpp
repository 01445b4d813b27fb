#include "study/cli/output.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "study/cli/command_line.h"

namespace linkstudy {

void print_out(std::string_view text) {
  const bool is_written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (is_written && std::fflush(stdout) == 0) return;
  throw std::runtime_error(
      fmt::format("standard output cannot be written: {}", std::strerror(errno)));
}

std::string summary_line(std::string_view label, std::string_view value) {
  return fmt::format("{:<13}{}\n", label, value);
}

void require_writable(const std::string& path) {
  if (path == "-") return;
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path folder = fs::path(path).parent_path();
  const bool is_there = folder.empty() || fs::is_directory(folder, error);
  if (is_there && !fs::is_directory(path, error)) return;
  throw UsageError(
      is_there ? fmt::format("--csv {}: is a directory", path)
               : fmt::format("--csv {}: there is no directory '{}'", path, folder.string()));
}

}  // namespace linkstudy
