#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "study/record/lines.h"
#include "study/report/table_cells.h"
#include "study/report/write_table.h"

namespace linkstudy {
namespace {

constexpr std::size_t kLeastHeadWidth = 10;  // names are broken into lines of no less

std::string latex_escaped(std::string_view text) {
  std::string safe;
  for (char c : text) {
    switch (c) {
      case '\\':
        safe += "\\textbackslash{}";
        break;
      case '^':
        safe += "\\textasciicircum{}";
        break;
      case '~':
        safe += "\\textasciitilde{}";
        break;
      case '#':
      case '$':
      case '%':
      case '&':
      case '_':
      case '{':
      case '}':
        safe += '\\';
        [[fallthrough]];
      default:
        safe += c;
    }
  }
  return safe;
}

// "N s/m" as \si{N.s/m}; what is no unit in the sense of siunitx as text.
std::string unit_of(const std::string& unit) {
  if (unit.empty() || unit == "1") return "";
  if (unit == "%") return "\\si{\\percent}";
  if (unit.find_first_of("#$%&_{}\\:") != std::string::npos) return latex_escaped(unit);
  std::string literal = unit;
  std::ranges::replace(literal, ' ', '.');
  return fmt::format("\\si{{{}}}", literal);
}

// "-2.5e-05" in its parts.
struct Digits {
  bool is_negative = false;
  std::string whole;
  std::string fraction;
  std::string exponent;  // "-5"

