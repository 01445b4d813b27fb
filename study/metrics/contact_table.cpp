#include "study/metrics/contact_table.h"

#include <algorithm>
#include <cmath>

#include "core/simulation/contact_list.h"

namespace linkstudy {
namespace {

struct ContactRow {
  ContactRecord record;
  ContactPlace place;
  std::int64_t unlisted;
};

std::string within_of(const ContactRecord& one) {
  const bool begins = !std::isnan(one.begin), ends = !std::isnan(one.end);
  if (begins) return ends ? "whole" : "lasts at the end";
  return ends ? "there at the start" : "throughout";
}

double restitution_of(const ContactRecord& one) {
  return one.approach > 0.0 ? one.separation / one.approach : std::nan("");
}

std::vector<ContactRow> rows_of(const Mechanism& mechanism, const ContactList& contacts) {
  const auto places = contact_places(mechanism);
  std::vector<ContactRow> rows;
  for (const ContactRecord& one : contacts.records) {
    rows.push_back({one, places[one.contact], contacts.unlisted});
  }
  return rows;
}

}  // namespace

Table make_contact_table(const Mechanism& mechanism, const ContactList& contacts) {
  std::vector<ContactRow> rows = rows_of(mechanism, contacts);
  const auto turns = [](const ContactRow& row) { return row.place.turns; };
  const bool all_turn = std::ranges::all_of(rows, turns);
  const bool has_units = all_turn || std::ranges::none_of(rows, turns);
  const auto unit = [&](const char* shift, const char* turn) {
    return !has_units ? "" : all_turn ? turn : shift;
  };
  TableOf<ContactRow> table("contacts", "contact", std::move(rows));
  table.add("at", "", "closure, or joint (and its coordinate)",
            [](const ContactRow& r) { return r.place.owner; });
  table.add("contact", "", "number of the contact in the closure, or end of the stop",
            [](const ContactRow& r) { return r.place.side; });
  table.add("begin", "s", "when it begins; none where it is there at the start",
            [](const ContactRow& r) { return r.record.begin; });
  table.add("end", "s", "when it ends; none where it lasts at the end of the run",
            [](const ContactRow& r) { return r.record.end; });
  table.add("approach_speed", unit("m/s", "rad/s"), "at its begin, into it",
            [](const ContactRow& r) { return r.record.approach; });
  table.add("separation_speed", unit("m/s", "rad/s"), "at its end, out of it",
            [](const ContactRow& r) { return r.record.separation; });
  table.add("restitution", "", "separation_speed over approach_speed: what came of it",
            [](const ContactRow& r) { return restitution_of(r.record); });
  table.add("peak_force", unit("N", "N m"), "largest normal force, or moment",
            [](const ContactRow& r) { return r.record.force; });
  table.add("depth", unit("m", "rad"), "greatest depth",
            [](const ContactRow& r) { return r.record.depth; });
  table.add("along", "", "m: a shift, in m, m/s and N; rad: a turn, in rad, rad/s and N m",
            [](const ContactRow& r) { return std::string(r.place.turns ? "rad" : "m"); });
  table.add("within", "", "what of it the run holds",
            [](const ContactRow& r) { return within_of(r.record); });
  table.add("unlisted", "", "contacts of this run beyond those listed",
            [](const ContactRow& r) { return r.unlisted; });
  return table.take();
}

}  // namespace linkstudy
