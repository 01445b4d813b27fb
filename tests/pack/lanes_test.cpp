// Runs in lanes against runs alone: to the last bit, whatever the neighbours do.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>

#include "core/simulation/written_steps.h"
#include "tests/mechanisms/bushing.h"
#include "tests/mechanisms/journal_in_bearing.h"
#include "tests/mechanisms/n_four_bar.h"
#include "tests/mechanisms/pendulum.h"
#include "tests/mechanisms/random_linkages.h"
#include "tests/mechanisms/repeating_loads.h"
#include "tests/mechanisms/rsrrp.h"
#include "tests/support/engine_probe.h"
#include "tests/support/same_bits.h"
#include "tests/support/simd_levels.h"

namespace linkstudy::testing::lanes_test {
namespace {

// A case and everything that its run left.
struct Case {
  Model model;
  Observers observers;
  SimulationOutcome outcome;
};

Observers watch_everything(const Model& model, long steps) {
  const std::vector<Channel> all = list_channels(model.mechanism);
  Observers o;
  o.series.push_back({all, {0, steps, 7}, {}});
  o.reductions.push_back({all.back(), {1, steps, 2}, {}});
  o.reductions.back().place = {all[1]};
  o.contacts.most = 20;
  return o;
}

// Same structure, other numbers: masses, stiffness and speeds of case i.
Case make_case(const Linkage& linkage, int i, long steps) {
  Linkage changed = linkage;
  const double factor = 1.0 + 0.03 * i;
  for (Link& link : changed.links) {
    link.mass *= factor;
    link.inertia *= factor;
  }
  for (Closure& c : changed.closures) {
    for (double& x : c.sde.stiffness) x *= 1.0 + 0.1 * i;
    if (c.model != ClosureModel::clearance) continue;
    // Each lane meets its bearing at another step.
    for (double& x : changed.joints[0].velocity) x *= 1.0 + 0.07 * i;
    c.clearance.radial *= 1.0 - 0.02 * i;
  }
  changed.points = {{"tip", changed.links.back().name, factor * Eigen::Vector3d::Ones()}};
  Case made{compile(changed), {}, {}};
  made.observers = watch_everything(made.model, steps);
  return made;
}

std::vector<Case> make_cases(const Linkage& linkage, int count, long steps) {
  std::vector<Case> cases;
  for (int i = 0; i < count; ++i) cases.push_back(make_case(linkage, i, steps));
  return cases;
}

void run_cases(std::vector<Case>& cases, const SimulationOptions& options, SimdLevel level) {
  std::vector<BatchCase> batch;
  for (Case& c : cases) batch.push_back({&c.model.parameters, &c.model.start, &c.observers, {}});
  if (level.kernels != Kernels::written) level.kernels = Kernels::general;
  simulate_batch(cases.front().model.mechanism, options, batch, {}, level);
  for (std::size_t i = 0; i < cases.size(); ++i) cases[i].outcome = batch[i].outcome;
}

bool same_contacts(const ContactList& a, const ContactList& b) {
  const auto same = [](const ContactRecord& x, const ContactRecord& y) {
    return x.contact == y.contact &&
           same_bits({x.begin, x.end, x.approach, x.separation, x.force, x.depth},
                     {y.begin, y.end, y.approach, y.separation, y.force, y.depth});
  };
  return a.unlisted == b.unlisted && std::ranges::equal(a.records, b.records, same);
}

::testing::AssertionResult same_run(const Case& a, const Case& b) {
  const auto differ = [](const char* what) { return ::testing::AssertionFailure() << what; };
  if (a.outcome.cause != b.outcome.cause) return differ("cause");
  if (a.outcome.steps != b.outcome.steps) return differ("steps");
  if (a.outcome.message != b.outcome.message) return differ("message");
  if (!same_bits(a.outcome.final_state.q, b.outcome.final_state.q)) return differ("positions");
  if (!same_bits(a.outcome.final_state.v, b.outcome.final_state.v)) return differ("velocities");
  if (!same_bits(a.outcome.final_state.z, b.outcome.final_state.z)) return differ("bristles");
  if (a.outcome.contacts != b.outcome.contacts) return differ("contacts");
  if (a.outcome.least_contact_steps != b.outcome.least_contact_steps)
    return differ("contact steps");
  if (!same_bits({a.outcome.drift_max, a.outcome.energy_residual_max, a.outcome.energy_scale},
                 {b.outcome.drift_max, b.outcome.energy_residual_max, b.outcome.energy_scale})) {
    return differ("drift or energy");
  }
  const StepLimit &l = a.outcome.step_limit, &m = b.outcome.step_limit;
  if (!same_bits({l.seconds, l.omega_max, l.t}, {m.seconds, m.omega_max, m.t})) {
    return differ("step limit");
  }
  if (!same_bits(a.observers.series[0].values, b.observers.series[0].values))
    return differ("series");
  const auto& r = a.observers.reductions[0];
  const auto& s = b.observers.reductions[0];
  if (!same_bits({r.min, r.max, r.sum, r.square, r.last},
                 {s.min, s.max, s.sum, s.square, s.last})) {
    return differ("reduction");
  }
  if (r.min_step != s.min_step || r.max_step != s.max_step ||
      !same_bits({r.min_place, r.max_place}, {s.min_place, s.max_place})) {
    return differ("place of an extreme");
  }
  if (!same_contacts(a.observers.contacts, b.observers.contacts)) return differ("list of contacts");
  return ::testing::AssertionSuccess();
}

// Contacts, friction and springs in joints. The contacts are soft enough for the steps.
std::vector<Linkage> loose_linkages() {
  std::vector<Linkage> all;
  for (const ClearanceKind kind : {ClearanceKind::planar, ClearanceKind::spatial}) {
    JournalInBearing j;
    j.kind = kind;
    j.velocity = {0.6, 0.2, 0.0};
    j.turning = {kind == ClearanceKind::spatial ? 8.0 : 0.0, 0.0, 30.0};
    Clearance c = loose_bearing();
    c.stiffness = 1e7;
    c.friction = table_1_friction();
    for (const FreeBristle rule : {FreeBristle::reset, FreeBristle::relax, FreeBristle::hold}) {
      c.free_bristle = rule;
      all.push_back(journal_in_bearing(j, c));
    }
    c.exponent = 1.4;
    c.stiffness = 3e6;
    all.push_back(journal_in_bearing(j, c));
    c.approach = ApproachSpeed::greatest;
    c.points = ContactPoints::two;
    all.push_back(journal_in_bearing(j, c));
  }
  Linkage rubbing = rsrrp();
  for (Joint& joint : rubbing.joints) {
    joint.friction = JointFriction{table_1_friction(), FrictionLoad::reaction, 0.01, 0.05, 3.0};
    joint.stiffness = {2.0};
    joint.damping = {0.1};
    joint.velocity = {0.0};
  }
  all.push_back(rubbing);
  return all;
}

// All kinds of joints, closures and loads that there are.
std::vector<Linkage> linkages() {
  std::vector<Linkage> all = {rsrrp(), rsrrp_revolute(), n_four_bar(2)};
  Linkage replaced = rsrrp();
  replaced.closures[0].model = ClosureModel::sde;
  all.push_back(replaced);
  for (std::uint64_t seed = 0; seed < 6; ++seed) all.push_back(random_tree(seed));
  Linkage repeating = rsrrp();
  add_repeating_loads("A", "coupler", 2.0, repeating);
  all.push_back(repeating);
  for (const JointType type :
       {JointType::spherical, JointType::revolute, JointType::universal, JointType::prismatic,
        JointType::cylindrical, JointType::planar, JointType::fixed}) {
    Linkage cut = random_closed_linkage(3, type, ClosureModel::cut);
    for (const auto s :
         {Stabilization::none, Stabilization::baumgarte, Stabilization::projection}) {
      cut.closures[0].stabilization = s;
      all.push_back(cut);
    }
    all.push_back(random_closed_linkage(4, type, ClosureModel::sde));
  }
  for (const Linkage& loose : loose_linkages()) all.push_back(loose);
  // Lanes find their rotation vectors by different entries of the quaternion.
  for (const Eigen::Vector3d& turn : {Eigen::Vector3d(0.9, -1.1, 0.4), {0, 2.8, 0.3}, {0, 0, 0}}) {
    all.push_back(bushing(
        {.stiffness = {3, 8, 20}, .damping = {0.1, 0, 0.2}, .turn = turn, .rate = {40, -30, 50}}));
  }
  return all;
}

SimulationOptions short_run(long steps) {
  return steps_of(1e-4, 1e-4 * static_cast<double>(steps), 1e-3);
}

}  // namespace

TEST(Lanes, A_case_in_a_pack_has_the_bits_of_its_own_run) {
  constexpr long steps = 60;
  const std::vector<Linkage> all = linkages();
  for (const SimdLevel& level : step_loops()) {
    for (std::size_t n = 0; n < all.size(); ++n) {
      const int count = level.lanes + 2;  // a full pack and a part of one
      std::vector<Case> packed = make_cases(all[n], count, steps);
      std::vector<Case> alone = make_cases(all[n], count, steps);
      run_cases(packed, short_run(steps), level);
      run_cases(alone, short_run(steps), {level.isa, 1});
      for (std::size_t i = 0; i < packed.size(); ++i) {
        EXPECT_EQ(packed[i].outcome.cause, Cause::ok) << packed[i].outcome.message;
        EXPECT_TRUE(same_run(packed[i], alone[i]))
            << name_of(level.isa) << ", linkage " << n << ", case " << i;
      }
    }
  }
}

TEST(Lanes, Written_steps_of_fifty_random_linkages_have_the_bits_of_the_general_loop) {
  if (!machine_has(InstructionSet::avx2)) GTEST_SKIP() << "no fused instructions here";
  constexpr long steps = 300;
  const std::array closures = {JointType::spherical,   JointType::universal, JointType::prismatic,
                               JointType::cylindrical, JointType::planar,    JointType::revolute,
                               JointType::fixed};
  for (std::uint64_t seed = 10; seed < 60; ++seed) {
    const JointType type = closures[seed % closures.size()];
    const Linkage linkage = seed % 3 == 0   ? random_tree(seed)
                            : seed % 3 == 1 ? random_closed_linkage(seed, type, ClosureModel::cut)
                                            : random_closed_linkage(seed, type, ClosureModel::sde);
    std::vector<Case> written = make_cases(linkage, 4, steps);
    std::vector<Case> general = make_cases(linkage, 4, steps);
    const int before = written_report().kernels;
    run_cases(written, short_run(steps), {InstructionSet::avx2, 4, Kernels::written});
    run_cases(general, short_run(steps), {InstructionSet::avx2, 4, Kernels::general});
    EXPECT_EQ(written_report().kernels, before + 1) << seed;
    for (std::size_t i = 0; i < written.size(); ++i) {
      EXPECT_EQ(general[i].outcome.steps, steps);
      EXPECT_TRUE(same_run(written[i], general[i])) << seed << " lane " << i;
    }
  }
}

// What was 0 or 1 in the first pack may be any number in the next.
TEST(Lanes, Written_steps_hold_for_no_more_than_what_they_were_written_for) {
  if (!machine_has(InstructionSet::avx2)) GTEST_SKIP() << "no fused instructions here";
  constexpr long steps = 40;
  const auto run_with = [&](double aside, double pull, Kernels kernels) {
    std::vector<Case> cases = make_cases(rsrrp(), 4, steps);
    for (Case& c : cases) {
      c.model.parameters.gravity.z += aside;
      c.model.parameters.gravity.x += pull;
    }
    run_cases(cases, short_run(steps), {InstructionSet::avx2, 4, kernels});
    return cases;
  };
  int written = written_report().kernels;
  const auto expect = [&](double aside, double pull, int more) {
    const std::vector<Case> a = run_with(aside, pull, Kernels::written);
    const std::vector<Case> b = run_with(aside, pull, Kernels::general);
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_TRUE(same_run(a[i], b[i])) << aside << pull;
    EXPECT_EQ(written_report().kernels, written + more) << aside << ' ' << pull;
    written = written_report().kernels;
  };
  expect(0.0, 0.0, 1);
  expect(0.0, 0.0, 0);
  expect(1e-4, 0.0, 1);
  expect(0.0, 0.0, 0);
  expect(1e-4, 0.3, 1);  // fits all from now on
  expect(0.0, 0.3, 0);
}

TEST(Lanes, Sets_with_fused_instructions_agree_on_every_bit_of_the_whole_rsrrp_run) {
  if (!machine_has(InstructionSet::avx512)) GTEST_SKIP() << "no AVX-512 here";
  for (const ClosureModel model : {ClosureModel::sde, ClosureModel::cut}) {
    const Linkage linkage = rsrrp_test_vector(model);
    const SimulationOptions options = steps_of(1e-4, 15.0, 1e-2);
    std::vector<Case> eight = make_cases(linkage, 8, 150000);
    std::vector<Case> four = make_cases(linkage, 4, 150000);
    std::vector<Case> one = make_cases(linkage, 1, 150000);
    run_cases(eight, options, {InstructionSet::avx512, 8});
    run_cases(four, options, {InstructionSet::avx2, 4});
    run_cases(one, options, {InstructionSet::avx2, 1});
    ASSERT_EQ(one[0].outcome.steps, 150000);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_TRUE(same_run(eight[i], four[i])) << i;
    EXPECT_TRUE(same_run(eight[0], one[0]));
  }
}

TEST(Lanes, Baseline_agrees_with_the_fused_sets_to_rounding) {
  if (!machine_has(InstructionSet::avx2)) GTEST_SKIP() << "no fused instructions here";
  std::vector<Case> fused = make_cases(rsrrp(), 2, 10000);
  std::vector<Case> rounded = make_cases(rsrrp(), 2, 10000);
  run_cases(fused, steps_of(1e-4, 1.0, 1e-2), {InstructionSet::avx2, 4});
  run_cases(rounded, steps_of(1e-4, 1.0, 1e-2), {InstructionSet::baseline, 2});
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_NEAR(fused[i].outcome.final_state.q[PositionIndex(k)],
                  rounded[i].outcome.final_state.q[PositionIndex(k)], 1e-10);
    }
  }
}

