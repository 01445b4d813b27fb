// Radau IIA of three stages, order 5 (Hairer and Wanner, Solving Ordinary Differential Equations
// II, sec. IV.5 and IV.8): collocation at c = (4 - sqrt 6)/10, (4 + sqrt 6)/10, 1 of a step,
//   z_i = h sum_j a_ij f(t + c_j h, y + z_j),   y' = y + z_3,
// by simplified Newton steps with one Jacobian J for all stages. In the basis in which A^-1 falls
// into the real eigenvalue gamma and the pair alpha +- i beta, each takes one real and one complex
// system with gamma/h - J and (alpha - i beta)/h - J. J is kept while Newton converges fast, its
// factors while the step does not change.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "core/numerics/adaptive_methods.h"
#include "core/numerics/dense.h"
#include "core/numerics/difference_jacobian.h"

namespace linkstudy {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::RowVector3d;
using Eigen::Vector3d;
using Eigen::VectorXcd;
using Eigen::VectorXd;

constexpr int kMostIterations = 10;      // of Newton in a step
constexpr double kFastNewton = 1e-3;     // rate of convergence at which J is kept
constexpr double kFirstRate = 10.0;      // of Newton's first change: of little meaning yet
constexpr double kSafety = 0.9;          // of a step that is predicted
constexpr double kMostGrowth = 8.0;      // of a step
constexpr double kMostShrinkage = 5.0;   // of a step
constexpr double kWorthFactoring = 1.2;  // growth below which the factors are worth more
constexpr double kAfterFailure = 0.5;    // of a step at which Newton has failed

// The method by its definition, and the embedded formula of order 3 with the real eigenvalue of A
// as the weight of the slope at the begin.
struct Coefficients {
  Vector3d c;
  Matrix3d inverse;  // A^-1
  Matrix3d basis;    // columns: eigenvector of gamma, real and imaginary part of the pair's
  Matrix3d basis_inverse;
  double gamma, alpha, beta;
  double weight;         // gamma_0 = 1 / gamma
  RowVector3d embedded;  // of z: (b^ - b) A^-1
  Matrix3d powers;       // of z: coefficients of s, s^2, s^3 of the polynomial through 0 and z

  Coefficients() {
    const double root = std::sqrt(6.0);
    c << (4.0 - root) / 10.0, (4.0 + root) / 10.0, 1.0;
    Matrix3d monomials, integrals;  // c_i^k and c_i^(k+1) / (k+1)
    for (int k = 0; k < 3; ++k) {
      monomials.col(k) = c.array().pow(k);
      integrals.col(k) = c.array().pow(k + 1) / (k + 1);
    }
    inverse = monomials * integrals.inverse();
    powers = (c.asDiagonal() * monomials).inverse();
    const GeneralEigen eigen = decompose_general(inverse);
    int real = 0;
    for (int i = 1; i < 3; ++i) {
      if (std::fabs(eigen.values[i].imag()) < std::fabs(eigen.values[real].imag())) real = i;
    }
    const int pair = (real + 1) % 3;
    gamma = eigen.values[real].real();
    alpha = eigen.values[pair].real();
    beta = eigen.values[pair].imag();
    basis.col(0) = eigen.vectors.col(real).real();
    basis.col(1) = eigen.vectors.col(pair).real();
    basis.col(2) = eigen.vectors.col(pair).imag();
    basis_inverse = basis.inverse();
    weight = 1.0 / gamma;
    // b is the last row of A; b^ has the moments 1/q less what the begin contributes.
    const RowVector3d moments(1.0 - weight, 0.5, 1.0 / 3.0);
    const RowVector3d b = (integrals * monomials.inverse()).row(2);
    embedded = (moments * monomials.inverse() - b) * inverse;
  }
};

const Coefficients& coefficients() {
  static const Coefficients one;
  return one;
}

class Radau final : public AdaptiveIntegrator {
 public:
  explicit Radau(AdaptiveProblem p)
      : AdaptiveIntegrator(std::move(p)),
        n_(static_cast<int>(
            std::ranges::count_if(problem().absolute, [](double x) { return std::isfinite(x); }))),
        integrals_(problem().size() - n_),
        differences_(typical_sizes(problem()), problem().passive),
        counted_([this](double t, const double* y, double* dy) { evaluate(t, y, dy); }),
        matrix_(n_, n_),
        shifted_(n_, n_),
        shifted_complex_(n_, n_),
        scale_(n_),
        slope_(n_ + integrals_),
        state_(n_),
        error_(n_),
        pair_(n_),
        solved_(n_),
        z_(n_, 3),
        w_(n_, 3),
        f_(n_, 3),
        residual_(n_, 3),
        change_(n_, 3),
        polynomial_(n_, 3),
        of_stages_(n_),
        before_(n_),
        old_(n_ + integrals_),
        whole_(n_ + integrals_),
        whole_slope_(n_ + integrals_),
        integrand_(integrals_, 3),
        integral_(integrals_, 3) {
    const double relative = problem().relative;
    newton_limit_ = std::max(10.0 * std::numeric_limits<double>::epsilon() / relative,
                             std::min(0.03, std::sqrt(relative)));
  }

