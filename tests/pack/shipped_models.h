// The mechanisms that come with the program, as the tests run them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "study/config/model_document.h"
#include "tests/support/source_file.h"

namespace linkstudy::testing {

inline std::vector<std::string> shipped_models() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(source_file("configs/mechanisms"))) {
    if (entry.path().extension() == ".toml") names.push_back(entry.path().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

// By constant steps.
inline ModelInput read_model(const std::string& path) {
  Diagnostics diagnostics;
  const auto document = ModelDocument::load(path, diagnostics);
  ModelInput input = *document->with({}, diagnostics);
  EXPECT_TRUE(diagnostics.empty()) << path;
  input.options.integrator = Integrator::rk4;
  return input;
}

// False where there is nothing to change: all closures are loose.
inline bool set_closures(ClosureModel model, Linkage& linkage) {
  bool changes = false;
  for (Closure& c : linkage.closures) {
    if (c.model == ClosureModel::clearance) continue;
    c.model = model;
    changes = true;
  }
  return changes;
}

}  // namespace linkstudy::testing
