// Frequencies and damping of flexible links against the theory of beams, from the engine's
// spectrum.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/dynamics/spectrum.h"
#include "core/flexible/rigid_finite_elements.h"
#include "tests/mechanisms/cantilever.h"

namespace linkstudy::testing::cantilever_modes_test {
namespace {

// Bending is ten times faster in the one plane than in the other, torsion is faster still: the four
// lowest modes are the first two of the soft plane, the first of the stiff one, the third of the
// soft one.
BeamData soft_about_z() {
  BeamData data;
  data.second_moment_z = 1e-9;
  data.second_moment_y = 1e-7;
  data.torsion_constant = 1e-8;
  return data;
}

BeamData soft_about_y() {
  BeamData data = soft_about_z();
  std::swap(data.second_moment_y, data.second_moment_z);
  return data;
}

std::vector<std::complex<double>> upper_eigenvalues(const BeamData& data, int n, double wall) {
  const Model model = compile(expand_flexible_links(cantilever(data, n, wall)));
  std::vector<std::complex<double>> upper;
  for (const auto& lambda : compute_spectrum(model, model.start).eigenvalues) {
    if (lambda.imag() > 0.0) upper.push_back(lambda);
  }
  std::sort(upper.begin(), upper.end(),
            [](const auto& a, const auto& b) { return std::abs(a) < std::abs(b); });
  return upper;
}

std::vector<double> frequencies(const BeamData& data, int n, double wall = 0.0) {
  std::vector<double> result;
  for (const auto& lambda : upper_eigenvalues(data, n, wall)) result.push_back(std::abs(lambda));
  return result;
}

// Relative errors of the first three bending frequencies of the soft plane.
std::array<double, 3> bending_errors(const BeamData& data, int n) {
  const std::vector<double> all = frequencies(data, n);
  const double soft = std::min(data.bending_y(), data.bending_z());
  return {all[0] / bending_frequency(data, soft, 1) - 1.0,
          all[1] / bending_frequency(data, soft, 2) - 1.0,
          all[3] / bending_frequency(data, soft, 3) - 1.0};
}

}  // namespace

TEST(CantileverModes, The_first_bending_frequency_is_off_by_the_known_error) {
  for (const BeamData& data : {soft_about_z(), soft_about_y()}) {
    EXPECT_NEAR(bending_errors(data, 4)[0], 0.0145, 5e-5);
    EXPECT_NEAR(bending_errors(data, 10)[0], 0.0023, 5e-5);
  }
}

TEST(CantileverModes, Three_bending_frequencies_converge_at_second_order_in_both_planes) {
  for (const BeamData& data : {soft_about_z(), soft_about_y()}) {
    const std::array<double, 3> coarse = bending_errors(data, 8);
    const std::array<double, 3> fine = bending_errors(data, 16);
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_NEAR(std::log2(coarse[j] / fine[j]), 2.0, 0.1) << j + 1;
      EXPECT_LT(std::abs(fine[j]), 0.02) << j + 1;
    }
  }
}

TEST(CantileverModes, Both_planes_swing_with_their_own_stiffness_at_once) {
  const BeamData data = soft_about_z();
  const std::vector<double> all = frequencies(data, 10);
  EXPECT_NEAR(all[2] / bending_frequency(data, data.bending_y(), 1), 1.0, 0.0025);
  EXPECT_NEAR(all[2] / all[0], 10.0, 1e-3);  // root of J_y / J_z
}

TEST(CantileverModes, A_beam_held_at_its_end_has_the_modes_of_one_held_at_its_begin) {
  const BeamData data;
  const std::vector<double> begin = frequencies(data, 5);
  const std::vector<double> end = frequencies(data, 5, data.length);
  ASSERT_EQ(begin.size(), 15u);
  for (std::size_t k = 0; k < 15; ++k) EXPECT_NEAR(end[k] / begin[k], 1.0, 1e-6) << k;
}

TEST(CantileverModes, A_beam_held_in_its_middle_has_every_mode_of_its_halves_twice) {
  BeamData half;
  half.length /= 2;
  half.mass /= 2;
  half.axial /= 2;
  const std::vector<double> whole = frequencies({}, 6, 0.5 * BeamData{}.length);
  const std::vector<double> halves = frequencies(half, 3);
  ASSERT_EQ(whole.size(), 18u);
  for (std::size_t k = 0; k < 18; ++k) EXPECT_NEAR(whole[k] / halves[k / 2], 1.0, 1e-6) << k;
}

// Torsion: n equal springs c = G J_t / D and n inertias I = I_axial / n, the last one a half. The
// chain's own frequencies are 2 sqrt(c / I) sin((2 j - 1) pi / (4 n)), the shaft's their limit.
TEST(CantileverModes, Torsion_frequencies_are_those_of_a_chain_of_discs_and_tend_to_the_shaft_s) {
  BeamData data;
  data.torsion_constant = 1e-14;  // far below all bending
  for (const int n : {1, 2, 4, 8}) {
    const std::vector<double> all = frequencies(data, n);
    const double c = data.torsion() * n / data.length, inertia = data.axial / n;
    for (int j = 1; j <= std::min(n, 3); ++j) {
      const double chain = 2.0 * std::sqrt(c / inertia) * std::sin((2 * j - 1) * M_PI / (4.0 * n));
      EXPECT_NEAR(all[static_cast<std::size_t>(j - 1)] / chain, 1.0, 1e-4) << n << " " << j;
    }
  }
  const double coarse = 1.0 - frequencies(data, 4)[0] / torsion_frequency(data, 1);
  const double fine = 1.0 - frequencies(data, 8)[0] / torsion_frequency(data, 1);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.1);
}

// Kelvin and Voigt: zeta = retardation * omega / 2 in every mode, omega the undamped frequency.
TEST(CantileverModes, Damping_grows_with_the_frequency_of_the_mode) {
  BeamData data;
  const std::vector<double> undamped = frequencies(data, 4);
  data.retardation = 1e-4;
  const auto damped = upper_eigenvalues(data, 4, 0.0);
  ASSERT_EQ(damped.size(), 12u);
  for (std::size_t k = 0; k < damped.size(); ++k) {
    const double zeta = data.retardation * undamped[k] / 2.0;
    ASSERT_LT(zeta, 0.9);  // beyond 1 a pair becomes real
    EXPECT_NEAR(std::abs(damped[k]) / undamped[k], 1.0, 1e-5);
    EXPECT_NEAR(-damped[k].real() / undamped[k] / zeta, 1.0, 1e-4) << k;
  }
}

}  // namespace linkstudy::testing::cantilever_modes_test
