// linkstudy kinematics: reports, tables and objects of the models in configs/.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <complex>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cli/program.h"
#include "tests/support/source_file.h"

namespace linkstudy::testing::kinematics_test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class Kinematics : public Program {
 protected:
  static std::string model(const std::string& name) {
    return source_file("configs/mechanisms/" + name + ".toml");
  }
  Ended analyse(const std::string& name, const std::string& options = "") const {
    return run("kinematics " + model(name) + " " + options);
  }
  json object(const std::string& name, const std::string& options = "") const {
    return json::parse(analyse(name, options + " --json").out);
  }
};

struct Rows {
  std::vector<std::string> names;
  std::vector<std::vector<double>> values;  // NaN where missing
  double at(std::size_t row, const std::string& name) const {
    const auto column = std::find(names.begin(), names.end(), name) - names.begin();
    return values.at(row).at(static_cast<std::size_t>(column));
  }
};

Rows read_rows(const std::string& csv) {
  Rows rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('#')) continue;
    std::vector<std::string> cells;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    if (rows.names.empty()) {
      rows.names = cells;
      continue;
    }
    rows.values.emplace_back();
    for (const std::string& cell : cells) {
      rows.values.back().push_back(cell.empty() ? std::nan("") : std::stod(cell));
    }
  }
  return rows;
}

// The point at distance a from P and b from Q that lies to the left of the way from P to Q.
std::complex<double> apex(std::complex<double> P, std::complex<double> Q, double a, double b) {
  const double base = std::abs(Q - P);
  const double along = (a * a - b * b + base * base) / (2.0 * base);
  return P + (Q - P) / base * std::complex<double>(along, std::sqrt(a * a - along * along));
}

// Of planar_two_loop: angle of the lever as a function of that of the crank, two triangles.
double lever_angle(double crank) {
  const std::complex<double> B = std::polar(0.1, crank), D = 0.4, G(-0.1, 0.45);
  const std::complex<double> C = apex(B, D, 0.35, 0.3);
  const std::complex<double> E = B + (C - B) / 0.35 * std::complex<double>(0.2, 0.15);
  return std::arg(apex(G, E, 0.25, 0.3) - G);
}

// Of a function with one maximum between the two.
template <class F>
double largest(F f, double low, double high) {
  for (int i = 0; i < 100; ++i) {
    const double third = (high - low) / 3.0;
    if (f(low + third) < f(high - third)) {
      low += third;
    } else {
      high -= third;
    }
  }
  return f(low);
}

TEST_F(Kinematics, Tells_the_mobility_of_every_model_in_configs) {
  const std::vector<std::tuple<std::string, int, int, int>> known = {
      {"bennett", 1, -2, 3},
      {"rssr", 2, 2, 0},
      {"rccc", 1, 1, 0},
      {"slider_crank", 1, -2, 3},
      {"stewart", 6, 6, 0},
      {"four_bar", 1, -2, 3},
      {"n_four_bar", 1, -5, 6},
      {"planar_two_loop", 1, -5, 6},
      {"pendulum", 1, 1, 0},
      {"rsrrp", 1, 1, 0},
      {"rsrrp_revolute", 1, 1, 0},
      {"spatial_slider_crank", 1, 1, 0},
      {"rsup", 1, 1, 0},
      {"rsup_flexible", 1, 1, 0},
      {"rsup_clearance_planar", 1, 1, 0},
      {"rsup_clearance_spatial", 1, 1, 0},
      {"rsup_clearance_flexible", 1, 1, 0},
      {"flores_slider_crank", 1, -2, 3}};
  for (const auto& [name, mobility, kutzbach, redundant] : known) {
    const json j = object(name);
    EXPECT_EQ(j["mobility"], mobility) << name;
    EXPECT_EQ(j["kutzbach"], kutzbach) << name;
    EXPECT_EQ(j["redundant_constraints"], redundant) << name;
    EXPECT_EQ(j["singular_state"], redundant > 0 ? "permanent" : "none") << name;
    EXPECT_TRUE(j["closed"]) << name;
    EXPECT_TRUE(j["complete"]) << name;
    for (const char* key : {"redundant_joints", "idle_freedoms", "loops", "rank", "rank_gap",
                            "singular_positions", "basic_loops", "h", "h_R", "dependent"}) {
      EXPECT_TRUE(j.contains(key)) << name << " " << key;
    }
  }
}

