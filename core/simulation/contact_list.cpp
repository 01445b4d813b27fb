#include "core/simulation/contact_list.h"

#include <algorithm>
#include <cmath>

#include "core/forces/end_stops.h"
#include "core/model/contact_of.h"
#include "core/model/walk.h"
#include "core/numerics/bracketed_root.h"
#include "core/simulation/channels.h"

namespace linkstudy {
namespace {

constexpr int kParts = 4;          // of a span, between which the largest force is looked for
constexpr double kFarBelow = 0.5;  // of the largest so far: spans with less at both ends are not

// Where the depth passes zero, as a part of the span.
double crossing_of(const NearnessSpan& span) {
  const double first = span.begin.depth, last = span.end.depth;
  if (first == 0.0 || (first > 0.0) == (last > 0.0)) return 0.0;
  return bracket_root([&](double s) { return span.at(s).depth; }, 0.0, 1.0, first, last).second;
}

NearnessSpan part_of(const NearnessSpan& span, double first, double last) {
  return {span.time_at(first), span.time_at(last), span.at(first), span.at(last)};
}

double deepest_of(const NearnessSpan& span) {
  double depth = std::max({0.0, span.begin.depth, span.end.depth});
  if (!(span.begin.rate > 0.0 && span.end.rate < 0.0)) return depth;
  const auto rate = [&](double s) { return span.at(s).rate; };
  const double turn = bracket_root(rate, 0.0, 1.0, span.begin.rate, span.end.rate).first;
  return std::max(depth, span.at(turn).depth);
}

std::string joint_of_stop(const Mechanism& m, const StopStructure& stop) {
  for (const BodyIndex b : bodies_outwards(m)) {
    const Body& body = m.bodies[b];
    const int i = stop.v - body.v_begin;
    if (i < 0 || i >= body.v_count) continue;
    const std::string name = "joint." + m.joint_names[b];
    return body.v_count > 1 ? name + "." + std::to_string(i) : name;
  }
  return {};
}

}  // namespace

IndexedVector<ContactIndex, ContactPlace> contact_places(const Mechanism& m) {
  IndexedVector<ContactIndex, ContactPlace> places(m.contacts.size());
  for (const ClearanceStructure& c : m.clearances) {
    const std::string owner = "closure." + m.closure_names[c.closure];
    for (const ContactIndex i : contacts_of(c)) {
      places[i] = {owner, std::to_string(i - c.contact_begin)};
    }
  }
  for (const StopStructure& stop : m.stops) {
    places[stop.contact] = {joint_of_stop(m, stop), stop.is_high ? "high" : "low",
                            is_rotation(m, stop.v)};
  }
  return places;
}

ContactRecorder::ContactRecorder(const Mechanism& mechanism, const Parameters<double>& parameters,
                                 ContactList& list)
    : m_(mechanism),
      p_(parameters),
      list_(list),
      places_(contact_places(mechanism)),
      current_(mechanism.contacts.size()) {
  list_.records.reserve(list_.most);  // none while stepping
}

void ContactRecorder::step(const ContactStep& s) {
  const NearnessSpan span{s.t0, s.t1, {s.depth0, s.rate0}, {s.depth1, s.rate1}};
  if (!s.touched && s.depth0 > 0.0) {
    start_inside(s.contact);
    follow(s.contact, span, s.approach);
    return;
  }
  const double crossing = s.touched && s.touches ? 0.0 : crossing_of(span);
  const Nearness there = span.at(crossing);
  if (!s.touched) begin(s.contact, span.time_at(crossing), there.rate);
  if (s.touches) return follow(s.contact, part_of(span, crossing, 1.0), s.approach);
  follow(s.contact, part_of(span, 0.0, crossing), s.approach);
  end(s.contact, span.time_at(crossing), -there.rate);
}

void ContactRecorder::start_inside(ContactIndex contact) {
  open(contact, {});
}

void ContactRecorder::begin(ContactIndex contact, double t, double speed) {
  ContactRecord record;
  record.begin = t;
  record.approach = std::max(speed, 0.0);
  open(contact, record);
}

void ContactRecorder::open(ContactIndex contact, ContactRecord record) {
  record.contact = contact;
  record.number = begun_++;
  if (list_.records.size() < list_.most) {
    list_.records.push_back(record);
  } else {
    ++list_.unlisted;
  }
  current_[contact] = record;
}

double ContactRecorder::force(ContactIndex contact, const Nearness& now, double approach) const {
  const ContactStructure& c = m_.contacts[contact];
  if (c.stop.exists()) {
    return stop_force(m_.stops[c.stop], p_.stops[c.stop], now.depth, now.rate, approach).normal;
  }
  const ClearanceStructure& clearance = m_.clearances[c.clearance];
  return normal_contact_force(p_.clearances[c.clearance].contact, clearance.hertz, now.depth,
                              now.rate, approach, clearance.approach)
      .normal;
}

// The largest force lies near the largest of some, where the parabola through it and its
// neighbours has its vertex.
void ContactRecorder::follow(ContactIndex contact, const NearnessSpan& span, double approach) {
  ContactRecord& record = current_[contact];
  record.depth = std::max(record.depth, deepest_of(span));
  const auto force_at = [&](double s) { return force(contact, span.at(s), approach); };
  std::array<double, kParts + 1> forces{force_at(0.0)};
  forces.back() = force_at(1.0);
  if (std::max(forces.front(), forces.back()) < kFarBelow * record.force) return note(record);
  for (std::size_t k = 1; k < kParts; ++k) forces[k] = force_at(static_cast<double>(k) / kParts);
  const auto largest = std::ranges::max_element(forces);
  const auto place = static_cast<std::size_t>(largest - forces.begin());
  const std::size_t middle = std::clamp<std::size_t>(place, 1, kParts - 1);
  const double before = forces[middle - 1], after = forces[middle + 1];
  const double bend = before - 2.0 * forces[middle] + after;
  record.force = std::max(record.force, *largest);
  if (bend < 0.0) {
    const double vertex = (static_cast<double>(middle) + 0.5 * (before - after) / bend) / kParts;
    record.force = std::max(record.force, force_at(std::clamp(vertex, 0.0, 1.0)));
  }
  note(record);
}

void ContactRecorder::end(ContactIndex contact, double t, double speed) {
  ContactRecord& record = current_[contact];
  record.end = t;
  record.separation = std::max(speed, 0.0);
  note(record);
}

void ContactRecorder::note(const ContactRecord& record) {
  const auto number = static_cast<std::size_t>(record.number);
  if (number < list_.records.size()) list_.records[number] = record;
  auto& hardest = list_.hardest[places_[record.contact].turns ? 1 : 0];
  const bool is_it = hardest && hardest->number == record.number;
  if (is_it || !hardest || record.force > hardest->force) hardest = record;
}

void record_contact(ContactRecorder& recorder, const ContactStep& step) {
  recorder.step(step);
}

}  // namespace linkstudy
