#include "study/evaluate/evaluator.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <stdlib.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <thread>

#include "study/evaluate/reference_bytes.h"
#include "tests/study/evaluate/read_evaluator.h"

namespace linkstudy::evaluator_test {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;
using Result = linkstudy::Evaluation;

std::string link_text(const char* name, double centre, const char* inertia) {
  return fmt::format(R"(
[[link]]
name = "{}"
mass = 1.0
center_of_mass = [{}, 0.0, 0.0]
inertia = {}
)",
                     name, centre, inertia);
}

// A hinge `at` along x of its parent, turned by `degrees` at the start.
std::string hinge_text(const char* name, const char* parent, const char* child, double at,
                       int degrees) {
  return fmt::format(R"(
[[joint]]
name = "{}"
type = "revolute"
parent = "{}"
child = "{}"
frame = {{ position = [{}, 0.0, 0.0] }}
initial = {{ position = ["{} deg"] }}
)",
                     name, parent, child, at, degrees);
}

// A parallelogram: crank, coupler and rocker in the plane z = 0, closed at C.
std::string model_text() {
  const char* short_link = "[1e-3, 4e-3, 4e-3]";
  return R"(format = 1
kind = "model"
name = "four-bar"
gravity = [0.0, -9.81, 0.0]
)" + link_text("crank", 0.1, short_link) +
         link_text("rod", 0.25, "[1e-3, 2e-2, 2e-2]") + link_text("rocker", 0.1, short_link) +
         hinge_text("A", "ground", "crank", 0.0, 60) + hinge_text("B", "crank", "rod", 0.2, -60) +
         hinge_text("D", "rod", "rocker", 0.5, -120) + R"(
[[closure]]
name = "C"
type = "spherical"
first = { link = "rocker", position = [0.2, 0.0, 0.0] }
second = { link = "ground", position = [0.5, 0.0, 0.0] }
model = "cut"
sde = { stiffness = 1e5, damping_ratio = 0.7 }

[simulation]
end_time = 0.1
step = 1e-3
)";
}

constexpr const char* kHead = R"(format = 1
kind = "study"
model = "model.toml"
)";

std::string vary_text(const char* parameter, const char* values) {
  return fmt::format("[[vary]]\nparameter = \"{}\"\nvalues = [{}]\n", parameter, values);
}

constexpr const char* kWeightless = "base = { set = { gravity = [0.0, 0.0, 0.0] } }\n";

class Evaluation : public ::testing::Test {
 protected:
  Evaluation() {
    std::string pattern = (fs::temp_directory_path() / "linkstudy_evaluate.XXXXXX").string();
    directory_ = ::mkdtemp(pattern.data());
    std::ofstream(directory_ / "model.toml") << model_text();
  }
  ~Evaluation() override { fs::remove_all(directory_); }

  // Null with diagnostics where the study is wrong.
  std::unique_ptr<Evaluator> try_to_make(const std::string& study) {
    const std::string path = (directory_ / "study.toml").string();
    std::ofstream(path) << kHead << study;
    return read_evaluator(path, diagnostics_);
  }

  void make(const std::string& study) {
    evaluator_ = try_to_make(study);
    if (!evaluator_) throw std::logic_error(said());
  }

  Result evaluate(const std::vector<Value>& values) {
    const Point point{0, values};
    return evaluator_->evaluate({&point, 1}).at(0);
  }

  std::vector<Result> evaluate_all(const std::vector<std::vector<Value>>& all) {
    std::vector<Point> points;
    for (const std::vector<Value>& values : all) points.push_back({0, values});
    return evaluator_->evaluate(points);
  }

  static std::string bytes_of(const Result& result) { return to_bytes(WholeEvaluation{result}); }

  double number(const Result& result, const std::string& name) const {
    const std::vector<Response>& responses = evaluator_->responses();
    for (std::size_t i = 0; i < responses.size(); ++i) {
      if (responses[i].name == name) return result.responses.at(i);
    }
    ADD_FAILURE() << "no response " << name;
    return std::nan("");
  }

  std::string said() const { return to_string(diagnostics_); }

