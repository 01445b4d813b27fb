#include "study/report/channels_text.h"

#include <fmt/format.h>

#include <sstream>

#include "core/simulation/channel_kinds.h"
#include "study/config/key_reference.h"

namespace linkstudy {
namespace {

constexpr std::size_t kPageWidth = 98;

std::string indented(const std::string& words) {
  std::string text;
  std::string line = "   ";
  std::istringstream stream(words);
  for (std::string word; stream >> word;) {
    if (line.size() + 1 + word.size() > kPageWidth) {
      text += line + "\n";
      line = "   ";
    }
    line += " " + word;
  }
  return text + line + "\n";
}

std::string unit_text(std::string unit) {
  for (std::size_t at = 0; (at = unit.find('|', at)) != std::string::npos; at += 4) {
    unit.replace(at, 1, " or ");
  }
  return unit.empty() ? "1" : unit;
}

std::string entry(const std::string& names, std::string_view unit, const std::string& meaning) {
  return fmt::format("{}  [{}]\n", names, unit_text(std::string(unit))) + indented(meaning);
}

// Components of one vector, or contacts of one closure, share their line.
bool belong_together(const Mechanism& m, const Channel& a, const Channel& b) {
  const auto owner = [](const Channel& c) { return c.name.substr(0, c.name.rfind('.')); };
  return a.quantity == b.quantity && a.unit == b.unit && owner(a) == owner(b) &&
         describe_channel(m, a) == describe_channel(m, b);
}

}  // namespace

std::string channel_patterns_text() {
  std::string text =
      "Channels: every number of a run that has a name. SI units and radians; NAME is that of a "
      "joint,\nclosure or point of the model, i counts from 0. `linkstudy describe channels MODEL` "
      "lists those of\na model.\n\n";
  for (const ChannelKind& kind : channel_kinds()) {
    const std::string of = kind.of.empty() ? "" : fmt::format(" (of {})", kind.of);
    text += entry(pattern_of(kind), kind.unit, std::string(kind.meaning) + of);
  }
  const auto order = [](const char* key) { return describe_key("model", key).comment; };
  return text + "\nCoordinates of a joint, q:\n" + indented(order("joint.*.initial.position")) +
         "Their rates, v:\n" + indented(order("joint.*.initial.velocity")) + "Groups:\n" +
         indented(
             "a vector is named without its component (closure.S.force) wherever a signal is "
             "asked for; --signals and [[trace]] also take everything under a name: joint.A, "
             "closure.S, point.tip, energy.");
}

std::string channels_text(const Mechanism& mechanism) {
  const std::vector<Channel> all = list_channels(mechanism);
  std::string text;
  for (std::size_t i = 0; i < all.size();) {
    const std::size_t first = i;
    std::string names = all[i].name;
    while (++i < all.size() && belong_together(mechanism, all[first], all[i])) {
      names += "  " + all[i].name;
    }
    text += entry(names, all[first].unit, describe_channel(mechanism, all[first]));
  }
  return text;
}

}  // namespace linkstudy
