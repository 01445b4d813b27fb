// One value of the model under whatever spelling: "link.0.mass" is "link.crank.mass",
// "joint.A.initial.position" holds "joint.A.initial.position.0".
#pragma once

#include "study/config/key.h"

namespace linkstudy {

struct ValuePath {
  std::vector<std::string> parts;     // elements of [[tables]] by their position, or *
  std::vector<const KeyNode*> nodes;  // (parts), nothing for indices into an array
};

// Nothing when the path names no key of the schema or no element of the document. A path of the
// key tables, with *, is one too.
std::optional<ValuePath> find_value_path(const Tree& document, const KeyNode& schema,
                                         const std::string& path);

// The element of [[tables]] by its name, or else by its position.
std::optional<std::size_t> find_element_index(const Tree& list, const std::string& name);

// How setting the second value bears on the first.
enum class PathRelation {
  apart,      // not at all
  same,       // it is the same value
  contains,   // it is a part of the first: stiffness, stiffness.x
  contained,  // the first is a part of it
  excludes    // the two cannot stand beside each other: damping, damping_ratio
};
PathRelation relation_of(const ValuePath& first, const ValuePath& second);

// relation_of with paths as they are written; those that name nothing are apart.
PathRelation relation_of(const Tree& document, const KeyNode& schema, const std::string& first,
                         const std::string& second);

// The value at a path without *, of a validated document; { all = value } stands for its value.
// Null where there is none.
const Tree* find_value(const Tree& document, const KeyNode& schema, const std::string& path);

// The unit of the value at `path`, which names one of the row; of an array, of its first entry.
// `document` may be validated or not. Nothing when the neighbours do not tell.
std::optional<std::string> unit_of_path(const Tree& document, const KeyNode& schema,
                                        const KeyRow& row, const std::string& path);

// A position in a list, written as a part of a path; nothing where it is none.
std::optional<std::size_t> parse_index(const std::string& text);

}  // namespace linkstudy
