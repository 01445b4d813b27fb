#include "study/record/evaluation.h"

namespace linkstudy {

std::vector<std::string> cause_words() {
  return {kCauseNames.begin(), kCauseNames.end()};
}

}  // namespace linkstudy
