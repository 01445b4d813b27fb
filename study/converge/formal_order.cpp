#include "study/converge/formal_order.h"

#include <algorithm>

#include "study/converge/refinement.h"

namespace linkstudy::convergence {

double find_formal_order(const std::string& path, Integrator integrator,
                         const std::optional<Reduction>& reduce) {
  const std::vector<std::string> parts = split_path(path);
  if (path == "simulation.step") {
    if (integrator != Integrator::rk4) return kUnknown;
    return reduce && *reduce != Reduction::last ? 2.0 : 4.0;
  }
  if (std::ranges::count(parts, "stiffness") > 0) return 1.0;
  if (parts.back() == "segments") return 2.0;
  return kUnknown;
}

}  // namespace linkstudy::convergence
