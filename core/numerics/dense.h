// Factorisations of dense matrices as plain functions, each compiled once. They are Eigen's, named
// at each function; whoever includes only this header compiles none of them.
#pragma once

#include <Eigen/Core>

namespace linkstudy {

// a = u diag(values) v^T, values falling. JacobiSVD (two-sided rotations: small values are
// accurate).
struct SingularValues {
  Eigen::VectorXd values;
  Eigen::MatrixXd u, v;
};
enum class SingularVectors {
  thin,   // as many as values
  full,   // u and v square
  right,  // v alone, square
};
SingularValues decompose_singular(const Eigen::MatrixXd& a, SingularVectors vectors);
Eigen::VectorXd singular_values(const Eigen::MatrixXd& a);

// Of least norm among those that minimise |a x - b|: CompleteOrthogonalDecomposition. Pivots count
// above `threshold` times the largest; 0: above what rounding leaves of it.
Eigen::VectorXd solve_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                                    double threshold = 0.0);

// a x = b with a symmetric and positive definite: LDLT.
Eigen::MatrixXd solve_definite(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

// PartialPivLU.
double determinant(const Eigen::MatrixXd& a);

// Orthonormal columns that span what the rows of a leave free, by FullPivLU: pivots count above
// `threshold` times the largest. No column where they hold everything. Cheaper than null_space() of
// rank.h, and without its gap.
Eigen::MatrixXd kernel_basis(const Eigen::MatrixXd& a, double threshold);

// a = vectors diag(values) vectors^T with a symmetric, values rising: SelfAdjointEigenSolver.
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
SymmetricEigen decompose_symmetric(const Eigen::MatrixXd& a);

// a vectors = vectors diag(values): EigenSolver. Conjugate pairs follow each other, the positive
// imaginary part first; vectors have length 1.
struct GeneralEigen {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;
};
GeneralEigen decompose_general(const Eigen::MatrixXd& a);
Eigen::VectorXcd eigenvalues_of(const Eigen::MatrixXd& a);

}  // namespace linkstudy
