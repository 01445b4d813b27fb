#include "study/session/stored_answer.h"

#include <nlohmann/json.hpp>

namespace linkstudy {

nlohmann::json stored_answer(const StudyResults& results) {
  if (results.answers.empty()) return nullptr;
  const Attribute* text = find_attribute(results.answers.front().tables, "answer");
  if (text == nullptr) return nullptr;
  return nlohmann::json::parse(std::get<std::string>(text->value), nullptr, false);
}

}  // namespace linkstudy