TEST(Lanes, Neither_order_nor_neighbours_change_a_bit) {
  constexpr long steps = 200;
  for (const SimdLevel& level : step_loops()) {
    for (const ClosureModel model : {ClosureModel::sde, ClosureModel::cut}) {
      const Linkage linkage = rsrrp_test_vector(model);
      std::vector<Case> there = make_cases(linkage, level.lanes, steps);
      std::vector<Case> back = make_cases(linkage, level.lanes, steps);
      std::reverse(back.begin(), back.end());
      std::vector<Case> odd = make_cases(linkage, level.lanes, steps);
      for (std::size_t i = 1; i < odd.size(); ++i) {
        const double bad = i % 2 == 0 ? 1e300 : std::numeric_limits<double>::quiet_NaN();
        odd[i].model.parameters.bodies[BodyIndex(1)].mass = bad;
        odd[i].model.start.v[VelocityIndex(0)] = bad;
      }
      run_cases(there, short_run(steps), level);
      run_cases(back, short_run(steps), level);
      run_cases(odd, short_run(steps), level);
      for (std::size_t i = 0; i < there.size(); ++i) {
        EXPECT_TRUE(same_run(there[i], back[there.size() - 1 - i]));
      }
      EXPECT_TRUE(same_run(there[0], odd[0]));
      for (std::size_t i = 1; i < odd.size(); ++i) {
        EXPECT_EQ(odd[i].outcome.cause, Cause::diverged);
        EXPECT_EQ(odd[i].outcome.steps, 0);
      }
    }
  }
}

