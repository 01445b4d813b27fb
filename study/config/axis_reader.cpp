#include "study/config/axis_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "study/config/read_value.h"
#include "study/config/validate.h"
#include "study/config/value_list.h"
#include "study/config/value_path.h"

namespace linkstudy {
namespace {

using Kind = Tree::Kind;

constexpr std::array kForms = {"values", "lin", "log", "ladder", "around", "normal", "triangular"};
constexpr double kLeastShare = 1e-6;  // of a normal distribution within its bounds

std::vector<std::string> forms_of(Design design) {
  switch (design) {
    case Design::grid:
    case Design::list:
      return {"values", "lin", "log", "ladder", "around"};
    case Design::centered:
      return {"around"};
    case Design::latin_hypercube:
    case Design::sobol:
    case Design::saltelli:
      return {"lin", "log", "normal", "triangular"};
    case Design::vector:
    case Design::morris:
      break;
  }
  return {"lin", "log"};
}

class AxisReader {
 public:
  AxisReader(const NamedParameter& of, const DesignOptions& design, const ModelDocument& document,
             Diagnostics& diagnostics)
      : of_(of), design_(design), document_(document), diagnostics_(diagnostics) {}

  std::optional<ReadAxis> read(Tree& vary) {
    const auto given =
        std::ranges::find_if(kForms, [&](const char* one) { return vary.find(one) != nullptr; });
    if (given == kForms.end()) return std::nullopt;  // said by its rows
    form_ = *given;
    Tree& value = *vary.find(form_);
    const std::vector<std::string> known = forms_of(design_.type);
    if (std::ranges::find(known, form_) == known.end()) {
      fail(vary.find_key(form_)->at,
           fmt::format("'{}': {} does not go with a design of type '{}'", of_.parameter.path, form_,
                       name_of(design_.type)),
           fmt::format("it takes {}", fmt::join(known, ", ")));
      return std::nullopt;
    }
    if (!value.is_valid() || !has_right_count(value)) return std::nullopt;
    if (form_ == "around") return read_around(value);
    if (is_sampled(design_.type)) return read_sampled(value);
    return read_values(vary);
  }

 private:
  void fail(const Location& at, std::string message, std::string remedy) {
    diagnostics_.add(at, std::move(message), std::move(remedy));
  }

  bool is_list() const { return design_.type == Design::grid || design_.type == Design::list; }

  // lin and log have a count where the design has none of its own.
  bool has_right_count(const Tree& value) {
    if (form_ != "lin" && form_ != "log") return true;
    const std::size_t wanted = is_list() ? 3 : 2;
    if (value.items.size() == wanted) return true;
    const char* entries = is_list()                        ? "[first, last, count]"
                          : design_.type == Design::vector ? "[first, last]"
                                                           : "[lowest, highest]";
    fail(value.at,
         fmt::format("'{}': {} is {} in a design of type '{}', got {} entries", of_.parameter.path,
                     form_, entries, name_of(design_.type), value.items.size()),
         fmt::format("{} = {}", form_, entries));
    return false;
  }

  std::optional<ReadAxis> read_values(Tree& vary) {
    std::optional<std::size_t> count;
    if (design_.type == Design::vector) {
      if (!takes_real_numbers(vary.find(form_)->at, "moved in steps")) return std::nullopt;
      count = design_.steps + 1;
    }
    ReadAxis axis;
    axis.values = read_value_list(vary, *of_.row, of_.parameter.unit, of_.parameter.path, count,
                                  diagnostics_);
    return axis.values.empty() ? std::nullopt : std::optional(std::move(axis));
  }

  // A real number: whole numbers and words have no values between others.
  bool takes_real_numbers(const Location& at, const char* deed) {
    if (is_numeric_row(*of_.row) && of_.row->type != KeyType::integer) return true;
    fail(at, fmt::format("'{}' is no real number and cannot be {}", of_.parameter.path, deed),
         "list its values in a grid or a list");
    return false;
  }

  bool is_right(Tree& value) {
    return validate_value(value, *of_.row, of_.parameter.unit, of_.parameter.path, diagnostics_);
  }

  // A number in the unit of the parameter that is none of its values.
  std::optional<double> read_length(Tree& value, const std::string& key) {
    if (!value.is_valid()) return std::nullopt;
    KeyRow row = *of_.row;
    row.type = KeyType::number;
    row.unit = of_.parameter.unit;
    row.range = kPositive;
    const std::string subject = fmt::format("{} of '{}'", key, of_.parameter.path);
    if (!validate_number(value, row, subject, diagnostics_)) return std::nullopt;
    return value.as_number();
  }

  std::optional<ReadAxis> read_around(Tree& around) {
    if (!takes_real_numbers(around.at, "moved in steps")) return std::nullopt;
    const auto center = read_center(around);
    Tree* step = around.find("step");
    const Tree* ratio = around.find("ratio");
    const std::int64_t steps = integer_of(around, "steps", 0);
    const std::optional<double> length = step ? read_length(*step, "step") : std::nullopt;
    const bool is_known = center && steps > 0 && (length || (ratio && ratio->is_valid()));
    if (!is_known) return std::nullopt;
    const bool stands_still = !length && (ratio->as_number() == 1.0 || *center == 0.0);
    if (stands_still) {
      fail(around.at, fmt::format("the values of '{}' are all the same", of_.parameter.path),
           "give a ratio other than 1 and a centre other than 0, or a step");
      return std::nullopt;
    }
    ReadAxis axis;
    axis.center = static_cast<std::size_t>(steps);
    for (std::int64_t i = -steps; i <= steps; ++i) {
      const auto n = static_cast<double>(i);
      const double value =
          length ? *center + n * *length : *center * std::pow(ratio->as_number(), n);
      axis.values.push_back(Tree::make_number(i == 0 ? *center : value, around.at));
    }
    if (!is_right(axis.values.front()) || !is_right(axis.values.back())) return std::nullopt;
    return axis;
  }

