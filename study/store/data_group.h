// What a results file is made of, whatever it is about: a tree of groups, each with columns over
// one axis and with attributes. Nothing here knows studies or mechanics.
// Rules: the columns of a group have one length. A first column with role "axis" (numbers) is the
// group's axis; without one the rows are numbered. Names are free text; a file stores them as
// [A-Za-z][A-Za-z0-9_]* and keeps the free text beside.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace linkstudy {

using ColumnValues = std::variant<std::vector<double>, std::vector<std::int64_t>,
                                  std::vector<std::uint8_t>, std::vector<std::string>>;

struct DataColumn {
  std::string name;       // "closure.S.force.x"
  std::string unit;       // SI; "" for pure numbers and words
  std::string long_name;  // meaning in words
  std::string role;       // "axis", "parameter", "response", ...
  ColumnValues values;
  std::vector<std::string> flag_meanings;  // bytes only: word i is the meaning of value i

  bool operator==(const DataColumn&) const = default;
};

struct DataAttribute {
  std::string name;
  std::variant<std::string, double, std::int64_t, std::uint64_t> value;

  bool operator==(const DataAttribute&) const = default;
};

struct DataGroup {
  std::string name;
  std::vector<DataColumn> columns;
  std::vector<DataAttribute> attributes;
  std::vector<DataGroup> groups;
  bool compressed = false;  // chunked, shuffled and deflated; for long histories

  bool operator==(const DataGroup&) const = default;
};

// Rows of a column.
std::size_t row_count(const DataColumn& column);

// The part with a name, or null.
const DataColumn* find_column(const DataGroup& group, std::string_view name);
const DataAttribute* find_attribute(const DataGroup& group, std::string_view name);
const DataGroup* find_group(const DataGroup& group, std::string_view name);

}  // namespace linkstudy