TEST(Lanes, A_lane_that_diverges_ends_as_it_would_alone_and_leaves_the_others) {
  Linkage linkage = rsrrp();
  linkage.closures[0].model = ClosureModel::sde;
  constexpr long steps = 3000;
  for (const SimdLevel& level : step_loops()) {
    const auto make = [&] {
      std::vector<Case> cases = make_cases(linkage, std::max(level.lanes, 2), steps);
      for (auto& s : cases[1].model.parameters.springs) s.stiffness = 1e9;  // far past the limit
      cases[1].model.start.q[PositionIndex(0)] += 1e-6;
      return cases;
    };
    std::vector<Case> packed = make(), alone = make();
    run_cases(packed, short_run(steps), level);
    run_cases(alone, short_run(steps), {level.isa, 1});
    EXPECT_NE(packed[1].outcome.cause, Cause::ok);
    EXPECT_GT(packed[1].outcome.steps, 0);
    EXPECT_LT(packed[1].outcome.steps, steps);
    for (std::size_t i = 0; i < packed.size(); ++i) {
      EXPECT_TRUE(same_run(packed[i], alone[i])) << name_of(level.isa) << " lane " << i;
      if (i != 1) {
        EXPECT_EQ(packed[i].outcome.cause, Cause::ok);
      }
    }
  }
}

