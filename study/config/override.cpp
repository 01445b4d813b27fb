#include "study/config/override.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/topology/nearest_name.h"
#include "study/config/toml_reader.h"
#include "study/config/unit.h"
#include "study/config/value_path.h"

namespace linkstudy {
namespace {

using Kind = Tree::Kind;

Tree* find_element(Tree& list, const std::string& name) {
  const std::optional<std::size_t> index = find_element_index(list, name);
  return index ? &list.items[*index] : nullptr;
}

bool is_list(KeyType type) {
  return type == KeyType::numbers || type == KeyType::scalars || type == KeyType::texts ||
         type == KeyType::matrix;
}

bool holds_keys(KeyType type) {
  return type == KeyType::table || type == KeyType::tables || type == KeyType::overrides;
}

// The array a path enters when the file does not write it.
std::optional<Tree> standard_array(const Tree& owner, const KeyNode& node) {
  if (node.standard) return node.standard;
  return node.row.derive ? node.row.derive(owner) : std::nullopt;
}

// Walks one path and makes what it needs on the way.
class Setter {
 public:
  Setter(Tree& document, const KeyNode& schema, const Override& override)
      : document_(document),
        schema_(schema),
        override_(override),
        parts_(split_path(override.path)) {}

  bool run() { return in_table(document_, schema_, 0); }

 private:
  bool in_table(Tree& table, const KeyNode& node, std::size_t at) {
    if (!table.is(Kind::table)) return false;
    const KeyNode* child = parts_[at] == "*" ? nullptr : node.find(parts_[at]);
    if (child == nullptr || child->row.type == KeyType::planned) return false;
    const bool is_last = at + 1 == parts_.size();
    if (is_last) return set_last(table, node, *child);
    if (child->row.type == KeyType::tables) return in_tables(table, *child, at + 1);
    if (is_list(child->row.type)) return in_array(table, node, *child, at + 1);
    if (!child->children.empty()) return in_inner_table(table, node, *child, at + 1);
    return false;
  }

  bool set_last(Tree& table, const KeyNode& node, const KeyNode& child) {
    const Tree& value = override_.value;
    if (holds_keys(child.row.type) && !value.is(Kind::table)) return false;
    if (child.row.type == KeyType::tables) return false;
    leave_group(table, node, child);
    Tree& place = table.set(child.name, value);
    relocate(place, value.at);
    if (child.row.type == KeyType::numbers && value.is_scalar()) {
      place = Tree::make_array({value}, value.at);
    }
    return true;
  }

  void leave_group(Tree& table, const KeyNode& node, const KeyNode& child) const {
    if (child.row.group.empty()) return;
    for (const KeyNode& other : node.children) {
      if (other.row.group == child.row.group && other.name != child.name) table.erase(other.name);
    }
  }

  bool in_tables(Tree& table, const KeyNode& child, std::size_t at) {
    Tree* list = table.find(child.name);
    if (list == nullptr || !list->is(Kind::array)) return false;
    Tree* element = find_element(*list, parts_[at]);
    if (element == nullptr || at + 1 == parts_.size()) return false;
    element_ = element;
    return in_table(*element, *child.element(), at + 1);
  }

  bool in_array(Tree& table, const KeyNode& node, const KeyNode& child, std::size_t at) {
    Tree* list = table.find(child.name);
    if (list == nullptr) {
      const std::optional<Tree> made = standard_array(element_ ? *element_ : document_, child);
      if (!made) return false;
      leave_group(table, node, child);
      list = &table.set(child.name, *made);
      relocate(*list, override_.value.at);
    }
    for (; at < parts_.size(); ++at) {
      const std::optional<std::size_t> index = parse_index(parts_[at]);
      if (!index || !list->is(Kind::array) || *index >= list->items.size()) return false;
      list = &list->items[*index];
    }
    if (list->is(Kind::array)) return false;
    *list = override_.value;
    return true;
  }

