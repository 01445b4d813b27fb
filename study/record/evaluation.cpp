#include "study/record/evaluation.h"

namespace linkstudy {

std::vector<std::string> cause_words() {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < kWords<Cause>.size(); ++i) {
    words.emplace_back(name_of(static_cast<Cause>(i)));
  }
  return words;
}

}  // namespace linkstudy
