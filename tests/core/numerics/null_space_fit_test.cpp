// The least of a + W^T n over J^T n = 0 against the pseudo-inverse of Eigen.
#include "core/numerics/null_space_fit.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>

#include "tests/support/near.h"
#include "tests/support/random.h"

namespace linkstudy::testing::null_space_fit_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Problem {
  MatrixXd J, W;  // by row of J
  VectorXd a;
  int rank;
  int counted;
};

// Rows of J of rank `rank`, sizes of its columns decades apart.
Problem random_problem(int rows, int columns, int rank, int effects, int counted, Random& random) {
  const MatrixXd left = random.matrix(rows, rank, 1.0);
  MatrixXd right = random.matrix(rank, columns, 1.0);
  Problem p{{}, random.matrix(rows, effects, 1.0), random.vector(effects, 1.0), rank, counted};
  for (int k = 0; k < columns; ++k) right.col(k) *= std::pow(10.0, k % 4);
  p.J = left * right;
  return p;
}

VectorXd change_by_pseudo_inverse(const Problem& p) {
  const Eigen::FullPivLU<MatrixXd> lu = [&] {
    Eigen::FullPivLU<MatrixXd> made;
    made.setThreshold(1e-9);
    made.compute(p.J.transpose());
    return made;
  }();
  if (lu.dimensionOfKernel() == 0) return VectorXd::Zero(p.a.size());
  const MatrixXd H = p.W.transpose() * lu.kernel();
  const VectorXd z =
      H.topRows(p.counted).completeOrthogonalDecomposition().solve(-p.a.head(p.counted));
  return H * z;
}

VectorXd change_by_fit(const Problem& p) {
  const auto rows = static_cast<int>(p.J.rows()), columns = static_cast<int>(p.J.cols());
  const auto effects = static_cast<int>(p.W.cols());
  NullSpaceFit fit(rows, columns, effects, p.counted);
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::Map<RowMajor>(fit.jacobian(), rows, columns) = p.J;
  Eigen::Map<RowMajor>(fit.effects(), rows, effects) = p.W;
  fit.reduce(p.rank);
  Eigen::Map<VectorXd>(fit.given(), effects) = p.a;
  fit.fit();
  return Eigen::Map<const VectorXd>(fit.change(), effects);
}

}  // namespace

TEST(NullSpaceFit, Is_the_least_squares_change_within_the_null_space) {
  Random random(11);
  for (const auto& [rows, columns, rank] :
       {std::array{5, 3, 2}, {11, 6, 4}, {6, 8, 6}, {7, 1, 0}, {5, 0, 0}, {12, 20, 9}}) {
    const Problem p = random_problem(rows, columns, rank, 36, 24, random);
    EXPECT_TRUE(near_absolute(change_by_fit(p), change_by_pseudo_inverse(p), 1e-10))
        << rows << " " << columns << " " << rank;
  }
}

TEST(NullSpaceFit, Does_not_depend_on_the_order_of_rows) {
  Random random(3);
  const Problem p = random_problem(9, 6, 4, 30, 30, random);
  Problem turned = p;
  turned.J = p.J.colwise().reverse().eval();
  turned.W = p.W.colwise().reverse().eval();
  EXPECT_TRUE(near_absolute(change_by_fit(turned), change_by_fit(p), 1e-11));
}

// What the counted entries cannot tell is left alone.
TEST(NullSpaceFit, A_change_without_effect_on_what_counts_is_not_made) {
  Random random(5);
  Problem p = random_problem(4, 3, 2, 12, 6, random);
  p.W.leftCols(6).setZero();
  EXPECT_EQ(change_by_fit(p).norm(), 0.0);
}

}  // namespace linkstudy::testing::null_space_fit_test
