// Comparisons of matrices, vectors and numbers that say where and by how much they differ.
//   EXPECT_TRUE(near_relative(M, M_oracle, 1e-12));
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <string>

namespace linkstudy::testing {

// Largest |actual - expected| at most `tolerance`. NaN never passes.
::testing::AssertionResult near_absolute(const Eigen::MatrixXd& actual,
                                         const Eigen::MatrixXd& expected, double tolerance);

// Largest |actual - expected| at most tolerance * largest |expected|.
::testing::AssertionResult near_relative(const Eigen::MatrixXd& actual,
                                         const Eigen::MatrixXd& expected, double tolerance);

}  // namespace linkstudy::testing
