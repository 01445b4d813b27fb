// A mass that falls along z, q = -g t^2 / 2 and v = -g t with g = 9 m/s^2, for 2 s, and a folder
// for studies of it.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>

#include "tests/study/evaluate/read_evaluator.h"

namespace linkstudy {

inline constexpr double kGravity = 9.0;  // m/s^2

class FallingMassFolder : public ::testing::Test {
 protected:
  FallingMassFolder() {
    std::string pattern =
        (std::filesystem::temp_directory_path() / "linkstudy_fall.XXXXXX").string();
    directory_ = ::mkdtemp(pattern.data());
    write("model.toml", R"(format = 1
kind = "model"
gravity = [0.0, 0.0, -9.0]
[[link]]
name = "b"
mass = 1.0
inertia = [0.01, 0.01, 0.01]
[[joint]]
name = "P"
type = "prismatic"
parent = "ground"
child = "b"
[simulation]
end_time = 2.0
step = 0.08
)");
  }
  ~FallingMassFolder() override { std::filesystem::remove_all(directory_); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(directory_ / name) << text;
  }

  // Of a study of these lines.
  std::unique_ptr<Evaluator> make(const std::string& text) {
    write("study.toml", "format = 1\nkind = \"study\"\nmodel = \"model.toml\"\n" + text);
    return read_evaluator((directory_ / "study.toml").string(), diagnostics_);
  }

  static Evaluation evaluate(Evaluator& evaluator, double step) {
    const Point point{0, {step}};
    return evaluator.evaluate({&point, 1}).at(0);
  }

  std::filesystem::path directory_;
  Diagnostics diagnostics_;
};

}  // namespace linkstudy
