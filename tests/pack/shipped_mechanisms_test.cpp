// Written steps of every mechanism that is shipped, and of its replacement joints, against the
// general loop: whole runs of ten thousand steps to the bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "core/simulation/prepare.h"
#include "core/simulation/written_steps.h"
#include "study/config/model_document.h"
#include "tests/support/same_bits.h"
#include "tests/support/source_file.h"

namespace linkstudy::testing::shipped_mechanisms_test {
namespace {

constexpr int kCases = 5;  // a pack and the first of the next
constexpr double kSteps = 1e4;

ModelInput read_mechanism(const std::string& file, ClosureModel closures) {
  Diagnostics diagnostics;
  const auto document = ModelDocument::load(file, diagnostics);
  ModelInput input = *document->with({}, diagnostics);
  EXPECT_TRUE(diagnostics.empty()) << file;
  for (Closure& c : input.linkage.closures)
    if (c.model != ClosureModel::clearance) c.model = closures;
  return input;
}

struct Runs {
  std::vector<Parameters<double>> parameters;
  std::vector<Observers> observers;
  std::vector<BatchCase> cases;
};

// Every case under a pull of its own; all channels are looked at now and then, forces always.
Runs run(const Model& model, const SimulationOptions& options, const SimdLevel& level) {
  const StepGrid grid = make_step_grid(options);
  const std::vector<Channel> all = list_channels(model.mechanism);
  Runs runs;
  runs.parameters.assign(kCases, model.parameters);
  runs.observers.resize(kCases);
  for (std::size_t i = 0; i < kCases; ++i) {
    runs.parameters[i].gravity.y += 0.01 * static_cast<double>(i);
    runs.observers[i].series = {{all, {0, grid.count, 100}, {}},
                                {{all.back()}, {0, grid.count, 1}, {}}};
    runs.cases.push_back({&runs.parameters[i], &model.start, &runs.observers[i], {}});
  }
  simulate_batch(model.mechanism, options, runs.cases, {}, level);
  return runs;
}

void expect_same(const Runs& written, const Runs& general) {
  for (std::size_t i = 0; i < kCases; ++i) {
    const SimulationOutcome& a = written.cases[i].outcome;
    const SimulationOutcome& b = general.cases[i].outcome;
    EXPECT_EQ(a.cause, b.cause) << a.message;
    EXPECT_EQ(a.steps, b.steps);
    EXPECT_TRUE(same_bits(a.final_state.q, b.final_state.q));
    EXPECT_TRUE(same_bits(a.final_state.v, b.final_state.v));
    EXPECT_TRUE(same_bits(a.final_state.z, b.final_state.z));
    EXPECT_EQ(a.contacts, b.contacts);
    EXPECT_EQ(a.drift_max, b.drift_max);
    EXPECT_EQ(a.energy_residual_max, b.energy_residual_max);
    for (const std::size_t k : {0u, 1u}) {
      EXPECT_TRUE(
          same_bits(written.observers[i].series[k].values, general.observers[i].series[k].values));
    }
  }
}

}  // namespace

TEST(ShippedMechanisms, Written_steps_have_the_bits_of_the_general_loop) {
  if (!machine_has(InstructionSet::avx2)) GTEST_SKIP() << "no fused instructions here";
  int seen = 0;
  for (const auto& entry : std::filesystem::directory_iterator(source_file("configs/mechanisms"))) {
    for (const ClosureModel closures : {ClosureModel::cut, ClosureModel::sde}) {
      ModelInput input = read_mechanism(entry.path(), closures);
      SCOPED_TRACE(entry.path().filename().string() +
                   (closures == ClosureModel::cut ? " cut" : " sde"));
      const bool changes =
          std::any_of(input.linkage.closures.begin(), input.linkage.closures.end(),
                      [](const Closure& c) { return c.model != ClosureModel::clearance; });
      if (input.options.integrator != Integrator::rk4) continue;
      if (closures == ClosureModel::sde && !changes) continue;
      input.options.end_time = kSteps * input.options.step;
      const Preparation p = prepare(input.linkage, input.options);
      ASSERT_EQ(p.cause, Cause::ok) << p.message;
      const int before = written_report().kernels;
      const Runs written = run(p.model, input.options, {InstructionSet::avx2, 4, Kernels::written});
      EXPECT_GT(written_report().kernels, before);
      expect_same(written,
                  run(p.model, input.options, {InstructionSet::avx2, 4, Kernels::general}));
      ++seen;
    }
  }
  EXPECT_GE(seen, 30);
  EXPECT_EQ(written_report().untraceable, 0) << written_report().why;
}

// A crank of next to no mass: the rows of the closure differ by many powers of ten, and the quick
// factor refuses them.
TEST(ShippedMechanisms, Where_rows_are_nearly_dependent_the_general_loop_takes_over) {
  if (!machine_has(InstructionSet::avx2)) GTEST_SKIP() << "no fused instructions here";
  ModelInput input =
      read_mechanism(source_file("configs/mechanisms/rsrrp.toml"), ClosureModel::cut);
  for (Link& link : input.linkage.links) {
    if (link.name != "crank") continue;
    link.mass *= 1e-12;
    link.inertia *= 1e-12;
  }
  input.options.end_time = 0.01;
  const Model model = compile(input.linkage);
  expect_same(run(model, input.options, {InstructionSet::avx2, 4, Kernels::written}),
              run(model, input.options, {InstructionSet::avx2, 4, Kernels::general}));
}

}  // namespace linkstudy::testing::shipped_mechanisms_test
