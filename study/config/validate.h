// A tree against the key tables, in one pass and in place: unknown keys, types, units, ranges,
// lengths and words are judged, texts with units become numbers, defaults are filled in.
// What was reported becomes `invalid`, so that later passes say nothing more about it.
#pragma once

#include "study/config/key.h"

namespace linkstudy {

void validate(Tree& document, const KeyNode& schema, Diagnostics& diagnostics);

// One number against its row ("80 mm" becomes 0.08); false, and invalid, when it was reported.
bool validate_number(Tree& value, const KeyRow& row, const std::string& subject,
                     Diagnostics& diagnostics);

}  // namespace linkstudy
