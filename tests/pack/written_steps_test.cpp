// Steps that the program writes at run time, over every shipped mechanism and its replacement
// joints: the bits of the general step loop, lane by lane.
#include "core/simulation/written_steps.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/simulation/prepare.h"
#include "core/simulation/simulate.h"
#include "tests/mechanisms/repeating_loads.h"
#include "tests/pack/shipped_models.h"
#include "tests/support/same_bits.h"
#include "tests/support/simd_levels.h"

namespace linkstudy::testing::written_steps_test {
namespace {

struct Runs {
  std::vector<Parameters<double>> parameters;
  std::vector<BatchCase> cases;
  std::vector<Observers> observers;
};

// Cases that differ in their masses and in what pulls at them.
Runs run(const Model& model, const SimulationOptions& options, int count, long stride,
         SimdLevel level, Kernels kernels) {
  level.kernels = kernels;
  const StepGrid grid = make_step_grid(options);
  Runs runs;
  const std::vector<Channel> all = list_channels(model.mechanism);
  const auto n = static_cast<std::size_t>(count);
  runs.observers.assign(n, {});
  runs.parameters.assign(n, model.parameters);
  for (std::size_t i = 0; i < n; ++i) {
    const double scale = 1.0 + 1e-3 * static_cast<double>(i);
    for (auto& b : runs.parameters[i].bodies) b.mass *= scale;
    runs.parameters[i].gravity.y += 0.01 * static_cast<double>(i);
    Observers& o = runs.observers[i];
    o.series = {{all, {0, grid.count, stride}, {}}, {{all.back()}, {0, grid.count, 1}, {}}};
    runs.cases.push_back({&runs.parameters[i], &model.start, &o, {}});
  }
  simulate_batch(model.mechanism, options, runs.cases, {}, level);
  return runs;
}

void expect_same(const Runs& a, const Runs& b) {
  for (std::size_t i = 0; i < a.cases.size(); ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    const SimulationOutcome &x = a.cases[i].outcome, &y = b.cases[i].outcome;
    EXPECT_EQ(x.cause, y.cause) << x.message;
    EXPECT_EQ(x.steps, y.steps);
    EXPECT_EQ(x.rejected, y.rejected);
    EXPECT_EQ(x.evaluations, y.evaluations);
    EXPECT_TRUE(same_bits(x.final_state.q, y.final_state.q));
    EXPECT_TRUE(same_bits(x.final_state.v, y.final_state.v));
    EXPECT_TRUE(same_bits(x.final_state.z, y.final_state.z));
    EXPECT_EQ(x.contacts, y.contacts);
    EXPECT_EQ(x.least_contact_steps, y.least_contact_steps);
    EXPECT_EQ(x.drift_max, y.drift_max);
    EXPECT_EQ(x.least_rank, y.least_rank);
    EXPECT_EQ(x.energy_residual_max, y.energy_residual_max);
    EXPECT_EQ(x.step_limit.seconds, y.step_limit.seconds);
    for (std::size_t k = 0; k < a.observers[i].series.size(); ++k) {
      EXPECT_TRUE(same_bits(a.observers[i].series[k].values, b.observers[i].series[k].values));
    }
  }
}

}  // namespace

TEST(WrittenSteps, Of_every_shipped_model_have_the_bits_of_the_general_step_loop) {
  for (const std::string& path : shipped_models()) {
    ModelInput input = read_model(path);
    input.options.end_time = std::min(input.options.end_time, 3e3 * input.options.step);
    const Preparation p = prepare(input.linkage, input.options);
    ASSERT_EQ(p.cause, Cause::ok) << path << p.message;
    for (const SimdLevel& level : simd_levels()) {
      SCOPED_TRACE(path + " " + std::string(name_of(level.isa)));
      const int before = written_report().kernels;
      // One pack and, where two go side by side, two that are not full.
      const int beside = packs_beside(level) * level.lanes - 3;
      // Channels are written with the step, or by evaluations.
      for (const auto& [count, stride] : {std::pair{level.lanes, 3}, {std::max(1, beside), 97}}) {
        expect_same(run(p.model, input.options, count, stride, level, Kernels::written),
                    run(p.model, input.options, count, stride, level, Kernels::general));
      }
      const bool writes = level.isa != InstructionSet::baseline;
      EXPECT_EQ(written_report().kernels > before, writes);
    }
  }
}

// And instants inside adaptive steps, where channels are looked at often and seldom.
TEST(WrittenTrials, Of_every_shipped_model_have_the_bits_of_the_general_loop) {
  for (const std::string& path : shipped_models()) {
    ModelInput input = read_model(path);
    const Preparation p = prepare(input.linkage, input.options);
    ASSERT_EQ(p.cause, Cause::ok) << path << p.message;
    SimulationOptions options = input.options;
    options.integrator = Integrator::adaptive;
    options.relative_tolerance = 1e-6;
    options.absolute_tolerance = 1e-8;
    options.end_time = std::min(options.end_time, 3e3 * options.step);
    options.step = options.end_time / 200;
    options.output_interval = 10 * options.step;
    options.step_limit = 300;
    for (const SimdLevel& level : simd_levels()) {
      SCOPED_TRACE(path + " " + std::string(name_of(level.isa)));
      for (const long stride : {3, 97}) {
        const int cases = level.lanes + 1;
        const Runs general = run(p.model, options, cases, stride, level, Kernels::general);
        expect_same(run(p.model, options, cases, stride, level, Kernels::written), general);
        expect_same(run(p.model, options, cases, stride, {level.isa, 1}, Kernels::written),
                    general);
      }
    }
  }
  EXPECT_EQ(written_report().untraceable, 0) << written_report().why;
}

TEST(WrittenSteps, Of_cut_and_replacement_joints_have_them_over_ten_thousand_steps) {
  if (!machine_has(InstructionSet::avx2)) GTEST_SKIP() << "no fused instructions here";
  const SimdLevel level{InstructionSet::avx2, 4};
  constexpr int cases = 5;  // a pack and the first of the next
  int seen = 0;
  for (const std::string& path : shipped_models()) {
    for (const ClosureModel closures : {ClosureModel::cut, ClosureModel::sde}) {
      ModelInput input = read_model(path);
      const bool changes = set_closures(closures, input.linkage);
      if (closures == ClosureModel::sde && !changes) continue;
      SCOPED_TRACE(path + (closures == ClosureModel::cut ? " cut" : " sde"));
      input.options.end_time = 1e4 * input.options.step;
      const Preparation p = prepare(input.linkage, input.options);
      ASSERT_EQ(p.cause, Cause::ok) << p.message;
      expect_same(run(p.model, input.options, cases, 100, level, Kernels::written),
                  run(p.model, input.options, cases, 100, level, Kernels::general));
      ++seen;
    }
  }
  EXPECT_GE(seen, 30);
  EXPECT_EQ(written_report().untraceable, 0) << written_report().why;
}

// Lanes that differ in their position find their part of a table one by one.
TEST(WrittenSteps, Of_loads_that_repeat_and_go_over_a_coordinate_have_them) {
  if (!machine_has(InstructionSet::avx2)) GTEST_SKIP() << "no fused instructions here";
  const SimdLevel level{InstructionSet::avx2, 4};
  for (const ClosureModel closures : {ClosureModel::cut, ClosureModel::sde}) {
    ModelInput input = read_model(source_file("configs/mechanisms/rsrrp.toml"));
    set_closures(closures, input.linkage);
    add_repeating_loads("A", "coupler", 2.0, input.linkage);
    input.options.end_time = 1e4 * input.options.step;
    const Preparation p = prepare(input.linkage, input.options);
    ASSERT_EQ(p.cause, Cause::ok) << p.message;
    expect_same(run(p.model, input.options, 5, 7, level, Kernels::written),
                run(p.model, input.options, 5, 7, level, Kernels::general));
  }
  EXPECT_EQ(written_report().untraceable, 0) << written_report().why;
}

// One-sided springs, tables and actuators, on lanes that are slack beside lanes that are taut.
TEST(WrittenSteps, Of_springs_between_points_have_them_while_they_come_and_go) {
  if (!machine_has(InstructionSet::avx2)) GTEST_SKIP() << "no fused instructions here";
  const SimdLevel level{InstructionSet::avx2, 4};
  for (const ClosureModel closures : {ClosureModel::cut, ClosureModel::sde}) {
    ModelInput input = read_model(source_file("configs/mechanisms/rsrrp.toml"));
    set_closures(closures, input.linkage);
    const auto spring = [&](const char* name, const Eigen::Vector3d& first, const char* link) {
      PointSpring one;
      one.name = name;
      one.first = {kGround, first};
      one.second = {link, {0.01, 0.09, 0.02}};
      return one;
    };
    PointSpring rope = spring("rope", {0.1, 0.1, 0.0}, "crank");
    rope.acts = SpringActs::tension;
    rope.stiffness = 400.0;
    rope.damping = 20.0;
    rope.free_length = 0.12;
    PointSpring table = spring("table", {0.0, -0.1, 0.3}, "coupler");
    table.acts = SpringActs::compression;
    table.force = ForceCurve{{0.1, 0.3, 0.35, 0.6}, {-90.0, -10.0, 5.0, 20.0}};
    PointSpring cylinder = spring("cylinder", {0.3, 0.0, 0.2}, "crank");
    cylinder.course = Course{CourseShape::table, 0.0, 0.0, {0.0, 0.2, 0.5}, {0.0, 30.0, -20.0}};
    input.linkage.springs = {rope, table, cylinder};
    input.options.end_time = 1e4 * input.options.step;
    const Preparation p = prepare(input.linkage, input.options);
    ASSERT_EQ(p.cause, Cause::ok) << p.message;
    const Runs general = run(p.model, input.options, 5, 7, level, Kernels::general);
    expect_same(run(p.model, input.options, 5, 7, level, Kernels::written), general);
    const Series& kept = general.observers[0].series[0];
    std::size_t column = 0;
    while (kept.channels[column].name != "spring.rope.force") ++column;
    int slack = 0, taut = 0;
    for (std::size_t row = 0; row < kept.rows(); ++row) {
      ++(kept.values[row * kept.channels.size() + column] > 0.0 ? taut : slack);
    }
    EXPECT_GT(slack, 10);
    EXPECT_GT(taut, 5);
  }
  EXPECT_EQ(written_report().untraceable, 0) << written_report().why;
}

// A crank of next to no mass: the rows of the closure differ by many powers of ten, and the quick
// factor refuses them.
TEST(WrittenSteps, Give_way_to_the_general_loop_where_rows_are_nearly_dependent) {
  if (!machine_has(InstructionSet::avx2)) GTEST_SKIP() << "no fused instructions here";
  ModelInput input = read_model(source_file("configs/mechanisms/rsrrp.toml"));
  set_closures(ClosureModel::cut, input.linkage);
  for (Link& link : input.linkage.links) {
    if (link.name != "crank") continue;
    link.mass *= 1e-12;
    link.inertia *= 1e-12;
  }
  input.options.end_time = 0.01;
  const Model model = compile(input.linkage);
  const SimdLevel level{InstructionSet::avx2, 4};
  expect_same(run(model, input.options, level.lanes, 1, level, Kernels::written),
              run(model, input.options, level.lanes, 1, level, Kernels::general));
}

}  // namespace linkstudy::testing::written_steps_test
