// Keys bound to members. Fields<Record> makes rows of the key tables (key.h) whose values fill the
// members of a Record: type, words and default of a row are those of its member.
//   Fields<Material> fields;
//   fields.add("young", &Material::young, {.meaning = "...", .unit = "Pa", .range = kPositive});
// A member is a pointer to member, or a function from the record to a reference.
#pragma once

#include <Eigen/Core>
#include <concepts>
#include <functional>
#include <span>
#include <type_traits>
#include <utility>

#include "core/base/words.h"
#include "study/config/key.h"
#include "study/config/override.h"

namespace linkstudy {

// A default as it is shown: shortest digits, powers of ten where the number is small or large.
std::string standard_text(double value);
std::string standard_text(const std::string& value);
std::string standard_text(const Eigen::Vector3d& value);
std::string standard_text(const Eigen::Matrix3d& value);

void fill_member(Eigen::Vector3d& member, const Tree& value);
void fill_member(Eigen::Matrix3d& member, const Tree& value);
void fill_member(std::vector<double>& member, const Tree& value);

// "cut: exact, by multipliers; sde: by a spring-damping element", behind what the row says itself.
struct WordMeaning {
  std::string_view text;
  std::string_view meaning;
};
std::string with_meanings(const std::string& meaning, const std::vector<WordMeaning>& words);

// A default beside that of the member could disagree with it.
void require_no_standard(const std::string& key, const KeyRow& row);

template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;

template <class T>
constexpr KeyType key_type_of() {
  if constexpr (std::is_same_v<T, bool>) {
    return KeyType::boolean;
  } else if constexpr (std::is_enum_v<T>) {
    return KeyType::word;
  } else if constexpr (std::is_integral_v<T>) {
    return KeyType::integer;
  } else if constexpr (std::is_same_v<T, std::string>) {
    return KeyType::text;
  } else if constexpr (std::is_same_v<T, Eigen::Matrix3d>) {
    return KeyType::matrix;
  } else if constexpr (std::is_same_v<T, std::vector<Override>>) {
    return KeyType::overrides;
  } else if constexpr (std::is_floating_point_v<T>) {
    return KeyType::number;
  } else {
    return KeyType::numbers;
  }
}

// `value` fits the row: validate() has seen to that.
template <class T>
void set_member(T& member, const Tree& value) {
  if constexpr (is_optional<T>) {
    set_member(member.emplace(), value);
  } else if constexpr (std::is_same_v<T, bool>) {
    member = value.boolean;
  } else if constexpr (std::is_enum_v<T>) {
    member = *find_word<T>(value.text);
  } else if constexpr (std::is_integral_v<T>) {
    member = static_cast<T>(value.integer);
  } else if constexpr (std::is_floating_point_v<T>) {
    member = value.as_number();
  } else if constexpr (std::is_same_v<T, std::string>) {
    member = value.text;
  } else if constexpr (std::is_same_v<T, std::vector<Override>>) {
    member = flatten_overrides(value);
  } else {
    fill_member(member, value);
  }
}

template <class T>
std::string standard_of(const T& member) {
  if constexpr (std::is_same_v<T, bool>) {
    return member ? "true" : "false";
  } else if constexpr (std::is_enum_v<T>) {
    return standard_text(std::string(name_of(member)));
  } else if constexpr (std::is_integral_v<T>) {
    return std::to_string(member);
  } else if constexpr (std::is_same_v<T, std::vector<Override>>) {
    return "{}";
  } else if constexpr (is_optional<T> || std::is_same_v<T, std::vector<double>>) {
    return {};
  } else {
    return standard_text(member);
  }
}

template <class E>
std::vector<std::string> word_texts(std::span<const E> values) {
  std::vector<std::string> texts;
  for (const E value : values) texts.emplace_back(name_of(value));
  return texts;
}

// The row applies where the neighbour holds one of these words.
template <class E>
Condition only_where(std::string key, std::initializer_list<E> values) {
  return {std::move(key), word_texts(std::span<const E>(values))};
}

// Effect where a switch holds one of some words (key.h).
template <class E>
Effect acts_where(std::string key, std::initializer_list<E> values, std::string needs = {}) {
  return {std::move(key), word_texts(std::span<const E>(values)), std::move(needs), false};
}

// The same of what is written for the switch to choose from.
template <class E>
Effect stands_by(std::string key, std::initializer_list<E> values) {
  return {std::move(key), word_texts(std::span<const E>(values)), {}, true};
}

// Of a table with a key `enabled`.
inline Effect when_enabled(const std::string& path) {
  return {path + ".enabled", {"true"}, {}, true};
}

template <class Record>
class Fields {
 public:
  // What is done with a value, in place of or after the member.
  using Hook = std::function<void(Record& record, Tree& value, const Reading& reading)>;

