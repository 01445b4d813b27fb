// The program that runs, whatever revision it says it is of: SHA-256 of its executable file. A
// revision does not tell of changes that were not committed, nor of the compiler.
#pragma once

#include <string>

namespace linkstudy {

// 64 hexadecimal digits; empty where the file cannot be read.
std::string program_digest();

}  // namespace linkstudy