  bool in_inner_table(Tree& table, const KeyNode& node, const KeyNode& child, std::size_t at) {
    if (child.find(parts_[at]) == nullptr) return false;
    leave_group(table, node, child);
    Tree* inner = table.find(child.name);
    if (inner == nullptr) inner = &table.set(child.name, Tree::make_table(override_.value.at));
    if (child.row.type == KeyType::number_or_table && inner->is_scalar()) {
      Tree components = Tree::make_table(inner->at);
      components.set("all", *inner);
      *inner = std::move(components);
    }
    return in_table(*inner, child, at);
  }

  Tree& document_;
  const KeyNode& schema_;
  const Override& override_;
  std::vector<std::string> parts_;
  Tree* element_ = nullptr;  // the joint, link, ... the path runs through
};

// A part of the path after another, with every element in place of *.
class Expander {
 public:
  explicit Expander(const std::string& path) : parts_(split_path(path)) {}

  std::vector<std::string> run(const Tree& document, const KeyNode& schema) {
    expand(&document, &schema, 0, {});
    return std::move(paths_);
  }

 private:
  // Where the tree or the tables of keys end the rest is taken as it stands: what is wrong with it
  // is said by who uses it.
  void expand(const Tree* tree, const KeyNode* node, std::size_t at, const std::string& before) {
    if (at == parts_.size()) {
      paths_.push_back(before);
      return;
    }
    const std::string here = before.empty() ? parts_[at] : before + "." + parts_[at];
    const KeyNode* child = node != nullptr ? node->find(parts_[at]) : nullptr;
    const Tree* value = tree != nullptr && tree->is(Kind::table) ? tree->find(parts_[at]) : nullptr;
    const bool is_list = child != nullptr && child->row.type == KeyType::tables;
    if (!is_list || at + 1 == parts_.size()) return expand(value, child, at + 1, here);
    const std::string& element = parts_[at + 1];
    if (value == nullptr || !value->is(Kind::array)) return;
    bool is_found = element == "*";
    for (std::size_t i = 0; i < value->items.size(); ++i) {
      const Tree* own = value->items[i].find("name");
      const bool is_named = own != nullptr && own->is(Kind::text);
      const std::string name = is_named ? own->text : std::to_string(i);
      if (element != "*" && element != name && element != std::to_string(i)) continue;
      is_found = true;
      expand(&value->items[i], child->element(), at + 2, here + "." + name);
    }
    if (!is_found) expand(nullptr, nullptr, at + 2, here + "." + element);
  }