  // A key and its member. `then`: what the value says beyond it.
  template <class Member>
  void add(const std::string& key, Member member, KeyRow row, Hook then = {}) {
    using T = std::remove_cvref_t<std::invoke_result_t<Member, Record&>>;
    if (row.type == KeyType::number) row.type = key_type_of<typename Inner<T>::type>();
    if constexpr (std::is_enum_v<T>) add_words<T>(row, kWords<T>);
    require_no_standard(key, row);
    if (!row.required && !row.derive) {
      Record record{};
      row.standard = standard_of(std::invoke(member, record));
    }
    const Hook fill = [member, then](Record& record, Tree& value, const Reading& reading) {
      set_member(std::invoke(member, record), value);
      if (then) then(record, value, reading);
    };
    read(key, std::move(row), fill);
  }

  // A member of two values that are written as words.
  template <class Member>
  void add_choice(const std::string& key, Member member, const std::array<Word<bool>, 2>& words,
                  KeyRow row) {
    row.type = KeyType::word;
    add_words(row, words);
    require_no_standard(key, row);
    Record record{};
    const bool standard = std::invoke(member, record);
    row.standard =
        standard_text(std::string(std::ranges::find(words, standard, &Word<bool>::value)->text));
    read(key, std::move(row), [member, words](Record& to, Tree& value, const Reading&) {
      std::invoke(member, to) = std::ranges::find(words, value.text, &Word<bool>::text)->value;
    });
  }

  // A key without a member of its own; where it has no `hook`, another row of the table reads it.
  void read(const std::string& key, KeyRow row, Hook hook = {}) {
    row.path = key;
    if (hook) row.bind.fill = erased(std::move(hook));
    rows_.push_back(std::move(row));
  }

  // Keys of an enumeration that no member has.
  template <class E>
  void read_word(const std::string& key, KeyRow row, Hook hook = {}) {
    row.type = KeyType::word;
    add_words<E>(row, kWords<E>);
    read(key, std::move(row), std::move(hook));
  }

  // A table whose keys fill the same record.
  void table(const std::string& key, KeyRow row, Fields inner, Hook then = {}) {
    add_table(key, KeyType::table, std::move(row), std::move(inner), {}, std::move(then));
  }

  // A table whose keys fill a member; one that is optional exists where the table is written.
  template <class Member, class Part>
  void table(const std::string& key, Member member, KeyRow row, Fields<Part> inner,
             Hook then = {}) {
    add_table(key, KeyType::table, std::move(row), std::move(inner), part<Part>(member),
              std::move(then));
  }

  // The same with a first key `enabled`: false leaves the member empty.
  template <class Member, class Part>
  void switched_table(const std::string& key, Member member, KeyRow row, Fields<Part> inner,
                      const std::string& off) {
    Fields<Part> all;
    all.read("enabled", {.path = {}, .type = KeyType::boolean, .meaning = off, .standard = "true"});
    all.append(std::move(inner));
    table(key, member, std::move(row), std::move(all),
          [member](Record& record, Tree& table, const Reading&) {
            const Tree* enabled = table.find("enabled");
            const bool is_off = enabled != nullptr && enabled->is(Tree::Kind::boolean);
            if (is_off && !enabled->boolean) std::invoke(member, record).reset();
          });
  }

  // [[key]], one element of a vector each.
  template <class Member, class Element>
  void tables(const std::string& key, Member member, KeyRow row, Fields<Element> inner) {
    const auto append = [member](void* record) -> void* {
      return &std::invoke(member, *static_cast<Record*>(record)).emplace_back();
    };
    add_table(key, KeyType::tables, std::move(row), std::move(inner), append, {});
  }

