// The contacts of runs: those of stored results as one table, and the hardest of a run in words.
#pragma once

#include <optional>
#include <string>

#include "core/model/mechanism.h"
#include "core/simulation/contact_record.h"
#include "study/store/results.h"

namespace linkstudy {

// Run after run below each other (study/metrics/contact_table.h), the name of the run in front.
// Nothing where no run has a contact.
std::optional<Table> contacts_table(const StudyResults& results);

// "closure.S 0: 812.4 N, 3.1e-06 m deep, met with 0.12 m/s, left with 0.1 m/s, at t = 0.031 s";
// empty where there was none.
std::string hardest_contact_text(const Mechanism& mechanism, const ContactList& contacts);

}  // namespace linkstudy
