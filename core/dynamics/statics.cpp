#include "core/dynamics/statics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/dynamics/differences.h"
#include "core/dynamics/motion.h"
#include "core/dynamics/static_balance.h"
#include "core/dynamics/static_descent.h"
#include "core/dynamics/static_failure.h"
#include "core/forces/end_stops.h"
#include "core/kinematics/assembly.h"
#include "core/kinematics/scaled_closures.h"
#include "core/model/undriven.h"
#include "core/numerics/dense.h"

namespace linkstudy {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMaxIterations = 100;
constexpr double kLongestStep = 0.2;      // rad or m, of one iteration
constexpr double kForceTolerance = 1e-9;  // relative to the weights and loads at play

VectorXd newton_step(const BalanceSystem& s, Eigen::Index closures) {
  VectorXd x = solve_least_squares(s.a, s.r, 1e-13);
  x.tail(closures) *= s.scale;
  return x;
}

// Of what is piecewise linear: a curve or a course.
template <class Piecewise>
double steepest(const Model& model, const Piecewise& curve) {
  double steepest = 0.0;
  for (const SegmentIndex k : indices(curve.begin, curve.end)) {
    const double slope = model.parameters.segments[k].slope;
    steepest = std::max(steepest, std::abs(slope));
  }
  return steepest;
}

// Largest stiffness of a spring between points along its line, and across it: force / length.
double stiffest_line(const Model& model, const State<double>& s) {
  Workspace<double> w = make_workspace<double>(model.mechanism);
  compute_motion(model.mechanism, model.parameters, s, w);
  double stiffest = 0.0;
  for (const PointSpringIndex i : indices_of(w.point_springs)) {
    const PointSpringStructure& structure = model.mechanism.point_springs[i];
    const PointSpringState<double>& x = w.point_springs[i];
    stiffest = std::max(stiffest, model.parameters.point_springs[i].stiffness);
    if (x.length > 0.0) stiffest = std::max(stiffest, std::abs(x.force) / x.length);
    stiffest = std::max(stiffest, steepest(model, structure.curve));
    if (structure.course.q.exists())
      stiffest = std::max(stiffest, steepest(model, structure.course));
  }
  return stiffest;
}

// Stiffness times the rounding of positions, far from the origin too, on the levers at play: no
// smaller force residual can be asked for.
double rounding_floor(const Model& model, const State<double>& s) {
  const Extent extent = compute_extent(model, s);
  const double reach = std::max(extent.farthest, extent.length) * std::max(extent.length, 1.0);
  double largest = 0.0;
  for (const RowIndex r : indices_of(model.mechanism.sde_rows)) {
    const bool turns = measures_turn(model.mechanism.sde_rows[r].kind);
    largest = std::max(largest, model.parameters.springs[r].stiffness * (turns ? 1.0 : reach));
  }
  for (const JointSpringParameters<double>& spring : model.parameters.joint_springs) {
    largest = std::max(largest, spring.stiffness * std::max(1.0, std::abs(spring.rest)));
  }
  for (const JointSpring& spring : model.mechanism.joint_springs) {
    const double q = s.q[spring.q];
    const double slope = steepest(model, spring.curve);
    largest = std::max(largest, slope * std::max(1.0, std::abs(q)));
  }
  for (const LoadStructure& load : model.mechanism.loads) {
    if (!load.course.q.exists()) continue;
    const double q = std::abs(s.q[load.course.q]);
    largest = std::max(largest, steepest(model, load.course) * std::max({1.0, reach, q}));
  }
  for (const StopIndex i : indices_of(model.parameters.stops)) {
    const StopParameters<double>& stop = model.parameters.stops[i];
    const double depth = stop_depth(model.mechanism.stops[i], stop, s.q.data());
    if (!(depth > 0.0)) continue;
    const double slope = stop.contact.exponent * stop.contact.stiffness *
                         std::pow(depth, stop.contact.exponent - 1.0);
    largest = std::max(largest, slope * std::max(1.0, std::abs(stop.limit)));
  }
  return 8.0 * std::numeric_limits<double>::epsilon() *
         std::max(largest, stiffest_line(model, s) * reach);
}

class EquilibriumSearch {
 public:
  EquilibriumSearch(const Model& model, const State<double>& start)
      : model_(model),
        free_(free_velocities(model)),
        w_(make_workspace<double>(model.mechanism)),
        x_(start) {
    std::fill(x_.v.begin(), x_.v.end(), 0.0);
    report_.time = start.t;
  }

