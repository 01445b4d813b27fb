#include "study/config/tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace linkstudy {
namespace {

Tree make(Tree::Kind kind, Location at) {
  Tree tree;
  tree.kind = kind;
  tree.at = std::move(at);
  return tree;
}

bool equal_tables(const Tree& a, const Tree& b) {
  if (a.keys.size() != b.keys.size()) return false;
  for (std::size_t i = 0; i < a.keys.size(); ++i) {
    const Tree* other = b.find(a.keys[i].name);
    if (other == nullptr || !equal_content(a.items[i], *other)) return false;
  }
  return true;
}

}  // namespace

const Tree* Tree::find(std::string_view key) const {
  for (std::size_t i = 0; i < keys.size(); ++i)
    if (keys[i].name == key) return &items[i];
  return nullptr;
}

Tree* Tree::find(std::string_view key) {
  return const_cast<Tree*>(static_cast<const Tree*>(this)->find(key));
}

const Tree::Key* Tree::find_key(std::string_view key) const {
  for (const Key& candidate : keys)
    if (candidate.name == key) return &candidate;
  return nullptr;
}

Tree& Tree::set(std::string_view key, Tree value) {
  if (Tree* old = find(key)) {
    *old = std::move(value);
    return *old;
  }
  keys.push_back({std::string(key), value.at});
  items.push_back(std::move(value));
  return items.back();
}

void Tree::erase(std::string_view key) {
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (keys[i].name != key) continue;
    keys.erase(keys.begin() + static_cast<std::ptrdiff_t>(i));
    items.erase(items.begin() + static_cast<std::ptrdiff_t>(i));
    return;
  }
}

Tree Tree::make_boolean(bool value, Location at) {
  Tree tree = make(Kind::boolean, std::move(at));
  tree.boolean = value;
  return tree;
}

Tree Tree::make_integer(std::int64_t value, Location at) {
  Tree tree = make(Kind::integer, std::move(at));
  tree.integer = value;
  return tree;
}

Tree Tree::make_number(double value, Location at) {
  Tree tree = make(Kind::number, std::move(at));
  tree.number = value;
  return tree;
}

Tree Tree::make_text(std::string value, Location at) {
  Tree tree = make(Kind::text, std::move(at));
  tree.text = std::move(value);
  return tree;
}

Tree Tree::make_array(std::vector<Tree> items, Location at) {
  Tree tree = make(Kind::array, std::move(at));
  tree.items = std::move(items);
  return tree;
}

Tree Tree::make_table(Location at) {
  return make(Kind::table, std::move(at));
}

bool equal_content(const Tree& a, const Tree& b) {
  if (a.kind != b.kind) return false;
  switch (a.kind) {
    case Tree::Kind::invalid:
      return true;
    case Tree::Kind::boolean:
      return a.boolean == b.boolean;
    case Tree::Kind::integer:
      return a.integer == b.integer;
    case Tree::Kind::number:
      return a.number == b.number && std::signbit(a.number) == std::signbit(b.number);
    case Tree::Kind::text:
      return a.text == b.text;
    case Tree::Kind::array:
      return std::equal(a.items.begin(), a.items.end(), b.items.begin(), b.items.end(),
                        equal_content);
    case Tree::Kind::table:
      return equal_tables(a, b);
  }
  return false;
}

void relocate(Tree& tree, const Location& at) {
  tree.at = at;
  for (Tree::Key& key : tree.keys) key.at = at;
  for (Tree& item : tree.items) relocate(item, at);
}

std::string shown(const Tree& tree) {
  switch (tree.kind) {
    case Tree::Kind::invalid:
      return "nothing";
    case Tree::Kind::boolean:
      return tree.boolean ? "true" : "false";
    case Tree::Kind::integer:
      return std::to_string(tree.integer);
    case Tree::Kind::number:
      return fmt::format("{:.9g}", tree.number);
    case Tree::Kind::text:
      return tree.text.size() <= 60 ? "'" + tree.text + "'"
                                    : "'" + tree.text.substr(0, 57) + "...'";
    case Tree::Kind::table:
      return "a table";
    case Tree::Kind::array:
      break;
  }
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(tree.items.size(), 7); ++i) {
    text += (i > 0 ? ", " : "") + (i < 6 ? shown(tree.items[i]) : std::string("..."));
  }
  return "[" + text + "]";
}

std::string number_text(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

}  // namespace linkstudy