  fs::path directory_;
  Diagnostics diagnostics_;
  std::unique_ptr<Evaluator> evaluator_;
};

constexpr const char* kAgainstItself = R"(
reference = { set = {} }
[[vary]]
parameter = "simulation.step"
values = [1e-3, 5e-4, 3e-4]
[[match]]
signal = "closure.C.force"
tolerance = 0.01
)";

TEST_F(Evaluation, Of_the_reference_itself_has_no_error_at_all) {
  make(kAgainstItself);
  const Result result = evaluate({1e-3});
  EXPECT_EQ(result.status, Cause::ok) << result.message;
  for (const char* axis : {"x", "y", "z"}) {
    EXPECT_EQ(number(result, std::string("error_max_closure_C_force_") + axis), 0.0);
    EXPECT_EQ(number(result, std::string("error_rms_closure_C_force_") + axis), 0.0);
  }
  EXPECT_EQ(number(result, "steps"), 100.0);
  EXPECT_DOUBLE_EQ(number(result, "end_time"), 0.1);
}

TEST_F(Evaluation, Against_a_turned_signal_is_off_by_twice_its_size) {
  make(std::string(kAgainstItself) + "reference_signal = \"-closure.C.force\"\n");
  const Result result = evaluate({1e-3});
  EXPECT_DOUBLE_EQ(number(result, "error_max_closure_C_force_y"), 2.0);
  EXPECT_DOUBLE_EQ(number(result, "error_rms_closure_C_force_y"), 2.0);
}

TEST_F(Evaluation, At_half_the_step_differs_by_the_order_of_RK4_only) {
  make(kAgainstItself);
  const Result half = evaluate({5e-4});
  EXPECT_GT(number(half, "error_max_closure_C_force_y"), 0.0);
  EXPECT_LT(number(half, "error_max_closure_C_force_y"), 1e-6);
}

TEST_F(Evaluation, Without_a_common_time_grid_is_an_invalid_point) {
  make(kAgainstItself);
  const Result result = evaluate({0.1 / 1009});  // 1009 is prime and over the limit
  EXPECT_EQ(result.status, Cause::invalid_point);
  EXPECT_THAT(result.message, HasSubstr("no common time grid"));
  EXPECT_EQ(result.responses.size(), evaluator_->responses().size());
}

TEST_F(Evaluation, Of_an_impossible_value_is_an_invalid_point_with_its_reason) {
  make(vary_text("link.rod.mass", "1.0"));
  const Result result = evaluate({-1.0});
  EXPECT_EQ(result.status, Cause::invalid_point);
  EXPECT_THAT(result.message, HasSubstr("mass must be positive"));
}

TEST_F(Evaluation, Is_the_same_to_the_last_bit_when_repeated) {
  make(kAgainstItself);
  EXPECT_EQ(bytes_of(evaluate({5e-4})), bytes_of(evaluate({5e-4})));
}

std::string with_speed(const char* study) {
  return study + std::string(R"(
[[response]]
name = "speed"
signal = "joint.A.v"
reduce = "last"
[[trace]]
signals = ["joint.A.v"]
)");
}

constexpr const char* kTwoLoads = R"(
reference = { set = { "closure.C.model" = "cut" } }
base = { set = { "closure.C.model" = "sde" } }
[[vary]]
parameter = "closure.C.sde.stiffness"
values = [1e5]
[[match]]
signal = "closure.C.force"
norm = "rms"
tolerance = 0.01
[[load_case]]
name = "light"
[[load_case]]
name = "heavy"
set = { "link.rod.mass" = 10.0 }
)";

