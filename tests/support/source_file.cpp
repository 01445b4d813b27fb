#include "tests/support/source_file.h"

namespace linkstudy::testing {

std::string source_file(const std::string& path) {
  return std::string(LINKSTUDY_SOURCE_DIR) + "/" + path;
}

}  // namespace linkstudy::testing