  StaticsReport run(State<double>& s) {
    const State<double> start = x_;
    iterate();
    if (!report_.converged) {
      x_ = descend_to_rest(model_, start, free_, w_);
      report_.descended = x_.q != start.q;
      if (report_.descended) iterate();
    }
    if (!report_.converged) {
      report_.reason = describe_unbalance(model_, start, free_, w_);
      return report_;
    }
    for (const PositionIndex i : indices_of(s.q)) {
      report_.displacement = std::max(report_.displacement, std::abs(x_.q[i] - s.q[i]));
    }
    report_.multipliers = lambda_;
    report_.holding = VectorXd::Zero(model_.mechanism.nv);
    const VectorXd net = net_force(balance_, lambda_);
    for (const VelocityIndex k : model_.held) report_.holding[k.value()] = -net[k.value()];
    static_cast<StabilityReport&>(report_) = judge_stability(model_, x_, lambda_, free_, w_);
    s = x_;
    return report_;
  }

 private:
  // From x_.
  void iterate() {
    report_.iterations = 0;
    const double tolerance =
        std::max(kForceTolerance * force_scale(model_, x_.t), rounding_floor(model_, x_));
    balance_ = compute_balance(model_, x_, w_);
    lambda_ = least_multipliers(balance_, free_);
    for (;; ++report_.iterations) {
      const VectorXd force = take_entries(net_force(balance_, lambda_), free_);
      report_.force_residual = force.size() > 0 ? force.lpNorm<Eigen::Infinity>() : 0.0;
      report_.closure_residual = balance_.phi.norm();
      report_.converged =
          report_.force_residual <= tolerance && report_.closure_residual <= kClosedTolerance;
      if (report_.converged || report_.iterations == kMaxIterations) return;
      if (!force.allFinite()) return;
      move(force);
    }
  }

  void move(const VectorXd& force) {
    const MatrixXd gradient = compute_force_gradient(model_, x_, lambda_, free_, w_).value;
    const BalanceSystem system = make_balance_system(gradient, balance_, force, free_);
    const VectorXd step = newton_step(system, balance_.phi.size());
    const auto n = static_cast<Eigen::Index>(free_.size());
    const double longest = n > 0 ? step.head(n).lpNorm<Eigen::Infinity>() : 0.0;
    const double part = longest > kLongestStep ? kLongestStep / longest : 1.0;
    const int nv = model_.mechanism.nv;
    x_ = displaced(model_.mechanism, x_, scatter_entries(part * step.head(n), free_, nv));
    lambda_ += part * step.tail(balance_.phi.size());
    balance_ = compute_balance(model_, x_, w_);
  }

  const Model& model_;
  std::vector<int> free_;
  Workspace<double> w_;
  State<double> x_;
  Balance balance_;
  VectorXd lambda_;
  StaticsReport report_;
};

}  // namespace

StaticsReport solve_statics(const Model& model, State<double>& s) {
  return EquilibriumSearch(model, s).run(s);
}

Model with_holding_efforts(const Model& model, const StaticsReport& report) {
  Model held = model;
  for (const VelocityIndex k : model.held) {
    if (is_driven(model.mechanism, k)) continue;
    held.mechanism.loads.push_back({.type = LoadType::drive, .v = k});
    held.parameters.loads.push_back({{report.holding[k.value()], 0.0, 0.0, 0.0}, 0.0, {}, {}});
  }
  return held;
}

}  // namespace linkstudy
