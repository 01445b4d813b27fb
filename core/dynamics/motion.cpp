#include "core/dynamics/motion.h"

#include <algorithm>

#include "core/dynamics/equations_of_motion.h"

namespace linkstudy {

void compute_motion(const Mechanism& m, const Parameters<double>& p, const State<double>& s,
                    Workspace<double>& w) {
  if (s.z.size() == w.z.size()) w.z = s.z;  // a state of another form has no bristles here
  evaluate(m, p, s.t, s.q.data(), s.v.data(), w);
}

Eigen::MatrixXd compute_mass_matrix(const Mechanism& m, const Parameters<double>& p,
                                    const State<double>& s) {
  Workspace<double> w = make_workspace<double>(m);
  update_factored_mass_matrix(m, p, s.t, s.q.data(), s.v.data(), w);
  Eigen::MatrixXd l = Eigen::MatrixXd::Identity(m.nv, m.nv);
  Eigen::VectorXd d(m.nv);
  for (const VelocityIndex k : velocities(m)) {
    const double inverse = w.inverse_pivot[k];
    d[k.value()] = inverse > 0.0 ? 1.0 / inverse : 0.0;
    for (const VelocityIndex i : ancestors(m, k)) l(k.value(), i.value()) = w.mass(k, i);
  }
  return l.transpose() * d.asDiagonal() * l;
}

}  // namespace linkstudy
