// An input as a small ordered tree: numbers, integers, booleans, texts, arrays and tables, each
// with the place it was written. Nothing here knows which keys exist.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "study/config/diagnostic.h"

namespace linkstudy {

struct Tree {
  // `invalid` marks a value that was already reported: nothing more is said about it.
  enum class Kind { invalid, boolean, integer, number, text, array, table };

  struct Key {
    std::string name;
    Location at;
  };

  Kind kind = Kind::invalid;
  Location at;  // where the value starts; of a [table], its header
  bool boolean = false;
  std::int64_t integer = 0;
  double number = 0.0;
  std::string text;         // a text; of a number, the unit it was converted to, if it had one
  std::vector<Tree> items;  // elements of an array, values of a table
  std::vector<Key> keys;    // of a table, parallel to items

  bool is(Kind other) const { return kind == other; }
  bool is_valid() const { return kind != Kind::invalid; }
  bool is_numeric() const { return kind == Kind::number || kind == Kind::integer; }
  bool is_scalar() const { return is_valid() && kind != Kind::array && kind != Kind::table; }
  double as_number() const { return kind == Kind::integer ? static_cast<double>(integer) : number; }

  // Of a table: the value of a key, or nothing.
  const Tree* find(std::string_view key) const;
  Tree* find(std::string_view key);
  const Key* find_key(std::string_view key) const;
  Tree& set(std::string_view key, Tree value);  // replaces or appends
  void erase(std::string_view key);

  static Tree make_boolean(bool value, Location at = {});
  static Tree make_integer(std::int64_t value, Location at = {});
  static Tree make_number(double value, Location at = {});
  static Tree make_text(std::string value, Location at = {});
  static Tree make_array(std::vector<Tree> items = {}, Location at = {});
  static Tree make_table(Location at = {});
};

// Same values; the order of keys, the places and the units once given do not count.
bool equal_content(const Tree& a, const Tree& b);

// Every value and key of the tree gets this place.
void relocate(Tree& tree, const Location& at);

// The value as a user would write it, shortened: "-1", "'heavy'", "[1, 2]", "a table".
std::string shown(const Tree& tree);

// Shortest text that reads back to the same bits (at most 17 significant digits), always a TOML
// float ("1.0", "1e-04"), never an integer.
std::string number_text(double value);

}  // namespace linkstudy