TEST_F(Evaluation, Answers_every_load_case_under_its_name) {
  make(with_speed(kTwoLoads));
  const Result result = evaluate({1e5});
  ASSERT_EQ(result.status, Cause::ok) << result.message;
  const double light = number(result, "light_gap_max");
  const double heavy = number(result, "heavy_gap_max");
  EXPECT_GT(light, 0.0);
  EXPECT_GT(heavy, 3.0 * light);  // ten times the rod on the same spring
  ASSERT_EQ(evaluator_->judged_errors().size(), 6u);
  EXPECT_EQ(evaluator_->judged_errors()[3].name, "heavy.closure.C.force.x");
  const std::size_t index = evaluator_->judged_errors()[4].response;
  EXPECT_EQ(evaluator_->responses()[index].name, "heavy_error_rms_closure_C_force_y");
  EXPECT_EQ(evaluator_->worst(RunNumber::omega_max, result.responses),
            std::max(number(result, "light_omega_max"), number(result, "heavy_omega_max")));
  EXPECT_EQ(evaluator_->worst(RunNumber::step_limit, result.responses),
            std::min(number(result, "light_step_limit"), number(result, "heavy_step_limit")));
  ASSERT_EQ(result.derived.size(), 4u);
  EXPECT_EQ(result.derived[3].name, "heavy_closure.C.sde.damping");
  EXPECT_GT(result.derived[3].values[0], result.derived[1].values[0]);  // more effective mass
}

TEST_F(Evaluation, Keeps_traces_that_end_with_the_last_response) {
  make(with_speed(kTwoLoads));
  const Result result = evaluate({1e5});
  ASSERT_EQ(result.traces.size(), 2u);
  EXPECT_EQ(result.traces[1].load_case, "heavy");
  const std::vector<Trace>& traces = result.traces[1].traces;
  ASSERT_EQ(traces.size(), 2u);
  EXPECT_EQ(traces[0].name, "time");
  EXPECT_DOUBLE_EQ(traces[0].values.back(), 0.1);
  EXPECT_EQ(traces[1].values.back(), number(result, "heavy_speed"));
  evaluator_->run_references();
  EXPECT_EQ(evaluator_->reference_traces().size(), 2u);
}

TEST_F(Evaluation, Names_the_load_case_that_failed_and_keeps_what_is_known) {
  make(with_speed(kTwoLoads));
  const Result result = evaluate({1e12});
  EXPECT_NE(result.status, Cause::ok);
  EXPECT_THAT(result.message, HasSubstr("load case 'light'"));
  EXPECT_TRUE(std::isnan(number(result, "light_error_max_closure_C_force_x")));
  EXPECT_LT(number(result, "light_step_limit"), 1e-3);
  EXPECT_TRUE(std::isnan(number(result, "heavy_step_limit")));
}

TEST_F(Evaluation, Ends_at_its_time_limit) {
  make(kWeightless + vary_text("simulation.end_time", "1e5"));
  evaluator_->set_timeout(0.05);
  const Result result = evaluate({1e5});
  EXPECT_EQ(result.status, Cause::timeout) << result.message;
}

TEST_F(Evaluation, Is_cancelled_between_blocks_of_steps_and_not_tried_again) {
  make(kWeightless + vary_text("simulation.end_time", "1e5") + vary_text("link.rod.mass", "1.0"));
  std::thread other([&] {
    while (evaluator_->reached() == 0.0) std::this_thread::yield();
    evaluator_->cancel();
  });
  const std::vector<std::vector<Value>> points = {{1e5, 1.0}, {1e5, 2.0}};
  const std::vector<Result> results = evaluate_all(points);
  other.join();
  for (const Result& result : results) {
    EXPECT_EQ(result.status, Cause::cancelled) << result.message;
    EXPECT_EQ(result.attempts, 1u);
  }
  EXPECT_EQ(evaluate({0.1, 1.0}).status, Cause::cancelled) << "what follows ends at once";
}

constexpr const char* kMatched = R"(
reference = { set = { "closure.C.model" = "cut" } }
base = { set = { "closure.C.model" = "sde" } }
[[vary]]
parameter = "link.rod.mass"
values = [1.0]
[[match]]
signal = "closure.C.force"
tolerance = 0.01
[[trace]]
signals = ["closure.C.force"]
)";

TEST_F(Evaluation, Against_a_stored_reference_is_the_same_to_the_last_bit) {
  make(kMatched);
  const std::string stored = encode_reference(evaluator_->run_reference(0));
  const std::string own = bytes_of(evaluate({1.5}));
  make(kMatched);
  evaluator_->set_reference(0, decode_reference(stored));
  evaluator_->run_references();
  EXPECT_EQ(encode_reference(evaluator_->run_reference(0)), stored);
  EXPECT_EQ(bytes_of(evaluate({1.5})), own);
  EXPECT_FALSE(evaluator_->run_reference(0).poses.empty());
}

