// The files that `init` writes beside each other.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "study/cli/starter.h"

namespace linkstudy {

// Of the model that a study or tune refers to.
inline constexpr const char* kStarterModel = "model.toml";

struct NewFile {
  std::filesystem::path path;
  std::string text;
};

// Names in the input `kind`, written to `output` or nowhere.
StarterNames starter_names(const std::string& kind, const std::optional<std::string>& output);

// The input, and what it needs beside it: a model where there is none, and the batch script.
// Throws UsageError where two would have one name.
std::vector<NewFile> starter_files(const std::string& kind, const std::string& output,
                                   bool with_batch_script);

// Everything that stands in the way, before anything is written: throws UsageError.
void require_free(const std::vector<NewFile>& files, bool overwrites);

}  // namespace linkstudy
