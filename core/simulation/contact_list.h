// Records the contacts of one run as its steps pass. Between two states depth and rate are those of
// the cubic through both (core/simulation/nearness.h): begin and end are its zeros, speeds its
// rates there, and the largest force is that of the contact's law along it. A contact that comes
// and goes between two states is not seen.
#pragma once

#include <string>
#include <vector>

#include "core/model/mechanism.h"
#include "core/model/parameters.h"
#include "core/simulation/contact_record.h"
#include "core/simulation/kernel.h"
#include "core/simulation/nearness.h"

namespace linkstudy {

// Where a contact is: "closure.S" and the number of its contact there (as in
// closure.S.normal_force.0), or "joint.J" ("joint.J.1" of a joint with several coordinates) and the
// end, "low" or "high".
struct ContactPlace {
  std::string owner;
  std::string side;
  bool turns = false;  // depths are angles
};

IndexedVector<ContactIndex, ContactPlace> contact_places(const Mechanism& mechanism);

class ContactRecorder {
 public:
  // All must outlive it.
  ContactRecorder(const Mechanism& mechanism, const Parameters<double>& parameters,
                  ContactList& list);

  // Of constant steps.
  void step(const ContactStep& step);

  // The same of steps that begin and end with contacts. Speeds are positive into the contact at its
  // begin and out of it at its end.
  void start_inside(ContactIndex contact);
  void begin(ContactIndex contact, double t, double speed);
  void follow(ContactIndex contact, const NearnessSpan& span, double approach);
  void end(ContactIndex contact, double t, double speed);

 private:
  double force(ContactIndex contact, const Nearness& at, double approach) const;
  void open(ContactIndex contact, ContactRecord record);
  void note(const ContactRecord& record);

  const Mechanism& m_;
  const Parameters<double>& p_;
  ContactList& list_;
  IndexedVector<ContactIndex, ContactPlace> places_;
  IndexedVector<ContactIndex, ContactRecord> current_;
  long begun_ = 0;
};

}  // namespace linkstudy