 private:
  using Stages = Eigen::Matrix<double, Eigen::Dynamic, 3>;
  enum class Newton { converged, too_slow, not_finite };

  // Where the absolute and the relative tolerance are the same.
  static std::vector<double> typical_sizes(const AdaptiveProblem& p) {
    std::vector<double> sizes = p.absolute;
    for (double& x : sizes) x /= p.relative;
    return sizes;
  }

  void forget_slopes() override { known_ = false; }
  void forget_steps() override {
    linearized_ = has_polynomial_ = has_history_ = rejected_last_ = false;
    factored_ = 0.0;
    left_ = 1.0;
  }

  const double* slopes() override {
    if (!known_) evaluate(t(), y(), slope_.data());
    known_ = true;
    return slope_.data();
  }

  Eigen::Map<const VectorXd> begin() const { return {y(), n_}; }
  Eigen::Map<const VectorXd> begin_of_integrals() const { return {y() + n_, integrals_}; }

  // Slopes at `state_`, in whole_slope_.
  void evaluate_whole(double time) {
    whole_.head(n_) = state_;
    whole_.tail(integrals_) = begin_of_integrals();
    evaluate(time, whole_.data(), whole_slope_.data());
  }

  void linearize() {
    const SlopeDerivative& derivative = problem().derivative;
    if (!derivative || !derivative(t(), y(), matrix_.data())) {
      differences_.update(counted_, t(), y());
      for (int k = 0; k < n_; ++k)
        for (int i = 0; i < n_; ++i) matrix_(i, k) = differences_.by_unknown(i, k);
    }
    linearized_ = true;
    fresh_ = true;
    factored_ = 0.0;
  }

  void factorize(double h) {
    if (factored_ == h) return;
    const Coefficients& k = coefficients();
    shifted_ = -matrix_;
    shifted_.diagonal().array() += k.gamma / h;
    real_.compute(shifted_);
    shifted_complex_ = -matrix_.cast<std::complex<double>>();
    shifted_complex_.diagonal().array() += std::complex<double>(k.alpha, -k.beta) / h;
    complex_.compute(shifted_complex_);
    factored_ = h;
  }

  double norm(const Eigen::Ref<const Stages>& x) const {
    return std::sqrt((x.array().colwise() / scale_.array()).square().sum() / (3.0 * n_));
  }

  // Where the polynomial of the last step leads, as far as it starts at its end.
  void predict(double h) {
    if (!has_polynomial_) {
      z_.setZero();
    } else {
      const double part = h / length_;
      for (int i = 0; i < 3; ++i) {
        const double s = 1.0 + coefficients().c[i] * part;
        z_.col(i) = polynomial_ * Vector3d(s - 1.0, s * s - 1.0, s * s * s - 1.0);
      }
    }
    w_.noalias() = z_ * coefficients().basis_inverse.transpose();
  }

  void evaluate_stages(double h) {
    for (int i = 0; i < 3; ++i) {
      state_ = begin() + z_.col(i);
      evaluate_whole(t() + coefficients().c[i] * h);
      f_.col(i) = whole_slope_.head(n_);
      integrand_.col(i) = whole_slope_.tail(integrals_);
    }
  }

