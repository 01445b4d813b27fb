// Sobol indices from n blocks of values f(A), f(AB_1) .. f(AB_k), f(B) (design/samples.h):
//   first order  S_i = (1/n) sum f(B) (f(AB_i) - f(A)) / V   Saltelli et al. (2010), table 2 (b)
//   total        T_i = (1/2n) sum (f(A) - f(AB_i))^2 / V     Jansen (1999), the same table (f)
// V is the variance of f(A) and f(B) together, and f(B) is taken from their mean: the estimate of
// S_i does not scatter with the mean. S_i is the share of the variance that goes when x_i is fixed
// alone, T_i the share that stays when all others are fixed. Estimates of small S_i may be
// negative.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace linkstudy::sensitivity {

struct VarianceIndices {
  std::vector<double> first;
  std::vector<double> total;
  double mean = 0.0;
  double variance = 0.0;  // 0: there are no indices, all NaN
};

// `blocks` is (n, k + 2), a block a row; `rows`: which of them, some more than once in a resample.
VarianceIndices estimate_indices(const Eigen::MatrixXd& blocks, std::span<const std::size_t> rows);

}  // namespace linkstudy::sensitivity