TEST_F(Evaluation, Takes_no_reference_that_is_damaged_or_of_another_study) {
  make(kMatched);
  const std::string stored = encode_reference(evaluator_->run_reference(0));
  for (std::size_t length = 0; length < stored.size(); length += 7) {
    EXPECT_THROW(decode_reference(stored.substr(0, length)), std::out_of_range) << length;
  }
  EXPECT_THROW(decode_reference(stored + "x"), std::out_of_range);
  EXPECT_THROW(evaluator_->set_reference(0, {}), std::out_of_range);
}

TEST_F(Evaluation, Stops_the_study_when_the_reference_fails) {
  make(R"(
reference = { set = { "closure.C.model" = "sde", "closure.C.sde.stiffness" = 1e12 } }
[[vary]]
parameter = "link.rod.mass"
values = [1.0]
[[match]]
signal = "closure.C.force"
tolerance = 0.01
)");
  try {
    evaluator_->run_references();
    FAIL() << "the reference runs";
  } catch (const ReferenceFailure& failure) {
    EXPECT_THAT(failure.what(), HasSubstr("the reference run failed"));
  }
}

TEST_F(Evaluation, Reports_unknown_signals_at_their_place_with_the_nearest) {
  EXPECT_FALSE(
      try_to_make(vary_text("link.rod.mass", "1.0") +
                  "[[response]]\nname = \"f\"\nsignal = \"closure.C.fors\"\nreduce = \"max\"\n"));
  EXPECT_THAT(said(), HasSubstr("study.toml:9:10: error: there is no signal 'closure.C.fors'"));
  EXPECT_THAT(said(), HasSubstr("closure.C.force"));
}

// Stiffnesses, steps and models that share step loops and that do not, in two load cases, one
// diverging, two invalid.
constexpr const char* kMixed = R"(
reference = { set = { "closure.C.model" = "cut" } }
[[vary]]
parameter = "closure.C.sde.stiffness"
values = [1e5]
[[vary]]
parameter = "closure.C.model"
values = ["sde"]
[[vary]]
parameter = "simulation.step"
values = [1e-3]
[[vary]]
parameter = "link.rod.mass"
values = [1.0]
[[match]]
signal = "closure.C.force"
tolerance = 0.01
[[load_case]]
name = "as_is"
[[load_case]]
name = "light_crank"
set = { "link.crank.mass" = 0.5 }
)";

std::vector<std::vector<Value>> mixed_points() {
  const Value sde = std::string("sde");
  const Value cut = std::string("cut");
  return {{1e5, sde, 1e-3, 1.0},  {2e5, sde, 1e-3, 1.0},  {1e12, sde, 1e-3, 1.0},
          {1e5, cut, 1e-3, 1.0},  {3e5, sde, 5e-4, 1.0},  {1e5, sde, 1e-3, -1.0},
          {4e5, sde, 1e-3, 2.0},  {1e5, cut, 1e-3, 3.0},  {5e5, sde, 1e-3, 1.0},
          {1e5, sde, 1e-17, 1.0}, {6e5, sde, 1e-3, 1.0},  {7e5, sde, 5e-4, 1.0},
          {8e5, sde, 1e-3, 1.0},  {9e5, sde, 1e-3, 1.0},  {1e6, sde, 1e-3, 1.0},
          {1e4, sde, 1e-3, 1.0},  {2e4, sde, 1e-3, 10.0}, {3e4, sde, 1e-3, 0.1}};
}

