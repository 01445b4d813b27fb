#include "config_text.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

namespace linkstudy::test {

const std::string kRsrrp = rsrrp_text();

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

}  // namespace linkstudy::test
