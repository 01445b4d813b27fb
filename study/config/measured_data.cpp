#include "study/config/measured_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/classification.hpp>
#include <boost/algorithm/string/trim.hpp>
#include <charconv>
#include <cmath>
#include <limits>

#include "core/topology/nearest_name.h"
#include "study/config/key.h"
#include "study/config/toml_reader.h"

namespace linkstudy {
namespace {

constexpr std::size_t kMostReports = 10;  // of one file: more of the same help nobody

struct CsvCell {
  std::string text;
  int column = 0;
};

struct CsvLine {
  int number = 0;
  std::vector<CsvCell> cells;
};

std::string without_blanks(std::string_view text) {
  return boost::algorithm::trim_copy_if(std::string(text), boost::algorithm::is_any_of(" \t\r"));
}

// Columns count code points.
int code_points(std::string_view text) {
  return static_cast<int>(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

std::vector<CsvCell> split_line(std::string_view line, char separator) {
  std::vector<CsvCell> cells;
  std::string text;
  std::size_t begin = 0;
  bool is_quoted = false;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    const bool is_end = i == line.size() || (!is_quoted && line[i] == separator);
    if (is_end) {
      cells.push_back({without_blanks(text), code_points(line.substr(0, begin)) + 1});
      text.clear();
      begin = i + 1;
    } else if (line[i] != '"') {
      text += line[i];
    } else if (is_quoted && i + 1 < line.size() && line[i + 1] == '"') {
      text += line[i++];
    } else {
      is_quoted = !is_quoted;
    }
  }
  return cells;
}

char find_separator(std::string_view heads) {
  for (const char one : {'\t', ';'})
    if (heads.find(one) != std::string_view::npos) return one;
  return ',';
}

std::vector<CsvLine> split_text(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  std::vector<CsvLine> lines;
  char separator = ',';
  int number = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    ++number;
    const std::string content = without_blanks(line);
    if (content.empty() || content.front() == '#') continue;
    if (lines.empty()) separator = find_separator(line);
    lines.push_back({number, split_line(line, separator)});
  }
  return lines;
}

class CsvReader {
 public:
  CsvReader(const std::string& path, std::vector<CsvLine> lines, Diagnostics& diagnostics)
      : path_(path),
        file_(make_location(path).file),
        lines_(std::move(lines)),
        diagnostics_(diagnostics) {}

  // SI values of a column; empty when it was reported.
  MeasuredChannel read(const WantedColumn& wanted) {
    MeasuredChannel channel{wanted.channel, {}, wanted.channel_at, {}};
    const std::optional<std::size_t> column = find_head(wanted);
    if (!column || !read_unit(*column, channel)) return channel;
    const double factor = channel.unit ? channel.unit->factor : 1.0;
    for (std::size_t row = 1; row < lines_.size(); ++row) {
      const CsvLine& line = lines_[row];
      const bool is_there = *column < line.cells.size();
      channel.values.push_back(is_there ? factor * number_of_cell(line, *column)
                                        : std::numeric_limits<double>::quiet_NaN());
    }
    return channel;
  }

  // The numbers of a column as an array; incomplete when something was reported.
  Tree read_array(const WantedArray& wanted) {
    Tree array = Tree::make_array({}, wanted.column.channel_at);
    const std::optional<std::size_t> column = find_head(wanted.column);
    MeasuredChannel channel;
    if (!column || !read_unit(*column, channel)) return array;
    if (wanted.holds_words) {
      read_words(*column, array);
      return array;
    }
    const std::string unit = channel.unit ? find_unit(*channel.unit, wanted.units) : std::string();
    if (channel.unit && unit.empty()) {
      report(lines_.front(), *column,
             fmt::format("column '{}' must be in {}", wanted.column.head,
                         fmt::join(unit_alternatives(wanted.units), " or ")),
             "choose another column, or mend the unit of its head");
      return array;
    }
    const std::optional<Unit> to = unit.empty() ? std::nullopt : parse_unit(unit);
    for (std::size_t row = 1; row < lines_.size(); ++row) {
      const std::optional<double> written = written_number(lines_[row], *column);
      if (!written) continue;
      const double number = to ? *convert_unit(*written, *channel.unit, *to) : *written;
      array.items.push_back(Tree::make_number(number, place(lines_[row], *column)));
      array.items.back().text = unit;
    }
    return array;
  }

