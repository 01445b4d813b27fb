// What links are drawn as: how it is written, and that it is only drawn.
#include <gtest/gtest.h>

#include "config_text.h"
#include "core/simulation/prepare.h"
#include "core/simulation/simulate.h"
#include "study/config/toml_writer.h"

namespace linkstudy::shape_test {
namespace {

using test::read_good;
using test::replaced;

std::string plain_text() {
  return replaced(test::kRsrrp, "center_of_mass = [0.0, 0.25, 0.0]",
                  R"(center_of_mass = [0, 0.25, 0]
flexible.end = [0, 0.5, 0]
flexible.young = 2e11
flexible.shear = 8e10
flexible.section = { shape = "circle", diameter = 0.02 })");
}

// The same with shapes of a rigid and of the flexible link.
std::string drawn_text() {
  const std::string crank = replaced(plain_text(), "name = \"crank\"", R"(name = "crank"
shape = [{ kind = "cylinder", end = [0, "10 cm", 0], diameter = "12 mm" },
         { kind = "sphere", position = [0, 0.1, 0], diameter = 0.03 },
         { kind = "box", sides = ["4 cm", 0.02, 0.01], euler_zyx = ["90 deg", 0, 0] }])");
  return replaced(crank, "name = \"coupler\"", R"(name = "coupler"
shape = [{ kind = "cylinder", begin = [0, 0.1, 0], end = [0, 0.5, 0], diameter = 0.02 }])");
}

TEST(Shape, Solids_are_read_with_their_units_and_frames) {
  const ModelInput input = read_good(drawn_text());
  const std::vector<Solid>& solids = input.linkage.links[0].shape;
  ASSERT_EQ(solids.size(), 3u);
  EXPECT_EQ(solids[0], (Solid{.end = {0.0, 0.1, 0.0}, .diameter = 0.012, .frame = {}}));
  Solid ball{.kind = SolidKind::sphere, .diameter = 0.03, .frame = {}};
  ball.frame.position.y() = 0.1;
  EXPECT_EQ(solids[1], ball);
  EXPECT_EQ(solids[2].kind, SolidKind::box);
  EXPECT_EQ(solids[2].sides, Eigen::Vector3d(0.04, 0.02, 0.01));
  // Its x is the y of the link.
  EXPECT_EQ(solids[2].frame.rotation.col(0), Eigen::Vector3d::UnitY());
}

TEST(Shape, Resolved_input_holds_it_and_reads_back_the_same) {
  const ModelInput input = read_good(drawn_text());
  EXPECT_EQ(read_good(write_toml(input.resolved)).linkage, input.linkage);
  EXPECT_EQ(input.linkage.links[0].shape.size(), 3u);
}

TEST(Shape, All_that_is_wrong_is_told_in_one_pass) {
  Diagnostics diagnostics;
  EXPECT_FALSE(test::read_text(replaced(test::kRsrrp, "name = \"crank\"", R"(name = "crank"
shape = [{ kind = "cylinder", end = [0, "10 kg", 0], diameter = -1 }, { kind = "ball" },
         { kind = "box", sides = [1, 2], position = [0, 0], axis = [0, 0, 1] }, 5])"),
                               diagnostics));
  std::string told;
  for (const Diagnostic& one : diagnostics.sorted()) told += one.message + "\n";
  EXPECT_EQ(told,
            "link 'crank': shape 0: end.1 must be a number in m, got '10 kg'\n"
            "link 'crank': shape 0: diameter must be positive, got -1 m\n"
            "link 'crank': shape 1: kind must be one of cylinder, box, sphere, got 'ball'\n"
            "link 'crank': shape 2: sides must have 3 entries, got 2\n"
            "link 'crank': shape 2: position must have 3 entries, got 2\n"
            "link 'crank': shape 2: axis is not a known key\n"
            "link 'crank': shape must be an array of tables, got 5\n");
}

std::vector<double> end_of(const ModelInput& input) {
  const Preparation p = prepare(input.linkage, input.options);
  EXPECT_EQ(p.cause, Cause::ok) << p.message;
  Observers none;
  const SimulationOutcome outcome =
      simulate(p.model.mechanism, p.model.parameters, p.model.start, input.options, none);
  EXPECT_EQ(outcome.cause, Cause::ok) << outcome.message;
  std::vector<double> end = outcome.final_state.q;
  end.insert(end.end(), outcome.final_state.v.begin(), outcome.final_state.v.end());
  return end;
}

// A rigid and a flexible link; whether a run sees it at all is shown by the mass.
TEST(Shape, Leaves_every_bit_of_a_run_as_it_is) {
  const std::vector<std::string> brief = {"simulation.end_time=0.02", "simulation.step=1e-5"};
  std::vector<std::string> heavier = brief;
  heavier.push_back("link.crank.mass=1.01");
  const std::vector<double> end = end_of(read_good(drawn_text(), brief));
  EXPECT_EQ(end, end_of(read_good(plain_text(), brief)));
  EXPECT_NE(end, end_of(read_good(plain_text(), heavier)));
}

}  // namespace
}  // namespace linkstudy::shape_test
