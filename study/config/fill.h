// Records from a validated tree: every value fills the member that its row is bound to (fields.h).
// Defaults that depend on neighbours, and units that do, are settled here. What was reported leaves
// its member as it is in a new record.
#pragma once

#include "study/config/key.h"

namespace linkstudy {

// `record` is of the type whose Fields made the rows of the schema.
void fill_record(void* record, Tree& document, const KeyNode& schema, Diagnostics& diagnostics);

}  // namespace linkstudy
