#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/topology/nearest_name.h"
#include "study/cli/exit_code.h"
#include "study/cli/output.h"
#include "study/cli/starter.h"
#include "study/cli/verbs.h"
#include "study/store/file.h"

namespace linkstudy {
namespace {

namespace fs = std::filesystem;

constexpr const char* kModelName = "model.toml";

struct NewFile {
  fs::path path;
  std::string text;
};

std::string kind_of(const CommandLine& line) {
  const std::string& kind = line.inputs.front();
  const std::vector<std::string> kinds = starter_kinds();
  if (std::ranges::find(kinds, kind) != kinds.end()) return kind;
  if (kind == "converge") {
    throw UsageError(
        fmt::format("init converge: refinement ladders are not supported in this "
                    "version; kinds: {}",
                    fmt::join(kinds, ", ")));
  }
  throw UsageError(fmt::format("init: there is no kind '{}'; {}", kind, suggest_name(kind, kinds)));
}

StarterNames names_of(const std::string& kind, const std::optional<std::string>& output) {
  const fs::path path = output.value_or(kind + ".toml");
  return {path.filename().string(), kModelName, "results_" + path.stem().string()};
}

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

// The input, and what it needs beside it: a model where there is none, and the batch script.
std::vector<NewFile> files_of(const CommandLine& line, const std::string& kind) {
  const fs::path path = *line.output;
  const StarterNames names = names_of(kind, line.output);
  std::vector<NewFile> files = {{path, make_starter(kind, names)}};
  const fs::path model = path.parent_path() / kModelName;
  if (kind != "model" && !fs::exists(model)) {
    files.push_back({model, make_starter("model", names_of("model", model.string()))});
  }
  if (line.slurm) files.push_back(batch_script_of(kind, path, names));
  return files;
}

// Everything that stands in the way, before anything is written.
void require_writable(const std::vector<NewFile>& files, bool fresh) {
  for (const NewFile& file : files) {
    std::error_code error;
    const fs::path folder = file.path.parent_path();
    if (!folder.empty() && !fs::is_directory(folder, error)) {
      throw UsageError(fmt::format("init: there is no directory '{}'", folder.string()));
    }
    if (fs::is_directory(file.path, error)) {
      throw UsageError(fmt::format("init: {} is a directory", file.path.string()));
    }
    if (!fresh && fs::exists(file.path, error)) {
      throw UsageError(fmt::format("init: {} exists; --fresh overwrites it", file.path.string()));
    }
  }
}

void require_sense(const CommandLine& line, const std::string& kind) {
  if (!line.slurm) return;
  if (kind == "model") {
    throw UsageError("init: --slurm goes with study and tune; a model is one short run");
  }
  if (!line.output) {
    throw UsageError("init: --slurm writes a script beside the input; add --output FILE");
  }
}

void write_files(const CommandLine& line, const std::string& kind) {
  const std::vector<NewFile> files = files_of(line, kind);
  if (std::ranges::any_of(files.begin() + 1, files.end(),
                          [&](const NewFile& file) { return file.path == files.front().path; })) {
    throw UsageError(
        fmt::format("init: {} is the name of the model that a {} refers to; choose "
                    "another",
                    files.front().path.string(), kind));
  }
  require_writable(files, line.fresh);
  for (const NewFile& file : files) {
    write_file_atomically(file.path, file.text);
    print_out(file.path.string() + "\n");
  }
}

}  // namespace

int run_init(const CommandLine& line) {
  const std::string kind = kind_of(line);
  require_sense(line, kind);
  if (line.output) {
    write_files(line, kind);
    return kDone;
  }
  print_out(make_starter(kind, names_of(kind, std::nullopt)));
  if (kind != "model") {
    fmt::print(stderr, "linkstudy: it refers to {}: linkstudy init model -o {}\n", kModelName,
               kModelName);
  }
  return kDone;
}

}  // namespace linkstudy
