#include "study/page/page.h"

#include "study/page/page_data.h"

namespace linkstudy {
namespace {

std::string as_html(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (c == '<') {
      safe += "&lt;";
    } else if (c == '&') {
      safe += "&amp;";
    } else {
      safe += c;
    }
  }
  return safe;
}

}  // namespace

std::string page_of(const StudyResults& results, const MovingRuns& again) {
  const PageTexts& texts = page_texts();
  const std::string data = page_json(results, again);
  const std::string title = as_html(results.description.name);
  std::string page;
  std::string_view rest = texts.frame;
  while (!rest.empty()) {
    const std::size_t begin = rest.find('@');
    const std::size_t end = begin == rest.npos ? rest.npos : rest.find('@', begin + 1);
    page += rest.substr(0, begin);
    if (end == rest.npos) break;
    const std::string_view name = rest.substr(begin + 1, end - begin - 1);
    if (name == "title") page += title;
    if (name == "style") page += texts.style;
    if (name == "libraries") page += texts.libraries;
    if (name == "data") page += data;
    if (name == "script") page += texts.script;
    rest.remove_prefix(end + 1);
  }
  return page;
}

}  // namespace linkstudy
