// The RSRRP linkage of tests/mechanisms/rsrrp.h as an input file: reference set R1, ready to run.
#pragma once

#include <string>

namespace linkstudy::test {

std::string rsrrp_text();

// `text` with `to` for `from`, which must be there exactly once.
std::string replaced(std::string text, const std::string& from, const std::string& to);

}  // namespace linkstudy::test
