#include "study/config/value_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/topology/nearest_name.h"
#include "study/config/read_value.h"
#include "study/config/validate.h"

namespace linkstudy {
namespace {

using Kind = Tree::Kind;
constexpr double kMostValues = 1.0e6;

class ValueLister {
 public:
  ValueLister(const KeyRow& row, const std::string& unit, const std::string& parameter,
              std::optional<std::size_t> count, Diagnostics& diagnostics)
      : row_(row), unit_(unit), parameter_(parameter), count_(count), diagnostics_(diagnostics) {}

  std::vector<Tree> read(Tree& vary) {
    if (Tree* list = vary.find("values")) return read_values(*list);
    for (const char* form : {"lin", "log", "ladder"}) {
      Tree* value = vary.find(form);
      if (value == nullptr || !value->is_valid()) continue;
      if (!is_numeric_row(row_)) {
        fail(*value, fmt::format("'{}' takes no number, got {}", parameter_, form),
             "list its words with values = [...]");
        return {};
      }
      return form == std::string_view("ladder") ? read_ladder(*value) : read_interval(*value, form);
    }
    return {};
  }

 private:
  void fail(const Tree& value, std::string message, std::string remedy) {
    diagnostics_.add(value.at, std::move(message), std::move(remedy));
  }

  bool is_right(Tree& value) {
    return validate_value(value, row_, unit_, parameter_, diagnostics_);
  }

  std::vector<Tree> read_values(Tree& list) {
    if (!list.is(Kind::array)) return {};
    if (list.items.empty()) fail(list, "values must not be empty, got []", "give at least one");
    bool all_right = true;
    for (Tree& value : list.items) all_right = is_right(value) && all_right;
    return all_right ? list.items : std::vector<Tree>();
  }

  std::vector<Tree> read_interval(Tree& list, const std::string& form) {
    Tree& first = list.items[0];
    Tree& last = list.items[1];
    const bool first_is_right = is_right(first);
    if (!is_right(last) || !first_is_right) return {};
    const std::optional<std::size_t> n = count_ ? count_ : read_count(list.items[2], form);
    if (!n) return {};
    const bool is_log = form == "log";
    if (is_log && !(first.as_number() > 0.0 && last.as_number() > 0.0)) {
      fail(list, fmt::format("log needs positive ends, got {}", shown(list)), "use lin");
      return {};
    }
    return interval(first, last, *n, is_log);
  }

  std::optional<std::size_t> read_count(const Tree& count, const std::string& form) {
    const double n = count.is_numeric() ? count.as_number() : 0.0;
    if (!(n >= 2.0 && n <= kMostValues && n == std::floor(n))) {
      fail(count,
           fmt::format("the count of {} must be an integer of at {}, got {}", form,
                       n > kMostValues ? fmt::format("most {:.0f}", kMostValues) : "least 2",
                       shown(count)),
           fmt::format("{} = [first, last, count]", form));
      return std::nullopt;
    }
    return static_cast<std::size_t>(n);
  }

  static std::vector<Tree> interval(const Tree& first, const Tree& last, std::size_t n,
                                    bool is_log) {
    const double a = is_log ? std::log10(first.as_number()) : first.as_number();
    const double b = is_log ? std::log10(last.as_number()) : last.as_number();
    std::vector<Tree> values;
    for (std::size_t i = 0; i < n; ++i) {
      const double s = a + (b - a) * static_cast<double>(i) / static_cast<double>(n - 1);
      values.push_back(Tree::make_number(is_log ? std::pow(10.0, s) : s, first.at));
    }
    values.front().number = first.as_number();
    values.back() = last;
    return values;
  }

  std::vector<Tree> read_ladder(Tree& ladder) {
    Tree& from = *ladder.find("from");
    const Tree& ratio = *ladder.find("ratio");
    const Tree& levels = *ladder.find("levels");
    if (!from.is_valid() || !ratio.is_valid() || !levels.is_valid() || !is_right(from)) return {};
    if (ratio.as_number() == 1.0 || from.as_number() == 0.0) {
      fail(ladder, fmt::format("the levels of '{}' are all the same", parameter_),
           "give a ratio other than 1 and a start other than 0");
      return {};
    }
    std::vector<Tree> values;
    for (std::int64_t i = 0; i < levels.integer; ++i) {
      const double power = std::pow(ratio.as_number(), static_cast<double>(i));
      values.push_back(Tree::make_number(from.as_number() * power, from.at));
    }
    if (!is_right(values.back())) return {};
    return values;
  }

  const KeyRow& row_;
  const std::string& unit_;
  const std::string& parameter_;
  std::optional<std::size_t> count_;
  Diagnostics& diagnostics_;
};

}  // namespace

bool is_numeric_row(const KeyRow& row) {
  return row.type == KeyType::number || row.type == KeyType::number_or_table ||
         row.type == KeyType::numbers || row.type == KeyType::integer;
}

bool validate_value(Tree& value, const KeyRow& row, const std::string& unit,
                    const std::string& parameter, Diagnostics& diagnostics) {
  if (!value.is_valid()) return false;
  const auto fail = [&](const std::string& wanted, std::string remedy) {
    diagnostics.add(value.at, fmt::format("{} must be {}, got {}", parameter, wanted, shown(value)),
                    std::move(remedy));
    value.kind = Kind::invalid;
    return false;
  };
  if (is_numeric_row(row)) {
    KeyRow one = row;
    one.type = KeyType::number;
    one.unit = unit;
    if (!validate_number(value, one, parameter, diagnostics)) return false;
    const bool is_whole = value.number == std::floor(value.number);
    return row.type != KeyType::integer || is_whole || fail("an integer", row.meaning);
  }
  if (row.type == KeyType::boolean) {
    return value.is(Kind::boolean) || fail("true or false", row.meaning);
  }
  if (!value.is(Kind::text)) return fail("a word in quotes", row.meaning);
  const bool is_listed =
      std::find(row.words.begin(), row.words.end(), value.text) != row.words.end();
  if (row.type != KeyType::word || is_listed) return true;
  return fail(fmt::format("one of {}", fmt::join(row.words, ", ")),
              suggest_name(value.text, row.words));
}

std::vector<Tree> read_value_list(Tree& vary, const KeyRow& row, const std::string& unit,
                                  const std::string& parameter, std::optional<std::size_t> count,
                                  Diagnostics& diagnostics) {
  return ValueLister(row, unit, parameter, count, diagnostics).read(vary);
}

}  // namespace linkstudy
