// Certified values of NIST's Statistical Reference Datasets, nonlinear regression (public domain):
// estimates to 1e-6 of themselves, standard errors to 1e-4 (differences of 1e-3 give J to 1e-6).
#include <gtest/gtest.h>

#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "planted_model.h"

namespace linkstudy::calibration::nist_test {
namespace {

const std::vector<double> kMisraX = {77.6,  114.9, 141.1, 190.8, 239.9, 289.0, 332.8,
                                     378.4, 434.8, 477.3, 536.8, 593.1, 689.1, 760.0};
const std::vector<double> kMisraY = {10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02,
                                     44.82, 50.76, 55.05, 61.01, 66.40, 75.47, 81.78};
const std::vector<double> kBoxX = {1, 2, 3, 5, 7, 10};
const std::vector<double> kBoxY = {109, 149, 149, 191, 213, 224};

// y = b1 (1 - exp(-b2 x))
PlantedModel saturation(std::vector<double> x) {
  return [x = std::move(x)](const std::vector<double>& b) {
    std::vector<double> y;
    for (const double one : x) y.push_back(b[0] * (1.0 - std::exp(-b[1] * one)));
    return y;
  };
}

FitProblem misra() {
  return one_series({{"b1", "", false, 10.0, 1000.0, 500.0}, {"b2", "", true, 1e-6, 1e-1, 1e-4}},
                    kMisraX.size());
}

// NIST takes errors for independent (the residuals of Misra1a are not: rho is 0.62).
FitOptions white() {
  FitOptions options;
  options.autocorrelation = Autocorrelation::none;
  return options;
}

void expect_close(double certified, double found, double relative) {
  EXPECT_NEAR(certified, found, relative * std::abs(certified));
}

TEST(NistMisra1a, has_the_certified_estimates_and_standard_errors) {
  const FitResult fit = calibrate(misra(), white(), evaluate_with(saturation(kMisraX), kMisraY));
  EXPECT_EQ(FitStatus::fitted, fit.status) << fit.reason;
  expect_close(238.94212918, fit.estimates[0].value, 1e-6);
  expect_close(5.5015643181e-4, fit.estimates[1].value, 1e-6);
  expect_close(0.12455138894, fit.sum, 1e-9);
  expect_close(2.7070075241, fit.estimates[0].standard_error, 1e-4);
  expect_close(7.2668688436e-6, fit.estimates[1].standard_error, 1e-4);
  const double t = quantile(boost::math::students_t(12.0), 0.975);
  expect_close(238.94212918 - t * 2.7070075241, fit.estimates[0].linear.low, 1e-5);
  EXPECT_TRUE(fit.check.confirms) << fit.check.ended;
}

// Nearly linear: both kinds of interval agree to a few percent of their width.
TEST(NistMisra1a, has_profiles_near_the_linear_intervals) {
  const FitResult fit = calibrate(misra(), white(), evaluate_with(saturation(kMisraX), kMisraY));
  for (const Estimate& one : fit.estimates) {
    const double width = one.linear.high - one.linear.low;
    EXPECT_EQ(ProfileEnd::crossed, one.low_end);
    EXPECT_NEAR(one.linear.low, one.profile.low, 0.04 * width);
    EXPECT_NEAR(one.linear.high, one.profile.high, 0.04 * width);
  }
}

// From (1, 1) alone descents run into the flat far side: the other starts find the way.
TEST(NistBoxBod, is_found_from_the_lethal_start) {
  const FitProblem problem =
      one_series({{"b1", "", false, 1.0, 1000.0, 1.0}, {"b2", "", false, 0.001, 10.0, 1.0}}, 6);
  const FitResult fit = calibrate(problem, white(), evaluate_with(saturation(kBoxX), kBoxY));
  expect_close(213.80940889, fit.estimates[0].value, 1e-6);
  expect_close(0.54723748542, fit.estimates[1].value, 1e-6);
  expect_close(1168.0088766, fit.sum, 1e-9);
  expect_close(12.354515176, fit.estimates[0].standard_error, 1e-4);
  expect_close(0.10455993237, fit.estimates[1].standard_error, 1e-4);
  EXPECT_GE(fit.starts.size(), 20u);
}

}  // namespace
}  // namespace linkstudy::calibration::nist_test
