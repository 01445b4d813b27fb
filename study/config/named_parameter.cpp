#include "study/config/named_parameter.h"

#include <fmt/format.h>

#include "study/config/value_list.h"

namespace linkstudy {

using Kind = Tree::Kind;

std::optional<NamedParameter> find_named_parameter(const ModelDocument& document, const Tree& path,
                                                   Diagnostics& diagnostics) {
  const std::optional<Parameter> parameter = parameter_for(document, path.text);
  const KeyRow* row = find_row(document.tree(), model_schema(), path.text);
  if (parameter && row != nullptr) return NamedParameter{*parameter, row};
  if (row != nullptr && path.text.find('*') != std::string::npos) {
    diagnostics.add(path.at,
                    fmt::format("parameter '{}' names values of several units, or none that one "
                                "number can have",
                                path.text),
                    "give each its own entry");
    return std::nullopt;
  }
  diagnostics.add(
      path.at, fmt::format("parameter names no value of {}, got '{}'", document.file(), path.text),
      nearest_paths(document.tree(), model_schema(), path.text));
  return std::nullopt;
}

std::optional<NamedRange> read_named_range(Tree& range, const NamedParameter& of,
                                           const Location& at, const std::string& deed,
                                           Diagnostics& diagnostics) {
  if (!is_numeric_row(*of.row) || of.row->type == KeyType::integer) {
    diagnostics.add(at,
                    fmt::format("'{}' is no real number and cannot be {}", of.parameter.path, deed),
                    "vary it in a study instead");
    return std::nullopt;
  }
  Tree* log = range.find("log");
  Tree* limits = log != nullptr ? log : range.find("lin");
  if (limits == nullptr || !limits->is(Kind::array)) return std::nullopt;
  bool is_right = true;
  for (Tree& limit : limits->items) {
    is_right = validate_value(limit, *of.row, of.parameter.unit, of.parameter.path, diagnostics) &&
               is_right;
  }
  if (!is_right) return std::nullopt;
  const NamedRange found{log != nullptr, limits->items[0].as_number(), limits->items[1].as_number(),
                         limits->items};
  if (found.low < found.high && (log == nullptr || found.low > 0.0)) return found;
  diagnostics.add(limits->at,
                  fmt::format("range must rise{}, got {}",
                              log != nullptr ? " from a positive number" : "", shown(*limits)),
                  "range = { log = [lowest, highest] }");
  return std::nullopt;
}

}  // namespace linkstudy
