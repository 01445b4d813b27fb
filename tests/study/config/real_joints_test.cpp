// Clearance, contact, friction, springs and flexible links as they are written and read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "config_text.h"
#include "study/config/beam_section.h"
#include "study/config/toml_reader.h"
#include "study/config/toml_writer.h"
#include "study/config/validate.h"

namespace linkstudy::real_joints_test {
namespace {

using test::kRsrrp;
using test::read_good;
using test::read_text;
using test::replaced;
using ::testing::ElementsAre;

constexpr double kPi = std::numbers::pi;

// The reference linkage with a revolute closure that has every table of a real joint.
std::string real_closure() {
  return replaced(replaced(kRsrrp, "type = \"spherical\"", "type = \"revolute\""),
                  "cut.stabilization = \"none\"",
                  "clearance = { kind = \"spatial\", bearing = \"first\", radial = \"1 mm\", "
                  "bearing_radius = \"5 mm\", length = \"2 cm\" }\n"
                  "contact = { law = \"flores\", restitution = 0.5, exponent = 2.2, stiffness = "
                  "3e9, bearing = { young = \"70 GPa\", poisson = 0.33 }, approach = \"greatest\", "
                  "points = \"two\", least_speed = \"1 mm/s\", "
                  "free_bristle = \"relax\" }\n"
                  "friction = { mu_s = 0.2, mu_k = 0.1, stribeck_speed = \"17.5 mm/s\", sigma0 = "
                  "600, sigma1 = 24.5, sigma2 = 0.1, damping_speed = \"2 cm/s\" }");
}

const char* const kCoupler = "name = \"coupler\"\nmass = 1.5\ncenter_of_mass = [0.0, 0.25, 0.0]\n";
const char* const kSteel = "end = [0, 0.5, 0], young = \"207 GPa\", shear = \"80 GPa\"";

std::string with_beam(const std::string& rest) {
  return replaced(kRsrrp, kCoupler,
                  std::string(kCoupler) + "flexible = { " + kSteel + ", " + rest + " }\n");
}

// As read, before flexible links become chains of elements.
FlexibleBeam beam_of(const std::string& text) {
  Diagnostics diagnostics;
  Tree tree = *parse_toml(text, "model.toml", diagnostics);
  validate(tree, model_schema(), diagnostics);
  const Linkage linkage = read_model(std::move(tree), diagnostics).linkage;
  EXPECT_TRUE(diagnostics.empty()) << to_string(diagnostics);
  EXPECT_TRUE(linkage.links[3].flexible);
  return linkage.links[3].flexible.value_or(FlexibleBeam{});
}

TEST(RealJoints, A_clearance_with_its_contact_and_friction_is_read_key_by_key) {
  const ModelInput input = read_good(real_closure(), {"closure.S.model=clearance"});
  const Closure& closure = input.linkage.closures[0];
  EXPECT_EQ(closure.model, ClosureModel::clearance);
  const Clearance& c = closure.clearance;
  EXPECT_EQ(c.kind, ClearanceKind::spatial);
  EXPECT_TRUE(c.bearing_is_first);
  EXPECT_EQ(c.radial, 1e-3);
  EXPECT_EQ(c.bearing_radius, 5e-3);
  EXPECT_EQ(c.length, 0.02);
  EXPECT_EQ(c.law, ContactLaw::flores);
  EXPECT_EQ(c.restitution, 0.5);
  EXPECT_EQ(c.exponent, 2.2);
  EXPECT_EQ(c.stiffness, 3e9);
  EXPECT_EQ(c.bearing.young, 70e9);
  EXPECT_EQ(c.bearing.poisson, 0.33);
  EXPECT_EQ(c.journal.young, 207e9);
  EXPECT_EQ(c.journal.poisson, 0.3);
  EXPECT_EQ(c.approach, ApproachSpeed::greatest);
  EXPECT_EQ(c.points, ContactPoints::two);
  EXPECT_EQ(c.least_speed, 1e-3);
  EXPECT_EQ(c.free_bristle, FreeBristle::relax);
  ASSERT_TRUE(c.friction);
  EXPECT_EQ(c.friction->mu_s, 0.2);
  EXPECT_EQ(c.friction->mu_k, 0.1);
  EXPECT_DOUBLE_EQ(c.friction->v_s, 0.0175);
  EXPECT_EQ(c.friction->sigma0, 600.0);
  EXPECT_EQ(c.friction->sigma1, 24.5);
  EXPECT_EQ(c.friction->sigma2, 0.1);
  EXPECT_EQ(c.friction->v_d, 0.02);
}

TEST(RealJoints, One_word_switches_between_the_models_of_a_closure) {
  for (const auto& [word, model] :
       {std::pair("cut", ClosureModel::cut), std::pair("sde", ClosureModel::sde),
        std::pair("clearance", ClosureModel::clearance)}) {
    const ModelInput input = read_good(real_closure(), {std::string("closure.S.model=") + word});
    EXPECT_EQ(input.linkage.closures[0].model, model);
    EXPECT_EQ(input.linkage.closures[0].clearance.radial, 1e-3);
  }
}

TEST(RealJoints, Defaults_of_a_contact_are_steel_and_are_written_where_there_is_a_clearance) {
  const std::string text =
      replaced(replaced(kRsrrp, "type = \"spherical\"", "type = \"revolute\""), "model  = \"cut\"",
               "model = \"clearance\"\nclearance = { radial = 1e-3, bearing_radius = 5e-3 }");
  const ModelInput input = read_good(text);
  const Clearance& c = input.linkage.closures[0].clearance;
  EXPECT_EQ(c.kind, ClearanceKind::planar);
  EXPECT_FALSE(c.bearing_is_first);
  EXPECT_EQ(c.law, ContactLaw::lankarani_nikravesh);
  EXPECT_EQ(c.restitution, 0.9);
  EXPECT_EQ(c.exponent, 1.5);
  EXPECT_FALSE(c.stiffness);
  EXPECT_EQ(c.bearing.young, 207e9);
  EXPECT_EQ(c.approach, ApproachSpeed::begin);
  EXPECT_EQ(c.points, ContactPoints::one);
  EXPECT_EQ(c.least_speed, 1e-4);
  EXPECT_EQ(c.free_bristle, FreeBristle::reset);
  EXPECT_FALSE(c.friction);
  const Tree& closure = input.resolved.find("closure")->items[0];
  EXPECT_EQ(closure.find("contact")->find("restitution")->number, 0.9);
  EXPECT_EQ(closure.find("contact")->find("journal")->find("poisson")->number, 0.3);
  EXPECT_EQ(read_good(kRsrrp).resolved.find("closure")->items[0].find("contact"), nullptr);
}

TEST(RealJoints, Friction_goes_off_by_one_word_in_closures_and_joints) {
  EXPECT_FALSE(read_good(real_closure(), {"closure.S.friction.enabled=false"})
                   .linkage.closures[0]
                   .clearance.friction);
  const std::vector<std::string> sets = {
      "joint.A.friction={ mu_s = 0.3, mu_k = 0.2, sigma0 = 1e5, radius = \"8 mm\", length = 0.04, "
      "preload = \"0.1 kN\" }"};
  const std::optional<JointFriction> on = read_good(kRsrrp, sets).linkage.joints[0].friction;
  ASSERT_TRUE(on);
  EXPECT_EQ(on->law.mu_s, 0.3);
  EXPECT_EQ(on->law.v_s, 0.01);
  EXPECT_EQ(on->law.v_d, 0.0);
  EXPECT_EQ(on->radius, 0.008);
  EXPECT_EQ(on->length, 0.04);
  EXPECT_EQ(on->preload, 100.0);
  EXPECT_FALSE(
      read_good(kRsrrp, {sets[0], "joint.A.friction.enabled=false"}).linkage.joints[0].friction);
}

TEST(RealJoints, Springs_take_the_units_of_their_coordinates) {
  const ModelInput input = read_good(
      kRsrrp, {"joint.P.spring={ stiffness = [\"2 kN/m\"], rest = [\"20 cm\"] }",
               "joint.A.spring.stiffness=[\"3 N m/deg\"]", "joint.A.spring.damping.0=0.5"});
  const Joint& a = input.linkage.joints[0];
  const Joint& p = input.linkage.joints[1];
  ASSERT_EQ(a.stiffness.size(), 1u);
  EXPECT_DOUBLE_EQ(a.stiffness[0], 3.0 * 180.0 / kPi);
  EXPECT_THAT(a.damping, ElementsAre(0.5));
  EXPECT_THAT(a.rest, ElementsAre(0.0));
  EXPECT_THAT(p.stiffness, ElementsAre(2000.0));
  EXPECT_THAT(p.damping, ElementsAre(0.0));
  EXPECT_THAT(p.rest, ElementsAre(0.2));
  EXPECT_TRUE(input.linkage.joints[2].stiffness.empty());
  Diagnostics diagnostics;
  const auto document = ModelDocument::parse(kRsrrp, "model.toml", diagnostics);
  EXPECT_EQ(parameter_for(*document, "joint.P.spring.damping.0")->unit, "N s/m");
  EXPECT_EQ(parameter_for(*document, "joint.A.spring.rest.0")->unit, "rad");
}

TEST(RealJoints, A_flexible_link_becomes_a_chain_of_one_element_more_than_segments) {
  const std::string text = with_beam("section = { shape = \"circle\", diameter = \"22 mm\" }");
  const auto links = [&](const std::vector<std::string>& sets) {
    return read_good(text, sets).linkage.links.size();
  };
  EXPECT_EQ(links({}), 3u + 5u);
  EXPECT_EQ(links({"link.coupler.flexible.segments=7"}), 3u + 8u);
  EXPECT_EQ(links({"link.coupler.flexible.enabled=false"}), 4u);
  Diagnostics diagnostics;
  const auto document = ModelDocument::parse(text, "model.toml", diagnostics);
  const Override segments = make_override("link.coupler.flexible.segments", 2.0);
  EXPECT_EQ(document->with({&segments, 1}, diagnostics)->linkage.links.size(), 3u + 3u);
  EXPECT_TRUE(parameter_for(*document, "link.coupler.flexible.segments"));
}

TEST(RealJoints, A_beam_is_read_with_the_axis_across_it_that_is_not_written) {
  const std::string section =
      "section = { shape = \"given\", second_moment_y = \"2 cm^4\", "
      "second_moment_z = 3e-8, torsion_constant = 1e-8 }";
  const FlexibleBeam beam = beam_of(with_beam("segments = 3, retardation = \"20 us\", " + section));
  EXPECT_EQ(beam.segments, 3);
  EXPECT_EQ(beam.begin, Eigen::Vector3d::Zero());
  EXPECT_EQ(beam.end, Eigen::Vector3d(0, 0.5, 0));
  EXPECT_EQ(beam.across, Eigen::Vector3d::UnitX());
  EXPECT_EQ(beam.young, 207e9);
  EXPECT_EQ(beam.shear, 80e9);
  EXPECT_DOUBLE_EQ(beam.retardation, 2e-5);
  EXPECT_DOUBLE_EQ(beam.second_moment_y, 2e-8);
  EXPECT_EQ(beam.second_moment_z, 3e-8);
  EXPECT_EQ(beam.torsion_constant, 1e-8);
  EXPECT_EQ(beam_of(with_beam("across = [0, 0, 7], " + section)).across, Eigen::Vector3d::UnitZ());
}

TEST(RealJoints, Sections_written_by_shape_have_their_moments) {
  const FlexibleBeam circle =
      beam_of(with_beam("section = { shape = \"circle\", diameter = 0.02 }"));
  EXPECT_DOUBLE_EQ(circle.second_moment_y, kPi * 1e-8 / 4.0);  // pi r^4 / 4
  EXPECT_EQ(circle.second_moment_z, circle.second_moment_y);
  EXPECT_DOUBLE_EQ(circle.torsion_constant, kPi * 1e-8 / 2.0);
  const FlexibleBeam tube =
      beam_of(with_beam("section = { shape = \"tube\", outer = 0.04, inner = 0.02 }"));
  EXPECT_NEAR(tube.second_moment_y, kPi * 15e-8 / 4.0, 1e-21);
  EXPECT_NEAR(tube.torsion_constant, kPi * 15e-8 / 2.0, 1e-21);
  // width along y, height along z: bending about y has the cube of the height.
  const FlexibleBeam bar =
      beam_of(with_beam("section = { shape = \"rectangle\", width = 0.01, height = 0.03 }"));
  EXPECT_NEAR(bar.second_moment_y, 0.01 * 2.7e-5 / 12.0, 1e-21);
  EXPECT_NEAR(bar.second_moment_z, 0.03 * 1e-6 / 12.0, 1e-21);
  EXPECT_NEAR(bar.torsion_constant, 0.263 * 0.03 * 1e-6, 0.0005 * 0.03 * 1e-6);
}

// Coefficients k1 in J_t = k1 l s^3: Timoshenko and Goodier, Theory of Elasticity, sec. 109, table.
TEST(RealJoints, Torsion_of_rectangles_is_that_of_the_printed_table) {
  const std::pair<double, double> table[] = {{1.0, 0.1406}, {1.2, 0.166}, {1.5, 0.196},
                                             {2.0, 0.229},  {2.5, 0.249}, {3.0, 0.263},
                                             {4.0, 0.281},  {5.0, 0.291}, {10.0, 0.312}};
  for (const auto& [ratio, k1] : table) {
    const double tolerance = ratio == 1.0 ? 5.1e-5 : 6e-4;  // half of the last digit printed
    EXPECT_NEAR(rectangle_section(1.0, ratio).torsion_constant / ratio, k1, tolerance) << ratio;
    EXPECT_EQ(rectangle_section(ratio, 1.0).torsion_constant,
              rectangle_section(1.0, ratio).torsion_constant);
  }
  EXPECT_NEAR(rectangle_section(1.0, 1e6).torsion_constant / 1e6, 1.0 / 3.0, 1e-6);
}

// The stress function as a double sine series: laplacian phi = -2, J_t = 2 integral phi.
TEST(RealJoints, Torsion_of_a_rectangle_agrees_with_a_double_series) {
  const double b = 0.7, h = 0.4;
  double sum = 0.0;
  for (int m = 1; m < 1200; m += 2) {
    for (int n = 1; n < 1200; n += 2) {
      const double mm = static_cast<double>(m) * m, nn = static_cast<double>(n) * n;
      sum += 1.0 / (mm * nn * (mm / (b * b) + nn / (h * h)));
    }
  }
  const double series = 256.0 * b * h / std::pow(kPi, 6) * sum;
  // The series is cut off where what is left is of the size of 1 / 1200^3.
  EXPECT_NEAR(rectangle_section(b, h).torsion_constant / series, 1.0, 2e-9);
}

TEST(RealJoints, Integrators_and_their_tolerances_are_read) {
  EXPECT_EQ(read_good(kRsrrp).options.integrator, Integrator::rk4);
  const SimulationOptions options =
      read_good(kRsrrp, {"simulation.integrator=adaptive", "simulation.tolerance.relative=1e-6",
                         "simulation.step_limit=2000"})
          .options;
  EXPECT_EQ(options.integrator, Integrator::adaptive);
  EXPECT_EQ(options.relative_tolerance, 1e-6);
  EXPECT_EQ(options.absolute_tolerance, 1e-10);
  EXPECT_EQ(options.step_limit, 2000);
  EXPECT_EQ(read_good(kRsrrp, {"simulation.integrator=stiff"}).options.integrator,
            Integrator::stiff);
}

TEST(RealJoints, A_resolved_text_with_everything_reads_back_to_itself) {
  const std::string text =
      replaced(real_closure(), kCoupler,
               std::string(kCoupler) + "flexible = { " + kSteel +
                   ", section = { shape = \"rectangle\", width = 0.01, height = 0.02 } }\n");
  const ModelInput input =
      read_good(text, {"closure.S.model=clearance", "joint.A.spring.damping.0=0.5",
                       "joint.P.friction={ mu_s = 0.2, mu_k = 0.2, sigma0 = 1e4 }"});
  const std::string resolved = write_toml(input.resolved);
  EXPECT_EQ(write_toml(read_good(resolved).resolved), resolved);
}

}  // namespace
}  // namespace linkstudy::real_joints_test
