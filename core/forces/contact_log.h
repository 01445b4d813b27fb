// What a run tells of its contacts.
#pragma once

namespace linkstudy {

// Steps of the shortest contact where none has ended.
inline constexpr double kNoContact = 1e9;

// Contacts of one lane, all places together.
template <class Real>
struct ContactLog {
  Real begun = Real(0.0);               // contacts begun
  Real least_steps = Real(kNoContact);  // steps in the shortest contact that has ended
};

}  // namespace linkstudy