// A pack that has ended goes along with the one beside it.
TEST(Lanes, Packs_side_by_side_end_each_for_itself) {
  if (!machine_has(InstructionSet::avx512)) GTEST_SKIP() << "no AVX-512 here";
  Linkage linkage = rsrrp();
  linkage.closures[0].model = ClosureModel::sde;
  constexpr long steps = 1500;
  const SimdLevel level{InstructionSet::avx512, 8, Kernels::written};
  ASSERT_EQ(packs_beside(level), 2);
  for (const int lost : {0, 1}) {  // which pack
    const auto make = [&] {
      std::vector<Case> cases = make_cases(linkage, 16, steps);
      for (int i = 8 * lost; i < 8 * (lost + 1); ++i) {
        Case& c = cases[static_cast<std::size_t>(i)];
        for (auto& s : c.model.parameters.springs) s.stiffness = 1e9;
        c.model.start.q[PositionIndex(0)] += 1e-6 * (1 + i);
      }
      return cases;
    };
    std::vector<Case> packed = make(), alone = make();
    run_cases(packed, short_run(steps), level);
    run_cases(alone, short_run(steps), {InstructionSet::avx2, 1});
    for (int i = 0; i < 16; ++i) {
      const auto n = static_cast<std::size_t>(i);
      EXPECT_TRUE(same_run(packed[n], alone[n])) << "pack " << lost << " lost, case " << i;
      EXPECT_EQ(packed[n].outcome.cause == Cause::ok, i / 8 != lost);
    }
  }
}

