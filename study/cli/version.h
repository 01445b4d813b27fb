// What was built: version, revision, compiler, libraries.
#pragma once

#include <string>

namespace linkstudy {

std::string program_version();  // "0.1.0"
std::string git_revision();     // "cbf8e1e", "" where it is not known
// The lines of --version.
std::string version_text();

}  // namespace linkstudy
