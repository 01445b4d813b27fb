// Step loops made for one structure: found for the models they were made from, with the bits of the
// general one, and giving way to it where rows become dependent.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/model/fixed_structure.h"
#include "core/simulation/kernels.h"
#include "core/simulation/prepare.h"
#include "core/simulation/simulate.h"
#include "study/config/model_document.h"
#include "study/specialize/fixed_kernels.h"
#include "tests/support/same_bits.h"
#include "tests/support/simd_levels.h"
#include "tests/support/source_file.h"

namespace linkstudy::fixed_kernels_test {
namespace {

using testing::same_bits;

ModelInput read_config(const std::string& name, const std::vector<std::string>& set) {
  Diagnostics diagnostics;
  std::vector<Override> overrides;
  for (const std::string& text : set) overrides.push_back(*parse_set(text, diagnostics));
  const auto document =
      ModelDocument::load(testing::source_file("configs/mechanisms/" + name), diagnostics);
  return *document->with(overrides, diagnostics);
}

void add_once() {
  static const bool added = (add_fixed_kernels(), true);
  ASSERT_TRUE(added);
}

struct Specialised {
  const char* file;
  std::vector<std::string> set;
};

const std::vector<Specialised>& specialised() {
  static const std::vector<Specialised> all = {{"rsrrp.toml", {"closure.S.model=sde"}},
                                               {"rsrrp.toml", {"closure.S.model=cut"}},
                                               {"rsrrp_revolute.toml", {"closure.R.model=sde"}},
                                               {"rsup_clearance_planar.toml", {}}};
  return all;
}

struct Runs {
  std::vector<BatchCase> cases;
  std::vector<Observers> observers;
};

Runs run(const Model& model, const SimulationOptions& options, int count,
         const StepLoopChoice& choice) {
  const StepGrid grid = make_step_grid(options);
  Runs runs;
  const std::vector<Channel> all = list_channels(model.mechanism);
  runs.observers.assign(static_cast<std::size_t>(count), {});
  for (auto& o : runs.observers) {
    o.series.push_back({all, {0, grid.count, 100}, {}});
    runs.cases.push_back({&model.parameters, &model.start, &o, {}});
  }
  simulate_batch(model.mechanism, options, runs.cases, {}, choice);
  return runs;
}

// One step of a kernel on a model, without observers.
bool is_abandoned(const Kernel& kernel, const Model& model) {
  std::vector<double> y = model.start.q;
  y.insert(y.end(), model.start.v.begin(), model.start.v.end());
  y.insert(y.end(), static_cast<std::size_t>(model.mechanism.nz) + 2, 0.0);
  std::vector<double> final_y = y;
  Observers none;
  LaneEnd end;
  const LaneCase lane{&model.parameters, y.data(), final_y.data(), &none, nullptr, &end};
  const KernelRun setting{0.0, 1e-4, 1, 1, 1.0, [](void*, double) { return Cause::ok; }, nullptr};
  kernel.run(model.mechanism, setting, &lane, 1);
  return end.abandoned;
}

}  // namespace

TEST(FixedKernels, The_listed_models_have_their_own_step_loop_and_others_do_not) {
  add_once();
  for (const Specialised& s : specialised()) {
    const Mechanism m = compile(read_config(s.file, s.set).linkage).mechanism;
    for (const SimdLevel& level : testing::simd_levels()) {
      const Kernel& kernel = find_kernel(m, level.isa, level.lanes);
      ASSERT_NE(kernel.serves, nullptr) << s.file;
      EXPECT_TRUE(kernel.serves(m));
      EXPECT_EQ(kernel.lanes, level.lanes);
      EXPECT_EQ(find_kernel(m, level.isa, level.lanes, true).serves, nullptr);
    }
  }
  const Mechanism other = compile(read_config("four_bar.toml", {}).linkage).mechanism;
  EXPECT_EQ(find_kernel(other, InstructionSet::baseline, 1).serves, nullptr);
}

TEST(FixedKernels, Whole_runs_have_the_bits_of_the_general_step_loop) {
  add_once();
  for (const Specialised& s : specialised()) {
    ModelInput input = read_config(s.file, s.set);
    input.options.end_time = std::min(3.0, 6e4 * input.options.step);
    input.linkage.points = {{"tip", input.linkage.links.back().name, Eigen::Vector3d::Ones()}};
    const Preparation p = prepare(input.linkage, input.options);
    ASSERT_EQ(p.cause, Cause::ok) << p.message;
    for (const SimdLevel& level : testing::simd_levels()) {
      for (const int lanes : {1, level.lanes}) {
        const Runs fixed = run(p.model, input.options, lanes, {{level.isa, lanes}, false});
        const Runs general = run(p.model, input.options, 1, {{level.isa, 1}, true});
        const SimulationOutcome& a = fixed.cases.back().outcome;
        const SimulationOutcome& b = general.cases.back().outcome;
        EXPECT_EQ(a.cause, Cause::ok) << a.message;
        EXPECT_TRUE(same_bits(a.final_state.q, b.final_state.q)) << s.file << lanes;
        EXPECT_TRUE(same_bits(a.final_state.v, b.final_state.v)) << s.file << lanes;
        EXPECT_TRUE(same_bits(a.final_state.z, b.final_state.z)) << s.file << lanes;
        EXPECT_EQ(a.contacts, b.contacts);
        EXPECT_EQ(a.drift_max, b.drift_max);
        EXPECT_EQ(a.energy_residual_max, b.energy_residual_max);
        EXPECT_TRUE(same_bits(fixed.observers.back().series[0].values,
                              general.observers.back().series[0].values));
      }
    }
  }
}

// A crank of next to no mass: the rows of the closure differ by many powers of ten, and the quick
// factor refuses them.
TEST(FixedKernels, Where_rows_are_nearly_dependent_the_general_step_loop_takes_over) {
  add_once();
  ModelInput input = read_config("rsrrp.toml", {"closure.S.model=cut"});
  for (Link& link : input.linkage.links) {
    if (link.name != "crank") continue;
    link.mass *= 1e-12;
    link.inertia *= 1e-12;
  }
  input.options.end_time = 0.01;
  const Model model = compile(input.linkage);
  const SimdLevel level = testing::simd_levels().back();
  ASSERT_NE(find_kernel(model.mechanism, level.isa, level.lanes).serves, nullptr);
  EXPECT_TRUE(is_abandoned(find_kernel(model.mechanism, level.isa, 1), model));
  const Runs fixed = run(model, input.options, level.lanes, {level, false});
  const Runs general = run(model, input.options, 1, {{level.isa, 1}, true});
  const SimulationOutcome& b = general.cases[0].outcome;
  for (const BatchCase& c : fixed.cases) {
    EXPECT_EQ(c.outcome.cause, b.cause);
    EXPECT_EQ(c.outcome.steps, b.steps);
    EXPECT_TRUE(same_bits(c.outcome.final_state.q, b.final_state.q));
  }
}

TEST(FixedStructure, The_source_text_lists_every_member) {
  const Mechanism m = compile(read_config("rsrrp.toml", {}).linkage).mechanism;
  const std::string text = write_fixed_structure(m, "sample");
  EXPECT_NE(text.find("struct sample {"), std::string::npos);
  for (const char* member :
       {"bodies", "stages", "v_parent", "velocities", "ball_q", "closures", "cut_rows", "sde_rows",
        "support", "loads", "joint_springs", "clearances", "contacts", "frictions", "projects"}) {
    EXPECT_NE(text.find(member), std::string::npos) << member;
  }
}

}  // namespace linkstudy::fixed_kernels_test
