// A convergence study as text for people: a table for each ladder with what is to be known of it,
// the orders of all, and what the wanted error needs.
#pragma once

#include <string>

#include "study/converge/convergence.h"

namespace linkstudy {

std::string convergence_text(const convergence::Convergence& result, std::size_t width);

}  // namespace linkstudy
