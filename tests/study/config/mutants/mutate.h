// Damage to the text of inputs, the same for the same seed and number.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace linkstudy::test {

// What is put into texts: every word and every value of the corpus, numbers at the edges, marks of
// the syntax, letters outside ASCII.
using Dictionary = std::vector<std::string>;

Dictionary make_dictionary(const std::vector<std::string>& corpus);

struct Mutant {
  std::size_t source = 0;  // in the corpus
  std::string text;
};

Mutant make_mutant(const std::vector<std::string>& corpus, const Dictionary& dictionary,
                   unsigned seed, int id);

}  // namespace linkstudy::test
