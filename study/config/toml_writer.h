// A Tree as TOML text: stable, and read back to the same content bit by bit. Values first, then
// [tables], then [[arrays of tables]]; deeper tables are written inline.
#pragma once

#include <string>

#include "study/config/tree.h"

namespace linkstudy {

std::string write_toml(const Tree& table);

}  // namespace linkstudy
