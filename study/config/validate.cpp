#include "study/config/validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/topology/nearest_name.h"
#include "study/config/unit.h"

namespace linkstudy {
namespace {

using Kind = Tree::Kind;

std::string described_type(const KeyRow& row, KeyType type) {
  std::string unit = row.unit.empty() || row.unit == "1" ? std::string() : " in " + row.unit;
  for (std::size_t at = 0; (at = unit.find('|', at)) != std::string::npos;) {
    unit.replace(at, 1, " or ");
  }
  switch (type) {
    case KeyType::number:
      return "a number" + unit;
    case KeyType::number_or_table:
      return "a number" + unit + " or a table of them";
    case KeyType::number_or_numbers:
      return "a number" + unit + " or an array of them";
    case KeyType::numbers:
      return "an array of numbers" + unit;
    case KeyType::integer:
      return "an integer";
    case KeyType::boolean:
      return "true or false";
    case KeyType::word:
      return "a word in quotes";
    case KeyType::name:
      return "a name in quotes";
    case KeyType::text:
      return "a text in quotes";
    case KeyType::texts:
      return "an array of texts";
    case KeyType::matrix:
      return "a matrix [[..], [..], [..]] of three rows";
    case KeyType::scalar:
      return "one value";
    case KeyType::scalars:
      return "an array of values";
    case KeyType::tables:
      return "an array of tables";
    case KeyType::table:
    case KeyType::overrides:
    case KeyType::planned:
      break;
  }
  return "a table";
}

std::string described_type(const KeyRow& row) {
  return described_type(row, row.type);
}

// "link.*.shape" is written [[link.shape]].
std::string header_of(std::string path) {
  for (std::size_t at = 0; (at = path.find("*.", at)) != std::string::npos;) path.erase(at, 2);
  return "[[" + path + "]]";
}

std::string type_remedy(const KeyNode& node) {
  const KeyRow& row = node.row;
  if (row.type == KeyType::tables) return fmt::format("write {} before each", header_of(row.path));
  if (row.type == KeyType::word) return fmt::format("one of {}", fmt::join(row.words, ", "));
  return row.meaning;
}

std::string counts_text(const std::vector<int>& counts) {
  return fmt::format("{}", fmt::join(counts, " or "));
}

class Validator {
 public:
  explicit Validator(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  void check_table(Tree& table, const KeyNode& node, const Scope* scope) {
    check_unknown(table, node, scope);
    check_groups(table, node, scope);
    for (const bool conditional : {false, true}) {
      for (const KeyNode& child : node.children) {
        const bool is_conditional = !child.row.only.key.empty();
        if (child.name != "*" && is_conditional == conditional)
          check_key(table, node, child, scope);
      }
    }
  }

 private:
  // Every report marks its value, so that it stays the only one about it.
  void report(Tree& value, std::string message, std::string remedy) {
    diagnostics_.add(value.at, std::move(message), std::move(remedy));
    value.kind = Kind::invalid;
  }

  static std::string subject(const Scope* scope, std::string_view key) {
    return subject_of({.up = scope, .key = key});
  }

  void check_unknown(Tree& table, const KeyNode& node, const Scope* scope) {
    for (std::size_t i = 0; i < table.keys.size(); ++i) {
      const Tree::Key& key = table.keys[i];
      const KeyNode* child = key.name == "*" ? nullptr : node.find(key.name);
      if (child != nullptr && child->row.type != KeyType::planned) continue;
      table.items[i].kind = Kind::invalid;
      if (child != nullptr) {
        const std::size_t cut = child->row.meaning.find("; ");
        diagnostics_.add(
            key.at, fmt::format("{} is not supported in this version", subject(scope, key.name)),
            fmt::format("this key is for {}, which comes later; {}",
                        child->row.meaning.substr(0, cut), child->row.meaning.substr(cut + 2)));
      } else {
        diagnostics_.add(key.at, fmt::format("{} is not a known key", subject(scope, key.name)),
                         suggest_name(key.name, node.child_names()));
      }
    }
  }

  static bool is_present(const Tree& table, const KeyNode& child) {
    return table.find(child.name) != nullptr;
  }

  void check_groups(Tree& table, const KeyNode& node, const Scope* scope) {
    for (std::size_t i = 0; i < node.children.size(); ++i) {
      const KeyNode& child = node.children[i];
      if (child.row.group.empty() || !is_present(table, child)) continue;
      for (std::size_t k = 0; k < i; ++k) {
        const KeyNode& other = node.children[k];
        if (other.row.group != child.row.group || !is_present(table, other)) continue;
        report_exclusive(table, other.name, child.name, scope);
        break;
      }
    }
  }

  void report_exclusive(Tree& table, const std::string& a, const std::string& b,
                        const Scope* scope) {
    const Location& first = table.find_key(a)->at;
    const Location& second = table.find_key(b)->at;
    const bool a_is_later =
        std::pair(first.line, first.column) > std::pair(second.line, second.column);
    diagnostics_.add(a_is_later ? first : second,
                     fmt::format("{} and {} exclude each other", subject(scope, a), b),
                     "give one of them only");
    table.find(a_is_later ? a : b)->kind = Kind::invalid;
  }

  enum class Applies { yes, no, unknown };

  static Applies applies(const Tree& table, const Condition& only) {
    if (only.key.empty()) return Applies::yes;
    const Tree* value = table.find(only.key);
    if (value == nullptr || !value->is(Kind::text)) return Applies::unknown;
    const bool listed =
        std::find(only.words.begin(), only.words.end(), value->text) != only.words.end();
    return listed ? Applies::yes : Applies::no;
  }

  void check_key(Tree& table, const KeyNode& node, const KeyNode& child, const Scope* scope) {
    const Applies verdict = applies(table, child.row.only);
    Tree* value = table.find(child.name);
    if (value == nullptr) {
      if (verdict == Applies::yes) add_missing(table, node, child, scope);
      return;
    }
    if (!value->is_valid()) return;
    if (verdict == Applies::no) {
      diagnostics_.add(table.find_key(child.name)->at,
                       fmt::format("{} does not go with {} = '{}'", subject(scope, child.name),
                                   child.row.only.key, table.find(child.row.only.key)->text),
                       fmt::format("remove it; it goes with {} = {}", child.row.only.key,
                                   fmt::join(child.row.only.words, ", ")));
      value->kind = Kind::invalid;
      return;
    }
    const Scope inner{.up = scope, .key = child.name};
    check_value(*value, child, inner);
  }

  void add_missing(Tree& table, const KeyNode& node, const KeyNode& child, const Scope* scope) {
    std::vector<std::string> names = {child.name};
    if (!child.row.group.empty()) {
      names.clear();
      for (const KeyNode& other : node.children) {
        if (other.row.group != child.row.group) continue;
        if (is_present(table, other)) return;
        names.push_back(other.name);
      }
    }
    if (child.standard) {
      Tree& value = table.set(child.name, *child.standard);
      relocate(value, table.at);
      table.keys.back().at = table.at;
      const Scope inner{.up = scope, .key = child.name};
      check_value(value, child, inner);
    } else if (child.row.required) {
      diagnostics_.add(
          table.at,
          fmt::format("{} is missing", subject(scope, fmt::to_string(fmt::join(names, " or ")))),
          fmt::format("add {} = {}: {}", names[0], described_type(child.row), child.row.meaning));
      Tree invalid;
      invalid.at = table.at;
      table.set(child.name, std::move(invalid));
    }
  }

  void report_type(Tree& value, const KeyNode& node, const Scope& scope) {
    report(value,
           fmt::format("{} must be {}, got {}", subject_of(scope), described_type(node.row),
                       shown(value)),
           type_remedy(node));
  }

  void check_value(Tree& value, const KeyNode& node, const Scope& scope) {
    if (!value.is_valid()) return;
    switch (node.row.type) {
      case KeyType::number:
        return check_number(value, node.row, scope);
      case KeyType::number_or_table:
        return value.is(Kind::table) ? check_table(value, node, &scope)
                                     : check_number(value, node.row, scope);
      case KeyType::number_or_numbers:
        if (value.is(Kind::array) && value.items.empty()) return report_type(value, node, scope);
        return value.is(Kind::array) ? check_array(value, node, scope)
                                     : check_number(value, node.row, scope);
      case KeyType::integer:
        return check_integer(value, node, scope);
      case KeyType::boolean:
        return value.is(Kind::boolean) ? void() : report_type(value, node, scope);
      case KeyType::word:
        return check_word(value, node, scope);
      case KeyType::name:
      case KeyType::text:
        return check_text(value, node, scope);
      case KeyType::numbers:
      case KeyType::texts:
      case KeyType::scalars:
        return check_array(value, node, scope);
      case KeyType::matrix:
        return check_matrix(value, node, scope);
      case KeyType::scalar:
        return value.is_scalar() ? void() : report_type(value, node, scope);
      case KeyType::table:
        return value.is(Kind::table) ? check_table(value, node, &scope)
                                     : report_type(value, node, scope);
      case KeyType::tables:
        return check_tables(value, node, scope);
      case KeyType::overrides:
        return value.is(Kind::table) ? void() : report_type(value, node, scope);
      case KeyType::planned:
        return;
    }
  }

  void check_number(Tree& value, const KeyRow& row, const Scope& scope) {
    // The subject is made only where it may be reported: nearly all numbers are right.
    const bool is_right = value.is_numeric() && std::isfinite(value.as_number()) &&
                          row.range.contains(value.as_number());
    if (!is_right) {
      validate_number(value, row, subject_of(scope), diagnostics_);
    } else if (value.is(Kind::integer)) {
      value.number = value.as_number();
      value.kind = Kind::number;
    }
  }

  void check_integer(Tree& value, const KeyNode& node, const Scope& scope) {
    const bool whole = value.is(Kind::number) && std::abs(value.number) < 1.0e15 &&
                       value.number == std::floor(value.number);
    if (whole) value = Tree::make_integer(static_cast<std::int64_t>(value.number), value.at);
    if (!value.is(Kind::integer)) return report_type(value, node, scope);
    const Range& range = node.row.range;
    if (range.contains(static_cast<double>(value.integer))) return;
    const std::string wanted =
        range.low == range.high ? fmt::format("must be {}", range.low) : range_text(range);
    report(value, fmt::format("{} {}, got {}", subject_of(scope), wanted, value.integer),
           node.row.meaning);
  }

  void check_word(Tree& value, const KeyNode& node, const Scope& scope) {
    if (!value.is(Kind::text)) return report_type(value, node, scope);
    const auto among = [&](const std::vector<std::string>& words) {
      return std::find(words.begin(), words.end(), value.text) != words.end();
    };
    if (among(node.row.words)) return;
    const std::string all = fmt::format("{}", fmt::join(node.row.words, ", "));
    if (among(node.row.planned)) {
      return report(
          value,
          fmt::format("{} = '{}' is not supported in this version", subject_of(scope), value.text),
          "supported: " + all);
    }
    report(value, fmt::format("{} must be one of {}, got '{}'", subject_of(scope), all, value.text),
           suggest_name(value.text, node.row.words));
  }

  void check_text(Tree& value, const KeyNode& node, const Scope& scope) {
    if (!value.is(Kind::text)) return report_type(value, node, scope);
    const bool is_name = node.row.type == KeyType::name;
    if (is_name ? is_legal_name(value.text) : !value.text.empty()) return;
    report(value,
           fmt::format("{} must {}, got '{}'", subject_of(scope),
                       is_name ? "be a letter followed by letters, digits or _" : "not be empty",
                       value.text),
           node.row.meaning);
  }

  void check_array(Tree& value, const KeyNode& node, const Scope& scope) {
    if (!value.is(Kind::array)) return report_type(value, node, scope);
    const std::vector<int>& counts = node.row.counts;
    const int count = static_cast<int>(value.items.size());
    if (!counts.empty() && std::find(counts.begin(), counts.end(), count) == counts.end()) {
      return report(value,
                    fmt::format("{} must have {} entries, got {}", subject_of(scope),
                                counts_text(counts), count),
                    node.row.meaning);
    }
    for (std::size_t i = 0; i < value.items.size(); ++i) {
      check_item(value.items[i], node, {.up = &scope, .key = std::to_string(i)});
    }
    const auto broken = [](const Tree& item) { return !item.is_valid(); };
    if (std::any_of(value.items.begin(), value.items.end(), broken)) value.kind = Kind::invalid;
  }

  void check_item(Tree& item, const KeyNode& node, const Scope& scope) {
    if (!item.is_valid()) return;
    const bool is_numeric =
        node.row.type == KeyType::numbers || node.row.type == KeyType::number_or_numbers;
    if (is_numeric) return check_number(item, node.row, scope);
    if (node.row.type == KeyType::texts && !(item.is(Kind::text) && !item.text.empty())) {
      report(item, fmt::format("{} must be a text, got {}", subject_of(scope), shown(item)),
             node.row.meaning);
    } else if (node.row.type == KeyType::scalars && !item.is_scalar()) {
      report(item, fmt::format("{} must be one value, got {}", subject_of(scope), shown(item)),
             node.row.meaning);
    }
  }

  void check_matrix(Tree& value, const KeyNode& node, const Scope& scope) {
    if (!value.is(Kind::array)) return report_type(value, node, scope);
    if (value.items.size() != 3) {
      return report(
          value, fmt::format("{} must have 3 rows, got {}", subject_of(scope), value.items.size()),
          node.row.meaning);
    }
    KeyNode row = node;
    row.row.type = KeyType::numbers;
    row.row.counts = {3};
    bool broken = false;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string key = std::to_string(i);
      check_array(value.items[i], row, {.up = &scope, .key = key});
      broken = broken || !value.items[i].is_valid();
    }
    if (broken) value.kind = Kind::invalid;
  }

