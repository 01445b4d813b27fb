// Multipliers of dependent rows against Eigen's complete orthogonal decomposition and against the
// full system of masses and rows in extended precision.
#include "core/numerics/redundant_system.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/base/pack.h"
#include "core/numerics/pivoted_qr.h"
#include "tests/support/near.h"
#include "tests/support/random.h"

namespace linkstudy::testing::redundant_system_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Extended = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

// Rows J of a system with mass matrix M, to be judged with the scales s and c.
struct Rows {
  MatrixXd j, m;
  VectorXd s, c;

  Rows(const MatrixXd& jacobian, const MatrixXd& mass)
      : j(jacobian), m(mass), s(VectorXd::Ones(j.rows())), c(VectorXd::Ones(j.cols())) {}
  MatrixXd a() const { return j * m.llt().solve(j.transpose()); }
};

MatrixXd random_mass(Random& random, Eigen::Index n) {
  const MatrixXd x = random.matrix(n, n, 1.0);
  return x * x.transpose() + 0.3 * MatrixXd::Identity(n, n);
}

// M = U U^T with U upper triangular, so L^T = U / diagonal and D = diagonal^2.
RedundantSystem<double> reduced(const Rows& rows, double tolerance) {
  const auto n = static_cast<int>(rows.j.cols());
  const MatrixXd backwards = rows.m.rowwise().reverse().colwise().reverse();
  const MatrixXd u = MatrixXd(backwards.llt().matrixL()).rowwise().reverse().colwise().reverse();
  const VectorXd diagonal = u.diagonal();
  const MatrixXd unit = u * diagonal.cwiseInverse().asDiagonal();
  RedundantSystem<double> system(static_cast<int>(rows.j.rows()), n);
  Eigen::Map<RowMajor>(system.jacobian(), rows.j.rows(), n) = rows.j;
  Eigen::Map<RowMajor>(system.factor(), rows.j.rows(), n) =
      unit.triangularView<Eigen::Upper>().solve(rows.j.transpose()).transpose();
  Eigen::Map<VectorXd>(system.inverse_pivot(), n) = diagonal.cwiseAbs2().cwiseInverse();
  Eigen::Map<VectorXd>(system.row_scale(), rows.j.rows()) = rows.s;
  Eigen::Map<VectorXd>(system.column_scale(), n) = rows.c;
  system.reduce(tolerance);
  system.factorize();
  return system;
}

VectorXd solved(RedundantSystem<double>& system, VectorXd b) {
  std::copy(b.begin(), b.end(), system.right_hand_side());
  system.solve();
  std::copy_n(system.right_hand_side(), b.size(), b.begin());
  return b;
}

// Least norm of S lambda, least squares of S^-1 (A lambda - b).
VectorXd expected(const Rows& rows, const VectorXd& b) {
  const VectorXd inverse = rows.s.cwiseInverse();
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> cod;
  cod.setThreshold(1e-10);
  cod.compute(inverse.asDiagonal() * rows.a() * inverse.asDiagonal());
  return inverse.cwiseProduct(cod.solve(inverse.cwiseProduct(b)));
}

// n rows of the given rank.
Rows random_dependent_rows(Random& random, int n, int rank) {
  const int columns = rank + 2;
  const MatrixXd j = random.matrix(n, rank, 1.0) * random.matrix(rank, columns, 1.0);
  return {j, random_mass(random, columns)};
}

VectorXd decades(Random& random, Eigen::Index n, double size) {
  VectorXd x = random.vector(n, size);
  for (double& value : x) value = std::pow(10.0, value);
  return x;
}

}  // namespace

TEST(PivotedQr, Its_triangle_multiplies_back_to_the_squares_of_the_columns) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed);
    const int length = 1 + random.below(8), count = 1 + random.below(8);
    const MatrixXd a = random.matrix(length, count, 1.0);
    MatrixXd qr = a;
    std::vector<int> order(static_cast<std::size_t>(count));
    std::iota(order.begin(), order.end(), 0);
    std::vector<double> exchanged(static_cast<std::size_t>(std::min(length, count)));
    ASSERT_EQ(factorize_pivoted(length, count, 1e-12, qr.data(), exchanged.data()),
              std::min(length, count));
    for (std::size_t k = 0; k < exchanged.size(); ++k) {
      std::swap(order[k], order[static_cast<std::size_t>(exchanged[k])]);
    }
    const MatrixXd r = qr.triangularView<Eigen::Upper>();
    const MatrixXd permuted = a(Eigen::all, order);
    ASSERT_TRUE(near_absolute(r.transpose() * r, permuted.transpose() * permuted, 1e-13)) << seed;
    for (int i = 1; i < std::min(length, count); ++i) {
      ASSERT_LE(std::fabs(r(i, i)), std::fabs(r(i - 1, i - 1)) * (1 + 1e-12)) << seed;
    }
  }
}

