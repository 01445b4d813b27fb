// The reference linkage field by field, defaults, frames, spring-damping elements, round trips.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <numbers>

#include "config_text.h"
#include "study/config/toml_reader.h"
#include "study/config/toml_writer.h"

namespace linkstudy::model_test {
namespace {

using test::kRsrrp;
using test::read_good;
using test::read_text;
using test::replaced;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double kPi = std::numbers::pi;

TEST(Model, The_reference_linkage_is_read_link_by_link) {
  const ModelInput input = read_good(kRsrrp);
  EXPECT_EQ(input.name, "RSRRP linkage, reference set R1");
  EXPECT_EQ(input.linkage.gravity, Eigen::Vector3d(0.0, -9.81, 0.0));
  ASSERT_EQ(input.linkage.links.size(), 4u);
  const char* names[] = {"crank", "slider", "yoke", "coupler"};
  const double masses[] = {1.0, 2.0, 0.2, 1.5};
  const double centres[] = {0.05, 0.0, 0.0, 0.25};
  const Eigen::Vector3d moments[] = {{8.3333333e-4, 1.0e-4, 8.3333333e-4},
                                     {1.0e-3, 1.0e-3, 1.0e-3},
                                     {1.0e-4, 1.0e-4, 1.0e-4},
                                     {0.03125, 1.0e-4, 0.03125}};
  for (std::size_t i = 0; i < 4; ++i) {
    const Link& link = input.linkage.links[i];
    EXPECT_EQ(link.name, names[i]);
    EXPECT_EQ(link.mass, masses[i]);
    EXPECT_EQ(link.center_of_mass, Eigen::Vector3d(0.0, centres[i], 0.0));
    EXPECT_EQ(link.inertia, Eigen::Matrix3d(moments[i].asDiagonal()));
  }
}

TEST(Model, The_reference_linkage_is_read_joint_by_joint) {
  const ModelInput input = read_good(kRsrrp);
  const std::vector<Joint>& joints = input.linkage.joints;
  ASSERT_EQ(joints.size(), 4u);
  const char* names[] = {"A", "P", "Q", "R"};
  const char* parents[] = {"ground", "ground", "slider", "yoke"};
  const char* children[] = {"crank", "slider", "yoke", "coupler"};
  const double starts[] = {0.0, 0.25, 0.0, -kPi / 3.0};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(joints[i].name, names[i]);
    EXPECT_EQ(joints[i].parent, parents[i]);
    EXPECT_EQ(joints[i].child, children[i]);
    EXPECT_EQ(joints[i].type, i == 1 ? JointType::prismatic : JointType::revolute);
    ASSERT_EQ(joints[i].position.size(), 1u);
    EXPECT_DOUBLE_EQ(joints[i].position[0], starts[i]);
    EXPECT_THAT(joints[i].velocity, ElementsAre(0.0));
    EXPECT_FALSE(joints[i].hold);
    EXPECT_EQ(joints[i].child_frame.rotation, Eigen::Matrix3d::Identity());
    EXPECT_EQ(joints[i].child_frame.position, Eigen::Vector3d::Zero());
    EXPECT_EQ(joints[i].pitch, 0.0);
  }
  EXPECT_EQ(joints[0].frame.rotation, Eigen::Matrix3d::Identity());
  EXPECT_DOUBLE_EQ(joints[1].frame.position.y(), -(0.5 * std::sin(kPi / 3.0) - 0.10 + 0.05));
  Eigen::Matrix3d slider;
  slider << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  EXPECT_EQ(joints[1].frame.rotation, slider);
  EXPECT_EQ(joints[2].frame.position, Eigen::Vector3d(0.05, 0.0, 0.0));
  Eigen::Matrix3d turned;  // Rx(-90 deg)
  turned << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  EXPECT_EQ(joints[3].frame.rotation, turned);
}

TEST(Model, The_reference_closure_loads_and_options_are_read) {
  const ModelInput input = read_good(kRsrrp);
  ASSERT_EQ(input.linkage.closures.size(), 1u);
  const Closure& s = input.linkage.closures[0];
  EXPECT_EQ(s.name, "S");
  EXPECT_EQ(s.type, JointType::spherical);
  EXPECT_EQ(s.first.link, "crank");
  EXPECT_EQ(s.first.frame.position, Eigen::Vector3d(0.0, 0.1, 0.0));
  EXPECT_EQ(s.second.link, "coupler");
  EXPECT_EQ(s.second.frame.position, Eigen::Vector3d(0.0, 0.5, 0.0));
  EXPECT_EQ(s.model, ClosureModel::cut);
  EXPECT_EQ(s.stabilization, Stabilization::none);
  EXPECT_EQ(s.alpha, 100.0);
  EXPECT_EQ(s.beta, 50.0);
  EXPECT_EQ(s.sde.axes, SdeAxes::ground);
  EXPECT_THAT(s.sde.stiffness, ElementsAre(1e6, 1e6, 1e6, 0, 0, 0));
  EXPECT_THAT(s.sde.damping, ElementsAre(1e3, 1e3, 1e3, 0, 0, 0));
  EXPECT_FALSE(s.sde.damping_ratio);
  ASSERT_EQ(input.linkage.loads.size(), 2u);
  const Load& drive = input.linkage.loads[0];
  EXPECT_EQ(drive.type, LoadType::drive);
  EXPECT_EQ(drive.joint, "A");
  EXPECT_EQ(drive.coordinate, 0);
  EXPECT_EQ(drive.course.shape, CourseShape::ramp);
  EXPECT_EQ(drive.course.value, 10.0);
  EXPECT_EQ(drive.course.duration, 5.0);
  const Load& resistance = input.linkage.loads[1];
  EXPECT_EQ(resistance.type, LoadType::resistance);
  EXPECT_EQ(resistance.law.shape, ResistanceShape::linear);
  EXPECT_EQ(resistance.law.value, 10.0);
  EXPECT_EQ(resistance.law.at_speed, 9.0);
  EXPECT_EQ(input.options.end_time, 15.0);
  EXPECT_EQ(input.options.step, 1.0e-4);
  EXPECT_EQ(input.options.output_interval, 1.0e-2);
  EXPECT_EQ(input.options.drift_limit, 1.0e-3);
  EXPECT_EQ(input.options.start, Start::equilibrium);
}

TEST(Model, Resolved_text_reads_back_to_the_same_tree_bit_by_bit) {
  for (const std::vector<std::string>& sets :
       {std::vector<std::string>{},
        {"closure.S.sde.stiffness.x=1e7"},
        {"joint.A.type=spherical", "joint.A.initial.position=[0.1, \"1 deg\", 0]",
         "joint.A.initial.velocity=[0.1, 0, 0.3]", "load.resistance.law.value=0.1"}}) {
    const ModelInput input = read_good(kRsrrp, sets);
    const std::string text = write_toml(input.resolved);
    Diagnostics diagnostics;
    const std::optional<Tree> again = parse_toml(text, "resolved.toml", diagnostics);
    ASSERT_TRUE(again) << to_string(diagnostics) << text;
    EXPECT_TRUE(equal_content(*again, input.resolved)) << text;
    EXPECT_EQ(write_toml(*again), text);
    // Checking a resolved file changes nothing any more.
    EXPECT_EQ(write_toml(read_good(text).resolved), text);
  }
}

TEST(Model, Elements_of_sliding_closures_turn_with_the_first_end_unless_told_otherwise) {
  const std::string unsaid = replaced(kRsrrp, "axes = \"ground\", ", "");
  const auto axes_of = [&](const std::string& type) {
    const ModelInput input = read_good(unsaid, {"closure.S.type=" + type, "closure.S.model=sde"});
    const ModelInput again = read_good(write_toml(input.resolved));
    EXPECT_EQ(again.linkage.closures[0].sde.axes, input.linkage.closures[0].sde.axes) << type;
    return input.linkage.closures[0].sde.axes;
  };
  for (const char* type : {"prismatic", "cylindrical", "planar"}) {
    EXPECT_EQ(axes_of(type), SdeAxes::first) << type;
  }
  for (const char* type : {"spherical", "revolute", "universal", "fixed"}) {
    EXPECT_EQ(axes_of(type), SdeAxes::ground) << type;
  }
}

TEST(Model, Numbers_and_texts_survive_writing_bit_by_bit) {
  Tree table = Tree::make_table();
  for (const double value :
       {0.1, 1.0 / 3.0, 5e-324, 1.7976931348623157e308, -0.0, 1e22, 123456789.0}) {
    table.set("key_" + std::to_string(table.keys.size()), Tree::make_number(value));
  }
  table.set("odd key \"x\"\n", Tree::make_text("tab\t quote\" back\\ \u00E9 \x01 del\x7F"));
  table.set("i", Tree::make_integer(std::numeric_limits<std::int64_t>::min()));
  table.set("empty", Tree::make_array());
  Tree nested = Tree::make_table();
  nested.set("none", Tree::make_table());
  nested.set("flag", Tree::make_boolean(true));
  table.set("nested", Tree::make_array({Tree::make_array({nested}), Tree::make_array()}));
  table.set("list", Tree::make_array({nested, nested}));
  table.set("sub", nested);
  Diagnostics diagnostics;
  const std::optional<Tree> again = parse_toml(write_toml(table), "t", diagnostics);
  ASSERT_TRUE(again) << to_string(diagnostics) << write_toml(table);
  EXPECT_TRUE(equal_content(*again, table)) << write_toml(table);
}

TEST(Model, Defaults_are_filled_in_and_written) {
  const ModelInput input = read_good(R"(format = 1
kind = "model"
[[link]]
name = "bob"
mass = 1
inertia = [1, 1, 1]
[[joint]]
name = "O"
type = "free"
coordinates = "quaternion"
parent = "ground"
child = "bob"
)");
  EXPECT_EQ(input.name, "unnamed");
  EXPECT_EQ(input.linkage.gravity, Eigen::Vector3d::Zero());
  EXPECT_EQ(input.options.end_time, 1.0);
  EXPECT_EQ(input.options.step, 1.0e-4);
  EXPECT_EQ(input.options.start, Start::given);
  EXPECT_THAT(input.linkage.joints[0].position, ElementsAre(0, 0, 0, 1, 0, 0, 0));
  EXPECT_EQ(input.linkage.joints[0].velocity.size(), 6u);
  const std::string text = write_toml(input.resolved);
  EXPECT_THAT(text, HasSubstr("gravity = [0.0, 0.0, 0.0]\n"));
  EXPECT_THAT(text, HasSubstr("drift_limit = 0.001\n"));
  EXPECT_THAT(text, HasSubstr("position = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]"));
}

TEST(Model, One_stiffness_fills_the_directions_the_type_blocks) {
  const std::string revolute = replaced(kRsrrp, "type = \"spherical\"", "type = \"revolute\"");
  const Sde sde = read_good(revolute).linkage.closures[0].sde;
  EXPECT_THAT(sde.stiffness, ElementsAre(1e6, 1e6, 1e6, 0, ::testing::DoubleEq(1e4),
                                         ::testing::DoubleEq(1e4)));  // arm 0.1 m
  const Sde longer = read_good(revolute, {"closure.S.sde.arm=0.5 m"}).linkage.closures[0].sde;
  EXPECT_EQ(longer.stiffness[kPsi], 0.25e6);
  EXPECT_EQ(longer.damping[kPsi], 250.0);
}

TEST(Model, Named_directions_add_free_and_replace) {
  const ModelInput input = read_good(
      kRsrrp, {"closure.S.sde.stiffness={ all = 1e6, x = 0, y = 2e6, psi = \"5 N m/rad\" }"});
  EXPECT_THAT(input.linkage.closures[0].sde.stiffness, ElementsAre(0, 2e6, 1e6, 0, 0, 5));
}

TEST(Model, A_component_set_on_a_scalar_keeps_the_other_directions) {
  const ModelInput input = read_good(kRsrrp, {"closure.S.sde.stiffness.x=3e6"});
  EXPECT_THAT(input.linkage.closures[0].sde.stiffness, ElementsAre(3e6, 1e6, 1e6, 0, 0, 0));
}

TEST(Model, A_damping_ratio_replaces_damping_and_back) {
  const Sde ratio = read_good(kRsrrp, {"closure.S.sde.damping_ratio=0.7"}).linkage.closures[0].sde;
  EXPECT_EQ(ratio.damping_ratio, 0.7);
  EXPECT_EQ(ratio.damping[kX], 0.0);
  const Sde back =
      read_good(kRsrrp, {"closure.S.sde.damping_ratio=0.7", "closure.S.sde.damping.y=5"})
          .linkage.closures[0]
          .sde;
  EXPECT_FALSE(back.damping_ratio);
  EXPECT_THAT(back.damping, ElementsAre(0, 5, 0, 0, 0, 0));
}

TEST(Model, Inertia_at_the_origin_is_moved_by_the_parallel_axis_theorem) {
  const std::string text =
      replaced(replaced(kRsrrp, "center_of_mass = [0.0, 0.25, 0.0]", "center_of_mass = [1, 2, 3]"),
               "inertia = [0.03125, 1.0e-4, 0.03125]",
               "inertia_at_origin = [21.0, 17.0, 9.5, -3.0, -4.5, -9.0]");
  // m = 1.5: m (c.c E - c c^T) = [19.5 -3 -4.5; -3 15 -9; -4.5 -9 7.5].
  const Eigen::Matrix3d inertia = read_good(text).linkage.links[3].inertia;
  EXPECT_TRUE(inertia.isApprox(Eigen::Vector3d(1.5, 2.0, 2.0).asDiagonal().toDenseMatrix(), 1e-14))
      << inertia;
}

TEST(Model, Four_ways_to_say_a_rotation_agree) {
  const double c = std::cos(0.3), s = std::sin(0.3);
  Eigen::Matrix3d expected;  // Rx(0.3)
  expected << 1, 0, 0, 0, c, -s, 0, s, c;
  const std::string rows = fmt::format("[[1, 0, 0], [0, {0}, -{1}], [0, {1}, {0}]]", c, s);
  const std::string quaternion = fmt::format("[{}, {}, 0, 0]", std::cos(0.15), std::sin(0.15));
  for (const std::string& form :
       {std::string("frame.rotation = { axis = [5, 0, 0], angle = 0.3 }"), "frame.matrix = " + rows,
        "frame.rotation.matrix = " + rows, std::string("frame.euler_zyx = [0, 0, 0.3]"),
        "frame.quaternion = " + quaternion,
        "frame = { rotation = { quaternion = " + quaternion + " } }"}) {
    const std::string text = replaced(kRsrrp, "frame.euler_zyx = [0.0, 0.0, \"-90 deg\"]", form);
    const Eigen::Matrix3d rotation = read_good(text).linkage.joints[3].frame.rotation;
    EXPECT_TRUE(rotation.isApprox(expected, 1e-15)) << form << "\n" << rotation;
  }
  const std::string zyx = replaced(kRsrrp, "frame.euler_zyx = [0.0, 0.0, \"-90 deg\"]",
                                   "frame.euler_zyx = [0.1, 0.2, 0.3]");
  // Third row of Rz(psi) Ry(theta) Rx(phi): -sin theta, cos theta sin phi, cos theta cos phi.
  const Eigen::Vector3d third = read_good(zyx).linkage.joints[3].frame.rotation.row(2);
  EXPECT_TRUE(third.isApprox(
      Eigen::Vector3d(-std::sin(0.2), std::cos(0.2) * std::sin(0.3), std::cos(0.2) * std::cos(0.3)),
      1e-15));
}

TEST(Model, A_rounded_matrix_is_made_orthonormal) {
  const std::string text =
      replaced(kRsrrp, "frame.euler_zyx = [0.0, 0.0, \"-90 deg\"]",
               "frame.matrix = [[0.8660254, -0.5, 0], [0.5, 0.8660254, 0], [0, 0, 1]]");
  const Eigen::Matrix3d r = read_good(text).linkage.joints[3].frame.rotation;
  EXPECT_LT((r.transpose() * r - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_NEAR(r(0, 0), std::sqrt(0.75), 1e-7);
}

TEST(Model, A_screw_is_given_per_revolution) {
  const std::string text =
      replaced(kRsrrp, "type = \"prismatic\"", "type = \"screw\"\npitch = \"5 mm/rev\"");
  const ModelInput input = read_good(replaced(text, "[\"25 cm\"]", "[1.5]"));
  EXPECT_DOUBLE_EQ(input.linkage.joints[1].pitch, 0.005 / (2.0 * kPi));
}

TEST(Model, Link_loads_keep_their_direction_and_frame) {
  const ModelInput input = read_good(kRsrrp + R"([[load]]
name = "push"
type = "link_force"
link = "coupler"
point = [0, "10 cm", 0]
direction = [0, 3, 4]
axes = "link"
course = { shape = "table", times = [0, "500 ms", 1], values = [0, "2 kN", 1] }
)");
  const Load& load = input.linkage.loads[2];
  EXPECT_EQ(load.type, LoadType::link_force);
  EXPECT_EQ(load.point, Eigen::Vector3d(0, 0.1, 0));
  EXPECT_TRUE(load.direction.isApprox(Eigen::Vector3d(0, 0.6, 0.8)));
  EXPECT_TRUE(load.follows_link);
  EXPECT_THAT(load.course.times, ElementsAre(0, 0.5, 1));
  EXPECT_THAT(load.course.values, ElementsAre(0, 2000, 1));
}

double best_of(int count, const std::function<void()>& action) {
  double best = 1.0e9;
  for (int i = 0; i < count; ++i) {
    const auto start = std::chrono::steady_clock::now();
    action();
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    best = std::min(best, took.count());
  }
  return best;
}

// A study builds one model a case: that must stay in the order of parsing a small text once (here
// 0.1 ms), a growth with the number of keys squared would show.
TEST(Model, A_case_costs_no_more_than_a_few_readings_of_the_text) {
  Diagnostics diagnostics;
  const auto document = ModelDocument::parse(kRsrrp, "model.toml", diagnostics);
  ASSERT_TRUE(document);
  std::vector<Override> overrides = {make_override("closure.S.sde.stiffness", 1e7),
                                     make_override("closure.S.model", "sde"),
                                     make_override("simulation.step", 1e-5)};
  const double text = best_of(20, [&] { ModelDocument::parse(kRsrrp, "model.toml", diagnostics); });
  const double built = best_of(20, [&] {
    overrides[0].value.number += 1.0;
    const auto input = document->with(overrides, diagnostics);
    ASSERT_EQ(input->linkage.closures[0].sde.stiffness[kX], overrides[0].value.number);
  });
  EXPECT_LT(built, 5.0 * text);
}

}  // namespace
}  // namespace linkstudy::model_test