  void check_tables(Tree& value, const KeyNode& node, const Scope& scope) {
    if (!value.is(Kind::array)) return report_type(value, node, scope);
    if (value.items.empty() && node.row.required) {
      return report(value, fmt::format("{} needs at least one entry, got []", node.name),
                    type_remedy(node));
    }
    for (std::size_t i = 0; i < value.items.size(); ++i) {
      Tree& item = value.items[i];
      if (!item.is(Kind::table)) {
        if (item.is_valid()) report_type(item, node, scope);
        continue;
      }
      const Scope inner{.up = &scope, .key = {}, .element = &item, .index = i};
      check_table(item, *node.element(), &inner);
    }
  }

  Diagnostics& diagnostics_;
};

// The number of a text with a unit, in the first alternative of the same dimension.
bool convert_text(Tree& value, const KeyRow& row, const std::string& subject,
                  Diagnostics& diagnostics) {
  const auto fail = [&](std::string message, std::string remedy) {
    diagnostics.add(value.at, std::move(message), std::move(remedy));
    value.kind = Kind::invalid;
    return false;
  };
  const bool is_one_of_many =
      row.type == KeyType::numbers || row.type == KeyType::number_or_numbers;
  const std::string wanted = described_type(row, is_one_of_many ? KeyType::number : row.type);
  const std::string example = row.unit.empty()
                                  ? "write a plain number"
                                  : fmt::format("write a number, or a text such as \"1.5 {}\"",
                                                unit_alternatives(row.unit).front());
  const std::optional<WrittenQuantity> quantity = split_quantity(value.text);
  if (!quantity)
    return fail(fmt::format("{} must be {}, got {}", subject, wanted, shown(value)), example);
  if (quantity->unit.empty()) {
    return fail(
        fmt::format("{} must be {}, got the text {} without a unit", subject, wanted, shown(value)),
        "remove the quotes, or add the unit");
  }
  UnitFault fault;
  const std::optional<Unit> unit = parse_unit(quantity->unit, &fault);
  if (!unit) {
    return fail(fmt::format("{}: {} is not a unit, got {}", subject, fault.part, shown(value)),
                fault.hint.empty() ? example + "; linkstudy describe units" : fault.hint);
  }
  for (const std::string& alternative : unit_alternatives(row.unit)) {
    const std::optional<double> converted =
        convert_unit(quantity->value, *unit, *parse_unit(alternative));
    if (!converted) continue;
    value = Tree::make_number(*converted, value.at);
    value.text = alternative;
    return true;
  }
  std::string angle;
  for (const std::string& alternative : unit_alternatives(row.unit)) {
    if (angle.empty()) angle = explain_angle(*unit, *parse_unit(alternative));
  }
  return fail(fmt::format("{} must be {}, got {}", subject, wanted, shown(value)),
              angle.empty() ? example : angle);
}

}  // namespace

bool validate_number(Tree& value, const KeyRow& row, const std::string& subject,
                     Diagnostics& diagnostics) {
  const auto fail = [&](const std::string& wanted, std::string remedy) {
    diagnostics.add(value.at, fmt::format("{} {}, got {}", subject, wanted, shown(value)),
                    std::move(remedy));
    value.kind = Kind::invalid;
    return false;
  };
  if (value.is(Kind::text) && !convert_text(value, row, subject, diagnostics)) return false;
  if (!value.is_numeric()) return fail("must be " + described_type(row), row.meaning);
  if (value.is(Kind::integer)) value = Tree::make_number(value.as_number(), value.at);
  if (!std::isfinite(value.number)) {
    return fail("must be a finite number", "replace NaN and infinity by a number");
  }
  if (row.range.contains(value.number)) return true;
  std::string unit = value.text.empty() ? row.unit : value.text;
  unit = unit.empty() || unit.find('|') != std::string::npos ? std::string() : " " + unit;
  diagnostics.add(
      value.at, fmt::format("{} {}, got {}{}", subject, range_text(row.range), shown(value), unit),
      fmt::format("{}: a number {}{}", row.meaning, range_symbol(row.range), unit));
  value.kind = Kind::invalid;
  return false;
}

void validate(Tree& document, const KeyNode& schema, Diagnostics& diagnostics) {
  Validator(diagnostics).check_table(document, schema, nullptr);
}

}  // namespace linkstudy
