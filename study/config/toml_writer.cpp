#include "study/config/toml_writer.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/topology/nearest_name.h"

namespace linkstudy {
namespace {

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) {
      result += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    } else {
      result += c;
    }
  }
  result += '"';
  return result;
}

std::string key_text(const std::string& key) {
  return is_legal_name(key) ? key : quoted(key);
}

std::string inline_text(const Tree& tree);

std::string joined_items(const Tree& tree) {
  std::string text;
  for (std::size_t i = 0; i < tree.items.size(); ++i) {
    if (i > 0) text += ", ";
    if (tree.is(Tree::Kind::table)) text += key_text(tree.keys[i].name) + " = ";
    text += inline_text(tree.items[i]);
  }
  return text;
}

std::string inline_text(const Tree& tree) {
  switch (tree.kind) {
    case Tree::Kind::boolean:
      return tree.boolean ? "true" : "false";
    case Tree::Kind::integer:
      return std::to_string(tree.integer);
    case Tree::Kind::number:
      return number_text(tree.number);
    case Tree::Kind::array:
      return fmt::format("[{}]", joined_items(tree));
    case Tree::Kind::table:
      return tree.items.empty() ? "{}" : fmt::format("{{ {} }}", joined_items(tree));
    case Tree::Kind::text:
    case Tree::Kind::invalid:
      break;
  }
  return quoted(tree.text);
}

bool is_array_of_tables(const Tree& tree) {
  return tree.is(Tree::Kind::array) && !tree.items.empty() &&
         std::all_of(tree.items.begin(), tree.items.end(),
                     [](const Tree& item) { return item.is(Tree::Kind::table); });
}

std::string lines(const Tree& table) {
  std::string text;
  for (std::size_t i = 0; i < table.items.size(); ++i) {
    text += key_text(table.keys[i].name) + " = " + inline_text(table.items[i]) + "\n";
  }
  return text;
}

}  // namespace

std::string write_toml(const Tree& table) {
  std::string values, tables, arrays;
  for (std::size_t i = 0; i < table.items.size(); ++i) {
    const Tree& item = table.items[i];
    const std::string key = key_text(table.keys[i].name);
    if (item.is(Tree::Kind::table)) {
      tables += "\n[" + key + "]\n" + lines(item);
    } else if (is_array_of_tables(item)) {
      for (const Tree& element : item.items) arrays += "\n[[" + key + "]]\n" + lines(element);
    } else {
      values += key + " = " + inline_text(item) + "\n";
    }
  }
  return values + tables + arrays;
}

}  // namespace linkstudy
