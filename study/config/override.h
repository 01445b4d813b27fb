// Setting a value by its path before validation: "joint.A.initial.position.0", "link.crank.mass",
// "closure.S.sde.stiffness.x". Elements of [[tables]] are addressed by name (or position).
// Overrides come from --set, from `set = {...}` of a study and from varied parameters; errors carry
// the place they were written.
#pragma once

#include <span>

#include "study/config/key.h"
#include "study/record/evaluation.h"

namespace linkstudy {

struct Override {
  std::string path;
  Tree value;
  Location origin;  // of the path
};

// "path=value" of --set: a number, a number and a unit, true or false, a word, a quoted text, or an
// inline TOML array or table. The place shown in errors is `--set path=value`.
std::optional<Override> parse_set(const std::string& text, Diagnostics& diagnostics);

// A point of a study as overrides.
Override make_override(const std::string& path, const Value& value);

// The entries of a `set` table; nested tables are read as dotted paths.
std::vector<Override> flatten_overrides(const Tree& set);

// A path with * for the element of [[tables]] as one path for each element of the document
// ("closure.*.sde.stiffness": that of every closure); without * itself.
std::vector<std::string> expand_path(const Tree& document, const KeyNode& schema,
                                     const std::string& path);

// Writes the value into the document, at every place of a path with *. A number becomes { all =
// number } when a component of it is set; setting one row of a group (damping, damping_ratio)
// removes the others; absent tables and arrays with a default are made. False when it was reported:
// the path names nothing.
bool set_value(Tree& document, const KeyNode& schema, const Override& override,
               Diagnostics& diagnostics);

// The row of a path that exists in the document (with *: everywhere), else nothing.
const KeyRow* find_row(const Tree& document, const KeyNode& schema, const std::string& path);

// Every path of one value that the document has, with the names written in it.
std::vector<std::string> value_paths(const Tree& document, const KeyNode& schema);

// "nearest: a, b, c"
std::string nearest_paths(const Tree& document, const KeyNode& schema, const std::string& path);

}  // namespace linkstudy
