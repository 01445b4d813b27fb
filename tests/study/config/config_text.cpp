#include "config_text.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

namespace linkstudy::test {

const std::string kRsrrp = rsrrp_text();

std::string real_joints_text() {
  std::string text = replaced(
      kRsrrp, "center_of_mass = [0.0, 0.25, 0.0]",
      "center_of_mass = [0.0, 0.25, 0.0]\n"
      "flexible = { segments = 4, end = [0, 0.5, 0], young = 2e11, shear = 8e10, section = { shape "
      "= \"circle\", diameter = 0.02 } }");
  text = replaced(text, "name = \"A\"\ntype = \"revolute\"",
                  "name = \"A\"\ntype = \"revolute\"\n"
                  "friction = { mu_s = 0.3, mu_k = 0.2, sigma0 = 1e5, radius = 0.01 }\n"
                  "spring = { stiffness = [\"3 N m/rad\"] }");
  text = replaced(text, "type = \"spherical\"", "type = \"revolute\"");
  return replaced(text, "model  = \"cut\"",
                  "model = \"clearance\"\nclearance = { radial = 1e-3, bearing_radius = 5e-3 }\n"
                  "contact = { restitution = 0.9 }\n"
                  "friction = { mu_s = 0.25, mu_k = 0.1, sigma0 = 600 }");
}

std::string write_file(const std::string& name, const std::string& text) {
  const auto* info = testing::UnitTest::GetInstance()->current_test_info();
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) /
      (std::string("linkstudy_config_") + info->test_suite_name() + "_" + info->name());
  std::filesystem::create_directories(folder);
  const std::string path = (folder / name).string();
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

std::optional<ModelInput> read_text(const std::string& text, Diagnostics& diagnostics,
                                    std::span<const Override> overrides) {
  const std::optional<ModelDocument> document =
      ModelDocument::parse(text, "model.toml", diagnostics);
  if (!document) return std::nullopt;
  return document->with(overrides, diagnostics);
}

Override set(const std::string& assignment) {
  Diagnostics diagnostics;
  const std::optional<Override> override = parse_set(assignment, diagnostics);
  if (!override) throw std::logic_error("test override: " + assignment);
  return *override;
}

ModelInput read_good(const std::string& text, const std::vector<std::string>& sets) {
  Diagnostics diagnostics;
  std::vector<Override> overrides;
  for (const std::string& assignment : sets) overrides.push_back(set(assignment));
  std::optional<ModelInput> input = read_text(text, diagnostics, overrides);
  EXPECT_TRUE(input) << to_string(diagnostics);
  return input.value_or(ModelInput{});
}

}  // namespace linkstudy::test
