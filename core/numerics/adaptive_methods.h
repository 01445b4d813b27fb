// The methods behind AdaptiveIntegrator; their types stay in their sources.
#pragma once

#include "core/numerics/adaptive_integrator.h"

namespace linkstudy {

std::unique_ptr<AdaptiveIntegrator> make_dormand_prince(AdaptiveProblem problem);
std::unique_ptr<AdaptiveIntegrator> make_radau(AdaptiveProblem problem);

}  // namespace linkstudy
