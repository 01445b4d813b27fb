#include "study/evaluate/derived_damping.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace linkstudy {
namespace {

std::string direction_name(const Row& row) {
  constexpr std::array kNames = {"x", "y", "z", "phi", "theta", "psi"};
  const bool is_numbered = row.kind == RowKind::spring_ground || row.kind == RowKind::spring_first;
  const auto direction = static_cast<std::size_t>(row.direction);
  return is_numbered ? std::to_string(direction) : kNames.at(direction);
}

struct NamedDamping {
  std::string direction;
  double value;
};

void add_group(const std::string& name, const char* group, const char* unit,
               const std::vector<NamedDamping>& rows, std::vector<Trace>& derived) {
  if (rows.empty()) return;
  const bool are_equal = std::ranges::all_of(
      rows, [&](const NamedDamping& row) { return row.value == rows.front().value; });
  if (are_equal) {
    derived.push_back({name + group, unit, {rows.front().value}});
    return;
  }
  for (const NamedDamping& row : rows) {
    derived.push_back({name + "." + row.direction, unit, {row.value}});
  }
}

}  // namespace

void add_damping(const Linkage& linkage, const Model& model, const std::string& prefix,
                 std::vector<Trace>& derived) {
  for (std::size_t i = 0; i < linkage.closures.size(); ++i) {
    const Closure& closure = linkage.closures[i];
    if (closure.model != ClosureModel::sde || !closure.sde.damping_ratio) continue;
    const ClosureStructure& structure = model.mechanism.closures[ClosureIndex(i)];
    std::vector<NamedDamping> shifts;
    std::vector<NamedDamping> turns;
    for (const RowIndex r : indices(structure.row_begin, structure.row_end)) {
      const Row& sde = model.mechanism.sde_rows[r];
      (measures_turn(sde.kind) ? turns : shifts)
          .push_back({direction_name(sde), model.parameters.springs[r].damping});
    }
    const std::string name = fmt::format("{}closure.{}.sde.damping", prefix, closure.name);
    derived.push_back({name + "_ratio", "", {*closure.sde.damping_ratio}});
    add_group(name, "", "N s/m", shifts, derived);
    add_group(name, ".turn", "N m s/rad", turns, derived);
  }
}

}  // namespace linkstudy
