// The order p with which f(h) = f_0 + a h^p approaches its limit f_0, from values at a few sizes h.
// Ratios of the sizes may differ: with h1 < h2 < h3, r21 = h2 / h1, r32 = h3 / h2 and the
// differences e21 = f2 - f1, e32 = f3 - f2 it is the root of
//   r21^p (r32^p - 1) / (r21^p - 1) = e32 / e21
// (Celik et al. 2008, J. Fluids Eng. 130, 078001, eq. 3, with s = 1). The left side rises with p
// from ln r32 / ln r21, so that there is one root or none; it is bracketed, since the fixed point
// of the paper need not converge. Equal ratios: p = ln(e32 / e21) / ln r.
#pragma once

#include <optional>

namespace linkstudy::convergence {

// Nothing where no p > 0 fits: differences of unlike sign, or that do not fall with h.
std::optional<double> order_of_differences(double e21, double e32, double r21, double r32);

// Of errors against a known limit, E = a h^p: ln(E2 / E1) / ln r21. NaN where an error is zero.
double order_of_errors(double e1, double e2, double r21);

}  // namespace linkstudy::convergence
