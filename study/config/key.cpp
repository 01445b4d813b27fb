#include "study/config/key.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "study/config/toml_reader.h"

namespace linkstudy {
namespace {

Tree parse_default(const KeyRow& row) {
  Diagnostics diagnostics;
  const std::optional<Tree> tree = parse_toml("value = " + row.standard, row.path, diagnostics);
  if (!tree) throw std::logic_error("key table: bad default of " + row.path);
  return *tree->find("value");
}

KeyNode& descend(KeyNode& node, const std::string& name) {
  for (KeyNode& child : node.children)
    if (child.name == name) return child;
  node.children.push_back({.name = name, .row = {}, .standard = {}, .children = {}});
  node.children.back().row.type = KeyType::table;
  return node.children.back();
}

std::vector<std::string> split(std::string_view text, char mark) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(mark, begin), text.size());
    parts.emplace_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

}  // namespace

bool Range::contains(double value) const {
  const bool above = low_is_out ? value > low : value >= low;
  const bool below = high_is_out ? value < high : value <= high;
  return above && below;
}

bool Range::is_everything() const {
  return std::isinf(low) && std::isinf(high);
}

const KeyNode* KeyNode::find(std::string_view key) const {
  for (const KeyNode& child : children)
    if (child.name == key) return &child;
  return nullptr;
}

std::vector<std::string> KeyNode::child_names() const {
  std::vector<std::string> names;
  for (const KeyNode& child : children) {
    if (child.row.type != KeyType::planned) names.push_back(child.name);
  }
  return names;
}

KeyNode make_schema(const std::vector<KeyRow>& rows) {
  KeyNode root;
  root.row.type = KeyType::table;
  for (const KeyRow& row : rows) {
    KeyNode* node = &root;
    for (const std::string& part : split_path(row.path)) node = &descend(*node, part);
    node->row = row;
    if (!row.standard.empty()) node->standard = parse_default(row);
  }
  return root;
}

const std::vector<KeyRow>& key_rows(FileKind kind) {
  static const std::vector<std::vector<KeyRow>> rows = [] {
    std::vector<std::vector<KeyRow>> all;
    for (std::size_t i = 0; i < kWords<FileKind>.size(); ++i) {
      const auto one = static_cast<FileKind>(i);
      all.push_back(one == FileKind::model ? make_model_rows() : make_study_rows(one));
    }
    return all;
  }();
  return rows[static_cast<std::size_t>(kind)];
}

const KeyNode& key_schema(FileKind kind) {
  static const std::vector<KeyNode> schemas = [] {
    std::vector<KeyNode> all;
    for (std::size_t i = 0; i < kWords<FileKind>.size(); ++i) {
      all.push_back(make_schema(key_rows(static_cast<FileKind>(i))));
    }
    return all;
  }();
  return schemas[static_cast<std::size_t>(kind)];
}

std::vector<std::string> split_path(std::string_view path) {
  return split(path, '.');
}

std::string range_text(const Range& range) {
  if (range.low == 0.0 && std::isinf(range.high)) {
    return range.low_is_out ? "must be positive" : "must not be negative";
  }
  if (std::isinf(range.high)) {
    return fmt::format("must be {} {}", range.low_is_out ? "above" : "at least", range.low);
  }
  return fmt::format("must lie in {}{}, {}{}", range.low_is_out ? "(" : "[", range.low, range.high,
                     range.high_is_out ? ")" : "]");
}

std::string range_symbol(const Range& range) {
  if (range.is_everything()) return {};
  if (range.low == range.high) return fmt::format("{}", range.low);
  if (std::isinf(range.high)) return fmt::format("{} {}", range.low_is_out ? ">" : ">=", range.low);
  return fmt::format("{}{}, {}{}", range.low_is_out ? "(" : "[", range.low, range.high,
                     range.high_is_out ? ")" : "]");
}

std::vector<std::string> unit_alternatives(const std::string& unit) {
  return split(unit, '|');
}

}  // namespace linkstudy