  std::string text() const {
    return (is_negative ? "-" : "") + whole + (fraction.empty() ? "" : "." + fraction) +
           (exponent.empty() ? "" : "e" + exponent);
  }
};

Digits split_number(std::string number) {
  Digits digits;
  digits.is_negative = number.starts_with('-');
  if (digits.is_negative) number.erase(0, 1);
  const std::size_t e = number.find('e');
  if (e != std::string::npos) digits.exponent = std::to_string(std::stoi(number.substr(e + 1)));
  const std::string mantissa = number.substr(0, e);
  const std::size_t point = mantissa.find('.');
  digits.whole = mantissa.substr(0, point);
  if (point != std::string::npos) digits.fraction = mantissa.substr(point + 1);
  return digits;
}

// "316228" as "3.16228e5", "0.00876" as "8.76e-3".
Digits in_powers_of_ten(const Digits& digits) {
  const std::string all = digits.whole + digits.fraction;
  const std::size_t first = all.find_first_not_of('0');
  if (first == std::string::npos) return digits;
  const int given = digits.exponent.empty() ? 0 : std::stoi(digits.exponent);
  const int shift = static_cast<int>(digits.whole.size()) - 1 - static_cast<int>(first);
  const std::string rest = all.substr(first + 1, all.find_last_not_of('0') - first);
  return {digits.is_negative, all.substr(first, 1), rest, std::to_string(given + shift)};
}

bool is_finite(const std::string& cell) {
  return !cell.empty() && cell.find("inf") == std::string::npos;
}

// The finite numbers of a column: all in powers of ten, with equally many decimals, where one is.
std::vector<std::optional<Digits>> numbers_of(const Column& column) {
  std::vector<std::optional<Digits>> numbers(row_count(column));
  bool has_powers = false;
  for (std::size_t row = 0; row < numbers.size(); ++row) {
    const std::string cell = shown(column, row, "");
    if (!is_finite(cell)) continue;
    numbers[row] = split_number(cell);
    has_powers = has_powers || !numbers[row]->exponent.empty();
  }
  if (!has_powers) return numbers;
  std::size_t decimals = 0;
  for (std::optional<Digits>& digits : numbers) {
    if (!digits) continue;
    digits = in_powers_of_ten(*digits);
    decimals = std::max(decimals, digits->fraction.size());
  }
  for (std::optional<Digits>& digits : numbers)
    if (digits) digits->fraction.resize(decimals, '0');
  return numbers;
}

// The digits that siunitx keeps room for: "-1.1e-1" for -2.5e-5.
std::string room_of(const std::vector<std::optional<Digits>>& numbers) {
  std::size_t whole = 1, fraction = 0, exponent = 0;
  bool has_minus = false, has_exponent_minus = false;
  for (const std::optional<Digits>& number : numbers) {
    if (!number) continue;
    const Digits& digits = *number;
    has_minus = has_minus || digits.is_negative;
    whole = std::max(whole, digits.whole.size());
    fraction = std::max(fraction, digits.fraction.size());
    const bool is_small = digits.exponent.starts_with('-');
    has_exponent_minus = has_exponent_minus || is_small;
    exponent = std::max(exponent, digits.exponent.size() - (is_small ? 1 : 0));
  }
  std::string room = fmt::format("{}{}", has_minus ? "-" : "", whole);
  if (fraction > 0) room += fmt::format(".{}", fraction);
  if (exponent > 0) room += fmt::format("e{}{}", has_exponent_minus ? "-" : "", exponent);
  return room;
}

struct LatexColumn {
  std::string alignment;
  std::vector<std::string> cells;
};

LatexColumn latex_column(const Column& column) {
  LatexColumn latex{"l", {}};
  std::vector<std::optional<Digits>> numbers(row_count(column));
  if (is_number(column)) {
    numbers = numbers_of(column);
    latex.alignment = fmt::format("S[table-format={}]", room_of(numbers));
  }
  for (std::size_t row = 0; row < numbers.size(); ++row) {
    const std::string cell = shown(column, row, "");
    const bool is_infinite = is_number(column) && !numbers[row] && !cell.empty();
    const std::string infinite = cell.starts_with('-') ? "{$-\\infty$}" : "{$\\infty$}";
    latex.cells.push_back(numbers[row]  ? numbers[row]->text()
                          : is_infinite ? infinite
                                        : latex_escaped(cell));
  }
  return latex;
}

std::string head_cell(const Column& column, const std::string& text) {
  return text.empty() || !is_number(column) ? text : "{" + text + "}";
}

template <class Content>
std::string line(const Table& table, Content content) {
  return joined_columns(table, " & ", content) + " \\\\\n";
}

// Names over several lines, at the bottom of the head.
std::string names_of(const Table& table, std::size_t rows) {
  std::vector<std::vector<std::string>> heads;
  std::size_t most = 0;
  for (const Column& column : table.columns) {
    std::size_t width = kLeastHeadWidth;
    for (std::size_t row = 0; row < rows; ++row) {
      width = std::max(width, text_width(shown(column, row, "")));
    }
    heads.push_back(wrapped(column.name, width));
    most = std::max(most, heads.back().size());
  }
  std::string text;
  for (std::size_t i = 0; i < most; ++i) {
    text += line(table, [&](const Column& column) {
      const auto& head = heads[static_cast<std::size_t>(&column - table.columns.data())];
      const std::size_t above = most - head.size();
      return head_cell(column, i < above ? "" : latex_escaped(head[i - above]));
    });
  }
  return text;
}

}  // namespace

std::string latex_of(const Table& table) {
  const std::size_t rows = row_count(table);
  std::vector<LatexColumn> columns;
  std::string text = "% \\usepackage{booktabs, siunitx}\n\\begin{tabular}{";
  for (const Column& column : table.columns) {
    columns.push_back(latex_column(column));
    text += " " + columns.back().alignment;
  }
  text += " }\n\\toprule\n" + names_of(table, rows);
  const bool has_units = std::ranges::any_of(
      table.columns, [](const Column& column) { return !unit_of(column.unit).empty(); });
  if (has_units) {
    text +=
        line(table, [](const Column& column) { return head_cell(column, unit_of(column.unit)); });
  }
  text += "\\midrule\n";
  for (std::size_t row = 0; row < rows; ++row) {
    text += line(table, [&](const Column& column) {
      return columns[static_cast<std::size_t>(&column - table.columns.data())].cells[row];
    });
  }
  return text + "\\bottomrule\n\\end{tabular}\n";
}

}  // namespace linkstudy
