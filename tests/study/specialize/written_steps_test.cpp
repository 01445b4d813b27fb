// Steps that the program writes at run time, over every shipped model: the bits of the general step
// loop, lane by lane.
#include "core/simulation/written_steps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "core/simulation/prepare.h"
#include "core/simulation/simulate.h"
#include "study/config/model_document.h"
#include "tests/support/same_bits.h"
#include "tests/support/simd_levels.h"
#include "tests/support/source_file.h"

namespace linkstudy::written_steps_test {
namespace {

using testing::same_bits;

std::vector<std::string> shipped_models() {
  std::vector<std::string> names;
  for (const auto& entry :
       std::filesystem::directory_iterator(testing::source_file("configs/mechanisms"))) {
    if (entry.path().extension() == ".toml") names.push_back(entry.path().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

ModelInput read_model(const std::string& path) {
  Diagnostics diagnostics;
  const auto document = ModelDocument::load(path, diagnostics);
  return *document->with({}, diagnostics);
}

struct Runs {
  std::vector<Parameters<double>> parameters;
  std::vector<State<double>> starts;
  std::vector<BatchCase> cases;
  std::vector<Observers> observers;
};

// Lanes that differ in their masses and, from the second on, in their speed.
Runs run(const Model& model, const SimulationOptions& options, int count, long stride,
         const StepLoopChoice& choice) {
  const StepGrid grid = make_step_grid(options);
  Runs runs;
  const std::vector<Channel> all = list_channels(model.mechanism);
  const auto n = static_cast<std::size_t>(count);
  runs.observers.assign(n, {});
  runs.parameters.assign(n, model.parameters);
  runs.starts.assign(n, model.start);
  for (std::size_t i = 0; i < n; ++i) {
    const double scale = 1.0 + 1e-3 * static_cast<double>(i);
    for (auto& b : runs.parameters[i].bodies) b.mass *= scale;
    Observers& o = runs.observers[i];
    o.series.push_back({all, {0, grid.count, stride}, {}});
    runs.cases.push_back({&runs.parameters[i], &runs.starts[i], &o, {}});
  }
  simulate_batch(model.mechanism, options, runs.cases, {}, choice);
  return runs;
}

SimdLevel with(SimdLevel level, Kernels kernels) {
  level.kernels = kernels;
  return level;
}

void expect_same(const Runs& a, const Runs& b, const std::string& where) {
  for (std::size_t i = 0; i < a.cases.size(); ++i) {
    const SimulationOutcome &x = a.cases[i].outcome, &y = b.cases[i].outcome;
    EXPECT_EQ(x.cause, y.cause) << where;
    EXPECT_EQ(x.steps, y.steps) << where;
    EXPECT_TRUE(same_bits(x.final_state.q, y.final_state.q)) << where << " lane " << i;
    EXPECT_TRUE(same_bits(x.final_state.v, y.final_state.v)) << where << " lane " << i;
    EXPECT_TRUE(same_bits(x.final_state.z, y.final_state.z)) << where << " lane " << i;
    EXPECT_EQ(x.contacts, y.contacts) << where;
    EXPECT_EQ(x.least_contact_steps, y.least_contact_steps) << where;
    EXPECT_EQ(x.drift_max, y.drift_max) << where;
    EXPECT_EQ(x.least_rank, y.least_rank) << where;
    EXPECT_EQ(x.energy_residual_max, y.energy_residual_max) << where;
    EXPECT_EQ(x.step_limit.seconds, y.step_limit.seconds) << where;
    EXPECT_TRUE(same_bits(a.observers[i].series[0].values, b.observers[i].series[0].values))
        << where << " lane " << i;
  }
}

}  // namespace

TEST(WrittenSteps, Of_every_shipped_model_have_the_bits_of_the_general_step_loop) {
  for (const std::string& path : shipped_models()) {
    ModelInput input = read_model(path);
    input.options.integrator = Integrator::rk4;
    input.options.end_time = std::min(input.options.end_time, 3e3 * input.options.step);
    const Preparation p = prepare(input.linkage, input.options);
    ASSERT_EQ(p.cause, Cause::ok) << path << p.message;
    for (const SimdLevel& level : testing::simd_levels()) {
      const int before = written_report().kernels;
      for (const long stride : {3, 97}) {  // channels written with the step, and by general steps
        const Runs written = run(p.model, input.options, level.lanes, stride,
                                 {with(level, Kernels::written), false});
        const Runs general =
            run(p.model, input.options, level.lanes, stride, {with(level, Kernels::general), true});
        expect_same(written, general, path + " " + std::string(name_of(level.isa)));
      }
      const bool writes = level.isa != InstructionSet::baseline;
      EXPECT_EQ(written_report().kernels > before, writes) << path;
    }
  }
}

}  // namespace linkstudy::written_steps_test
