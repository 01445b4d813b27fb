// Courses that repeat, go over a coordinate or stand in files, and the other tables that may.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>

#include "config_text.h"
#include "study/config/toml_writer.h"
#include "wrong_text.h"

namespace linkstudy::course_test {
namespace {

using test::expect_one_error;
using test::kRsrrp;
using test::read_good;
using test::write_file;
using test::Wrong;
using test::WrongFile;
using ::testing::DoubleEq;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double kPi = std::numbers::pi;

const std::string kLoads = R"(
[[load]]
name = "press"
type = "link_force"
link = "slider"
direction = [0, 0, -1]
course.shape = "table"
course.over = { joint = "A" }
course.positions = ["-90 deg", 0, "60 deg"]
course.values = [0, "2 kN", 5]
course.period = "1 rev"

[[load]]
name = "saw"
type = "force"
joint = "P"
course = { shape = "ramp", value = 3, duration = "20 ms", period = "50 ms" }

[[spring]]
name = "cylinder"
first = { link = "ground" }
second = { link = "coupler" }
course.shape = "table"
course.over = { joint = "P", coordinate = 0 }
course.positions = ["20 cm", 0.3]
course.values = [1, 2]
)";

std::string with_loads() {
  return kRsrrp + kLoads;
}

}  // namespace

TEST(LoadCourse, Is_read_with_its_period_and_what_it_goes_over) {
  const Linkage linkage = read_good(with_loads()).linkage;
  const Course& press = linkage.loads[2].course;
  EXPECT_EQ(press.over, (JointCoordinate{"A", 0}));
  EXPECT_THAT(press.positions, ElementsAre(DoubleEq(-kPi / 2), 0.0, DoubleEq(kPi / 3)));
  EXPECT_THAT(press.values, ElementsAre(0.0, 2000.0, 5.0));
  EXPECT_DOUBLE_EQ(press.period.value(), 2 * kPi);
  EXPECT_TRUE(press.times.empty());
  EXPECT_EQ(linkage.loads[3].course.period, 0.05);
  EXPECT_FALSE(linkage.loads[3].course.over);
  EXPECT_FALSE(linkage.loads[0].course.period);
  EXPECT_EQ(linkage.springs[0].course->over, (JointCoordinate{"P", 0}));
  EXPECT_THAT(linkage.springs[0].course->positions, ElementsAre(0.2, 0.3));
}

TEST(LoadCourse, Has_paths_to_its_period_and_positions) {
  const Linkage linkage =
      read_good(with_loads(),
                {"load.press.course.period=400 deg", "load.saw.course.period=1",
                 "load.press.course.positions.1=0.1", "spring.cylinder.course.over.joint=\"R\"",
                 "spring.cylinder.course.positions=[0, 1]"})
          .linkage;
  EXPECT_DOUBLE_EQ(linkage.loads[2].course.period.value(), 400 * kPi / 180);
  EXPECT_EQ(linkage.loads[2].course.positions[1], 0.1);
  EXPECT_EQ(linkage.loads[3].course.period, 1.0);
  EXPECT_EQ(linkage.springs[0].course->over->joint, "R");
}

