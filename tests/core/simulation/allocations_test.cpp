// The step loop allocates nothing: every operator new of this executable is counted.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "tests/mechanisms/four_bar.h"
#include "tests/mechanisms/rsup.h"
#include "tests/support/engine_probe.h"

namespace {
long allocations = 0;

void* counted(std::size_t size) {
  ++allocations;
  if (void* p = std::malloc(size > 0 ? size : 1)) return p;
  throw std::bad_alloc();
}
}  // namespace

void* operator new(std::size_t size) {
  return counted(size);
}
void* operator new[](std::size_t size) {
  return counted(size);
}
// What std::stable_sort takes; without it another library's would meet the delete below.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(size > 0 ? size : 1);
}
// Packs are wider than what malloc aligns to.
void* operator new(std::size_t size, std::align_val_t alignment) {
  ++allocations;
  const auto wide = static_cast<std::size_t>(alignment);
  if (void* p = std::aligned_alloc(wide, (size + wide - 1) / wide * wide)) return p;
  throw std::bad_alloc();
}
void operator delete(void* p, std::align_val_t) noexcept {
  std::free(p);
}
void operator delete(void* p, std::size_t, std::align_val_t) noexcept {
  std::free(p);
}
void operator delete(void* p) noexcept {
  std::free(p);
}
void operator delete[](void* p) noexcept {
  std::free(p);
}
void operator delete(void* p, std::size_t) noexcept {
  std::free(p);
}
void operator delete[](void* p, std::size_t) noexcept {
  std::free(p);
}

namespace linkstudy::testing::allocations_test {
namespace {

// Everything observers can ask for, sampled at every step.
Observers all_channels(const Model& model, long steps) {
  const std::vector<Channel> all = list_channels(model.mechanism);
  Observers observers;
  observers.series.push_back({all, {0, steps, 1}, {}});
  observers.reductions.push_back({all.back(), {0, steps, 1}, {}});
  return observers;
}

long allocations_of(const Model& model, long steps, const SimdLevel& level) {
  std::vector<Observers> observers(static_cast<std::size_t>(level.lanes),
                                   all_channels(model, steps));
  std::vector<BatchCase> cases;
  for (auto& o : observers) cases.push_back({&model.parameters, &model.start, &o, {}});
  const SimulationOptions options = steps_of(1e-4, 1e-4 * static_cast<double>(steps), 1e-3);
  const long before = allocations;
  simulate_batch(model.mechanism, options, cases, {}, level);
  const long after = allocations;
  EXPECT_EQ(cases.back().outcome.cause, Cause::ok) << cases.back().outcome.message;
  EXPECT_EQ(cases.back().outcome.steps, steps);
  EXPECT_EQ(observers[0].series[0].rows(), static_cast<std::size_t>(steps) + 1);
  return after - before;
}

// Alone and in a full pack of the widest instruction set, by the general loop and by steps that the
// first run has written.
void expect_no_more_with_ten_times_the_steps(const Model& model, const std::string& name) {
  for (const char* lanes : {"1", ""}) {
    for (const Kernels kernels : {Kernels::general, Kernels::written}) {
      SimdLevel level = choose_simd_level(nullptr, lanes);
      level.kernels = kernels;
      allocations_of(model, 200, level);
      const long few = allocations_of(model, 200, level);
      EXPECT_GT(few, 0) << "setting up allocates";
      EXPECT_EQ(allocations_of(model, 2000, level), few) << name << ' ' << name_of(kernels);
    }
  }
}

// Of adaptive runs to a tolerance that asks for so many steps, with contacts listed.
long allocations_of_adaptive(const Model& model, double end_time, const SimdLevel& level) {
  std::vector<Observers> observers(static_cast<std::size_t>(2 * level.lanes));
  for (Observers& o : observers) {
    o.reductions.push_back({list_channels(model.mechanism).back(), {0, 1000, 1}, {}});
    o.contacts.most = 50;
  }
  std::vector<BatchCase> cases;
  for (auto& o : observers) cases.push_back({&model.parameters, &model.start, &o, {}});
  SimulationOptions options = adaptive_steps_of(1e-3 * end_time, end_time, 1e-8);
  const long before = allocations;
  simulate_batch(model.mechanism, options, cases, {}, level);
  const long after = allocations;
  EXPECT_EQ(cases.back().outcome.cause, Cause::ok) << cases.back().outcome.message;
  return after - before;
}

}  // namespace

TEST(Allocations, The_counter_counts) {
  const long before = allocations;
  const std::vector<double> x(10000, 1.0);
  EXPECT_EQ(x.back(), 1.0);
  EXPECT_EQ(allocations, before + 1);
}

TEST(Allocations, Ten_times_the_steps_allocate_no_more) {
  Linkage replaced = rsrrp(), projected = rsrrp();
  replaced.closures[0].model = ClosureModel::sde;
  projected.closures[0].stabilization = Stabilization::projection;
  for (Linkage linkage : {rsrrp(), replaced, projected, four_bar()}) {
    linkage.points = {{"tip", linkage.links.back().name, Eigen::Vector3d::Ones()}};
    const Model model = compile(linkage);
    expect_no_more_with_ten_times_the_steps(model, linkage.name);
  }
}

TEST(Allocations, Ten_times_the_adaptive_steps_allocate_no_more) {
  Linkage projected = rsrrp();
  projected.closures[0].stabilization = Stabilization::projection;
  for (const Linkage& linkage : {rsrrp(), projected, rsup({.clearance = ClearanceKind::planar})}) {
    const Model model = compile(linkage);
    for (const char* lanes : {"1", ""}) {
      for (const Kernels kernels : {Kernels::general, Kernels::written}) {
        SimdLevel level = choose_simd_level(nullptr, lanes);
        level.kernels = kernels;
        allocations_of_adaptive(model, 0.05, level);
        const long few = allocations_of_adaptive(model, 0.05, level);
        EXPECT_GT(few, 0);
        EXPECT_EQ(allocations_of_adaptive(model, 0.5, level), few)
            << linkage.name << ' ' << name_of(kernels) << ' ' << level.lanes;
      }
    }
  }
}

TEST(Allocations, Sharing_redundant_reactions_allocates_no_more_with_ten_times_the_steps) {
  SimulationOptions options;
  options.redundant_reactions = RedundantReactions::loops;
  Linkage rubbing = four_bar();
  rubbing.joints[0].friction.emplace();
  rubbing.joints[0].friction->law = {.mu_s = 0.1, .mu_k = 0.1, .sigma0 = 200.0};
  rubbing.joints[0].friction->radius = 0.01;
  for (const Linkage& linkage : {four_bar(), rubbing}) {
    const Model model = prepare(linkage, options).model;
    EXPECT_FALSE(model.mechanism.loop_joints.empty());
    expect_no_more_with_ten_times_the_steps(model, linkage.name);
  }
}

}  // namespace linkstudy::testing::allocations_test
