// Factorisations of the step loop against Eigen's dense ones.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <vector>

#include "core/numerics/branch_sparse.h"
#include "core/numerics/rank.h"
#include "tests/support/near.h"
#include "tests/support/random.h"

namespace linkstudy::testing::linear_systems_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct SparseCase {
  int n;
  std::vector<int> parent;
  MatrixXd h;
};

using Node = TypedIndex<struct NodeTag>;

struct Tree {
  IndexedVector<Node, Node> v_parent;
};

Tree tree(const SparseCase& c) {
  Tree t;
  for (const int parent : c.parent) t.v_parent.push_back(Node(parent));
  return t;
}

IndexedMatrixView<Node, Node, double> view(RowMajor& h) {
  return {h.data(), static_cast<int>(h.cols())};
}
IndexedPointer<Node, double> view(VectorXd& x) {
  return x.data();
}

// Sum over nodes of w w^T with w on the path to the root: the sparsity of a mass matrix.
SparseCase random_tree_matrix(std::uint64_t seed) {
  Random random(seed);
  SparseCase c{1 + random.below(14), {}, {}};
  c.h = MatrixXd::Zero(c.n, c.n);
  for (int k = 0; k < c.n; ++k) c.parent.push_back(random.below(k + 1) - 1);
  for (int k = 0; k < c.n; ++k) {
    for (int copy = 0; copy < 3; ++copy) {
      VectorXd w = VectorXd::Zero(c.n);
      for (int i = k; i >= 0; i = c.parent[static_cast<std::size_t>(i)]) w[i] = random.within(1.0);
      c.h += w * w.transpose();
    }
    c.h(k, k) += 0.1;
  }
  return c;
}

double condition(const MatrixXd& a) {
  const VectorXd s = a.jacobiSvd().singularValues();
  return s[0] / s[s.size() - 1];
}

// Rows drawn at random, some of them sums of others: J J^T has the rank of J.
MatrixXd random_rows(Random& random, int rows, int columns, int rank) {
  return random.matrix(rows, rank, 1.0) * random.matrix(rank, columns, 1.0);
}

}  // namespace

TEST(BranchSparse, The_factor_multiplies_back_to_the_matrix_without_fill_in) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const SparseCase c = random_tree_matrix(seed);
    RowMajor factor = c.h;
    factor.triangularView<Eigen::StrictlyUpper>().setConstant(1e99);  // never read
    VectorXd inverse_pivot(c.n);
    factorize_branch_sparse(tree(c), view(factor), view(inverse_pivot));
    MatrixXd l = MatrixXd::Identity(c.n, c.n);
    for (int k = 0; k < c.n; ++k) {
      for (int i = c.parent[static_cast<std::size_t>(k)]; i >= 0;
           i = c.parent[static_cast<std::size_t>(i)]) {
        l(k, i) = factor(k, i);
      }
    }
    const MatrixXd d = inverse_pivot.cwiseInverse().asDiagonal();
    // A factorisation is backward stable: a few roundings of the largest entry.
    ASSERT_TRUE(near_relative(l.transpose() * d * l, c.h, 1e-14)) << "seed " << seed;
  }
}

TEST(BranchSparse, Solutions_are_those_of_a_dense_Cholesky_factorisation) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const SparseCase c = random_tree_matrix(seed);
    RowMajor factor = c.h;
    VectorXd inverse_pivot(c.n);
    const VectorXd b = Random(seed + 1000).vector(c.n, 1.0);
    VectorXd x = b;
    factorize_branch_sparse(tree(c), view(factor), view(inverse_pivot));
    solve_branch_transposed(tree(c), view(factor), view(x));
    x = x.cwiseProduct(inverse_pivot);
    solve_branch(tree(c), view(factor), view(x));
    ASSERT_TRUE(near_relative(x, c.h.llt().solve(b), 1e-14 * condition(c.h))) << "seed " << seed;
  }
}

TEST(Rank, A_product_of_thin_factors_has_their_width_and_a_clear_gap) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Random random(seed);
    const int rank = 1 + random.below(5);
    const MatrixXd a = random_rows(random, 7, 9, rank);
    const NumericalRank r = numerical_rank(a, 1e-9);
    EXPECT_EQ(r.rank, rank) << "seed " << seed;
    const VectorXd s = a.jacobiSvd().singularValues();
    EXPECT_NEAR(r.smallest_kept, s[rank - 1] / s[0], 1e-12);
    EXPECT_LT(r.largest_dropped, 1e-13);
  }
}

TEST(Rank, The_tolerance_decides_and_both_sides_of_the_gap_are_reported) {
  const MatrixXd a = Eigen::Vector3d(2.0, 2e-4, 2e-8).asDiagonal();
  const NumericalRank loose = numerical_rank(a, 1e-3), tight = numerical_rank(a, 1e-6);
  EXPECT_EQ(loose.rank, 1);
  EXPECT_NEAR(loose.largest_dropped, 1e-4, 1e-16);
  EXPECT_EQ(tight.rank, 2);
  EXPECT_NEAR(tight.smallest_kept, 1e-4, 1e-16);
  EXPECT_NEAR(tight.largest_dropped, 1e-8, 1e-20);
  EXPECT_EQ(numerical_rank(MatrixXd::Zero(2, 3), 1e-9).rank, 0);
  EXPECT_EQ(numerical_rank(MatrixXd(0, 3), 1e-9).rank, 0);
  const MatrixXd roundings = 1e-16 * MatrixXd::Identity(2, 2);
  EXPECT_EQ(numerical_rank(roundings, 1e-9).rank, 2);
  EXPECT_EQ(numerical_rank(roundings, 1e-9, 1e-3).rank, 0);
}

TEST(Rank, The_null_space_is_orthonormal_and_mapped_to_zero) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    const int rank = 1 + random.below(5);
    const MatrixXd a = random_rows(random, 7, 9, rank);
    const MatrixXd n = null_space(a, 1e-9);
    ASSERT_EQ(n.cols(), a.cols() - rank) << "seed " << seed;
    EXPECT_LT((a * n).norm(), 1e-13 * a.norm());
    EXPECT_LT((n.transpose() * n - MatrixXd::Identity(n.cols(), n.cols())).norm(), 1e-13);
  }
  EXPECT_EQ(null_space(MatrixXd(0, 3), 1e-9).cols(), 3);
}

}  // namespace linkstudy::testing::linear_systems_test