  void require_rising(const std::vector<double>& times, std::size_t column) {
    for (std::size_t i = 0; i < times.size(); ++i) {
      const bool is_right = std::isfinite(times[i]) && (i == 0 || times[i] > times[i - 1]);
      if (is_right) continue;
      report(lines_[i + 1], column,
             std::isfinite(times[i]) ? "this instant is not after the one before it"
                                     : "this line has no instant",
             "sort the lines by time, each with its own");
      return;
    }
  }

  std::optional<std::size_t> find_head(const WantedColumn& wanted) {
    const std::vector<CsvCell>& heads = lines_.front().cells;
    const auto found = std::ranges::find(heads, wanted.head, &CsvCell::text);
    if (found != heads.end()) return static_cast<std::size_t>(found - heads.begin());
    std::vector<std::string> names;
    for (const CsvCell& head : heads) names.push_back(head.text);
    diagnostics_.add(
        wanted.head_at, fmt::format("'{}' has no column '{}'", path_, wanted.head),
        fmt::format("nearest: {}", fmt::join(nearest_names(wanted.head, names, 3), ", ")));
    return std::nullopt;
  }

 private:
  bool read_unit(std::size_t column, MeasuredChannel& channel) {
    const CsvCell& head = lines_.front().cells[column];
    const std::size_t open = head.text.rfind('[');
    if (open == std::string::npos || head.text.back() != ']') return true;
    const std::string text = head.text.substr(open + 1, head.text.size() - open - 2);
    if (text.empty()) return true;
    UnitFault fault;
    channel.unit = parse_unit(text, &fault);
    if (channel.unit) return true;
    report(lines_.front(), column, fmt::format("'{}' is no unit", text),
           fault.hint.empty() ? "linkstudy describe units lists them" : fault.hint);
    return false;
  }

  // The first of "N|N m" that the unit can be converted to, or nothing.
  static std::string find_unit(const Unit& unit, const std::string& units) {
    for (const std::string& one : unit_alternatives(units)) {
      const std::optional<Unit> to = parse_unit(one);
      if (to && convert_unit(1.0, unit, *to)) return one;
    }
    return {};
  }

  void read_words(std::size_t column, Tree& array) {
    for (std::size_t row = 1; row < lines_.size(); ++row) {
      const CsvLine& line = lines_[row];
      const std::string word = column < line.cells.size() ? line.cells[column].text : "";
      if (word.empty()) {
        report(line, column, "this line has no word in the column", "every line needs its own");
      } else if (word == "true" || word == "false") {
        array.items.push_back(Tree::make_boolean(word == "true", place(line, column)));
      } else {
        array.items.push_back(Tree::make_text(word, place(line, column)));
      }
    }
  }

  // Of a line that must have one.
  std::optional<double> written_number(const CsvLine& line, std::size_t column) {
    const std::size_t before = reports_;
    const double number = column < line.cells.size() ? number_of_cell(line, column)
                                                     : std::numeric_limits<double>::quiet_NaN();
    if (std::isfinite(number)) return number;
    if (reports_ == before) {
      report(line, column, "this line has no number in the column",
             "every line of a table needs all of its numbers");
    }
    return std::nullopt;
  }

  double number_of_cell(const CsvLine& line, std::size_t column) {
    const std::string& text = line.cells[column].text;
    constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
    if (text.empty()) return kMissing;
    const char* begin = text.data() + (text.front() == '+' ? 1 : 0);
    const char* end = text.data() + text.size();
    double number = 0.0;
    const auto [at, error] = std::from_chars(begin, end, number);
    if (error == std::errc() && at == end && !std::isinf(number)) return number;
    report(line, column, fmt::format("'{}' is no number", text),
           "numbers have a decimal point; an empty cell or NaN is a missing sample");
    return kMissing;
  }