json swing_of(const json& object, const std::string& coordinate) {
  for (const json& one : object["swings"])
    if (one["coordinate"] == coordinate) return one;
  return {};
}

constexpr double kDegree = M_PI / 180.0;

// The angle opposite to c in a triangle of sides a, b, c, in degrees.
double opposite(double a, double b, double c) {
  return std::acos((a * a + b * b - c * c) / (2.0 * a * b)) / kDegree;
}

// Crank 0.10 m, coupler 0.35 m, rocker 0.30 m, frame 0.40 m. The rocker turns back where crank and
// coupler are in line; the transmission angle is extreme where crank and frame are. Ends lie
// between the 73 positions: the quintic through them is good to (5 deg)^6 / 46080 = 1e-11 of the
// sixth derivatives, which grow to some 1e3 here.
TEST_F(Kinematics, Finds_the_swing_and_the_least_transmission_angle_of_a_crank_rocker) {
  const json found = object("four_bar");
  const json rocker = swing_of(found, "joint.D.q");
  EXPECT_EQ(rocker["motion"], "swings");
  EXPECT_EQ(rocker["unit"], "deg");
  const double least = 180.0 - opposite(0.4, 0.3, 0.45),
               greatest = 180.0 - opposite(0.4, 0.3, 0.25);
  EXPECT_NEAR(rocker["least"]["value"], least, 1e-6);
  EXPECT_NEAR(rocker["greatest"]["value"], greatest, 1e-6);
  EXPECT_NEAR(rocker["swing"], greatest - least, 2e-6);
  // Stretched and folded: the crank points along the coupler, or away from it.
  EXPECT_NEAR(
      std::remainder(rocker["least"]["drive"].get<double>() - opposite(0.4, 0.45, 0.3), 360.0), 0.0,
      1e-4);
  EXPECT_NEAR(
      std::remainder(rocker["greatest"]["drive"].get<double>() - 180.0 - opposite(0.4, 0.25, 0.3),
                     360.0),
      0.0, 1e-4);
  EXPECT_EQ(swing_of(found, "joint.A.q")["motion"], "turns");
  EXPECT_EQ(swing_of(found, "joint.A.q")["driven"], true);
  EXPECT_EQ(swing_of(found, "joint.B.q")["on_ground"], false);
  ASSERT_EQ(found["transmission_angles"].size(), 1u);
  const json worst = found["transmission_angles"][0];
  EXPECT_EQ(worst["output"], "joint.D");
  const double near_frame = opposite(0.35, 0.3, 0.3), away = 180.0 - opposite(0.35, 0.3, 0.5);
  EXPECT_NEAR(worst["least"]["value"], std::min(near_frame, away), 1e-6);
  EXPECT_NEAR(std::remainder(worst["least"]["drive"].get<double>(), 360.0), 0.0, 1e-3);
  const std::string text = analyse("four_bar").out;
  EXPECT_THAT(text, HasSubstr("joint.D.q by"));
  EXPECT_THAT(text, HasSubstr("transmission angle to joint.D at least"));
}

// Crank 0.1 m, rod 0.3 m: a stroke of two cranks, and the rod leans most where the crank is across.
TEST_F(Kinematics, Finds_the_stroke_and_the_least_transmission_angle_of_a_slider_crank) {
  const json found = object("slider_crank");
  const json slider = swing_of(found, "joint.P.q");
  EXPECT_EQ(slider["unit"], "m");
  EXPECT_NEAR(slider["least"]["value"], 0.2, 1e-9);
  EXPECT_NEAR(slider["least"]["drive"], 180.0, 1e-4);
  EXPECT_NEAR(slider["greatest"]["value"], 0.4, 1e-9);
  EXPECT_NEAR(slider["greatest"]["drive"], 360.0, 1e-4);
  const json worst = found["transmission_angles"][0];
  EXPECT_EQ(worst["output"], "joint.P");
  EXPECT_NEAR(worst["least"]["value"], std::acos(0.1 / 0.3) / kDegree, 1e-6);
  EXPECT_NEAR(std::abs(std::remainder(worst["least"]["drive"].get<double>(), 360.0)), 90.0, 1e-3);
  EXPECT_THAT(object("n_four_bar")["swings"], Not(IsEmpty()));
  // The numbers of its head, from two triangles.
  const json lever = swing_of(object("planar_two_loop"), "joint.G.q");
  EXPECT_NEAR(lever["least"]["value"], -13.3702, 5e-5);
  EXPECT_NEAR(lever["greatest"]["value"], 46.5856, 5e-5);
  EXPECT_THAT(object("rsrrp")["transmission_angles"], IsEmpty()) << "a loop of five links";
  EXPECT_THAT(object("quick_return")["transmission_angles"].size(), ::testing::Le(1u));
}

