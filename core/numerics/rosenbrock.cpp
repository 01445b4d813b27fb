// Wrong sizes cannot occur; the checks of ublas would throw on matrices that are not finite.
#define BOOST_UBLAS_NDEBUG 1
#include <boost/numeric/odeint/stepper/rosenbrock4.hpp>
#include <boost/numeric/odeint/stepper/rosenbrock4_controller.hpp>
#include <cmath>
#include <optional>

#include "core/numerics/difference_jacobian.h"
#include "core/numerics/odeint_steppers.h"

namespace linkstudy {
namespace {

namespace odeint = boost::numeric::odeint;
namespace ublas = boost::numeric::ublas;

// Boost 1.74 has the weight of df/dt in the fourth stage with the wrong sign, which leaves order 1
// where f depends on the time.
struct Rodas : odeint::default_rosenbrock_coefficients<double> {
  const double d4 = -0.3620000000000023e-01;
};

// The stepper knows one absolute tolerance: it is given the unknowns u_i = y_i / absolute_i, for
// which that is 1. The method itself is the same in any scale of the unknowns.
class Rosenbrock final : public AdaptiveIntegrator {
 public:
  explicit Rosenbrock(AdaptiveProblem p)
      : AdaptiveIntegrator(std::move(p)),
        n_(problem().absolute.size()),
        scale_(problem().absolute),
        jacobian_(typical_sizes(problem()), problem().passive),
        begin_(n_),
        end_(n_),
        inside_(n_),
        y_(n_),
        slope_(n_),
        counted_([this](double t, const double* at, double* dy) { evaluate(t, at, dy); }) {
    forget_steps();
  }

 private:
  using Vector = ublas::vector<double>;
  using Matrix = ublas::matrix<double>;
  using Stepper = odeint::rosenbrock4_controller<odeint::rosenbrock4<double, Rodas>>;

  // Where the absolute and the relative tolerance are the same.
  static std::vector<double> typical_sizes(const AdaptiveProblem& p) {
    std::vector<double> sizes = p.absolute;
    for (double& x : sizes) x /= p.relative;
    return sizes;
  }

  void forget_slopes() override { known_ = linearized_ = false; }
  void forget_steps() override { stepper_.emplace(1.0, problem().relative); }

  const double* slopes() override {
    if (!known_) evaluate(t(), y(), slope_.data());
    known_ = true;
    return slope_.data();
  }

  // The slopes at the begin of the step are known, also when the step is tried again.
  void write_slopes(const Vector& u, Vector& du, double time) {
    const double* dy = slope_.data();
    if (&u != &begin_) {
      for (std::size_t i = 0; i < n_; ++i) y_[i] = u[i] * scale_[i];
      evaluate(time, y_.data(), inside_.data());
      dy = inside_.data();
    }
    for (std::size_t i = 0; i < n_; ++i) du[i] = dy[i] / scale_[i];
  }

  void write_jacobian(Matrix& j, Vector& by_time) const {
    for (std::size_t i = 0; i < n_; ++i) {
      for (std::size_t k = 0; k < n_; ++k) {
        j(i, k) =
            jacobian_.by_unknown(static_cast<int>(i), static_cast<int>(k)) * scale_[k] / scale_[i];
      }
      by_time[i] = jacobian_.by_time()[i] / scale_[i];
    }
  }

  void linearize(double h) {
    if (!linearized_) jacobian_.update(counted_, t(), y(), h);
    linearized_ = true;
  }

  Trial attempt(double h, State& end) override {
    slopes();
    linearize(h);
    for (std::size_t i = 0; i < n_; ++i) begin_[i] = y()[i] / scale_[i];
    const auto slopes_at = [this](const Vector& u, Vector& du, double s) {
      write_slopes(u, du, s);
    };
    const auto jacobian_at = [this](const Vector&, Matrix& j, double, Vector& by_time) {
      write_jacobian(j, by_time);
    };
    double time = t(), next = h;
    const auto result =
        stepper_->try_step(std::make_pair(slopes_at, jacobian_at), begin_, time, end_, next);
    for (std::size_t i = 0; i < n_; ++i) end[i] = end_[i] * scale_[i];
    if (result != odeint::success) return {false, next};
    stepper_->stepper().prepare_dense_output();
    forget_slopes();
    return {true, next};
  }

  void interpolate(double time, double* out) override {
    stepper_->stepper().calc_state(time, middle_, begin_, t_old(), end_, t());
    for (std::size_t i = 0; i < n_; ++i) out[i] = middle_[i] * scale_[i];
  }

  std::size_t n_;
  std::vector<double> scale_;
  DifferenceJacobian jacobian_;
  std::optional<Stepper> stepper_;
  Vector begin_, end_;  // of the last step, scaled
  Vector middle_ = Vector(n_);
  State inside_, y_, slope_;
  Slopes counted_;
  bool known_ = false;       // slope_ is of (t(), y())
  bool linearized_ = false;  // jacobian_ too
};

}  // namespace

std::unique_ptr<AdaptiveIntegrator> make_rosenbrock(AdaptiveProblem problem) {
  return std::make_unique<Rosenbrock>(std::move(problem));
}

}  // namespace linkstudy
