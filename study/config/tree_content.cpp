#include "study/config/tree_content.h"

#include <fmt/format.h>

#include <algorithm>

namespace linkstudy {
namespace {

enum class Tag : std::uint8_t { nothing, boolean, number, integer, text, array, table };

constexpr std::int64_t kExactIntegers = std::int64_t{1} << 53;

std::vector<std::size_t> sorted_by_key(const Tree& table) {
  std::vector<std::size_t> order(table.keys.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::sort(order, {},
                    [&](std::size_t i) -> const std::string& { return table.keys[i].name; });
  return order;
}

void put_integer(ByteWriter& out, std::int64_t value) {
  if (value > -kExactIntegers && value < kExactIntegers) {
    out.as<std::uint8_t>(Tag::number);
    out(static_cast<double>(value));
  } else {
    out.as<std::uint8_t>(Tag::integer);
    out(value);
  }
}

bool is_same(const Tree& first, const Tree& second) {
  ByteWriter a;
  ByteWriter b;
  put_content(a, first);
  put_content(b, second);
  return a.bytes() == b.bytes();
}

std::string joined(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

std::string name_of_item(const Tree& item, std::size_t position) {
  const Tree* name = item.is(Tree::Kind::table) ? item.find("name") : nullptr;
  return name != nullptr && name->is(Tree::Kind::text) ? name->text : std::to_string(position);
}

std::string shown_at(const Tree* tree) {
  return tree == nullptr ? "nothing" : shown(*tree);
}

std::optional<ContentDifference> find_below(const Tree& first, const Tree& second,
                                            const std::string& path);

std::optional<ContentDifference> find_in(const Tree* first, const Tree* second,
                                         const std::string& path) {
  if (first != nullptr && second != nullptr) return find_below(*first, *second, path);
  return ContentDifference{path, shown_at(first), shown_at(second)};
}

std::optional<ContentDifference> find_in_tables(const Tree& first, const Tree& second,
                                                const std::string& path) {
  for (const Tree::Key& key : first.keys) {
    const auto found = find_in(first.find(key.name), second.find(key.name), joined(path, key.name));
    if (found) return found;
  }
  for (const Tree::Key& key : second.keys) {
    if (first.find(key.name) != nullptr) continue;
    return find_in(nullptr, second.find(key.name), joined(path, key.name));
  }
  return std::nullopt;
}

// Lists of values are shown whole; of tables the first that differs.
std::optional<ContentDifference> find_in_arrays(const Tree& first, const Tree& second,
                                                const std::string& path) {
  const auto has_tables = [](const Tree& array) {
    return std::ranges::any_of(array.items,
                               [](const Tree& item) { return item.is(Tree::Kind::table); });
  };
  if (!has_tables(first) && !has_tables(second)) {
    return ContentDifference{path, shown(first), shown(second)};
  }
  for (std::size_t i = 0; i < std::max(first.items.size(), second.items.size()); ++i) {
    const Tree* a = i < first.items.size() ? &first.items[i] : nullptr;
    const Tree* b = i < second.items.size() ? &second.items[i] : nullptr;
    const auto found = find_in(a, b, joined(path, name_of_item(a != nullptr ? *a : *b, i)));
    if (found) return found;
  }
  return std::nullopt;
}

std::optional<ContentDifference> find_below(const Tree& first, const Tree& second,
                                            const std::string& path) {
  if (is_same(first, second)) return std::nullopt;
  if (first.is(Tree::Kind::table) && second.is(Tree::Kind::table)) {
    return find_in_tables(first, second, path);
  }
  if (first.is(Tree::Kind::array) && second.is(Tree::Kind::array)) {
    return find_in_arrays(first, second, path);
  }
  return ContentDifference{path, shown(first), shown(second)};
}

}  // namespace

void put_content(ByteWriter& out, const Tree& tree) {
  switch (tree.kind) {
    case Tree::Kind::invalid:
      return out.as<std::uint8_t>(Tag::nothing);
    case Tree::Kind::boolean:
      out.as<std::uint8_t>(Tag::boolean);
      return out.as<std::uint8_t>(tree.boolean);
    case Tree::Kind::integer:
      return put_integer(out, tree.integer);
    case Tree::Kind::number:
      out.as<std::uint8_t>(Tag::number);
      return out(tree.number);
    case Tree::Kind::text:
      out.as<std::uint8_t>(Tag::text);
      return out(tree.text);
    case Tree::Kind::array:
      out.as<std::uint8_t>(Tag::array);
      out(std::uint64_t{tree.items.size()});
      for (const Tree& item : tree.items) put_content(out, item);
      return;
    case Tree::Kind::table:
      out.as<std::uint8_t>(Tag::table);
      out(std::uint64_t{tree.items.size()});
      for (const std::size_t i : sorted_by_key(tree)) {
        out(tree.keys[i].name);
        put_content(out, tree.items[i]);
      }
      return;
  }
}

std::optional<ContentDifference> find_difference(const Tree& first, const Tree& second) {
  return find_below(first, second, "");
}

}  // namespace linkstudy
