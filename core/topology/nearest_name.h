// The name a user probably meant: the candidate with the smallest edit distance
//   d(a, b) = fewest insertions, deletions, substitutions and swaps of neighbours that turn a into
//   b
// (optimal string alignment, letters compared without case), offered only when d is at most a third
// of the longer name, at least 1.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace linkstudy {

int edit_distance(std::string_view a, std::string_view b);

// Empty when no candidate is near. Of equally near candidates the first one.
std::string nearest_name(std::string_view name, std::span<const std::string> candidates);

// Up to `count` candidates, nearest first, without a limit on the distance.
std::vector<std::string> nearest_names(std::string_view name,
                                       std::span<const std::string> candidates, std::size_t count);

// "did you mean 'crank'?" or "known: ground, crank, coupler".
std::string suggest_name(std::string_view name, std::span<const std::string> candidates);

// [A-Za-z][A-Za-z0-9_]*
bool is_legal_name(std::string_view name);

}  // namespace linkstudy
