#include "tests/study/config/mutants/mutate.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <random>
#include <set>

namespace linkstudy::test {
namespace {

const char* const kEdges[] = {"0",
                              "-0.0",
                              "-1",
                              "1",
                              "2",
                              "1e308",
                              "-1e308",
                              "5e-324",
                              "nan",
                              "inf",
                              "-inf",
                              "1e-300",
                              "1000000000",
                              "-9223372036854775808",
                              "9223372036854775807",
                              "99999999999999999999",
                              "0x7f",
                              "0.5",
                              "3.14159",
                              "1e5",
                              "\"90 deg\"",
                              "\"180 deg\"",
                              "\"1 mm\"",
                              "\"1e6 N/m\"",
                              "\"\"",
                              "\"x\"",
                              "true",
                              "false",
                              "1979-05-27",
                              "07:32:00",
                              "[]",
                              "{}",
                              "[0, 0, 0]",
                              "[1, 0, 0]",
                              "[[1,0,0],[0,1,0],[0,0,1]]",
                              "{ x = 1 }",
                              "\"closure.*.sde.stiffness\"",
                              "\"..\"",
                              "\"ground\""};
const char* const kMarks[] = {"[",
                              "]",
                              "[[",
                              "]]",
                              "{",
                              "}",
                              "=",
                              ".",
                              ",",
                              "#",
                              "\"",
                              "'",
                              "\"\"\"",
                              "'''",
                              "\\",
                              "\n",
                              "\r",
                              "\r\n",
                              "\t",
                              " ",
                              "[.a]",
                              "[=]",
                              "[#]",
                              "[[.x]]",
                              "a.b.c = 1\n",
                              "_",
                              "+",
                              "-",
                              ":",
                              "\\u00e9",
                              "\\U0001F600",
                              "\"\"\"\\\n  \xC3\xA9\"\"\"",
                              "\xC3\xA9",
                              "\xC2\xA0",
                              "\xE2\x80\x83",
                              "\xEF\xBB\xBF",
                              "\xF0\x9F\x98\x80",
                              "\xE3\x80\x80",
                              "\xC3"};

class Random {
 public:
  Random(unsigned seed, int id) {
    std::seed_seq sequence{seed, static_cast<unsigned>(id)};
    engine_.seed(sequence);
  }
  std::size_t below(std::size_t count) { return count == 0 ? 0 : engine_() % count; }
  const std::string& of(const std::vector<std::string>& list) { return list[below(list.size())]; }

 private:
  std::mt19937_64 engine_;  // its numbers are the same everywhere; those of distributions are not
};

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '-' ||
         c == '+';
}

struct Part {
  std::size_t begin = 0;
  std::size_t length = 0;
};

Part random_part(const std::string& text, Random& random, std::size_t most) {
  const std::size_t begin = random.below(text.size());
  return {begin, std::min(1 + random.below(most), text.size() - begin)};
}

Part random_word(const std::string& text, Random& random) {
  std::size_t begin = random.below(text.size());
  while (begin < text.size() && !is_word(text[begin])) ++begin;
  while (begin > 0 && begin < text.size() && is_word(text[begin - 1])) --begin;
  std::size_t end = begin;
  while (end < text.size() && is_word(text[end])) ++end;
  return {begin, end - begin};
}

Part random_line(const std::string& text, Random& random) {
  const std::size_t at = random.below(text.size());
  const std::size_t before = text.rfind('\n', at);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  const std::size_t after = text.find('\n', begin);
  return {begin, (after == std::string::npos ? text.size() : after + 1) - begin};
}

std::string cut(const std::string& text, const Part& part) {
  return text.substr(part.begin, part.length);
}

void damage(std::string& text, const std::vector<std::string>& corpus, const Dictionary& dictionary,
            Random& random) {
  if (text.empty()) text = random.of(corpus);
  const auto replace = [&text](const Part& part, const std::string& by) {
    text.replace(part.begin, part.length, by);
  };
  const std::string& other = random.of(corpus);
  switch (random.below(10)) {
    case 0: {  // one byte
      const auto byte = static_cast<char>(random.below(256));
      text[random.below(text.size())] = byte;
      break;
    }
    case 1:
      replace(random_part(text, random, 40), "");
      break;
    case 2: {
      const Part part = random_part(text, random, 200);
      text.insert(random.below(text.size()), cut(text, part));
      break;
    }
    case 3:
      text.resize(1 + random.below(text.size()));
      break;
    case 4:
      text.insert(random.below(text.size()), random.of(dictionary));
      break;
    case 5:  // a line of another input
      text.insert(random_line(text, random).begin, cut(other, random_line(other, random)));
      break;
    case 6:
      replace(random_line(text, random), "");
      break;
    case 7:
      replace(random_word(text, random), cut(other, random_word(other, random)));
      break;
    default:
      replace(random_word(text, random), random.of(dictionary));
  }
}

}  // namespace

Dictionary make_dictionary(const std::vector<std::string>& corpus) {
  std::set<std::string> words;
  for (const std::string& text : corpus) {
    std::string word;
    for (const char c : text + "\n") {
      if (is_word(c)) {
        word += c;
      } else if (!word.empty()) {
        words.insert(word);
        word.clear();
      }
    }
  }
  Dictionary dictionary(words.begin(), words.end());
  // As many edges and marks as words: each is drawn as often as all words together are.
  const std::size_t count = dictionary.size();
  for (std::size_t i = 0; i < count; ++i) {
    dictionary.push_back(kEdges[i % std::size(kEdges)]);
    dictionary.push_back(kMarks[i % std::size(kMarks)]);
  }
  return dictionary;
}

Mutant make_mutant(const std::vector<std::string>& corpus, const Dictionary& dictionary,
                   unsigned seed, int id) {
  Random random(seed, id);
  Mutant mutant;
  mutant.source = random.below(corpus.size());
  mutant.text = corpus[mutant.source];
  const std::size_t wounds = 1 + random.below(3);
  for (std::size_t i = 0; i < wounds; ++i) damage(mutant.text, corpus, dictionary, random);
  return mutant;
}

}  // namespace linkstudy::test
