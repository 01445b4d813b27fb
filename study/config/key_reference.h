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

// For a prefix that names nothing: the nearest patterns.
std::vector<std::string> nearest_keys(const std::string& path_prefix);

// Three tables: model, study, tune.
std::string key_reference_markdown();

}  // namespace linkstudy
