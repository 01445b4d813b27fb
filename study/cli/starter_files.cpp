#include "study/cli/starter_files.h"

#include <fmt/format.h>

#include <algorithm>

#include "study/config/input_error.h"

namespace linkstudy {
namespace {

namespace fs = std::filesystem;

// The program that runs now, so that the script finds it from anywhere.
std::string path_of_program() {
  std::error_code error;
  const fs::path path = fs::read_symlink("/proc/self/exe", error);
  return error ? "linkstudy" : path.string();
}

NewFile batch_script_of(const std::string& kind, const fs::path& input, const StarterNames& names) {
  fs::path path = input;
  path.replace_extension(".sbatch");
  return {path, make_batch_script(kind, path.filename().string(), names, path_of_program())};
}

}  // namespace

StarterNames starter_names(const std::string& kind, const std::optional<std::string>& output) {
  const fs::path path = output.value_or(kind + ".toml");
  return {path.filename().string(), kStarterModel, "results_" + path.stem().string()};
}

std::vector<NewFile> starter_files(const std::string& kind, const std::string& output,
                                   bool with_batch_script) {
  const fs::path path = output;
  const StarterNames names = starter_names(kind, output);
  std::vector<NewFile> files = {{path, make_starter(kind, names)}};
  const fs::path model = path.parent_path() / kStarterModel;
  if (kind != "model" && !fs::exists(model)) {
    files.push_back({model, make_starter("model", starter_names("model", model.string()))});
  }
  if (with_batch_script) files.push_back(batch_script_of(kind, path, names));
  if (std::ranges::count(files, path, &NewFile::path) == 1) return files;
  throw UsageError(fmt::format(
      "init: {} is the name of the model that a {} refers to; choose another", output, kind));
}

void require_free(const std::vector<NewFile>& files, bool overwrites) {
  for (const NewFile& file : files) {
    std::error_code error;
    const fs::path folder = file.path.parent_path();
    if (!folder.empty() && !fs::is_directory(folder, error)) {
      throw UsageError(fmt::format("init: there is no directory '{}'", folder.string()));
    }
    if (fs::is_directory(file.path, error)) {
      throw UsageError(fmt::format("init: {} is a directory", file.path.string()));
    }
    if (!overwrites && fs::exists(file.path, error)) {
      throw UsageError(fmt::format("init: {} exists; --fresh overwrites it", file.path.string()));
    }
  }
}

}  // namespace linkstudy
