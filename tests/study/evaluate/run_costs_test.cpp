// Costs of packs over each other: those of steps and freedoms that the models state.
#include "study/evaluate/run_costs.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>

#include "tests/study/evaluate/read_evaluator.h"

namespace linkstudy::run_costs_test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kModel = R"(format = 1
kind = "model"
[[link]]
name = "weight"
mass = 2.0
center_of_mass = [0.0, 0.0, 0.0]
inertia = [1.0, 1.0, 1.0]
[[joint]]
name = "P"
type = "prismatic"
parent = "ground"
child = "weight"
[simulation]
end_time = 1.0
step = 1e-2
)";

constexpr const char* kStudy = R"(format = 1
kind = "study"
model = "model.toml"
[[vary]]
parameter = "simulation.step"
values = [1e-2, 1e-3]
[[vary]]
parameter = "link.weight.mass"
values = [1.0, 2.0, 3.0]
[[response]]
name = "end"
signal = "joint.P.q"
reduce = "last"
[[load_case]]
name = "short"
[[load_case]]
name = "long"
set = { "simulation.end_time" = 3.0 }
)";

class Costs : public ::testing::Test {
 protected:
  Costs() {
    std::string pattern = (fs::temp_directory_path() / "linkstudy_costs.XXXXXX").string();
    directory_ = ::mkdtemp(pattern.data());
    std::ofstream(directory_ / "model.toml") << kModel;
    std::ofstream(directory_ / "study.toml") << kStudy;
    Diagnostics diagnostics;
    evaluator_ = read_evaluator((directory_ / "study.toml").string(), diagnostics);
  }
  ~Costs() override { fs::remove_all(directory_); }

  fs::path directory_;
  std::unique_ptr<Evaluator> evaluator_;
};

TEST_F(Costs, Count_the_steps_of_all_load_cases_and_points) {
  RunCosts costs(*evaluator_);
  const double one = costs.of({{0, {1e-2, 1.0}}});
  EXPECT_DOUBLE_EQ(one, 400.0);  // 100 and 300 steps of one freedom
  EXPECT_DOUBLE_EQ(costs.of({{0, {1e-2, 1.0}}, {1, {1e-2, 2.0}}, {2, {1e-2, 3.0}}}), 3.0 * one);
  EXPECT_DOUBLE_EQ(costs.of({{3, {1e-3, 1.0}}}), 10.0 * one);
  EXPECT_EQ(costs.of({{4, {-1.0, 1.0}}}), 0.0);
}

TEST_F(Costs, Put_the_longest_first_and_leave_equal_ones_in_their_order) {
  RunCosts costs(*evaluator_);
  std::vector<std::vector<Point>> packs = {{{0, {1e-2, 1.0}}},
                                           {{1, {1e-2, 2.0}}, {2, {1e-2, 3.0}}},
                                           {{3, {1e-3, 1.0}}},
                                           {{4, {1e-2, 2.0}}}};
  sort_by_cost(packs, costs);
  std::vector<std::uint64_t> firsts;
  for (const auto& pack : packs) firsts.push_back(pack.front().id);
  EXPECT_EQ(firsts, (std::vector<std::uint64_t>{3, 1, 0, 4}));
}

}  // namespace
}  // namespace linkstudy::run_costs_test