TEST_F(Kinematics, Names_joints_and_links) {
  EXPECT_THAT(object("bennett")["redundant_joints"],
              ElementsAre("joint.A", "joint.B", "joint.D", "closure.C"));
  const json idle = object("rssr")["idle_freedoms"];
  ASSERT_EQ(idle.size(), 1u);
  EXPECT_THAT(idle[0]["links"], ElementsAre("coupler"));
  EXPECT_THAT(analyse("rssr").out, HasSubstr("coupler moves alone between joint.B and closure.C"));
}

TEST_F(Kinematics, Writes_positions_velocities_and_accelerations) {
  const double crank = 0.1, rod = 0.3, w = 5.0;
  const Ended ended = analyse("slider_crank", "--positions 25 --speed 5 --csv table.csv");
  EXPECT_EQ(ended.code, 0) << ended.err;
  const Rows rows = read_rows(read_text(path("table.csv")));
  ASSERT_EQ(rows.values.size(), 25u);
  for (std::size_t i = 0; i < 25; ++i) {
    const double angle = rows.at(i, "joint.A.q");
    EXPECT_NEAR(angle, 1.0 + 2 * M_PI * static_cast<double>(i) / 24, 1e-12);
    const double s = crank * std::sin(angle), c = crank * std::cos(angle);
    const double root = std::sqrt(rod * rod - s * s);
    EXPECT_NEAR(rows.at(i, "joint.P.q"), c + root, 1e-9);
    EXPECT_NEAR(rows.at(i, "joint.P.v"), w * (-s - s * c / root), 1e-9);
    const double second = -c - (c * c - s * s) / root - s * s * c * c / (root * root * root);
    EXPECT_NEAR(rows.at(i, "joint.P.a"), w * w * second, 1e-9);
    EXPECT_LT(rows.at(i, "residual"), 1e-12);
    EXPECT_EQ(rows.at(i, "joint.A.a"), 0.0);
  }
}

TEST_F(Kinematics, Says_where_a_driven_slider_locks) {
  const json j = object("slider_crank", "--drive joint.P --to '500 mm'");
  EXPECT_FALSE(j["complete"]);
  ASSERT_EQ(j["singular_positions"].size(), 1u);
  EXPECT_EQ(j["singular_positions"][0]["kind"], "lock");
  EXPECT_NEAR(j["singular_positions"][0]["position"].get<double>(), 0.4, 1e-9);
  const std::string text = analyse("slider_crank", "--drive joint.P --to 0.1").out;
  EXPECT_THAT(text, AllOf(HasSubstr("locks: cannot be driven beyond 0.2"), HasSubstr("joint.A")));
}

TEST_F(Kinematics, Finds_both_locks_of_a_crank_that_cannot_turn_fully) {
  // Coupler and rocker in line: 0.45^2 = 0.4^2 + 0.25^2 - 2 0.4 0.25 cos(angle).
  const double limit = std::acos(0.1);
  const json crank = object("four_bar_double_rocker");
  EXPECT_FALSE(crank["complete"]);
  EXPECT_EQ(crank["mobility"], 1);
  ASSERT_EQ(crank["singular_positions"].size(), 2u);
  EXPECT_EQ(crank["singular_positions"][0]["kind"], "lock");
  EXPECT_EQ(crank["singular_positions"][1]["kind"], "lock");
  EXPECT_NEAR(crank["singular_positions"][0]["position"].get<double>(), limit, 1e-9);
  EXPECT_NEAR(crank["singular_positions"][1]["position"].get<double>(), -limit, 1e-9);
  const json rocker = object("four_bar_double_rocker", "--drive joint.D --to 1.0");
  ASSERT_EQ(rocker["singular_positions"].size(), 1u);
  EXPECT_NEAR(rocker["singular_positions"][0]["position"].get<double>(), M_PI - limit, 1e-9);
}

