#include "core/dynamics/static_failure.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "core/dynamics/motion.h"
#include "core/dynamics/static_balance.h"
#include "core/kinematics/assembly.h"
#include "core/kinematics/scaled_closures.h"
#include "core/model/walk.h"
#include "core/numerics/dense.h"
#include "core/spatial/rotation_vector.h"

namespace linkstudy {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMostTries = 80;
constexpr double kLongestTry = 0.2;  // rad or m
constexpr double kGone = 1e-3;       // of the stiffness times the force left: none against it
constexpr double kNever = 1e-9;      // of force over a radian or metre: no stiffness at all
constexpr double kTurned = 30.0;     // deg: where sines bend

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", x);
  return text;
}

struct Unbalanced {
  State<double> state;
  VectorXd lambda;
  Balance balance;
  VectorXd force;     // (free)
  MatrixXd gradient;  // (free, free)
  BalanceSystem system;
};

class LeastUnbalance {
 public:
  LeastUnbalance(const Model& model, const std::vector<int>& free, Workspace<double>& w)
      : model_(model), free_(free), w_(w) {}

  Unbalanced at(const State<double>& s, const VectorXd& lambda) {
    Unbalanced u{s, lambda, compute_balance(model_, s, w_), {}, {}, {}};
    u.force = take_entries(net_force(u.balance, lambda), free_);
    u.gradient = compute_force_gradient(model_, s, lambda, free_, w_).value;
    u.system = make_balance_system(u.gradient, u.balance, u.force, free_);
    return u;
  }

  Unbalanced seek(const State<double>& start) {
    const Balance b = compute_balance(model_, start, w_);
    Unbalanced here = at(start, least_multipliers(b, free_));
    double mu = 1e-6;  // of the largest diagonal entry
    for (int i = 0; i < kMostTries && mu < 1e8; ++i) {
      const Unbalanced next = stepped(here, mu);
      const bool better = next.force.allFinite() && next.system.r.norm() < here.system.r.norm();
      if (better) here = next;
      mu = better ? std::max(mu / 10.0, 1e-12) : mu * 10.0;
    }
    return here;
  }

 private:
  Unbalanced stepped(const Unbalanced& here, double mu) {
    const BalanceSystem& e = here.system;
    MatrixXd normal = e.a.transpose() * e.a;
    const double size = std::max(normal.diagonal().maxCoeff(), 1e-30);
    normal.diagonal().array() += mu * size;
    VectorXd x = solve_definite(normal, e.a.transpose() * e.r);
    x.tail(here.lambda.size()) *= e.scale;
    const auto n = static_cast<Eigen::Index>(free_.size());
    const double longest = x.head(n).lpNorm<Eigen::Infinity>();
    if (longest > kLongestTry) x *= kLongestTry / longest;
    const int nv = model_.mechanism.nv;
    return at(displaced(model_.mechanism, here.state, scatter_entries(x.head(n), free_, nv)),
              here.lambda + x.tail(here.lambda.size()));
  }

  const Model& model_;
  const std::vector<int>& free_;
  Workspace<double>& w_;
};

// Sines bear at most half of the stiffness: said where a closure is turned so far that it matters.
std::string hint_at_sines(const Model& model, const State<double>& s, Workspace<double>& w) {
  const Mechanism& m = model.mechanism;
  compute_motion(m, model.parameters, s, w);
  for (const ClosureIndex i : indices_of(m.closures)) {
    const ClosureStructure& c = m.closures[i];
    if (c.model != ClosureModel::sde || !c.needs_frames) continue;
    const ClosureState<double>& x = w.closures[i];
    const Vec3<double> phi = rotation_vector(x.R_WF, x.R_WS).phi;
    const double turn = std::sqrt(dot(phi, phi)) * 180.0 / std::numbers::pi;
    for (const RowIndex r : rows_of(c)) {
      const double stiffness = model.parameters.springs[r].stiffness;
      if (m.sde_rows[r].kind != RowKind::rotation || stiffness == 0.0 || turn < kTurned) continue;
      return "; closure '" + m.closure_names[i] + "' is turned by " + number(turn) +
             " deg there, and its measure of tilt is a sine: a stiffness k bears at most k/2 alone "
             "about an axis; tilt = \"angle\" bears k phi";
    }
  }
  return "";
}

}  // namespace

std::string describe_unbalance(const Model& model, const State<double>& start,
                               const std::vector<int>& free, Workspace<double>& w) {
  LeastUnbalance search(model, free, w);
  const Unbalanced end = search.seek(start);
  if (free.empty() || !end.force.allFinite()) return "";
  Eigen::Index at = 0;
  const double largest = end.force.cwiseAbs().maxCoeff(&at);
  const VectorXd u = end.force.normalized();
  const VelocityIndex k(free[static_cast<std::size_t>(at)]);
  const std::string what = number(largest) + " " + effort_unit(model.mechanism, k) + " at " +
                           velocity_name(model.mechanism, k);
  const auto against = [&](const MatrixXd& gradient) { return (gradient.transpose() * u).norm(); };
  const double never = kNever * end.force.norm();
  if (against(end.gradient) <= never && against(search.at(start, end.lambda).gradient) <= never) {
    return "nothing holds against " + what + " (friction is left out)";
  }
  const VectorXd slope = end.system.a.transpose() * end.system.r;
  if (slope.norm() > kGone * end.system.a.norm() * end.system.r.norm()) return "";
  return "the loads exceed what can be borne near the start: balance is missed by " + what +
         " at least, at a pose whose stiffness against that is gone (a limit load)" +
         hint_at_sines(model, end.state, w);
}

}  // namespace linkstudy
