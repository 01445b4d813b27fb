// The time histories of a run as a table: a column a channel, a row an instant.
#pragma once

#include "core/simulation/observers.h"
#include "study/record/table.h"

namespace linkstudy {

Table series_table(const Series& series);

}  // namespace linkstudy
