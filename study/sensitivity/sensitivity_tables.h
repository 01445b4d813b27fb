// Sensitivities as tables: "sensitivity", a row for each quantity and parameter with the columns of
// its method, and "failures", a row for each cause and parameter.
#pragma once

#include "study/record/table.h"
#include "study/sensitivity/sensitivity.h"

namespace linkstudy::sensitivity {

std::vector<Table> make_tables(const Sensitivity& result);

// One quantity, the strongest parameter first, without what others share.
Table make_quantity_table(const Sensitivity& result, const QuantitySensitivity& quantity);

Table make_failure_table(const Sensitivity& result);
// The same with values as ranges, for people.
Table make_failure_ranges(const Sensitivity& result);

}  // namespace linkstudy::sensitivity