TEST(PivotedQr, Triangular_solves_invert_the_triangle) {
  Random random(7);
  const MatrixXd a = random.matrix(6, 6, 1.0) + 3.0 * MatrixXd::Identity(6, 6);
  const MatrixXd r = a.triangularView<Eigen::Upper>();
  const VectorXd b = random.vector(4, 1.0);
  VectorXd x = b, y = b;
  solve_upper(6, 4, 4.0, a.data(), x.data());
  solve_upper_transposed(6, 4, 4.0, a.data(), y.data());
  EXPECT_TRUE(near_absolute(r.topLeftCorner(4, 4) * x, b, 1e-14));
  EXPECT_TRUE(near_absolute(r.topLeftCorner(4, 4).transpose() * y, b, 1e-14));
}

TEST(RedundantSystem, Random_dependent_rows_get_the_least_norm_of_a_complete_decomposition) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Random random(seed);
    const int rank = 1 + random.below(6);
    Rows rows = random_dependent_rows(random, rank + random.below(5), rank);
    rows.s = decades(random, rows.j.rows(), 0.3);
    RedundantSystem<double> system = reduced(rows, 1e-7);
    ASSERT_EQ(system.rank(), rank) << "seed " << seed;
    const VectorXd b = rows.a() * random.vector(rows.j.rows(), 1.0);
    // The decomposition to compare with forms A: conditions drawn reach 1e6.
    ASSERT_TRUE(near_relative(solved(system, b), expected(rows, b), 1e-8)) << "seed " << seed;
    ASSERT_TRUE(near_relative(rows.a() * solved(system, b), b, 1e-9)) << "seed " << seed;
  }
}

TEST(RedundantSystem, Rows_out_of_range_are_met_in_least_squares) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed);
    // One independent combination: the range of S^-1 A S^-1 is a line, whatever the masses.
    Rows rows = random_dependent_rows(random, 4, 1);
    rows.s = decades(random, 4, 1.0);
    RedundantSystem<double> system = reduced(rows, 1e-7);
    const VectorXd b = random.vector(4, 1.0);
    ASSERT_TRUE(near_relative(solved(system, b), expected(rows, b), 1e-9)) << "seed " << seed;
  }
}

TEST(RedundantSystem, Units_of_the_rows_over_twelve_decades_change_nothing) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed);
    const int rank = 1 + random.below(5);
    const Rows rows = random_dependent_rows(random, rank + 1 + random.below(4), rank);
    const VectorXd b = rows.a() * random.vector(rows.j.rows(), 1.0);
    Rows other = rows;
    other.s = decades(random, rows.j.rows(), 6.0);
    other.j = other.s.asDiagonal() * rows.j;
    RedundantSystem<double> system = reduced(rows, 1e-7), scaled = reduced(other, 1e-7);
    ASSERT_EQ(scaled.rank(), rank) << "seed " << seed;
    const VectorXd x = solved(system, b);
    const VectorXd y = solved(scaled, other.s.cwiseProduct(b));
    ASSERT_TRUE(near_relative(other.s.cwiseProduct(y), x, 1e-9)) << "seed " << seed;
  }
}

TEST(RedundantSystem, Units_of_the_velocities_over_twelve_decades_change_nothing) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed);
    const int rank = 1 + random.below(5);
    const Rows rows = random_dependent_rows(random, rank + 2, rank);
    const VectorXd b = rows.a() * random.vector(rows.j.rows(), 1.0);
    Rows other = rows;
    other.c = decades(random, rows.j.cols(), 6.0);
    other.j = rows.j * other.c.asDiagonal();
    other.m = other.c.asDiagonal() * rows.m * other.c.asDiagonal();
    RedundantSystem<double> system = reduced(rows, 1e-7), scaled = reduced(other, 1e-7);
    ASSERT_EQ(scaled.rank(), rank) << "seed " << seed;
    ASSERT_TRUE(near_relative(solved(scaled, b), solved(system, b), 1e-8)) << "seed " << seed;
  }
}

// [M J^T; J 0] holds no inverse of a mass: its solution in extended precision is the truth. The
// condition of J M^-1 J^T reaches 1e18 here.
TEST(RedundantSystem, Masses_over_eighteen_decades_neither_drop_a_row_nor_blur_the_multipliers) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const int n = 2 + random.below(4), columns = n + 1 + random.below(3);
    VectorXd mass = decades(random, columns, 9.0);
    Rows rows(random.matrix(n, columns, 1.0), mass.asDiagonal());
    RedundantSystem<double> system = reduced(rows, 1e-7);
    ASSERT_EQ(system.rank(), n) << "seed " << seed;
    const VectorXd tau = mass.cwiseProduct(random.vector(columns, 1.0));  // such as weights
    const VectorXd c = random.vector(n, 1.0);
    Extended kkt = Extended::Zero(columns + n, columns + n);
    kkt.topLeftCorner(columns, columns) = rows.m.cast<long double>();
    kkt.topRightCorner(columns, n) = rows.j.transpose().cast<long double>();
    kkt.bottomLeftCorner(n, columns) = rows.j.cast<long double>();
    Extended rhs(columns + n, 1);
    rhs << tau.cast<long double>(), c.cast<long double>();
    Eigen::FullPivLU<Extended> lu;
    lu.setThreshold(0.0L);
    const Extended truth = lu.compute(kkt).solve(rhs);
    const VectorXd lambda = truth.bottomRows(n).cast<double>();
    const VectorXd b = rows.j * tau.cwiseQuotient(mass) - c;
    ASSERT_TRUE(near_relative(solved(system, b), lambda, 1e-9)) << "seed " << seed;
  }
}

