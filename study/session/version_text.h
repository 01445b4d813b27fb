// The lines of --version, which /provenance keeps.
#pragma once

#include <string>

namespace linkstudy {

// Throws SimdError.
std::string version_text();

}  // namespace linkstudy