  void report(const CsvLine& line, std::size_t column, std::string message, std::string remedy) {
    if (reports_++ >= kMostReports) return;
    diagnostics_.add(place(line, column), std::move(message), std::move(remedy));
  }

  // Of a cell, or of the last where the line is too short.
  Location place(const CsvLine& line, std::size_t column) const {
    return {file_, line.number, line.cells[std::min(column, line.cells.size() - 1)].column};
  }

  const std::string& path_;
  std::shared_ptr<const std::string> file_;
  std::vector<CsvLine> lines_;
  Diagnostics& diagnostics_;
  std::size_t reports_ = 0;
};

bool require_numbers(const std::vector<CsvLine>& lines, const std::string& path, const Location& at,
                     Diagnostics& diagnostics) {
  if (lines.size() >= 2) return true;
  diagnostics.add(at, fmt::format("data '{}': there are no lines of numbers in it", path),
                  "a line of heads comes first, then a line for every instant");
  return false;
}

}  // namespace

std::optional<std::string> read_data_text(const std::string& path, const Location& at,
                                          Diagnostics& diagnostics) {
  Diagnostics unreadable;
  std::optional<std::string> text = read_text_file(path, unreadable);
  for (const Diagnostic& one : unreadable.sorted()) {
    diagnostics.add(at, fmt::format("data '{}': {}", path, one.message), one.remedy);
  }
  return unreadable.empty() ? text : std::nullopt;
}

std::shared_ptr<const MeasuredData> parse_measured_data(std::string text, const std::string& path,
                                                        const Location& at,
                                                        const std::vector<WantedColumn>& wanted,
                                                        Diagnostics& diagnostics) {
  auto data = std::make_shared<MeasuredData>();
  data->text = std::move(text);
  std::vector<CsvLine> lines = split_text(data->text);
  if (!require_numbers(lines, path, at, diagnostics)) return nullptr;
  Diagnostics found;
  CsvReader reader(path, std::move(lines), found);
  for (const WantedColumn& column : wanted) {
    MeasuredChannel channel = reader.read(column);
    if (column.channel != "time") {
      data->channels.push_back(std::move(channel));
      continue;
    }
    const bool is_time = !channel.unit || channel.unit->dimensions == std::array{0, 0, 1, 0};
    if (!is_time) {
      found.add(column.head_at, fmt::format("the unit of '{}' is none of time", column.head),
                "instants are in s, ms, min, ...");
    }
    if (found.empty()) reader.require_rising(channel.values, *reader.find_head(column));
    data->times = std::move(channel.values);
  }
  diagnostics.append(found);
  return found.empty() ? data : nullptr;
}

std::vector<WantedColumn> list_columns(const std::string& text, const std::string& path) {
  std::vector<WantedColumn> columns;
  const std::vector<CsvLine> lines = split_text(text);
  if (lines.empty()) return columns;
  const std::shared_ptr<const std::string> file = make_location(path).file;
  for (const CsvCell& head : lines.front().cells) {
    const Location at{file, lines.front().number, head.column};
    const bool has_unit = !head.text.empty() && head.text.back() == ']';
    const std::string name =
        head.text.substr(0, has_unit ? head.text.rfind('[') : head.text.size());
    columns.push_back({without_blanks(name), at, head.text, at});
  }
  return columns;
}

std::optional<std::vector<Tree>> parse_arrays(const std::string& text, const std::string& path,
                                              const Location& at,
                                              const std::vector<WantedArray>& wanted,
                                              Diagnostics& diagnostics) {
  std::vector<CsvLine> lines = split_text(text);
  if (!require_numbers(lines, path, at, diagnostics)) return std::nullopt;
  Diagnostics found;
  CsvReader reader(path, std::move(lines), found);
  std::vector<Tree> arrays;
  for (const WantedArray& one : wanted) arrays.push_back(reader.read_array(one));
  diagnostics.append(found);
  if (!found.empty()) return std::nullopt;
  return arrays;
}

}  // namespace linkstudy
