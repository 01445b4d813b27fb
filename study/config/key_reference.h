// The key reference, written from the key tables: `linkstudy describe` and configs/README.md.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace linkstudy {

// Every key under a path: "link", "link.*.mass", "link.crank.mass", "study.match", or everything
// for
// "". Nothing when no key is under it.
std::optional<std::string> describe(const std::string& path_prefix);

// One key in short, for comments in an input.
struct KeyDescription {
  std::string written;  // "scan = 16": the last part of its path and its default
  std::string comment;  // "mass; kg, > 0"
};

// path as in the tables ("link.*.mass"), kind one of the three. Throws std::logic_error where there
// is no such key.
KeyDescription describe_key(const std::string& kind, const std::string& path);

// For a prefix that names nothing: the nearest patterns.
std::vector<std::string> nearest_keys(const std::string& path_prefix);

// Three tables: model, study, tune.
std::string key_reference_markdown();

}  // namespace linkstudy
