// The factorisation of independent rows against Eigen's, and where it refuses.
#include "core/numerics/definite.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "tests/support/near.h"
#include "tests/support/random.h"

namespace linkstudy::testing::definite_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr double kMargin = 1e-6;

// Overwrites b with the solution unless it refuses.
bool solve(const MatrixXd& a, VectorXd& b) {
  const auto n = static_cast<int>(a.rows());
  RowMajor l = a;
  l.triangularView<Eigen::StrictlyUpper>().setConstant(1e99);  // never read
  VectorXd inverse(n);
  if (!factorize_definite(n, kMargin, l.data(), inverse.data())) return false;
  solve_definite(n, l.data(), inverse.data(), b.data());
  return true;
}

// Smallest pivot of L D L^T relative to the largest diagonal.
double smallest_pivot(const MatrixXd& a) {
  const MatrixXd l = a.llt().matrixL();
  return l.diagonal().cwiseAbs2().minCoeff() / a.diagonal().maxCoeff();
}

}  // namespace

TEST(Definite, Solutions_are_those_of_a_dense_Cholesky_factorisation) {
  int solved = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const int n = 1 + random.below(6);
    const MatrixXd j = random.matrix(n, n + 3, 1.0);
    const MatrixXd a = j * j.transpose();
    const VectorXd b = random.vector(n, 1.0);
    VectorXd x = b;
    ASSERT_EQ(solve(a, x), smallest_pivot(a) > kMargin) << "seed " << seed;
    const VectorXd s = a.jacobiSvd().singularValues();
    const double condition = s[0] / s[n - 1];
    if (x == b) continue;
    ++solved;
    ASSERT_TRUE(near_relative(x, a.llt().solve(b), 1e-14 * condition)) << "seed " << seed;
  }
  EXPECT_GT(solved, 190);
}

// The closed form for a size known to the compiler, against the factor for any size.
TEST(Definite, Three_unknowns_are_solved_and_refused_alike_by_inverse_and_by_factor) {
  int solved = 0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    Random random(seed);
    MatrixXd j = random.matrix(3, 4, 1.0);
    j.row(2) += 0.3 * static_cast<double>(seed % 5) * j.row(0);
    RowMajor a = j * j.transpose(), l = a;
    VectorXd b = random.vector(3, 1.0), x = b, unused(3);
    const bool clear = factorize_definite(Three(), kMargin, a.data(), unused.data());
    ASSERT_EQ(clear, factorize_definite(3, kMargin, l.data(), unused.data())) << "seed " << seed;
    if (!clear) continue;
    ++solved;
    solve_definite(Three(), a.data(), unused.data(), x.data());
    solve_definite(3, l.data(), unused.data(), b.data());
    const VectorXd s = (j * j.transpose()).jacobiSvd().singularValues();
    ASSERT_TRUE(near_relative(x, b, 1e-14 * s[0] / s[2])) << "seed " << seed;
  }
  EXPECT_GT(solved, 450);
}

TEST(Definite, A_small_pivot_refuses_the_matrix_and_a_large_one_does_not) {
  for (const double pivot : {0.5e-6, 2e-6}) {
    MatrixXd a = Eigen::Vector3d(1.0, pivot, 0.1).asDiagonal();
    VectorXd b = Eigen::Vector3d(1.0, pivot, 0.1);
    EXPECT_EQ(solve(a, b), pivot > kMargin);
  }
}

TEST(Definite, Dependent_vanishing_and_lost_rows_are_refused) {
  VectorXd b = Eigen::Vector2d(1.0, 1.0);
  EXPECT_FALSE(solve(MatrixXd::Ones(2, 2), b));
  EXPECT_FALSE(solve(MatrixXd::Zero(2, 2), b));
  EXPECT_FALSE(solve(MatrixXd::Constant(2, 2, std::nan("")), b));
}

}  // namespace linkstudy::testing::definite_test
