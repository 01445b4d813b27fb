#include "core/kinematics/idle_rows.h"

#include <cmath>

#include "core/kinematics/closure_jacobian.h"
#include "core/model/compile.h"

namespace linkstudy {
namespace {

constexpr int kPoses = 5;
constexpr double kRounding = 1e-12;  // of the lengths at play

// Poses without any symmetry: multiples of sqrt(2) modulo 1, as angles and as lengths.
void spread(const Mechanism& m, int pose, std::vector<double>& q) {
  for (std::size_t i = 0; i < q.size(); ++i) {
    const double x =
        std::sqrt(2.0) * static_cast<double>((pose + 1) * (2 * static_cast<int>(i) + 3));
    q[i] = 2.0 * (x - std::floor(x)) - 1.0;
  }
  normalize_quaternions(m, q.data());
}

double farthest_of(const Workspace<double>& w) {
  double farthest = 0.0;
  for (const ClosureState<double>& c : w.closures) {
    farthest = std::max({farthest, sqrt(dot(c.p_WF, c.p_WF)), sqrt(dot(c.p_WS, c.p_WS))});
  }
  return farthest;
}

// Bit r: row r vanishes here.
std::vector<bool> vanishing_rows(const Model& model, const std::vector<double>& q,
                                 Workspace<double>& w) {
  const Mechanism& m = model.mechanism;
  const std::vector<double> v(static_cast<std::size_t>(m.nv), 0.0);
  update_kinematics(m, model.parameters, q.data(), v.data(), w);
  update_rows<RowStorage::cut>(m, model.parameters, w);
  const Eigen::MatrixXd j = row_jacobian(m, model.parameters, w, m.cut_rows, w.cut_rows);
  const double limit = kRounding * std::max(1.0, farthest_of(w));
  std::vector<bool> vanishing;
  for (const RowIndex r : indices_of(m.cut_rows)) {
    const auto rates = j.row(r.value()).lpNorm<Eigen::Infinity>();
    vanishing.push_back(std::abs(w.cut_rows[r].d) <= limit && rates <= limit);
  }
  return vanishing;
}

}  // namespace

std::vector<unsigned> find_idle_directions(const Linkage& linkage) {
  const Model model = compile(linkage);
  const Mechanism& m = model.mechanism;
  std::vector<unsigned> idle(linkage.closures.size(), 0u);
  if (m.cut_rows.empty()) return idle;
  Workspace<double> w = make_workspace<double>(m);
  std::vector<double> q = model.start.q;
  std::vector<bool> always(m.cut_rows.size(), true);
  for (int pose = 0; pose < kPoses; ++pose) {
    spread(m, pose, q);
    const std::vector<bool> here = vanishing_rows(model, q, w);
    for (std::size_t r = 0; r < always.size(); ++r) always[r] = always[r] && here[r];
  }
  for (const RowIndex r : indices_of(m.cut_rows)) {
    const Row& row = m.cut_rows[r];
    if (always[static_cast<std::size_t>(r.value())] && !is_of_coupling(row.kind))
      idle[static_cast<std::size_t>(row.closure.value())] |= 1u << row.direction;
  }
  return idle;
}

}  // namespace linkstudy
