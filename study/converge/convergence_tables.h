// A convergence study as tables: "convergence", a row for each level of each ladder, and "orders",
// a row for each ladder.
#pragma once

#include <vector>

#include "study/converge/convergence.h"
#include "study/record/table.h"

namespace linkstudy::convergence {

std::vector<Table> make_tables(const Convergence& result);

// The levels of one ladder, with what they all share as title; columns that say nothing are left
// out.
Table make_ladder_table(const QuantityLadder& ladder);
// Without the remarks and what is the same in all rows.
Table make_order_table(const Convergence& result);

}  // namespace linkstudy::convergence