  std::optional<double> read_center(Tree& around) {
    if (Tree* center = around.find("center")) {
      return is_right(*center) ? std::optional(center->as_number()) : std::nullopt;
    }
    Diagnostics ignored;  // a model that is complete in its cases only has no value of its own
    const auto model = document_.with({}, ignored);
    const Tree* own =
        model ? find_value(model->resolved, model_schema(), of_.parameter.path) : nullptr;
    const bool is_only_one = own != nullptr && own->is(Kind::array) && own->items.size() == 1;
    if (is_only_one) own = &own->items.front();  // of a joint with one coordinate
    if (own != nullptr && own->is_numeric()) {
      around.set("center", Tree::make_number(own->as_number(), around.at));
      return own->as_number();
    }
    fail(around.at,
         fmt::format("the model has no value of '{}' to step around", of_.parameter.path),
         "say it: around = { center = ..., ... }");
    return std::nullopt;
  }

  std::optional<ReadAxis> read_sampled(Tree& value) {
    if (!takes_real_numbers(value.at, "sampled")) return std::nullopt;
    const std::optional<Distribution> found = value.is(Kind::array) ? read_range(value)
                                              : form_ == "normal"   ? read_normal(value)
                                                                    : read_triangular(value);
    if (!found) return std::nullopt;
    ReadAxis axis;
    axis.distribution = found;
    for (const double u : {kLeastUnit, 1.0 - kLeastUnit}) {
      axis.values.push_back(Tree::make_number(quantile(*found, u), value.at));
      if (!reaches_allowed(axis.values.back())) return std::nullopt;
    }
    return axis;
  }

  bool reaches_allowed(const Tree& end) {
    if (std::isfinite(end.number) && of_.row->range.contains(end.number)) return true;
    fail(end.at,
         fmt::format("'{}' {}, and its samples reach {:.6g}{}{}", of_.parameter.path,
                     range_text(of_.row->range), end.number, of_.parameter.unit.empty() ? "" : " ",
                     of_.parameter.unit),
         "give low and high within it");
    return false;
  }

  std::optional<Distribution> read_range(Tree& list) {
    Tree& low = list.items[0];
    Tree& high = list.items[1];
    const bool low_is_right = is_right(low);
    if (!is_right(high) || !low_is_right) return std::nullopt;
    const bool is_log = form_ == "log";
    Distribution d{is_log ? Law::log : Law::lin, low.as_number(), high.as_number()};
    if (d.low < d.high && (!is_log || d.low > 0.0)) return d;
    fail(list.at,
         fmt::format("the range of '{}' must rise{}, got {}", of_.parameter.path,
                     is_log ? " from a positive number" : "", shown(list)),
         fmt::format("{} = [lowest, highest]", form_));
    return std::nullopt;
  }

  // False when it was reported; an absent key leaves the number.
  bool read_number(Tree& table, const char* key, double& number) {
    Tree* value = table.find(key);
    if (value == nullptr) return true;
    if (!is_right(*value)) return false;
    number = value->as_number();
    return true;
  }

  std::optional<Distribution> read_normal(Tree& table) {
    Distribution d{Law::normal};
    Tree* deviation = table.find("deviation");
    const std::optional<double> length =
        deviation != nullptr ? read_length(*deviation, "deviation") : std::nullopt;
    bool is_known = read_number(table, "mean", d.mean) && length;
    is_known = read_number(table, "low", d.low) && is_known;
    is_known = read_number(table, "high", d.high) && is_known;
    if (!is_known) return std::nullopt;
    d.deviation = *length;
    if (d.low < d.high && share_within_bounds(d) >= kLeastShare) return d;
    fail(table.at,
         d.low < d.high ? fmt::format("the bounds of '{}' hold {:.2g} of its normal distribution",
                                      of_.parameter.path, share_within_bounds(d))
                        : fmt::format("low must lie below high in the normal distribution of '{}'",
                                      of_.parameter.path),
         "normal = { mean, deviation, low, high }, with bounds about the mean, or one, or none");
    return std::nullopt;
  }

  std::optional<Distribution> read_triangular(Tree& table) {
    Distribution d{Law::triangular};
    bool is_known = read_number(table, "low", d.low);
    is_known = read_number(table, "mode", d.mode) && is_known;
    is_known = read_number(table, "high", d.high) && is_known;
    if (!is_known) return std::nullopt;
    if (d.low < d.high && d.low <= d.mode && d.mode <= d.high) return d;
    fail(table.at,
         fmt::format("the triangle of '{}' must rise from low to high with its mode between, got "
                     "{:.6g}, {:.6g}, {:.6g}",
                     of_.parameter.path, d.low, d.mode, d.high),
         "triangular = { low, mode, high }");
    return std::nullopt;
  }

  const NamedParameter& of_;
  const DesignOptions& design_;
  const ModelDocument& document_;
  Diagnostics& diagnostics_;
  std::string form_;
};

}  // namespace

std::optional<ReadAxis> read_axis(Tree& vary, const NamedParameter& of, const DesignOptions& design,
                                  const ModelDocument& document, Diagnostics& diagnostics) {
  return AxisReader(of, design, document, diagnostics).read(vary);
}

}  // namespace linkstudy
