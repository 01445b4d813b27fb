// The key tables: every key an input may have, declared once. From the same rows come validation,
// defaults, unit conversion, the members that are filled (fields.h, fill.h), `linkstudy describe`
// and configs/README.md.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "study/config/file_kind.h"
#include "study/config/scope.h"
#include "study/config/tree.h"

namespace linkstudy {

enum class KeyType {
  number,             // a number in `unit`, or a text with a unit
  number_or_table,    // the same, or a table of such numbers with rows of their own
  number_or_numbers,  // the same, or an array of at least one
  integer,
  boolean,
  word,       // one of `words`
  name,       // [A-Za-z][A-Za-z0-9_]*
  text,       // any text that is not empty
  texts,      // array of such texts
  numbers,    // array of numbers in `unit`, of one of the lengths `counts` (any, when empty)
  matrix,     // three rows of three numbers
  scalar,     // one value whose meaning another key decides: number, text or boolean
  scalars,    // array of those
  table,      // keys with rows of their own
  tables,     // [[array of tables]]; rows of elements follow "path.*."
  overrides,  // table of path = value
  planned     // a key of a later version: stops with `meaning`
};

struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_is_out = false;
  bool high_is_out = false;

  bool contains(double value) const;
  bool is_everything() const;
};

inline constexpr Range kPositive{.low = 0.0, .low_is_out = true};
inline constexpr Range kNotNegative{.low = 0.0};

// A row applies only where the neighbour key `key` holds one of `words`.
struct Condition {
  std::string key;
  std::vector<std::string> words;
};

// Where a row, and all rows under it, has an effect: the switch `key` ("closure.*.model"; * is the
// row's own element, or any where the row has none) holds one of `words`, or is not given where
// there are no words. Key "verb": what the program is asked to do. A switch is not subject to the
// effects that it decides itself.
struct Effect {
  std::string key;
  std::vector<std::string> words = {};
  // Table without which no word can be chosen: where it is absent too, nothing can ever give the
  // row an effect.
  std::string needs = {};
  // Written beside others for the switch to choose from: its rest is no surprise.
  bool stands_by = false;
};

// What is known where a value is read.
struct Reading {
  Tree& document;       // from the root, validated
  const Tree* element;  // the element of [[tables]] that the value is in, if any
  const Scope& scope;
  Diagnostics& diagnostics;

  void report(Tree& value, std::string message, std::string remedy) const {
    diagnostics.add(value.at, std::move(message), std::move(remedy));
    value.kind = Tree::Kind::invalid;
  }
};

// How a row fills the record of its table; made by Fields (fields.h). A row without is for another
// row of the table, which reads both.
struct Binding {
  using Fill = std::function<void(void* record, Tree& value, const Reading& reading)>;
  Fill fill;                                 // of a value; of a table, once its keys are filled
  std::function<void*(void* record)> enter;  // of a table: the record of its keys (a new element)
  Fill finish;                               // of a table: what its keys say together
};

struct KeyRow {
  std::string path = {};  // "link.*.mass"; * stands for the name (or position) of an element
  KeyType type = KeyType::number;
  std::string meaning = {};
  std::string unit = {};  // alternatives "N|N m" are told apart by the neighbours
  Range range = {};
  bool required = false;
  std::string standard = {};              // default, as TOML text; empty: none. Of a row with a
                                          // member: what a new record has
  std::vector<std::string> words = {};    // of a word
  std::vector<std::string> planned = {};  // words of a later version
  std::vector<int> counts = {};           // allowed lengths of `numbers`, `texts` and `scalars`
  std::string group =
      {};  // of the rows of a group, one at most is given (exactly one, if required)
  Condition only = {};
  std::vector<Effect> effects = {};  // all must hold; none: it always has one
  // Where the unit has alternatives: those that hold, one for each entry or one for all. Nothing
  // where the neighbours do not tell. The tree need not be validated.
  std::function<std::vector<std::string>(const Tree& document, const Tree& element)> units_by = {};
  // A default that depends on neighbours in the element of [[tables]], or none.
  std::function<std::optional<Tree>(const Tree& element)> derive = {};
  // Of the head of a column in a table's `columns`: the array of the table that the column holds
  // (table_files.h).
  std::string held = {};
  Binding bind = {};
};

// Rows as a tree that follows the tree of the input.
struct KeyNode {
  std::string name;
  KeyRow row;
  std::optional<Tree> standard;  // parsed default
  std::vector<KeyNode> children;

  const KeyNode* find(std::string_view key) const;
  const KeyNode* element() const { return find("*"); }  // of tables
  std::vector<std::string> child_names() const;         // without planned ones
};

KeyNode make_schema(const std::vector<KeyRow>& rows);

// The keys of a kind of files: a section of the reference.
const std::vector<KeyRow>& key_rows(FileKind kind);
const KeyNode& key_schema(FileKind kind);
inline const KeyNode& model_schema() {
  return key_schema(FileKind::model);
}

// Where the keys are declared: *_keys.cpp.
std::vector<KeyRow> make_model_rows();
std::vector<KeyRow> make_study_rows(FileKind kind);  // of all that vary a model

// "closure.S.sde" -> {"closure", "S", "sde"}
std::vector<std::string> split_path(std::string_view path);

// "must be positive", "must lie in (0, 1]"
std::string range_text(const Range& range);

// "> 0", "(0, 1]"; empty for everything
std::string range_symbol(const Range& range);

// "N|N m" -> {"N", "N m"}
std::vector<std::string> unit_alternatives(const std::string& unit);

}  // namespace linkstudy
