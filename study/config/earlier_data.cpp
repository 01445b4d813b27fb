#include "study/config/earlier_data.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <boost/algorithm/string/classification.hpp>
#include <boost/algorithm/string/split.hpp>
#include <cmath>

#include "core/simulation/channel_kinds.h"
#include "core/topology/nearest_name.h"

namespace linkstudy {
namespace {

constexpr const char* kTimeHead = "time";

// A head of the text: its name, and the unit behind it.
std::string head_of(const Trace& trace) {
  return trace.unit.empty() ? trace.name : fmt::format("{} [{}]", trace.name, trace.unit);
}

std::string name_in(const std::string& head) {
  return head.substr(0, head.find(" ["));
}

std::vector<std::string> heads_in(const std::string& text) {
  std::vector<std::string> heads;
  const std::string line = text.substr(0, text.find('\n'));
  boost::algorithm::split(heads, line, boost::algorithm::is_any_of(","));
  return heads;
}

bool is_asked(const MeasuredInput& measured, const std::string& name) {
  return name == kTimeHead || std::ranges::count(measured.columns, name, &WantedColumn::head) > 0 ||
         std::ranges::any_of(measured.signals,
                             [&](const TraceInput& one) { return is_in_group(name, one.signal); });
}

// What the run does not have.
void require_kept(const EarlierRun& run, const std::string& source, const MeasuredInput& measured,
                  Diagnostics& diagnostics) {
  std::vector<std::string> names;
  for (const Trace& one : run.traces) names.push_back(one.name);
  const auto require = [&](const std::string& asked, const Location& at, bool is_kept) {
    if (is_kept) return;
    diagnostics.add(at, fmt::format("'{}' keeps no history of '{}'", source, asked),
                    fmt::format("nearest of what it keeps: {}",
                                fmt::join(nearest_names(asked, names, 3), ", ")));
  };
  for (const TraceInput& one : measured.signals) {
    require(one.signal, one.at, std::ranges::any_of(names, [&](const std::string& name) {
              return name != kTimeHead && is_in_group(name, one.signal);
            }));
  }
  for (const WantedColumn& one : measured.columns) {
    require(one.head, one.head_at, std::ranges::count(names, one.head) > 0);
  }
}

}  // namespace

std::vector<std::string> earlier_heads(const MeasuredInput& measured) {
  std::vector<std::string> heads;
  for (const TraceInput& one : measured.signals) heads.push_back(one.signal);
  for (const WantedColumn& one : measured.columns) heads.push_back(one.head);
  return heads;
}

std::optional<std::string> write_earlier_data(const EarlierRun& run, const std::string& source,
                                              const MeasuredInput& measured,
                                              Diagnostics& diagnostics) {
  Diagnostics found;
  require_kept(run, source, measured, found);
  diagnostics.append(found);
  if (!found.empty()) return std::nullopt;
  std::vector<const Trace*> taken;
  std::vector<std::string> cells;
  for (const Trace& one : run.traces) {
    if (!is_asked(measured, one.name)) continue;
    taken.push_back(&one);
    cells.push_back(head_of(one));
  }
  std::string text = fmt::format("{}\n", fmt::join(cells, ","));
  for (std::size_t row = 0; row < taken.front()->values.size(); ++row) {
    cells.clear();
    for (const Trace* one : taken) {
      const double value = one->values.at(row);
      cells.push_back(std::isnan(value) ? "" : fmt::format("{}", value));
    }
    text += fmt::format("{}\n", fmt::join(cells, ","));
  }
  return text;
}

std::shared_ptr<const MeasuredData> parse_earlier_data(const std::string& text,
                                                       const std::string& source,
                                                       const MeasuredInput& measured,
                                                       Diagnostics& diagnostics) {
  std::vector<WantedColumn> wanted;
  for (const std::string& head : heads_in(text)) {
    const std::string name = name_in(head);
    if (name == kTimeHead) {
      wanted.push_back({kTimeHead, measured.file_at, head, measured.file_at});
      continue;
    }
    const auto signal = std::ranges::find_if(
        measured.signals, [&](const TraceInput& one) { return is_in_group(name, one.signal); });
    if (signal != measured.signals.end()) wanted.push_back({name, signal->at, head, signal->at});
    for (const WantedColumn& one : measured.columns) {
      if (one.head == name) wanted.push_back({one.channel, one.channel_at, head, one.head_at});
    }
  }
  return parse_measured_data(text, source, measured.file_at, wanted, diagnostics);
}

}  // namespace linkstudy