TEST_F(Kinematics, Of_two_loops_follows_the_closed_form_around) {
  const Rows rows = read_rows(analyse("planar_two_loop", "--csv -").out);
  ASSERT_EQ(rows.values.size(), 73u);
  for (std::size_t i = 0; i < 73; ++i) {
    EXPECT_NEAR(rows.at(i, "joint.G.q"), lever_angle(rows.at(i, "joint.A.q")), 1e-9) << i;
  }
}

TEST_F(Kinematics, Of_two_loops_locks_at_both_ends_of_the_lever) {
  const double up = largest(lever_angle, 1.0, 2.0);
  const double down = -largest([](double crank) { return -lever_angle(crank); }, 4.0, 5.0);
  const json rising = object("planar_two_loop", "--drive joint.G --to 1.0");
  const json sinking = object("planar_two_loop", "--drive joint.G --to -1.0");
  ASSERT_EQ(rising["singular_positions"].size(), 1u);
  ASSERT_EQ(sinking["singular_positions"].size(), 1u);
  EXPECT_EQ(rising["singular_positions"][0]["kind"], "lock");
  EXPECT_NEAR(rising["singular_positions"][0]["position"].get<double>(), up, 1e-9);
  EXPECT_NEAR(sinking["singular_positions"][0]["position"].get<double>(), down, 1e-9);
}

// The pin between rod and rocker turns by the difference of the two.
TEST_F(Kinematics, Has_the_joints_that_close_loops_in_its_table) {
  const Rows rows = read_rows(analyse("four_bar", "--speed 3 --csv -").out);
  ASSERT_EQ(rows.values.size(), 73u);
  const double first = rows.at(0, "closure.C.q") - rows.at(0, "joint.D.q") +
                       rows.at(0, "joint.A.q") + rows.at(0, "joint.B.q");
  for (std::size_t i = 0; i < 73; ++i) {
    for (const char* quantity : {"q", "v", "a"}) {
      const auto at = [&](const std::string& joint) { return rows.at(i, joint + "." + quantity); };
      const double apart = at("joint.D") - at("joint.A") - at("joint.B");
      EXPECT_NEAR(at("closure.C"), apart + (*quantity == 'q' ? first : 0.0), 1e-10);
    }
  }
}

TEST_F(Kinematics, Reports_the_loops_and_the_ranks) {
  const json j = object("rsrrp");
  ASSERT_EQ(j["basic_loops"].size(), 1u);
  EXPECT_EQ(j["basic_loops"][0]["cut"], "closure.S");
  EXPECT_THAT(j["basic_loops"][0]["joints"],
              ElementsAre("joint.A", "closure.S", "joint.R", "joint.Q", "joint.P"));
  EXPECT_EQ(j["basic_loops"][0]["elements"].size(), 6u);
  EXPECT_EQ(j["h"], 3);
  EXPECT_EQ(j["h_R"], 3);
  EXPECT_EQ(j["dependent"], 3);
  EXPECT_THAT(analyse("rsrrp").out, HasSubstr("cut at closure.S; proper equations a"));
}

// Open and crossed four-bar: the same crank, two places of the pin.
TEST_F(Kinematics, Tells_the_branches_of_a_four_bar_apart) {
  const json crossed = object(
      "four_bar", "-s 'joint.B.initial.position=[-2.5]' -s 'joint.D.initial.position=[-2.0]'");
  const json open = object("four_bar");
  EXPECT_EQ(open["branch"].get<int>() * crossed["branch"].get<int>(), -1);
}