  // The change of w that the linearised equations ask for.
  void solve_stages(double h) {
    const Coefficients& k = coefficients();
    residual_.noalias() = f_ * k.basis_inverse.transpose();
    residual_.col(0) -= k.gamma / h * w_.col(0);
    residual_.col(1) -= (k.alpha * w_.col(1) + k.beta * w_.col(2)) / h;
    residual_.col(2) -= (k.alpha * w_.col(2) - k.beta * w_.col(1)) / h;
    change_.col(0) = real_.solve(residual_.col(0));
    pair_.real() = residual_.col(1);
    pair_.imag() = residual_.col(2);
    solved_ = complex_.solve(pair_);
    change_.col(1) = solved_.real();
    change_.col(2) = solved_.imag();
  }

  // Of what nothing depends on, from the slopes at the stages: no equation is left.
  void integrate(double h) {
    const Coefficients& k = coefficients();
    Stages w = integrand_ * k.basis_inverse.transpose();
    for (int i = 0; i < integrals_; ++i) {
      const std::complex<double> pair =
          h * std::complex<double>(w(i, 1), w(i, 2)) / std::complex<double>(k.alpha, -k.beta);
      w.row(i) << h / k.gamma * w(i, 0), pair.real(), pair.imag();
    }
    integral_ = w * k.basis.transpose();
  }

  Newton iterate(double h) {
    double before = 0.0;
    rate_ = kFastNewton;
    // What the first iteration leaves, by how the last step went; never taken for less than that
    // of a fast one, since f may have changed.
    double left = std::pow(std::max(left_, kFastNewton), 0.8);
    for (iterations_ = 1; iterations_ <= kMostIterations; ++iterations_) {
      evaluate_stages(h);
      if (!f_.allFinite()) return Newton::not_finite;
      solve_stages(h);
      const double size = norm(change_);
      if (!std::isfinite(size)) return Newton::not_finite;
      if (iterations_ > 1) {
        const double quotient = size / before;
        rate_ = iterations_ == 2 ? quotient : std::sqrt(quotient * last_quotient_);
        last_quotient_ = quotient;
        if (rate_ >= (iterations_ > 2 ? 0.99 : kFirstRate)) return Newton::too_slow;
        left = rate_ < 0.99 ? rate_ / (1.0 - rate_) : 100.0;
        const double expected = left * size * std::pow(rate_, kMostIterations - 1 - iterations_);
        if (iterations_ > 2 && expected > newton_limit_) return Newton::too_slow;
      }
      before = std::max(size, std::numeric_limits<double>::min());
      w_ += change_;
      z_.noalias() = w_ * coefficients().basis.transpose();
      if (left * size <= newton_limit_) {
        left_ = left;
        return Newton::converged;
      }
    }
    return Newton::too_slow;
  }

  // Of the embedded formula, filtered by gamma/h - J so that stiff parts do not rule it; where that
  // is too large after a start or a rejection, of the state moved by it.
  double estimate_error(double h) {
    const Coefficients& k = coefficients();
    of_stages_.noalias() = z_ * (k.embedded.transpose() * (k.gamma / h));
    state_ = slope_.head(n_) + of_stages_;
    error_ = real_.solve(state_);
    double size = error_norm();
    if (size >= 1.0 && (rejected_last_ || !has_history_)) {
      state_ = begin() + error_;
      evaluate_whole(t());
      before_ = whole_slope_.head(n_);
      before_ += of_stages_;
      error_ = real_.solve(before_);
      size = error_norm();
    }
    return std::max(size, 1e-10);
  }

  double error_norm() const {
    return std::sqrt((error_.array() / scale_.array()).square().sum() / n_);
  }

  Newton solve(double h) {
    for (;;) {
      if (!linearized_) linearize();
      factorize(h);
      predict(h);
      const Newton result = iterate(h);
      if (result == Newton::converged || fresh_) return result;
      linearized_ = false;  // an old Jacobian may be to blame
    }
  }

