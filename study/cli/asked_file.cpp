#include "study/cli/asked_file.h"

#include <fmt/format.h>

#include <filesystem>

#include "study/config/input_error.h"
#include "study/report/console.h"
#include "study/store/file.h"

namespace linkstudy {

namespace fs = std::filesystem;

void require_writable(const std::string& option, const std::optional<std::string>& path) {
  if (!path || *path == "-") return;
  std::error_code error;
  const fs::path folder = fs::path(*path).parent_path();
  const bool is_there = folder.empty() || fs::is_directory(folder, error);
  if (is_there && !fs::is_directory(*path, error)) return;
  throw UsageError(
      is_there ? fmt::format("{} {}: is a directory", option, *path)
               : fmt::format("{} {}: there is no directory '{}'", option, *path, folder.string()));
}

void require_other_file(const std::string& option, const std::optional<std::string>& path,
                        const std::string& input) {
  std::error_code ignored;
  if (!path || *path == "-" || !fs::equivalent(*path, input, ignored)) return;
  throw UsageError(
      fmt::format("{} {}: is the input, whose comments would be lost; choose another "
                  "file",
                  option, *path));
}

void remove_old(const std::optional<std::string>& path) {
  std::error_code ignored;  // what cannot be removed is reported when it is written
  if (path && *path != "-" && fs::is_regular_file(*path, ignored)) fs::remove(*path, ignored);
}

void print_text(const CommandLine& line, const std::string& text) {
  if (line.json || line.csv == "-" || line.write_start == "-") {
    fmt::print(stderr, "{}", text);
  } else {
    print_out(text);
  }
}

void write_asked(const std::string& path, const std::string& text) {
  path == "-" ? print_out(text) : write_file_atomically(path, text);
}

}  // namespace linkstudy