TEST_F(Kinematics, Fails_where_two_drives_of_one_freedom_contradict_each_other) {
  const std::string options = "--drive joint.A=1:1.3 --drive joint.D=1.7892514033875249:2.5";
  const Ended ended = analyse("four_bar", options);
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(ended.out, HasSubstr("joint.A, joint.D contradict each other"));
  EXPECT_EQ(object("four_bar", options)["contradiction"], true);
  EXPECT_EQ(object("four_bar")["contradiction"], false);
}

// Opposite cranks of a parallelogram turn alike: two drives of one freedom that fit.
TEST_F(Kinematics, Takes_more_drives_than_freedoms_that_fit_each_other) {
  const Ended ended = analyse("n_four_bar", "--drive joint.A0=2:2.5 --drive joint.A1=2:2.5");
  EXPECT_EQ(ended.code, 0) << ended.out << ended.err;
  EXPECT_THAT(ended.out, AllOf(HasSubstr("their courses fit each other"),
                               HasSubstr("73 of 73 positions"), Not(HasSubstr("contradict"))));
}

// A link turned by half a turn against what its closure describes: a weld is another weld, which no
// verb takes; an axis is the same joint, which all of them say.
TEST_F(Kinematics, And_all_verbs_tell_ends_turned_by_half_a_turn) {
  for (const char* type : {"fixed", "prismatic", "revolute", "cylindrical"}) {
    write("turned.toml", fmt::format(R"(format = 1
kind = "model"
[[link]]
name = "a"
mass = 1.0
center_of_mass = [0.1, 0.0, 0.0]
inertia = [0.001, 0.01, 0.01]
[[joint]]
name = "A"
type = "revolute"
parent = "ground"
child = "a"
initial = {{ position = [3.141592653589793], hold = true }}
[[closure]]
name = "W"
type = "{}"
first = {{ link = "a" }}
second = {{ link = "ground" }}
[simulation]
end_time = 0.01
step = 1.0e-3
)",
                                     type));
    const bool is_weld = *type == 'f' || *type == 'p';
    for (const char* verb : {"kinematics", "simulate", "statics"}) {
      const Ended ended = run(std::string(verb) + " turned.toml");
      EXPECT_EQ(ended.code, is_weld ? 3 : 0) << verb << " " << type;
      EXPECT_THAT(ended.out + ended.err,
                  HasSubstr(is_weld ? "turned against each other by half a turn"
                                    : "closure 'W': the axes of its two ends point against"))
          << verb << " " << type;
    }
  }
}

TEST_F(Kinematics, Drives_the_joints_of_the_model_file) {
  const json j = object("stewart");
  EXPECT_EQ(j["drives"].size(), 6u);
  EXPECT_TRUE(j["complete"]);
  const Rows rows = read_rows(analyse("stewart", "--positions 5 --csv -").out);
  ASSERT_EQ(rows.values.size(), 5u);
  EXPECT_EQ(rows.at(0, "joint.P3.v"), 0.0);  // smooth
  EXPECT_NEAR(rows.at(4, "joint.P3.v"), 0.0, 1e-15);
  EXPECT_GT(rows.at(2, "joint.P3.v"), 0.0);
}

TEST_F(Kinematics, Drives_several_joints_of_the_command_line) {
  const Ended ended = analyse("stewart",
                              "--drive 'joint.P1=1.25:1300 mm' --drive joint.P2 --drive joint.P3 "
                              "--drive joint.P4 --drive joint.P5 --drive joint.P6 --csv -");
  EXPECT_EQ(ended.code, 0) << ended.err;
  const Rows rows = read_rows(ended.out);
  ASSERT_EQ(rows.values.size(), 73u);
  EXPECT_NEAR(rows.at(0, "joint.P1.q"), 1.25, 1e-15);
  EXPECT_NEAR(rows.at(72, "joint.P1.q"), 1.3, 1e-15);
  EXPECT_NEAR(rows.at(72, "time"), 0.05, 1e-15);
  EXPECT_EQ(rows.at(72, "joint.P2.q"), rows.at(0, "joint.P2.q"));
}

TEST_F(Kinematics, Says_that_drives_contradict_each_other) {
  const std::string text = analyse("four_bar", "--drive joint.A=1:2 --drive joint.D").out;
  EXPECT_THAT(text, AllOf(HasSubstr("contradict each other"), HasSubstr("h_R = 2 of 1")));
}

