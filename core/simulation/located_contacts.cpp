// The contacts of a located run: where they begin and end, what they remember.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/simulation/contact_list.h"
#include "core/simulation/located_run.h"

namespace linkstudy {
namespace {

constexpr double kOpen = std::numeric_limits<double>::infinity();

bool any_touching(const std::vector<ContactPhase>& phases) {
  return std::any_of(phases.begin(), phases.end(),
                     [](const ContactPhase& phase) { return phase.touching; });
}

}  // namespace

void LocatedRun::set_memory(ContactIndex i, double rate) {
  const bool touching = phases_[i].touching;
  w_.memory[i] = {begin_[i].depth, rate, touching ? 1.0 : 0.0, touching ? std::fabs(rate) : 0.0,
                  touching ? 0.0 : kOpen};
}

void LocatedRun::read_nearness(int slot, std::vector<Nearness>& contacts) const {
  for (Nearness& one : contacts) {
    one.depth = frame_->get(lane_, slot++);
    one.rate = frame_->get(lane_, slot++);
  }
}

std::optional<ContactEvent> LocatedRun::find_event() {
  if (phases_.empty()) return std::nullopt;
  if (frame_ != nullptr) {
    read_nearness(frame_->slots().near, end_);
    read_nearness(frame_->slots().quarters, quarters_);
  } else {
    look_at(with_motions(integrator_->t(), integrator_->y()), end_.data());
  }
  return events_.find(integrator_->t_old(), integrator_->t(), begin_, end_, phases_, quarters_);
}

// By quarters of the step: a cubic each.
void LocatedRun::follow_contacts() {
  if (case_.contacts == nullptr || !any_touching(phases_)) return;
  before_ = begin_;
  const double begin = integrator_->t_old(), quarter = 0.25 * (reached_ - begin);
  const auto count = static_cast<std::ptrdiff_t>(phases_.size());
  double t = begin;
  for (int part = 1; part <= 4; ++part) {
    const double next = part == 4 ? reached_ : begin + part * quarter;
    if (event_ || frame_ == nullptr) {
      look_inside(next, after_.data());
    } else {
      const auto from = part == 4 ? end_.begin() : quarters_.begin() + (part - 1) * count;
      std::copy_n(from, count, after_.begin());
    }
    for (const ContactIndex i : indices_of(phases_)) {
      if (!phases_[i].touching) continue;
      case_.contacts->follow(i, {t, next, before_[i], after_[i]}, w_.memory[i].approach);
    }
    before_.swap(after_);
    t = next;
  }
}

void LocatedRun::count_step() {
  const double length = integrator_->t() - integrator_->t_old();
  bool touching = false;
  for (const ContactIndex i : indices_of(phases_)) {
    if (!phases_[i].touching) continue;
    touching = true;
    touches_[i].steps += 1.0;
    if (phases_[i].fresh) touches_[i].first_step = length;
  }
  if (!touching) free_step_ = length;
}

void LocatedRun::restart_at(const ContactEvent& event) {
  const ContactIndex i = event.contact;
  value_at(event.t, y_.data());
  time_ = event.t;
  settle(time_, y_.data());
  look_at(y_.data(), begin_.data());
  for (ContactPhase& phase : phases_) phase.fresh &= event.t == integrator_->t_old();
  phases_[i] = {!phases_[i].touching, true};
  set_memory(i, begin_[i].rate);
  if (phases_[i].touching) {
    begin_contact(i);
  } else {
    end_contact(i);
  }
  integrator_->start(event.t, y_.data(), first_step(i));
}

void LocatedRun::begin_contact(ContactIndex i) {
  log_.begun += 1.0;
  touches_[i].steps = 0.0;
  ContactRecorder* recorder = case_.contacts;
  if (recorder != nullptr) recorder->begin(i, time_, begin_[i].rate);
  if (++begun_in_interval_ > kMostContacts) fail(Cause::contact_budget);
}

void LocatedRun::end_contact(ContactIndex i) {
  log_.least_steps = std::min(log_.least_steps, touches_[i].steps);
  ContactRecorder* recorder = case_.contacts;
  if (recorder != nullptr) recorder->end(i, time_, -begin_[i].rate);
  const ContactStructure& contact = m_.contacts[i];
  const bool resets =
      contact.z.exists() && m_.clearances[contact.clearance].free_bristle == FreeBristle::reset;
  if (resets) y_[static_cast<std::size_t>(m_.nq + m_.nv + contact.z.value())] = 0.0;
}

// 0 where the integrator must find it.
double LocatedRun::first_step(ContactIndex i) const {
  if (phases_[i].touching) return touches_[i].first_step;
  return any_touching(phases_) ? integrator_->next_step() : free_step_;
}

}  // namespace linkstudy
