// Columns and rows of a table by what a user writes.
//   rows       = comparison { ("and" | ",") comparison }
//   comparison = column ("=" | "==" | "!=" | "<" | "<=" | ">" | ">=") (number [unit] | word)
// A number may have a unit ("1e5 N/m") of the column's dimension; it equals what agrees to the six
// digits that tables show. Words are equal or not. A missing number satisfies nothing.
#pragma once

#include <string>
#include <vector>

#include "study/record/table.h"

namespace linkstudy {

// "a,b" in its parts; empty ones are left out.
std::vector<std::string> split_list(const std::string& text);

// Role of columns that are there for those who name them.
inline constexpr const char* kOnDemand = "on demand";

// The columns with these names, in their order; without names all but those on demand. Throws
// UsageError with the nearest names.
Table choose_columns(const Table& table, const std::vector<std::string>& names);

// The rows that satisfy every comparison; all for an empty text. Throws UsageError that says
// what is wrong, with the nearest names where a column is none.
Table choose_rows(const Table& table, const std::string& text);

}  // namespace linkstudy