TEST(RedundantSystem, Independence_within_the_tolerance_counts_as_drift) {
  MatrixXd j(2, 3);
  j << 1, 0, 0, 1, 1e-5, 0;
  const Rows rows(j, MatrixXd::Identity(3, 3));
  EXPECT_EQ(reduced(rows, 1e-4).rank(), 1);
  EXPECT_EQ(reduced(rows, 1e-6).rank(), 2);
}

TEST(RedundantSystem, Equal_rows_share_the_multiplier_by_the_squares_of_their_scales) {
  Rows rows(MatrixXd::Ones(3, 2), MatrixXd::Identity(2, 2));
  RedundantSystem<double> equal = reduced(rows, 1e-7);
  EXPECT_TRUE(
      near_absolute(solved(equal, Eigen::Vector3d(6, 6, 6)), Eigen::Vector3d(1, 1, 1), 1e-14));
  rows.s << 1.0, 1.0, 2.0;  // a unit of the third counts twice: it carries a quarter of the others
  RedundantSystem<double> unequal = reduced(rows, 1e-7);
  EXPECT_TRUE(
      near_absolute(solved(unequal, Eigen::Vector3d(9, 9, 9)), Eigen::Vector3d(2, 2, 0.5), 1e-14));
}

TEST(RedundantSystem, Rows_that_all_vanish_carry_nothing) {
  const Rows rows(MatrixXd::Zero(3, 2), MatrixXd::Identity(2, 2));
  RedundantSystem<double> system = reduced(rows, 1e-7);
  EXPECT_EQ(system.rank(), 0);
  EXPECT_EQ(solved(system, Eigen::Vector3d(1, 2, 3)), Eigen::Vector3d::Zero());
}

// Systems of one size and of any ranks, two at a time.
TEST(RedundantSystem, Lanes_of_a_pack_have_the_bits_of_each_system_alone) {
  using Pair = Pack<2, Baseline>;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const int n = 2 + random.below(6), columns = 2 + random.below(6);
    RedundantSystem<Pair> pair(n, columns);
    std::array<VectorXd, 2> expected;
    std::array<int, 2> ranks{};
    for (int i = 0; i < 2; ++i) {
      const int rank = random.below(std::min(n, columns) + 1);
      const MatrixXd j = random.matrix(n, rank, 1.0) * random.matrix(rank, columns, 1.0);
      RedundantSystem<double> alone(n, columns);
      const auto fill = [&](double* one, Pair* both, int count, auto&& number) {
        for (int k = 0; k < count; ++k) set_lane(both[k], i, one[k] = number(k));
      };
      const MatrixXd y = random.matrix(columns, n, 1.0);
      const VectorXd b = random.vector(n, 1.0), d = decades(random, columns, 1.0);
      fill(alone.jacobian(), pair.jacobian(), n * columns,
           [&](int k) { return j(k / columns, k % columns); });
      fill(alone.factor(), pair.factor(), n * columns, [&](int k) { return y.data()[k]; });
      fill(alone.inverse_pivot(), pair.inverse_pivot(), columns, [&](int k) { return d[k]; });
      fill(alone.right_hand_side(), pair.right_hand_side(), n, [&](int k) { return b[k]; });
      alone.reduce(1e-9);
      alone.factorize();
      alone.solve();
      const auto at = static_cast<std::size_t>(i);
      ranks[at] = static_cast<int>(alone.rank());
      ASSERT_EQ(ranks[at], rank) << "seed " << seed;
      expected[at] = Eigen::Map<VectorXd>(alone.right_hand_side(), n);
    }
    pair.reduce(Pair(1e-9));
    pair.factorize();
    pair.solve();
    for (int i = 0; i < 2; ++i) {
      EXPECT_EQ(lane(pair.rank(), i), ranks[static_cast<std::size_t>(i)]) << "seed " << seed;
      for (int r = 0; r < n; ++r) {
        ASSERT_EQ(lane(pair.right_hand_side()[r], i), expected[static_cast<std::size_t>(i)][r])
            << "seed " << seed << ", lane " << i;
      }
    }
  }
}

}  // namespace linkstudy::testing::redundant_system_test