TEST_F(Kinematics, Leaves_velocities_out_where_branches_cross) {
  const Ended ended = analyse("n_four_bar", "--csv -");
  const Rows rows = read_rows(ended.out);
  ASSERT_EQ(rows.values.size(), 73u);
  EXPECT_NEAR(rows.at(18, "joint.A0.q"), M_PI, 1e-12);
  EXPECT_TRUE(std::isnan(rows.at(18, "joint.A1.v")));
  EXPECT_NEAR(rows.at(17, "joint.A1.v"), 1.0, 1e-9);
  EXPECT_NEAR(rows.at(54, "joint.A1.q"), rows.at(54, "joint.A0.q"), 1e-9);
  const json positions = object("n_four_bar")["singular_positions"];
  ASSERT_EQ(positions.size(), 2u);
  EXPECT_EQ(positions[0]["kind"], "branch");
}

TEST_F(Kinematics, Of_a_model_that_cannot_be_assembled_says_so) {
  const Ended ended = analyse("bennett", "--json -s 'joint.B.frame.position=[0.2502, 0, 0]'");
  EXPECT_EQ(ended.code, 3);
  EXPECT_FALSE(json::parse(ended.out)["closed"]);
  EXPECT_EQ(json::parse(ended.out)["mobility"], 0);
  EXPECT_THAT(ended.err, HasSubstr("cannot be assembled: closure.C stays open: gap"));
}

TEST_F(Kinematics, Explains_rounded_angles_and_forgotten_axes) {
  const auto first = [](const std::string& rotation) {
    return "-s 'closure.C.first.euler_zyx=" + rotation + "'";
  };
  EXPECT_THAT(on_one_line(analyse("four_bar", first("[0.0, -1.5708, 0.0]")).out),
              HasSubstr("axes apart by 3.67e-06 rad; an overconstrained loop closes only if its "
                        "dimensions are exact"));
  EXPECT_THAT(on_one_line(analyse("four_bar", first("[0.0, 0.0, 0.0]")).out),
              HasSubstr("the axis of a closure is x of its frames"));
}

TEST_F(Kinematics, Of_a_course_that_cannot_begin_fails) {
  EXPECT_EQ(analyse("four_bar_double_rocker", "--from 3 --to 1").code, 3);
  EXPECT_EQ(analyse("four_bar_double_rocker").code, 0);
}

TEST_F(Kinematics, Refuses_wrong_options) {
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {"--drive joint.Z", "there is no coordinate 'joint.Z'"},
      {"--to '1 m'", "--to must be a number in rad"},
      {"--from x", "--from must be a number in rad"},
      {"--positions 1", "--positions must be from 2"},
      {"--csv nowhere/x.csv", "there is no directory"},
      {"--drive joint.A --drive joint.A=0:1", "joint.A is given twice"},
      {"--drive joint.A=0", "a range is written FROM:TO"},
      {"--drive joint.A=0:1m", "TO must be a number in rad"},
      {"--drive joint.A --drive joint.B --to 1", "--to is for one drive, there are 2"},
      {"--drive joint.A --drive joint.B --speed 1", "--speed is for one drive"},
      {"--speed 0", "--speed must be positive"},
      {"--drive joint.A=0:1 --from 0", "contradict each other"},
      {"--h5 nowhere/x.h5", "there is no directory"},
      {"--csv - --json", "both want standard output"}};
  for (const auto& [options, message] : wrong) {
    const Ended ended = analyse("bennett", options);
    EXPECT_EQ(ended.code, 2) << options;
    EXPECT_THAT(ended.err, HasSubstr(message)) << options;
    EXPECT_EQ(ended.out, "") << options;
  }
  EXPECT_THAT(left_behind(), IsEmpty());
}

TEST_F(Kinematics, Says_that_it_does_not_know_rods) {
  const Ended ended = analyse("rssr_rod");
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("rssr_rod.toml:56:8: error: closure 'C': kinematics does not "
                                   "know a rod"));
}

}  // namespace

}  // namespace linkstudy::testing::kinematics_test
