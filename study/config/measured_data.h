// Measured histories and tables from a CSV file: a line of heads, then a line of numbers for every
// instant.
//   - heads may end in a unit in brackets, "Fx [kN]"; numbers are converted to SI units
//   - cells are separated by what separates the heads: tab, else ';', else ','; quotes: RFC 4180
//   - lines that begin with '#', and empty ones, are left out, as the units of `simulate --csv`
//   - an empty cell or NaN is a missing sample; instants must be there, and rise
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "study/config/tree.h"
#include "study/config/unit.h"

namespace linkstudy {

struct MeasuredChannel {
  std::string channel;         // of the model
  std::optional<Unit> unit{};  // of the head; none: SI, whatever the channel has
  Location at{};               // of the channel, where it was asked for
  std::vector<double> values;  // SI; NaN: missing
};

struct MeasuredData {
  std::vector<double> times;  // s
  std::vector<MeasuredChannel> channels;
  std::string text{};  // of the file
};

// A column of the file and what it is.
struct WantedColumn {
  std::string channel;  // "time", or a channel of the model
  Location channel_at;
  std::string head;
  Location head_at;
};

// A column whose cells are an array of an input.
struct WantedArray {
  WantedColumn column;
  std::string units;         // "N|N m": the head has a unit of one of them, or none
  bool holds_words = false;  // in place of numbers
};

// The text of a file; one that cannot be opened is reported at `at`.
std::optional<std::string> read_data_text(const std::string& path, const Location& at,
                                          Diagnostics& diagnostics);

// Nothing when anything was reported; `path` is the name of the text in messages.
std::shared_ptr<const MeasuredData> parse_measured_data(std::string text, const std::string& path,
                                                        const Location& at,
                                                        const std::vector<WantedColumn>& wanted,
                                                        Diagnostics& diagnostics);

// The columns of a text by their heads: the channel is the head without its unit.
std::vector<WantedColumn> list_columns(const std::string& text, const std::string& path);

// The columns as arrays of numbers in the unit that was wanted, each with its place in the file.
// Nothing when anything was reported: here every line needs its number, or its word.
std::optional<std::vector<Tree>> parse_arrays(const std::string& text, const std::string& path,
                                              const Location& at,
                                              const std::vector<WantedArray>& wanted,
                                              Diagnostics& diagnostics);

}  // namespace linkstudy
