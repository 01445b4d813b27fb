#include "tests/support/near.h"

#include <cmath>

namespace linkstudy::testing {
namespace {

::testing::AssertionResult within(const Eigen::MatrixXd& actual, const Eigen::MatrixXd& expected,
                                  double tolerance) {
  if (actual.rows() != expected.rows() || actual.cols() != expected.cols()) {
    return ::testing::AssertionFailure()
           << "sizes differ: " << actual.rows() << "x" << actual.cols() << " against "
           << expected.rows() << "x" << expected.cols();
  }
  for (Eigen::Index j = 0; j < actual.cols(); ++j) {
    for (Eigen::Index i = 0; i < actual.rows(); ++i) {
      const double difference = std::abs(actual(i, j) - expected(i, j));
      if (difference <= tolerance) continue;
      const Eigen::IOFormat digits(Eigen::FullPrecision);
      return ::testing::AssertionFailure() << "at (" << i << ", " << j << "): difference "
                                           << difference << " exceeds " << tolerance << "\nactual\n"
                                           << actual.format(digits) << "\nexpected\n"
                                           << expected.format(digits);
    }
  }
  return ::testing::AssertionSuccess();
}

}  // namespace

::testing::AssertionResult near_absolute(const Eigen::MatrixXd& actual,
                                         const Eigen::MatrixXd& expected, double tolerance) {
  return within(actual, expected, tolerance);
}

::testing::AssertionResult near_relative(const Eigen::MatrixXd& actual,
                                         const Eigen::MatrixXd& expected, double tolerance) {
  const double size = expected.size() > 0 ? expected.cwiseAbs().maxCoeff() : 0.0;
  return within(actual, expected, tolerance * size);
}

}  // namespace linkstudy::testing