TEST_F(Evaluation, Of_a_point_is_the_same_to_the_last_bit_alone_and_beside_others) {
  make(with_speed(kMixed));
  const std::vector<std::vector<Value>> points = mixed_points();
  const std::vector<Result> together = evaluate_all(points);
  ASSERT_EQ(together.size(), points.size());
  std::map<Cause, int> causes;
  for (std::size_t i = 0; i < points.size(); ++i) {
    ++causes[together[i].status];
    EXPECT_EQ(bytes_of(together[i]), bytes_of(evaluate(points[i]))) << i << together[i].message;
  }
  EXPECT_EQ(causes[Cause::ok], 15);
  EXPECT_EQ(causes[Cause::invalid_point], 2);
  EXPECT_EQ(together[5].status, Cause::invalid_point);
  EXPECT_EQ(together[9].status, Cause::invalid_point) << together[9].message;
}

// Histories of 1e18 steps are more than there is memory for: thrown, and tried three times.
TEST_F(Evaluation, That_throws_is_tried_again_and_disturbs_no_other) {
  make(vary_text("simulation.end_time", "0.1") + vary_text("link.rod.mass", "1.0") +
       "\n[[trace]]\nsignals = [\"joint.A.q\"]\n");
  const std::vector<std::vector<Value>> points = {{0.1, 1.0}, {1e15, 1.0}, {0.1, 2.0}};
  const std::vector<Result> results = evaluate_all(points);
  EXPECT_EQ(results[1].status, Cause::exception) << results[1].message;
  EXPECT_EQ(results[1].attempts, 3u);
  EXPECT_THAT(results[1].message, HasSubstr("an eighth of this machine's memory"));
  for (const std::size_t i : {0, 2}) {
    EXPECT_EQ(results[i].status, Cause::ok) << results[i].message;
    EXPECT_EQ(results[i].attempts, 1u);
    EXPECT_EQ(bytes_of(results[i]), bytes_of(evaluate(points[i])));
  }
}

TEST_F(Evaluation, Side_by_side_ends_at_one_time_limit_and_spares_those_that_are_shorter) {
  make(kWeightless + vary_text("simulation.end_time", "0.1") + vary_text("link.rod.mass", "1.0"));
  evaluator_->set_timeout(0.3);
  const std::vector<std::vector<Value>> points = {{1e5, 1.0}, {0.1, 1.0}, {1e5, 2.0}, {0.1, 2.0}};
  const std::vector<Result> results = evaluate_all(points);
  EXPECT_EQ(results[0].status, Cause::timeout);
  EXPECT_EQ(results[2].status, Cause::timeout);
  EXPECT_EQ(results[1].status, Cause::ok) << results[1].message;
  EXPECT_EQ(results[3].status, Cause::ok) << results[3].message;
}

TEST(EvaluationBytes, Come_back_as_they_went) {
  const std::vector<Point> points = {{7, {1.5, std::string("cut"), -0.0}}, {9, {}}};
  const auto read = from_bytes<std::vector<Point>>(to_bytes(points));
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0].id, 7u);
  EXPECT_EQ(read[0].values, points[0].values);
  EXPECT_EQ(read[1].id, 9u);
  Result result;
  result.point = points[0];
  result.status = Cause::diverged;
  result.message = "diverged at t = 1 s";
  result.responses = {1.0, std::nan(""), 3.0};
  result.derived = {{"closure.C.sde.damping", "N s/m", {7.0}}};
  result.traces = {{"fast", {{"time", "s", {0.0, 1.0}}, {"joint.A.q", "rad", {2.0, 3.0}}}}};
  result.attempts = 2;
  result.host = "n1";
  using Results = std::vector<WholeEvaluation>;
  const std::string bytes = to_bytes(Results{{result}, {Result()}});
  const auto results = from_bytes<Results>(bytes);
  EXPECT_EQ(to_bytes(results), bytes);
  EXPECT_EQ(results[0].evaluation.traces[0].traces[1].values[1], 3.0);
  EXPECT_EQ(results[0].evaluation.derived[0].values[0], 7.0);
  EXPECT_EQ(results[1].evaluation.status, Cause::ok);
  EXPECT_THROW(from_bytes<Results>(bytes.substr(0, bytes.size() - 3)), std::out_of_range);
  std::string wrong = bytes;
  wrong[wrong.find("diverged at") - 9] = 99;  // the cause, before the length of the message
  EXPECT_THROW(from_bytes<Results>(wrong), std::out_of_range);
}

}  // namespace
}  // namespace linkstudy::evaluator_test
