// Contacts of a run as records.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "core/model/indices.h"

namespace linkstudy {

// One contact. SI units; of joints that turn rad, rad/s and N m. What was not seen is not a number:
// begin and approach of a contact that is there at the start, end and separation of one that is
// there when the run ends.
struct ContactRecord {
  ContactIndex contact{};
  long number = 0;  // in the order in which they begin, from 0
  double begin = std::numeric_limits<double>::quiet_NaN();       // s
  double end = std::numeric_limits<double>::quiet_NaN();         // s
  double approach = std::numeric_limits<double>::quiet_NaN();    // speed at the begin, into it
  double separation = std::numeric_limits<double>::quiet_NaN();  // speed at the end, out of it
  double force = 0.0;                                            // largest normal force
  double depth = 0.0;                                            // greatest
};

// What observers keep of contacts.
struct ContactList {
  std::size_t most = 0;                // records; 0: nothing is kept
  std::vector<ContactRecord> records;  // the first, as they begin
  long unlisted = 0;                   // contacts beyond them
  // The one with the largest force, listed or not: between what shifts, between what turns.
  std::array<std::optional<ContactRecord>, 2> hardest;
};

}  // namespace linkstudy
