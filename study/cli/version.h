// What was built: version, revision, compiler, libraries.
#pragma once

#include <string>

namespace linkstudy {

std::string program_version();  // "0.1.0"
std::string git_revision();     // "cbf8e1e", "" where it is not known
// The step loops in use: "avx512, 8 lanes". Throws SimdError.
std::string simd_text();
// The lines of --version. Throws SimdError.
std::string version_text();

}  // namespace linkstudy
