#include "core/numerics/bracketed_root.h"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace linkstudy {
namespace {

namespace policies = boost::math::policies;
using Quiet = policies::policy<policies::evaluation_error<policies::errno_on_error>,
                               policies::domain_error<policies::errno_on_error>>;

bool is_narrow(double a, double b) {
  const double size = std::max(std::fabs(a), std::fabs(b));
  return std::fabs(b - a) <= 4.0 * std::numeric_limits<double>::epsilon() * size;
}

}  // namespace

Bracket bracket_root(const std::function<double(double)>& f, double low, double high, double fa,
                     double fb) {
  if (is_narrow(low, high)) return {low, high};
  if (fa == 0.0) return {low, low};
  if (fb == 0.0) return {high, high};
  if (!(std::signbit(fa) != std::signbit(fb))) return {low, high};
  std::uintmax_t evaluations = 100;
  const auto found =
      boost::math::tools::toms748_solve(f, low, high, fa, fb, is_narrow, evaluations, Quiet());
  return {found.first, found.second};
}

}  // namespace linkstudy