  Trial attempt(double h, State& end) override {
    slopes();
    scale_ = Eigen::Map<const VectorXd>(problem().absolute.data(), n_) +
             problem().relative * begin().cwiseAbs();
    const Newton result = solve(h);
    integrate(h);
    Eigen::Map<VectorXd>(end.data(), n_) = begin() + z_.col(2);
    Eigen::Map<VectorXd>(end.data() + n_, integrals_) = begin_of_integrals() + integral_.col(2);
    if (result != Newton::converged) {
      if (result == Newton::not_finite) end[0] = std::numeric_limits<double>::quiet_NaN();
      rejected_last_ = true;
      left_ = 1.0;
      return {false, kAfterFailure * h};
    }
    const double error = estimate_error(h);
    if (!std::isfinite(error)) {
      end[0] = error;
      return {false, kAfterFailure * h};
    }
    const double next = next_length(h, error);
    if (error >= 1.0) {
      rejected_last_ = true;
      return {false, next};
    }
    accept(h, error);
    return {true, next};
  }

  // By the error, by how hard Newton had to work, and, as Gustafsson proposed, by how the error
  // has changed since the last step.
  double next_length(double h, double error) const {
    const double most = kMostIterations;
    const double work = (2.0 * most + 1.0) / (2.0 * most + iterations_);
    const auto bounded = [](double x) { return std::clamp(x, 1.0 / kMostGrowth, kMostShrinkage); };
    double shrinkage = bounded(std::pow(error, 0.25) / (kSafety * std::min(1.0, work)));
    if (error < 1.0 && has_history_) {
      const double trend = accepted_length_ / h * std::pow(error * error / accepted_error_, 0.25);
      shrinkage = std::max(shrinkage, bounded(trend / kSafety));
    }
    if (error < 1.0 && rejected_last_) shrinkage = std::max(shrinkage, 1.0);
    const bool keeps = error < 1.0 && shrinkage <= 1.0 && shrinkage * kWorthFactoring >= 1.0;
    return keeps && rate_ <= kFastNewton ? h : h / shrinkage;
  }

  void accept(double h, double error) {
    polynomial_.noalias() = z_ * coefficients().powers.transpose();
    integral_ = (integral_ * coefficients().powers.transpose()).eval();
    old_.head(n_) = begin();
    old_.tail(integrals_) = begin_of_integrals();
    length_ = h;
    has_polynomial_ = has_history_ = true;
    accepted_length_ = h;
    accepted_error_ = std::max(1e-2, error);
    rejected_last_ = fresh_ = false;
    known_ = false;
    if (rate_ > kFastNewton) linearized_ = false;
  }

  void interpolate(double time, double* out) override {
    const double s = (time - t_old()) / length_;
    const Vector3d powers(s, s * s, s * s * s);
    Eigen::Map<VectorXd>(out, n_) = old_.head(n_) + polynomial_ * powers;
    Eigen::Map<VectorXd>(out + n_, integrals_) = old_.tail(integrals_) + integral_ * powers;
  }

  int n_;          // unknowns whose errors count
  int integrals_;  // the others: the last, on which nothing depends
  DifferenceJacobian differences_;
  Slopes counted_;
  MatrixXd matrix_, shifted_;
  MatrixXcd shifted_complex_;
  Eigen::PartialPivLU<MatrixXd> real_;
  Eigen::PartialPivLU<MatrixXcd> complex_;
  VectorXd scale_, slope_, state_, error_;
  VectorXcd pair_, solved_;
  Stages z_, w_, f_, residual_, change_;
  Stages polynomial_;  // of the last step
  VectorXd of_stages_, before_, old_;
  VectorXd whole_, whole_slope_;  // integrals with them
  Stages integrand_;              // slopes of integrals at the stages
  Stages integral_;               // at the stages, then as polynomial_
  double length_ = 0.0;           // of the last step
  double factored_ = 0.0;         // step of the factors; 0: none
  double newton_limit_ = 0.0;
  double rate_ = 0.0, last_quotient_ = 0.0;
  double left_ = 1.0;  // rate / (1 - rate) of the last step
  double accepted_length_ = 0.0, accepted_error_ = 0.0;
  int iterations_ = 0;
  bool known_ = false;       // slope_ is of (t(), y())
  bool linearized_ = false;  // matrix_ is good enough
  bool fresh_ = false;       // and of (t(), y())
  bool has_polynomial_ = false, has_history_ = false, rejected_last_ = false;
};

}  // namespace

std::unique_ptr<AdaptiveIntegrator> make_radau(AdaptiveProblem problem) {
  return std::make_unique<Radau>(std::move(problem));
}

}  // namespace linkstudy