  // [[key]] whose keys fill this record, or are read elsewhere.
  void tables(const std::string& key, KeyRow row, Fields inner) {
    add_table(key, KeyType::tables, std::move(row), std::move(inner), {}, {});
  }

  // The keys of a part beside those of the whole, in the same table.
  template <class Member, class Part>
  void include(Member member, Fields<Part> inner) {
    const std::function<void*(void*)> enter = part<Part>(member);
    for (KeyRow row : inner.rows_) {
      if (row.path.find('.') == std::string::npos) {
        row.bind.fill = of_part(enter, std::move(row.bind.fill));
        const auto deeper = std::move(row.bind.enter);
        const bool is_table = row.type == KeyType::table || row.type == KeyType::tables;
        if (is_table && !deeper) row.bind.enter = enter;
        if (deeper) row.bind.enter = [=](void* record) { return deeper(enter(record)); };
      }
      rows_.push_back(std::move(row));
    }
    join(of_part(enter, std::move(inner.finish_)));
  }

  // What the keys of the table say together, once each of them has been read.
  void finish(Hook hook) { join(erased(std::move(hook))); }

  void append(Fields other) {
    for (KeyRow& row : other.rows_) rows_.push_back(std::move(row));
    join(std::move(other.finish_));
  }

  // The same rows below a key of this table.
  Fields under(const std::string& prefix) && {
    for (KeyRow& row : rows_) row.path = prefix + row.path;
    return std::move(*this);
  }

  // The last row, for what a list of initialisers cannot say.
  KeyRow& back() { return rows_.back(); }

  const std::vector<KeyRow>& rows() const { return rows_; }

 private:
  template <class Other>
  friend class Fields;

  template <class T>
  struct Inner {
    using type = T;
  };
  template <class T>
  struct Inner<std::optional<T>> {
    using type = T;
  };

  static Binding::Fill erased(Hook hook) {
    if (!hook) return {};
    return [hook = std::move(hook)](void* record, Tree& value, const Reading& reading) {
      hook(*static_cast<Record*>(record), value, reading);
    };
  }

  static Binding::Fill of_part(const std::function<void*(void*)>& enter, Binding::Fill fill) {
    if (!fill) return {};
    return [enter, fill = std::move(fill)](void* record, Tree& value, const Reading& reading) {
      fill(enter(record), value, reading);
    };
  }

  template <class Part, class Member>
  static std::function<void*(void*)> part(Member member) {
    return [member](void* record) -> void* {
      auto& found = std::invoke(member, *static_cast<Record*>(record));
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(found)>, Part>) {
        return &found;
      } else {
        return &found.emplace();
      }
    };
  }

  // All words of the table, or those that the row names, in its order.
  template <class E, std::size_t n>
  static void add_words(KeyRow& row, const std::array<Word<E>, n>& words) {
    std::vector<WordMeaning> meanings;
    if (row.words.empty())
      for (const Word<E>& word : words) row.words.emplace_back(word.text);
    for (const std::string& text : row.words) {
      const auto word = std::ranges::find(words, text, &Word<E>::text);
      if (!word->meaning.empty()) meanings.push_back({word->text, word->meaning});
    }
    row.meaning = with_meanings(row.meaning, meanings);
  }

  template <class Part>
  void add_table(const std::string& key, KeyType type, KeyRow row, Fields<Part> inner,
                 std::function<void*(void*)> enter, Hook then) {
    row.path = key;
    row.type = type;
    row.bind = {erased(std::move(then)), std::move(enter), std::move(inner.finish_)};
    rows_.push_back(std::move(row));
    const std::string below = key + (type == KeyType::tables ? ".*." : ".");
    for (KeyRow& one : inner.rows_) {
      one.path = below + one.path;
      rows_.push_back(std::move(one));
    }
  }

  void join(Binding::Fill more) {
    if (!more) return;
    if (!finish_) {
      finish_ = std::move(more);
      return;
    }
    finish_ = [first = std::move(finish_), more](void* record, Tree& value,
                                                 const Reading& reading) {
      first(record, value, reading);
      more(record, value, reading);
    };
  }

  std::vector<KeyRow> rows_;
  Binding::Fill finish_;
};

}  // namespace linkstudy
