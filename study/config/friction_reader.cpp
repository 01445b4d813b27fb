#include "study/config/friction_reader.h"

#include "study/config/read_value.h"

namespace linkstudy {

std::optional<Friction> read_friction(const Tree& table) {
  const Tree* enabled = table.find("enabled");
  if (enabled != nullptr && enabled->is(Tree::Kind::boolean) && !enabled->boolean) {
    return std::nullopt;
  }
  // What was reported reads as a law that the checks of the core accept.
  Friction law;
  law.mu_k = number_of(table, "mu_k", 0.1);
  law.mu_s = number_of(table, "mu_s", law.mu_k);
  law.v_s = number_of(table, "stribeck_speed", law.v_s);
  law.sigma0 = number_of(table, "sigma0", 1.0);
  law.sigma1 = number_of(table, "sigma1", 0.0);
  law.sigma2 = number_of(table, "sigma2", 0.0);
  law.v_d = number_of(table, "damping_speed", 0.0);
  return law;
}

}  // namespace linkstudy
