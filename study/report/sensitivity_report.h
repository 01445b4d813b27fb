// Sensitivities as text for people: a table for each quantity, what cannot be told from 0 and how
// many blocks would tell it, and where evaluations failed.
#pragma once

#include <string>

#include "study/sensitivity/sensitivity.h"

namespace linkstudy {

std::string sensitivity_text(const sensitivity::Sensitivity& result, std::size_t width);

}  // namespace linkstudy
