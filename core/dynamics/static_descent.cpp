#include "core/dynamics/static_descent.h"

#include <algorithm>
#include <cmath>

#include "core/dynamics/static_balance.h"
#include "core/dynamics/static_stability.h"
#include "core/kinematics/assembly.h"
#include "core/kinematics/scaled_closures.h"
#include "core/numerics/dense.h"

namespace linkstudy {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMaxSteps = 200;
constexpr int kMaxHalvings = 12;
constexpr double kLongestDescent = 0.2;  // rad or m
constexpr double kFloor = 1e-6;          // of the largest stiffness
constexpr double kOvershoot = 0.5;       // of the force along a step, that may be left against it
constexpr double kNear = 1e-6;           // of the force at the start: Newton finishes from there

class Descent {
 public:
  Descent(const Model& model, const std::vector<int>& free, Workspace<double>& w)
      : model_(model), free_(free), w_(w) {}

  State<double> run(const State<double>& start) {
    State<double> s = start;
    double first = 0.0;
    for (int i = 0; i < kMaxSteps; ++i) {
      const FreeDirections f = find_free_directions(model_, s, free_, w_);
      if (f.basis.cols() == 0) return start;
      const VectorXd force = force_along(s, f);
      if (i == 0) first = force.norm();
      if (!force.allFinite()) return start;
      if (force.norm() <= kNear * first) return s;
      s = shut(advanced(s, f, force));
    }
    return start;
  }

 private:
  // Applied forces on the free directions; closures have none there.
  VectorXd force_along(const State<double>& s, const FreeDirections& f) {
    const VectorXd tau = take_entries(compute_balance(model_, s, w_).tau, free_);
    return f.basis.transpose() * f.measure.cwiseProduct(tau);
  }

  State<double> moved(const State<double>& s, const FreeDirections& f, const VectorXd& along) {
    const VectorXd dq = f.measure.cwiseProduct(f.basis * along);
    return displaced(model_.mechanism, s, scatter_entries(dq, free_, model_.mechanism.nv));
  }

  State<double> advanced(const State<double>& s, const FreeDirections& f, const VectorXd& force) {
    const VectorXd lambda = least_multipliers(compute_balance(model_, s, w_), free_);
    const MatrixXd gradient = compute_force_gradient(model_, s, lambda, free_, w_).value;
    MatrixXd k = -(f.basis.transpose() * f.measure.asDiagonal() * gradient *
                   f.measure.asDiagonal() * f.basis);
    k = 0.5 * (k + k.transpose()).eval();
    const SymmetricEigen eigen = decompose_symmetric(k);
    const double floor = std::max(kFloor * eigen.values.cwiseAbs().maxCoeff(), 1e-12);
    const VectorXd stiffness = eigen.values.cwiseAbs().cwiseMax(floor);
    VectorXd step = eigen.vectors * (eigen.vectors.transpose() * force).cwiseQuotient(stiffness);
    const double longest = f.measure.cwiseProduct(f.basis * step).lpNorm<Eigen::Infinity>();
    if (longest > kLongestDescent) step *= kLongestDescent / longest;
    for (int i = 0; i < kMaxHalvings; ++i) {
      const State<double> next = moved(s, f, step);
      if (force_along(next, f).dot(step) >= -kOvershoot * force.dot(step)) return next;
      step *= 0.5;
    }
    return moved(s, f, step);
  }

  // Back onto the closures, holds untouched.
  State<double> shut(State<double> s) {
    for (int i = 0; i < 4; ++i) {
      const Balance b = compute_balance(model_, s, w_);
      if (b.phi.size() == 0 || b.phi.norm() <= kClosedTolerance) return s;
      const VectorXd dq = solve_least_squares(take_columns(b.j, free_), -b.phi);
      s = displaced(model_.mechanism, s, scatter_entries(dq, free_, model_.mechanism.nv));
    }
    return s;
  }

  const Model& model_;
  const std::vector<int>& free_;
  Workspace<double>& w_;
};

}  // namespace

State<double> descend_to_rest(const Model& model, const State<double>& start,
                              const std::vector<int>& free, Workspace<double>& w) {
  return Descent(model, free, w).run(start);
}

}  // namespace linkstudy