namespace {

class WrongLoadCourse : public ::testing::TestWithParam<Wrong> {};

TEST_P(WrongLoadCourse, Gives_one_error_at_the_marked_place) {
  expect_one_error(with_loads(), GetParam());
}

const Wrong kCourses[] = {
    {"period_too_short", "period = \"1 rev\"", "period = @\"149 deg\"",
     "load 'press': period must be at least the length of the table", "jumps"},
    {"period_shorter_than_the_ramp", "period = \"50 ms\"", "period = @\"10 ms\"",
     "load 'saw': period must be at least duration, 0.02, got 0.01"},
    {"period_in_the_unit_of_time", "period = \"1 rev\"", "period = @\"1 s\"",
     "course.period must be in rad here, got a value in s"},
    {"period_in_the_unit_of_angles", "period = \"50 ms\"", "period = @\"1 rev\"",
     "course.period must be in s here, got a value in rad"},
    {"period_of_a_constant", "{ shape = \"ramp\", value = 3, duration = \"20 ms\", period",
     "{ shape = \"constant\", value = 3, @period",
     "course.period does not go with shape = 'constant'"},
    {"no_period", "period = \"1 rev\"", "period = @0", "course.period must be positive"},
    {"positions_in_metres", "\"-90 deg\", 0, \"60 deg\"", "@\"-1 m\", 0, 1",
     "course.positions.0 must be in rad here, got a value in m"},
    {"unknown_joint", "over = { joint = \"A\" }", "over = { joint = @\"E\" }",
     "load 'press': joint does not exist, got 'E'"},
    {"no_such_coordinate", "joint = \"P\", coordinate = 0", "joint = \"P\", coordinate = @1",
     "spring 'cylinder': joint 'P' has 1 coordinates"},
    {"both_abscissae", "positions = [\"20 cm\", 0.3]",
     "positions = [\"20 cm\", 0.3]\ncourse.@times = [0, 1]",
     "spring 'cylinder': course.times and positions exclude each other"},
    {"times_of_a_coordinate", "positions = [\"20 cm\", 0.3]", "times = @[0, 1]",
     "a course over a joint coordinate has no times"},
    {"positions_of_nothing", "over = { joint = \"P\", coordinate = 0 }\ncourse.positions = [",
     "positions = @[", "positions are those of a joint coordinate, and none is named"},
    {"over_of_a_ramp", "{ shape = \"ramp\", value = 3",
     "{ shape = \"ramp\", @over = { joint = \"A\" }, value = 3",
     "course.over does not go with shape = 'ramp'"},
    {"columns_of_no_file", "values = [1, 2]",
     "values = [1, 2]\ncourse.columns = @{ position = \"q\", value = \"F\" }",
     "course.columns are those of a file, and none is given"},
};

INSTANTIATE_TEST_SUITE_P(LoadCourses, WrongLoadCourse, ::testing::ValuesIn(kCourses),
                         [](const auto& tested) { return std::string(tested.param.what); });

const std::string kTables = R"(
[[load]]
name = "measured"
type = "torque"
joint = "A"
course = { shape = "table", file = "torque.csv", columns = { time = "t [ms]", value = "M [N mm]" } }

[[load]]
name = "press"
type = "link_force"
link = "slider"
direction = [0, 0, -1]
course.shape = "table"
course.over = { joint = "A" }
course.period = "1 rev"
course.file = "press.csv"
course.columns = { value = "F [kN]", position = "phi [deg]" }

[[spring]]
name = "buffer"
first = { link = "ground" }
second = { link = "coupler" }
force = { file = "buffer.csv", columns = { length = "l [mm]", force = "F" } }

[[motion]]
name = "slide"
joint = "P"
law = { shape = "table", file = "slide.csv", columns = { time = "t", position = "d [cm]" } }
)";

const char* const kOwnTable =
    "spring.table = { file = \"own.csv\", columns = { position = \"q [deg]\", effort = \"M\" } }\n";

void write_tables() {
  write_file("torque.csv", "# of a bench\nt [ms],M [N mm]\n0,1000\n10,2500\n\n30,-7\n");
  write_file("press.csv", "phi [deg];F [kN];other\n-180;1;x\n0;2.5;y\n180;1;z\n");
  write_file("buffer.csv", "l [mm]\tF\n100\t-300\n200\t0\n");
  write_file("slide.csv", "t,d [cm]\n0,25\n1,26\n2,25.5\n");
  write_file("own.csv", "q [deg],M\n-90,-2\n90,2\n");
}

std::string with_tables() {
  return test::replaced(kRsrrp, "name = \"R\"\n", std::string("name = \"R\"\n") + kOwnTable) +
         kTables;
}

std::optional<ModelInput> read_tables(const std::string& text, Diagnostics& diagnostics) {
  write_tables();
  const auto document = ModelDocument::load(write_file("model.toml", text), diagnostics);
  if (!document) return std::nullopt;
  return document->with({}, diagnostics);
}

}  // namespace

TEST(TableFiles, Hold_courses_springs_and_motions_with_the_units_of_their_heads) {
  Diagnostics diagnostics;
  const auto input = read_tables(with_tables(), diagnostics);
  ASSERT_TRUE(input) << to_string(diagnostics);
  const Linkage& linkage = input->linkage;
  EXPECT_THAT(linkage.loads[2].course.times, ElementsAre(0.0, 0.01, 0.03));
  EXPECT_THAT(linkage.loads[2].course.values, ElementsAre(1.0, 2.5, DoubleEq(-0.007)));
  EXPECT_THAT(linkage.loads[3].course.positions, ElementsAre(-kPi, 0.0, kPi));
  EXPECT_THAT(linkage.loads[3].course.values, ElementsAre(1000.0, 2500.0, 1000.0));
  EXPECT_THAT(linkage.springs[0].force->at, ElementsAre(0.1, 0.2));
  EXPECT_THAT(linkage.springs[0].force->force, ElementsAre(-300.0, 0.0));
  EXPECT_THAT(linkage.motions[0].times, ElementsAre(0.0, 1.0, 2.0));
  EXPECT_THAT(linkage.motions[0].positions, ElementsAre(0.25, 0.26, 0.255));
  const auto& joints = linkage.joints;
  const auto own = std::ranges::find_if(joints, [](const Joint& j) { return j.name == "R"; });
  EXPECT_THAT(own->spring_curve->curve.at, ElementsAre(-kPi / 2, kPi / 2));
}