  std::vector<std::string> parts_;
  std::vector<std::string> paths_;
};

bool set_everywhere(Tree& document, const KeyNode& schema, const Override& override) {
  const std::vector<std::string> paths = expand_path(document, schema, override.path);
  return !paths.empty() && std::ranges::all_of(paths, [&](const std::string& path) {
    const Override one{path, override.value, override.origin};
    return Setter(document, schema, one).run();
  });
}

void add_value_paths(const Tree& table, const KeyNode& node, const std::string& path,
                     std::vector<std::string>& paths) {
  for (const KeyNode& child : node.children) {
    const std::string here = path.empty() ? child.name : path + "." + child.name;
    const KeyType type = child.row.type;
    if (type == KeyType::planned || type == KeyType::overrides || child.name == "*") continue;
    const Tree* value = table.find(child.name);
    if (type == KeyType::tables) {
      for (std::size_t i = 0; value != nullptr && i < value->items.size(); ++i) {
        const Tree* name = value->items[i].find("name");
        const bool named = name != nullptr && name->is(Kind::text);
        add_value_paths(value->items[i], *child.element(),
                        here + "." + (named ? name->text : std::to_string(i)), paths);
      }
      continue;
    }
    if (type != KeyType::table && child.name != "name" && here != "kind" && here != "format") {
      paths.push_back(here);
    }
    static const Tree kEmpty = Tree::make_table();
    add_value_paths(value != nullptr ? *value : kEmpty, child, here, paths);
  }
}

}  // namespace

std::optional<Override> parse_set(const std::string& text, Diagnostics& diagnostics) {
  const Location origin = make_location("--set " + text);
  const std::size_t mark = text.find('=');
  if (mark == std::string::npos || mark == 0 || mark + 1 == text.size()) {
    diagnostics.add(origin, fmt::format("--set must be path=value, got '{}'", text),
                    "for example --set link.crank.mass=\"2 kg\"");
    return std::nullopt;
  }
  const std::string value = text.substr(mark + 1);
  const auto make = [&](Tree tree) {
    relocate(tree, origin);
    return Override{text.substr(0, mark), std::move(tree), origin};
  };
  if (value.front() == '[' || value.front() == '{' || value.front() == '"') {
    const std::optional<Tree> tree = parse_toml("value = " + value, *origin.file, diagnostics);
    if (!tree) return std::nullopt;
    return make(*tree->find("value"));
  }
  return make(make_override({}, Value(value)).value);
}

Override make_override(const std::string& path, const Value& value) {
  const Location origin = make_location(path);
  const auto make = [&](Tree tree) { return Override{path, std::move(tree), origin}; };
  if (const double* number = std::get_if<double>(&value)) {
    return make(Tree::make_number(*number, origin));
  }
  const std::string& text = std::get<std::string>(value);
  if (text == "true" || text == "false") return make(Tree::make_boolean(text == "true", origin));
  const std::optional<WrittenQuantity> quantity = split_quantity(text);
  const bool is_number = quantity && quantity->unit.empty();
  return make(is_number ? Tree::make_number(quantity->value, origin)
                        : Tree::make_text(text, origin));
}

std::vector<Override> flatten_overrides(const Tree& set) {
  std::vector<Override> result;
  if (!set.is(Kind::table)) return result;
  for (std::size_t i = 0; i < set.items.size(); ++i) {
    const Tree::Key& key = set.keys[i];
    if (!set.items[i].is(Kind::table)) {
      result.push_back({key.name, set.items[i], key.at});
      continue;
    }
    for (Override& inner : flatten_overrides(set.items[i])) {
      inner.path = key.name + "." + inner.path;
      result.push_back(std::move(inner));
    }
  }
  return result;
}

std::vector<std::string> expand_path(const Tree& document, const KeyNode& schema,
                                     const std::string& path) {
  if (path.find('*') == std::string::npos) return {path};
  return Expander(path).run(document, schema);
}

bool set_value(Tree& document, const KeyNode& schema, const Override& override,
               Diagnostics& diagnostics) {
  if (override.path == "format" || override.path == "kind") {
    diagnostics.add(override.origin, fmt::format("'{}' cannot be set", override.path),
                    "it says what the file is");
    return false;
  }
  Tree trial = document;
  if (set_everywhere(trial, schema, override)) {
    document = std::move(trial);
    return true;
  }
  diagnostics.add(override.origin,
                  fmt::format("the path '{}' names no value of {}", override.path,
                              document.at.file ? *document.at.file : "the document"),
                  nearest_paths(document, schema, override.path));
  return false;
}

const KeyRow* find_row(const Tree& document, const KeyNode& schema, const std::string& path) {
  const KeyNode* node = &schema;
  for (const std::string& part : split_path(path)) {
    const bool into_list = is_list(node->row.type);
    if (into_list) break;
    const KeyNode* next = node->row.type == KeyType::tables ? node->element() : node->find(part);
    if (next == nullptr) return nullptr;
    node = next;
  }
  Tree trial = document;
  const Override probe{path, Tree::make_number(0.0), {}};
  return set_everywhere(trial, schema, probe) ? &node->row : nullptr;
}

std::vector<std::string> value_paths(const Tree& document, const KeyNode& schema) {
  std::vector<std::string> paths;
  add_value_paths(document, schema, {}, paths);
  return paths;
}

std::string nearest_paths(const Tree& document, const KeyNode& schema, const std::string& path) {
  const std::vector<std::string> paths = value_paths(document, schema);
  return fmt::format("nearest: {}", fmt::join(nearest_names(path, paths, 3), ", "));
}

}  // namespace linkstudy
