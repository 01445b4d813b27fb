#include "study/record/findings.h"

#include <fmt/format.h>

#include "study/record/lines.h"

namespace linkstudy {
namespace {

constexpr std::size_t kLabelWidth = 13;

}  // namespace

std::string summary_line(std::string_view label, std::string_view value) {
  std::string text;
  std::string_view begin = label;
  for (const std::string& line : words_in_lines(value, kPageWidth - kLabelWidth)) {
    text += fmt::format("{:<{}}{}\n", begin, kLabelWidth, line);
    begin = "";
  }
  return text;
}

std::string text_of(const std::vector<Finding>& findings) {
  std::string text;
  for (const Finding& finding : findings) text += summary_line(finding.label, finding.text);
  return text;
}

Table findings_table(const std::vector<Finding>& findings) {
  TableOf<Finding> table("findings", "summary", findings);
  table.add("finding", "", "what it is about", [](const Finding& one) { return one.label; });
  table.add("text", "", "what was found", [](const Finding& one) { return one.text; });
  return table.take();
}

}  // namespace linkstudy
