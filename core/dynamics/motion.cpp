#include "core/dynamics/motion.h"

#include "core/dynamics/equations_of_motion.h"

namespace linkstudy {

void compute_motion(const Mechanism& m, const Parameters<double>& p, const State<double>& s,
                    Workspace<double>& w) {
  evaluate(m, p, s.t, s.q.data(), s.v.data(), w);
}

Eigen::MatrixXd compute_mass_matrix(const Mechanism& m, const Parameters<double>& p,
                                    const State<double>& s) {
  Workspace<double> w = make_workspace<double>(m);
  update_kinematics(m, p, s.q.data(), s.v.data(), w);
  update_inertial_wrenches(m, w);
  update_applied_forces(m, p, s.t, s.v.data(), w);
  update_bias(m, p, w);
  update_mass_matrix(m, p, w);
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(m.nv, m.nv);
  for (int k = 0; k < m.nv; ++k) {
    for (int i = k; i >= 0; i = m.v_parent[static_cast<std::size_t>(i)]) {
      mass(k, i) = mass(i, k) = w.mass[static_cast<std::size_t>(k * m.nv + i)];
    }
  }
  return mass;
}

}  // namespace linkstudy
