#include "study/store/data_group.h"

#include <algorithm>

namespace linkstudy {
namespace {

template <class Item>
const Item* find_named(const std::vector<Item>& items, std::string_view name) {
  const auto found = std::ranges::find(items, name, &Item::name);
  return found == items.end() ? nullptr : &*found;
}

}  // namespace

std::size_t row_count(const DataColumn& column) {
  return std::visit([](const auto& values) { return values.size(); }, column.values);
}

const DataColumn* find_column(const DataGroup& group, std::string_view name) {
  return find_named(group.columns, name);
}

const DataAttribute* find_attribute(const DataGroup& group, std::string_view name) {
  return find_named(group.attributes, name);
}

const DataGroup* find_group(const DataGroup& group, std::string_view name) {
  return find_named(group.groups, name);
}

}  // namespace linkstudy
