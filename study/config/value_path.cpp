#include "study/config/value_path.h"

#include <algorithm>
#include <charconv>

namespace linkstudy {
namespace {

using Kind = Tree::Kind;

// Follows the key tables and the document side by side.
class Finder {
 public:
  Finder(const Tree& document, const KeyNode& schema) : tree_(&document), node_(&schema) {}

  bool step(const std::string& part) {
    if (node_ == nullptr || (node_->children.empty() && node_->row.type != KeyType::table)) {
      return step_into_array(part);
    }
    return node_->row.type == KeyType::tables ? step_into_list(part) : step_into_table(part);
  }

  ValuePath path() && { return std::move(path_); }

 private:
  bool step_into_array(const std::string& part) {
    const std::optional<std::size_t> index = parse_index(part);
    if (!index) return false;
    add(std::to_string(*index), nullptr);
    return true;
  }

  bool step_into_list(const std::string& part) {
    if (part == "*") {
      tree_ = nullptr;
      add(part, node_->element());
      return true;
    }
    const bool is_list = tree_ != nullptr && tree_->is(Kind::array);
    const auto index = is_list ? find_element_index(*tree_, part) : std::nullopt;
    if (!index) return false;
    tree_ = &tree_->items[*index];
    add(std::to_string(*index), node_->element());
    return true;
  }

  bool step_into_table(const std::string& part) {
    const KeyNode* child = part == "*" ? nullptr : node_->find(part);
    if (child == nullptr) return false;
    tree_ = tree_ != nullptr && tree_->is(Kind::table) ? tree_->find(part) : nullptr;
    add(part, child);
    return true;
  }

  void add(std::string part, const KeyNode* node) {
    path_.parts.push_back(std::move(part));
    path_.nodes.push_back(node);
    node_ = node;
  }

  const Tree* tree_;
  const KeyNode* node_;
  ValuePath path_;
};

bool is_same_part(const std::string& a, const std::string& b) {
  return a == b || a == "*" || b == "*";
}

bool are_exclusive(const KeyNode* a, const KeyNode* b) {
  return a != nullptr && b != nullptr && !a->row.group.empty() && a->row.group == b->row.group;
}

}  // namespace

std::optional<std::size_t> parse_index(const std::string& text) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return index;
}

std::optional<std::size_t> find_element_index(const Tree& list, const std::string& name) {
  for (std::size_t i = 0; i < list.items.size(); ++i) {
    const Tree* own = list.items[i].find("name");
    if (own != nullptr && own->is(Kind::text) && own->text == name) return i;
  }
  const std::optional<std::size_t> index = parse_index(name);
  return index && *index < list.items.size() ? index : std::nullopt;
}

std::optional<ValuePath> find_value_path(const Tree& document, const KeyNode& schema,
                                         const std::string& path) {
  Finder finder(document, schema);
  for (const std::string& part : split_path(path))
    if (!finder.step(part)) return std::nullopt;
  return std::move(finder).path();
}

std::optional<std::string> unit_of_path(const Tree& document, const KeyNode& schema,
                                        const KeyRow& row, const std::string& path) {
  if (!row.units_by) return row.unit;
  const std::optional<ValuePath> value = find_value_path(document, schema, path);
  if (!value) return std::nullopt;
  const Tree* tree = &document;
  const Tree* element = nullptr;
  for (std::size_t i = 0; i < value->parts.size() && tree != nullptr; ++i) {
    const std::optional<std::size_t> index = parse_index(value->parts[i]);
    if (tree->is(Kind::array) && index && *index < tree->items.size()) {
      tree = &tree->items[*index];
      if (tree->is(Kind::table)) element = tree;
    } else if (tree->is(Kind::table) && value->nodes[i] != nullptr) {
      tree = tree->find(value->parts[i]);
    }
  }
  if (element == nullptr) return std::nullopt;
  const std::vector<std::string> units = row.units_by(document, *element);
  if (units.size() == 1) return units.front();
  const bool is_entry = value->nodes.back() == nullptr;
  const std::size_t entry = is_entry ? parse_index(value->parts.back()).value_or(0) : 0;
  return entry < units.size() ? std::optional(units[entry]) : std::nullopt;
}

PathRelation relation_of(const ValuePath& first, const ValuePath& second) {
  const std::size_t common = std::min(first.parts.size(), second.parts.size());
  for (std::size_t i = 0; i < common; ++i) {
    if (is_same_part(first.parts[i], second.parts[i])) continue;
    return are_exclusive(first.nodes[i], second.nodes[i]) ? PathRelation::excludes
                                                          : PathRelation::apart;
  }
  if (first.parts.size() == second.parts.size()) return PathRelation::same;
  return first.parts.size() < second.parts.size() ? PathRelation::contains
                                                  : PathRelation::contained;
}

PathRelation relation_of(const Tree& document, const KeyNode& schema, const std::string& first,
                         const std::string& second) {
  const auto a = find_value_path(document, schema, first);
  const auto b = find_value_path(document, schema, second);
  return a && b ? relation_of(*a, *b) : PathRelation::apart;
}

const Tree* find_value(const Tree& document, const KeyNode& schema, const std::string& path) {
  const std::optional<ValuePath> found = find_value_path(document, schema, path);
  if (!found) return nullptr;
  const Tree* value = &document;
  for (const std::string& part : found->parts) {
    if (value->is(Tree::Kind::array)) {
      const std::optional<std::size_t> index = parse_index(part);
      if (!index || *index >= value->items.size()) return nullptr;
      value = &value->items[*index];
      continue;
    }
    value = value->is(Tree::Kind::table) ? value->find(part) : nullptr;
    if (value == nullptr) return nullptr;
  }
  const Tree* all = value->is(Tree::Kind::table) ? value->find("all") : nullptr;
  return all != nullptr ? all : value;
}

}  // namespace linkstudy
