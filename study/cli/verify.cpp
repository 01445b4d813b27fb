#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "study/cli/input.h"
#include "study/cli/verb_table.h"
#include "study/record/counted.h"
#include "study/report/console.h"
#include "study/session/exit_code.h"
#include "study/session/verification.h"

namespace linkstudy {
namespace {

constexpr std::size_t kMostShown = 20;  // disagreements

std::string text_of(const Verification& found) {
  std::string text = fmt::format("{} of {} evaluations run again: {}\n", found.rerun.size(),
                                 found.stored, listed(found.rerun));
  for (std::size_t i = 0; i < std::min(found.disagreements.size(), kMostShown); ++i) {
    const Disagreement& one = found.disagreements[i];
    text += fmt::format("evaluation {}: {} is {}, stored {}\n", one.evaluation, one.column,
                        one.found, one.stored);
  }
  if (found.disagreements.size() > kMostShown) {
    text += fmt::format("and {} more\n", found.disagreements.size() - kMostShown);
  }
  if (found.disagreements.empty()) {
    text += found.to_the_bit ? "all agree to the last bit\n" : "all agree to rounding\n";
  }
  if (found.refuted) text += fmt::format("answer refuted: {}\n", *found.refuted);
  if (!found.answer.empty() && !found.refuted) {
    text += fmt::format("answer judged anew: {}, as stored\n", found.answer);
  }
  return text + (found.holds() ? "verified\n" : "refuted\n");
}

std::string json_of(const Verification& found) {
  nlohmann::ordered_json disagreements = nlohmann::ordered_json::array();
  for (const Disagreement& one : found.disagreements) {
    disagreements.push_back({{"evaluation", one.evaluation},
                             {"column", one.column},
                             {"stored", one.stored},
                             {"found", one.found}});
  }
  const nlohmann::ordered_json json = {
      {"status", found.holds() ? "verified" : "refuted"},
      {"stored", found.stored},
      {"rerun", found.rerun},
      {"to_the_bit", found.to_the_bit},
      {"disagreements", disagreements},
      {"answer", found.answer},
      {"refuted", found.refuted ? nlohmann::ordered_json(*found.refuted) : nullptr},
      {"warnings", found.warnings}};
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace

int run_verify(const CommandLine& line) {
  const StudyResults results = read_results_input(line);
  VerifyOptions options;
  options.all = line.all;
  if (line.count) options.count = static_cast<std::size_t>(*line.count);
  const Verification found = verify_results(results, options);
  for (const std::string& warning : found.warnings) {
    print_err(fmt::format("linkstudy: warning: {}\n", warning));
  }
  print_out(line.json ? json_of(found) : text_of(found));
  return found.holds() ? kDone : kNotTuned;
}

}  // namespace linkstudy
