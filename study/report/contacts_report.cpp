#include "study/report/contacts_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/simulation/contact_list.h"

namespace linkstudy {
namespace {

void append(Column& column, const Column& more) {
  std::visit(
      [&](auto& values) {
        const auto& others = std::get<std::decay_t<decltype(values)>>(more.values);
        values.insert(values.end(), others.begin(), others.end());
      },
      column.values);
  // Of runs that differ in them, `along` tells.
  if (column.unit != more.unit) column.unit.clear();
}

std::string contact_text(const ContactPlace& place, const ContactRecord& one) {
  const char* length = place.turns ? "rad" : "m";
  std::string text = fmt::format("{} {}: {:.4g} {}, {:.3g} {} deep", place.owner, place.side,
                                 one.force, place.turns ? "N m" : "N", one.depth, length);
  if (std::isnan(one.begin)) {
    text += ", there at the start";
  } else {
    text += fmt::format(", met with {:.4g} {}/s at t = {:.6g} s", one.approach, length, one.begin);
  }
  if (std::isnan(one.end)) return text + ", lasts at the end";
  return text + fmt::format(", left with {:.4g} {}/s", one.separation, length);
}

}  // namespace

std::optional<Table> contacts_table(const StudyResults& results) {
  if (results.contacts.empty()) return std::nullopt;
  std::vector<const Table*> runs;
  for (const Table& one : results.contacts) runs.push_back(&one);
  const auto evaluation = [](const Table* one) {
    return std::get<std::int64_t>(find_attribute(*one, "evaluation")->value);
  };
  std::ranges::stable_sort(runs, {}, evaluation);
  Table all{results.description.name, runs.front()->columns};
  std::vector<std::string> names(row_count(*runs.front()), runs.front()->name);
  for (std::size_t i = 1; i < runs.size(); ++i) {
    names.insert(names.end(), row_count(*runs[i]), runs[i]->name);
    for (std::size_t k = 0; k < all.columns.size(); ++k) {
      append(all.columns[k], runs[i]->columns.at(k));
    }
  }
  all.columns.insert(all.columns.begin(), {"run", "", "evaluation, and its load case", "", names});
  return all;
}

std::string hardest_contact_text(const Mechanism& mechanism, const ContactList& contacts) {
  const auto places = contact_places(mechanism);
  std::string text;
  for (const std::optional<ContactRecord>& one : contacts.hardest) {
    if (!one) continue;
    const ContactPlace& place = places[one->contact];
    text += (text.empty() ? "" : "; ") + contact_text(place, *one);
  }
  return text;
}

}  // namespace linkstudy
