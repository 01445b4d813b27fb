// Eigen's dense factorisations and products of MatrixXd, compiled once in dense_instances.cpp: a
// declaration here spares every other source the compilation, and changes no result. The build
// puts this header in front of sources (LINKSTUDY_PRECOMPILE); none needs it to compile or link.
#pragma once

#include <Eigen/Dense>

// usage: LINKSTUDY_DENSE_INSTANCES(extern) declares them, LINKSTUDY_DENSE_INSTANCES() defines them.
// gebp_kernel, the packing and the products below are internal to Eigen: the version is exact.
#if EIGEN_WORLD_VERSION == 3 && EIGEN_MAJOR_VERSION == 4
#define LINKSTUDY_DENSE_INSTANCES(declare)                                                         \
  namespace Eigen {                                                                                \
  declare template class JacobiSVD<MatrixXd>;                                                      \
  declare template class SelfAdjointEigenSolver<MatrixXd>;                                         \
  declare template class ColPivHouseholderQR<MatrixXd>;                                            \
  declare template class CompleteOrthogonalDecomposition<MatrixXd>;                                \
  declare template class LDLT<MatrixXd>;                                                           \
  declare template class LLT<MatrixXd>;                                                            \
  declare template LDLT<MatrixXd>& LDLT<MatrixXd>::compute(const EigenBase<MatrixXd>&);            \
  declare template LLT<MatrixXd>& LLT<MatrixXd>::compute(const EigenBase<MatrixXd>&);              \
  declare template SelfAdjointEigenSolver<MatrixXd>& SelfAdjointEigenSolver<MatrixXd>::compute(    \
      const EigenBase<MatrixXd>&, int);                                                            \
  namespace internal {                                                                             \
  using DenseColumns = const_blas_data_mapper<double, Index, ColMajor>;                            \
  using DenseRows = const_blas_data_mapper<double, Index, RowMajor>;                               \
  using DenseTraits = gebp_traits<double, double>;                                                 \
  declare template struct gebp_kernel<double, double, Index,                                       \
                                      blas_data_mapper<double, Index, ColMajor>, DenseTraits::mr,  \
                                      DenseTraits::nr, false, false>;                              \
  declare template struct gemm_pack_lhs<double, Index, DenseColumns, DenseTraits::mr,              \
                                        DenseTraits::LhsProgress, DenseTraits::LhsPacket4Packing,  \
                                        ColMajor>;                                                 \
  declare template struct gemm_pack_lhs<double, Index, DenseRows, DenseTraits::mr,                 \
                                        DenseTraits::LhsProgress, DenseTraits::LhsPacket4Packing,  \
                                        RowMajor>;                                                 \
  declare template struct gemm_pack_rhs<double, Index, DenseColumns, DenseTraits::nr, ColMajor>;   \
  declare template struct gemm_pack_rhs<double, Index, DenseRows, DenseTraits::nr, RowMajor>;      \
  declare template struct general_matrix_vector_product<Index, double, DenseColumns, ColMajor,     \
                                                        false, double, DenseColumns, false>;       \
  declare template struct general_matrix_vector_product<Index, double, DenseColumns, ColMajor,     \
                                                        false, double, DenseRows, false>;          \
  declare template struct general_matrix_vector_product<Index, double, DenseRows, RowMajor, false, \
                                                        double, DenseColumns, false>;              \
  declare template struct general_matrix_vector_product<Index, double, DenseRows, RowMajor, false, \
                                                        double, DenseRows, false>;                 \
  }                                                                                                \
  }
#else
#define LINKSTUDY_DENSE_INSTANCES(declare)
#endif

LINKSTUDY_DENSE_INSTANCES(extern)
