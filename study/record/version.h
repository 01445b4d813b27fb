// What was built: version, revision, compiler, step loops.
#pragma once

#include <string>

namespace linkstudy {

struct WrittenReport;

std::string program_version();  // "0.1.0"
std::string git_revision();     // "cbf8e1e", "" where it is not known
std::string build_text();       // "Release, GNU 12.2.0"
std::string hdf5_version();     // "1.10.8"
// The step loops in use: "avx512, 8 lanes". Throws SimdError.
std::string simd_text();
// What runs the steps: "written for each linkage (AVX-512)", or "general (why)". Throws SimdError.
std::string kernels_text();
// Of this process so far: "2 step kernels written in 3.1 ms", what of it AVX2 serves since the
// AVX-512 code gave other bits, and which structures run by the general loop alone; "" for none.
std::string written_text();
std::string written_text(const WrittenReport& report);

}  // namespace linkstudy
