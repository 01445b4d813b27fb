// The words of enumerations: what stands for an enumerator in inputs, messages, results and
// documentation. An enumeration has one table, beside it, as a specialisation of kWords; its rows
// stand in the order in which they are shown. A table that lacks an enumerator does not compile.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>

namespace linkstudy {

template <class E>
struct Word {
  E value;
  std::string_view text;
  std::string_view meaning = {};  // empty: the word says it all
};

template <class E>
inline constexpr std::array<Word<E>, 0> kWords = {};

// Whether the enumeration has an enumerator of this value: compilers print others as "(E)3".
template <auto value>
consteval bool is_enumerator() {
  const std::string_view name = __PRETTY_FUNCTION__;
  return name[name.rfind("= ") + 2] != '(';
}

// The rows of a table of all n enumerators 0 .. n - 1 of E, or of a choice of two.
template <class E, std::size_t n>
consteval std::array<Word<E>, n> make_words(const Word<E> (&rows)[n]) {
  if constexpr (std::is_enum_v<E>) {
    const bool is_next_one_too = is_enumerator<static_cast<E>(n)>();
    if (is_next_one_too) throw "an enumerator has no word";
  }
  for (std::size_t i = 0; i < n; ++i) {
    const auto has_value = [&](const Word<E>& row) { return row.value == static_cast<E>(i); };
    const auto has_word = [&](const Word<E>& row) { return row.text == rows[i].text; };
    if (std::ranges::count_if(rows, has_value) != 1) throw "an enumerator needs one word";
    if (std::ranges::count_if(rows, has_word) != 1) throw "a word is that of two enumerators";
  }
  return std::to_array(rows);
}

template <class E>
requires std::is_enum_v<E>
constexpr std::string_view name_of(E value) {
  static_assert(!kWords<E>.empty(), "the header with the words of the enumeration is missing");
  return std::ranges::find(kWords<E>, value, &Word<E>::value)->text;
}

template <class E>
requires std::is_enum_v<E>
constexpr std::optional<E> find_word(std::string_view text) {
  static_assert(!kWords<E>.empty(), "the header with the words of the enumeration is missing");
  const auto row = std::ranges::find(kWords<E>, text, &Word<E>::text);
  return row == kWords<E>.end() ? std::nullopt : std::optional<E>(row->value);
}

}  // namespace linkstudy
