// The content of a tree, apart from how it is written: the order of keys, places, and units once
// given do not count, and a whole number is the number it is. Two trees have equal bytes exactly
// when they say the same.
#pragma once

#include <optional>

#include "study/config/tree.h"
#include "study/record/bytes.h"

namespace linkstudy {

void put_content(ByteWriter& out, const Tree& tree);

// Where two trees first say something else: "closure.S.sde.stiffness", what each has there
// ("nothing" where it has no such key). Elements of tables are named by their names.
struct ContentDifference {
  std::string path;
  std::string first;
  std::string second;
};
std::optional<ContentDifference> find_difference(const Tree& first, const Tree& second);

}  // namespace linkstudy