// What is kept of a model needs no file, and its numbers have paths.
TEST(TableFiles, Are_numbers_of_the_model_once_it_is_read) {
  write_tables();
  const std::string path = write_file("model.toml", with_tables());
  Diagnostics diagnostics;
  const auto document = ModelDocument::load(path, diagnostics);
  ASSERT_TRUE(document) << to_string(diagnostics);
  for (const char* name : {"torque.csv", "press.csv", "buffer.csv", "slide.csv", "own.csv"}) {
    std::filesystem::remove(std::filesystem::path(path).parent_path() / name);
  }
  const auto input = document->with({}, diagnostics);
  for (const Tree* tree : {&document->tree(), &input->resolved}) {
    const std::string kept = write_toml(*tree);
    EXPECT_THAT(kept, ::testing::Not(HasSubstr(".csv")));
    const auto again = ModelDocument::parse(kept, "kept.toml", diagnostics);
    EXPECT_EQ(again->with({}, diagnostics)->linkage, input->linkage) << to_string(diagnostics);
  }
  const Override one = test::set("load.measured.course.values.1=9");
  EXPECT_EQ(document->with({&one, 1}, diagnostics)->linkage.loads[2].course.values[1], 9.0);
  const Override other = test::set("load.measured.course.file=\"other.csv\"");
  EXPECT_FALSE(document->with({&other, 1}, diagnostics));
  EXPECT_THAT(to_string(diagnostics),
              HasSubstr("error: load 'measured': course.file cannot be set: files are read with "
                        "the model"));
}

TEST(TableFiles, That_are_damaged_are_located_in_them) {
  Diagnostics diagnostics;
  read_tables(with_tables(), diagnostics);
  write_file("torque.csv", "t [ms],M [N mm]\n0,1\n10,much\n9,3\n20\n");
  write_file("press.csv", "phi [deg];F [kN]\n-180;1\n-190;2\n");
  const std::string path = write_file("model.toml", with_tables());
  EXPECT_FALSE(ModelDocument::load(path, diagnostics));
  const std::string said = to_string(diagnostics);
  EXPECT_THAT(said, HasSubstr("torque.csv:3:4: error: 'much' is no number"));
  EXPECT_THAT(said, HasSubstr("torque.csv:5:1: error: this line has no number in the column"));
  EXPECT_THAT(said,
              HasSubstr("press.csv:3:1: error: load 'press': course.positions must increase"));
  EXPECT_EQ(diagnostics.size(), 3u) << said;
}

namespace {

class WrongTableFile : public ::testing::TestWithParam<WrongFile> {};

TEST_P(WrongTableFile, Gives_one_error_that_says_its_place) {
  test::expect_one_message(with_tables(), GetParam(),
                           [](const std::string& text, Diagnostics& diagnostics) {
                             return read_tables(text, diagnostics).has_value();
                           });
}

const WrongFile kFiles[] = {
    {"no_file", "file = \"torque.csv\"", "file = \"lost.csv\"", "lost.csv"},
    {"no_column", "value = \"M [N mm]\"", "value = \"M [N m]\"", "has no column 'M [N m]'"},
    {"force_for_a_torque", "columns = { time = \"t [ms]\", value = \"M [N mm]\" }",
     "columns = { time = \"t [ms]\", value = \"t [ms]\" }",
     "torque.csv:2:1: error: column 't [ms]' must be in N m"},
    {"no_columns", ", columns = { length = \"l [mm]\", force = \"F\" }", "",
     "spring 'buffer': force.columns must name two columns of the file"},
    {"one_column", "columns = { length = \"l [mm]\", force = \"F\" }",
     "columns = { length = \"l [mm]\" }", "spring 'buffer': force.columns must name two columns"},
    {"unknown_column", "force = \"F\" }", "farce = \"F\" }",
     "spring 'buffer': force.columns.farce is not a known key"},
    {"column_by_number", "force = \"F\" }", "force = 2 }",
     "force.columns.force must be the head of a column, got 2"},
    {"file_and_numbers", "file = \"slide.csv\"", "times = [0, 1, 2], file = \"slide.csv\"",
     "motion 'slide': law.file and times exclude each other"},
};

INSTANTIATE_TEST_SUITE_P(TableFiles, WrongTableFile, ::testing::ValuesIn(kFiles),
                         [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace

}  // namespace linkstudy::course_test