TEST(Lanes, A_decaying_motion_ends_among_normal_numbers) {
  Linkage linkage = pendulum();
  linkage.gravity.setZero();
  Load brake;
  brake.name = "brake";
  brake.type = LoadType::resistance;
  brake.joint = linkage.joints[0].name;
  brake.law = {ResistanceShape::linear, 1000.0, 1.0};
  linkage.loads = {brake};
  linkage.joints[0].velocity = {1.0};
  const double inertia = EngineProbe(linkage).mass_matrix()(0, 0);
  const double rate = 1000.0 / inertia;  // 1/s
  const SimulationOptions options = steps_of(0.5 / rate, 3000.0 / rate, 100.0 / rate);
  for (const SimdLevel& level : step_loops()) {
    std::vector<Case> cases = make_cases(linkage, level.lanes, 6000);
    run_cases(cases, options, level);
    for (const Case& c : cases) {
      EXPECT_LT(std::fabs(c.outcome.final_state.v[VelocityIndex(0)]),
                1e-306);  // steps too small to tell are lost
    }
    for (double x : cases[0].observers.series[0].values) {
      EXPECT_FALSE(x != 0.0 && std::fabs(x) < std::numeric_limits<double>::min()) << x;
    }
  }
}

}  // namespace linkstudy::testing::lanes_test
