#include "study/cli/kept.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "study/store/directory.h"

namespace linkstudy {

Kept keep_if_asked(const CommandLine& line, const ReadModel& model, const std::string& course,
                   ModelResults results) {
  require(line.output || !line.fresh, "--fresh goes with -o DIR");
  if (!line.output) return {};
  return {keep_results(line, model.document, model.input, course, std::move(results)),
          *line.output};
}

std::string digest_line(const Kept& kept) {
  return kept.digest.empty() ? "" : fmt::format("results digest: {}\n", kept.digest);
}

std::string with_digest(const std::string& json, const Kept& kept) {
  if (kept.digest.empty()) return json;
  nlohmann::ordered_json object = nlohmann::ordered_json::parse(json);
  object["digest"] = kept.digest;
  object["results"] = (std::filesystem::path(kept.directory) / kResultsName).string();
  return object.dump();
}

}  // namespace linkstudy
