// The contacts of a run (core/simulation/contact_record.h) as a table, a row each.
#pragma once

#include "core/model/mechanism.h"
#include "core/simulation/contact_record.h"
#include "study/record/table.h"

namespace linkstudy {

// Contacts of one run that are listed; more are counted.
inline constexpr std::size_t kMostContactsListed = 1000;

// Units are those of the contacts where they all have the same; else they have none, and the column
// `along` tells for each.
Table make_contact_table(const Mechanism& mechanism, const ContactList& contacts);

}  // namespace linkstudy
