// Files of the source tree, for tests that read them.
#pragma once

#include <string>

namespace linkstudy::testing {

// `path` from the top folder of the project, absolute.
std::string source_file(const std::string& path);

}  // namespace linkstudy::testing
