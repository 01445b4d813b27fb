// Adaptive runs in lanes against the same runs alone: to the last bit, whatever the neighbours do,
// by every step loop of this machine.
#include "core/simulation/located_batch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <ranges>

#include "core/simulation/simulate.h"
#include "tests/mechanisms/bennett.h"
#include "tests/mechanisms/four_bar.h"
#include "tests/mechanisms/journal_in_bearing.h"
#include "tests/mechanisms/loose_slider_crank.h"
#include "tests/mechanisms/n_four_bar.h"
#include "tests/mechanisms/pendulum.h"
#include "tests/mechanisms/random_linkages.h"
#include "tests/mechanisms/repeating_loads.h"
#include "tests/mechanisms/rsup.h"
#include "tests/mechanisms/spatial_slider_crank.h"
#include "tests/support/engine_probe.h"
#include "tests/support/same_bits.h"
#include "tests/support/simd_levels.h"
#include "tests/support/zyx_equivalent.h"

namespace linkstudy::testing::located_batch_test {
namespace {

struct Case {
  Model model;
  Observers observers;
  SimulationOutcome outcome;
};

// All channels now and then, some at every instant, and the contacts.
Observers watch_everything(const Model& model, long instants) {
  const std::vector<Channel> all = list_channels(model.mechanism);
  Observers o;
  o.series.push_back({all, {0, instants, 10}, {}});
  o.series.push_back({{all.front(), all[1]}, {0, instants, 3}, {}});
  o.reductions.push_back({all.back(), {1, instants, 1}, {}});
  o.reductions.back().place = {all[1]};
  o.contacts.most = 20;
  return o;
}

// One structure, other numbers: case i is heavier and faster, its bearings are tighter.
Case make_case(const Linkage& linkage, int i, long instants) {
  Linkage changed = linkage;
  for (Link& link : changed.links) {
    link.mass *= 1.0 + 0.03 * i;
    link.inertia *= 1.0 + 0.03 * i;
  }
  for (Closure& c : changed.closures) {
    for (double& x : c.sde.stiffness) x *= 1.0 + 0.1 * i;
    if (c.model == ClosureModel::clearance) c.clearance.radial *= 1.0 - 0.02 * i;
  }
  for (Load& load : changed.loads) load.course.value *= 1.0 + 0.05 * i;
  Case made{compile(changed), {}, {}};
  made.observers = watch_everything(made.model, instants);
  return made;
}

std::vector<Case> make_cases(const Linkage& linkage, int count, long instants) {
  std::vector<Case> cases;
  for (int i = 0; i < count; ++i) cases.push_back(make_case(linkage, i, instants));
  return cases;
}

void run_cases(std::vector<Case>& cases, const SimulationOptions& options, const SimdLevel& level,
               const RunLimits& limits = {}) {
  std::vector<BatchCase> batch;
  for (Case& c : cases) batch.push_back({&c.model.parameters, &c.model.start, &c.observers, {}});
  simulate_batch(cases.front().model.mechanism, options, batch, limits, level);
  for (std::size_t i = 0; i < cases.size(); ++i) cases[i].outcome = std::move(batch[i].outcome);
}

// Each by itself.
void run_alone(std::vector<Case>& cases, const SimulationOptions& options, SimdLevel level) {
  level.lanes = 1;
  level.kernels = Kernels::general;
  for (Case& c : cases) {
    std::vector<BatchCase> one{{&c.model.parameters, &c.model.start, &c.observers, {}}};
    simulate_batch(c.model.mechanism, options, one, {}, level);
    c.outcome = std::move(one.front().outcome);
  }
}

bool same_record(const ContactRecord& a, const ContactRecord& b) {
  return a.contact == b.contact && a.number == b.number &&
         same_bits({a.begin, a.end, a.approach, a.separation, a.force, a.depth},
                   {b.begin, b.end, b.approach, b.separation, b.force, b.depth});
}

bool same_contacts(const ContactList& a, const ContactList& b) {
  const auto same_hardest = [](const auto& x, const auto& y) {
    return x.has_value() == y.has_value() && (!x || same_record(*x, *y));
  };
  return a.unlisted == b.unlisted && std::ranges::equal(a.records, b.records, same_record) &&
         std::ranges::equal(a.hardest, b.hardest, same_hardest);
}

bool same_reduction(const ChannelReduction& a, const ChannelReduction& b) {
  return a.seen == b.seen && a.min_step == b.min_step && a.max_step == b.max_step &&
         same_bits({a.min, a.max, a.sum, a.square, a.last, a.min_place, a.max_place},
                   {b.min, b.max, b.sum, b.square, b.last, b.min_place, b.max_place});
}

// The first that differs, or nothing.
std::string difference_of_outcomes(const SimulationOutcome& a, const SimulationOutcome& b) {
  if (a.cause != b.cause) return "cause";
  if (a.message != b.message) return "message";
  if (a.steps != b.steps) return "steps";
  if (a.rejected != b.rejected) return "rejected";
  if (a.evaluations != b.evaluations) return "evaluations";
  if (a.contacts != b.contacts) return "contacts";
  if (a.least_contact_steps != b.least_contact_steps) return "steps in contacts";
  if (a.redundant != b.redundant || a.least_rank != b.least_rank) return "rank";
  if (a.greatest_rank != b.greatest_rank) return "greatest rank";
  if (!same_bits({a.end_time, a.drift_max, a.energy_residual_max, a.energy_scale},
                 {b.end_time, b.drift_max, b.energy_residual_max, b.energy_scale})) {
    return "drift or energy";
  }
  const State<double>&x = a.final_state, &y = b.final_state;
  if (!same_bits(x.q, y.q) || !same_bits(x.v, y.v) || !same_bits(x.z, y.z)) return "final state";
  if (!same_bits({x.supplied, x.dissipated, x.dissipated_in_contacts},
                 {y.supplied, y.dissipated, y.dissipated_in_contacts})) {
    return "works";
  }
  return "";
}

std::string difference(const Case& a, const Case& b) {
  const std::string of_outcomes = difference_of_outcomes(a.outcome, b.outcome);
  if (!of_outcomes.empty()) return of_outcomes;
  for (std::size_t k = 0; k < a.observers.series.size(); ++k) {
    if (!same_bits(a.observers.series[k].values, b.observers.series[k].values)) return "series";
  }
  if (!std::ranges::equal(a.observers.reductions, b.observers.reductions, same_reduction)) {
    return "reduction";
  }
  return same_contacts(a.observers.contacts, b.observers.contacts) ? "" : "list of contacts";
}

void expect_same(const std::vector<Case>& lanes, const std::vector<Case>& alone,
                 const std::string& what) {
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    EXPECT_EQ(difference(lanes[i], alone[i]), "") << what << ", case " << i;
  }
}

std::string name_of_loop(const SimdLevel& level) {
  return std::string(name_of(level.isa)) + ", " + std::to_string(level.lanes) + " lanes, " +
         std::string(name_of(level.kernels));
}

constexpr long kInstants = 60;

// More cases than lanes, so that lanes are filled again while others run.
void expect_lanes_as_alone(const Linkage& linkage, const SimulationOptions& options,
                           const std::string& what, int more = 3) {
  for (const SimdLevel& level : step_loops()) {
    std::vector<Case> lanes = make_cases(linkage, level.lanes + more, kInstants), alone = lanes;
    run_cases(lanes, options, level);
    run_alone(alone, options, level);
    expect_same(lanes, alone, what + ", " + name_of_loop(level));
    EXPECT_GT(lanes[0].outcome.steps, 0) << what;
  }
}

SimulationOptions adaptive(double end_time, double tolerance = 1e-6) {
  return adaptive_steps_of(end_time / kInstants, end_time, tolerance);
}

Rsup clearance_set(double at_speed, bool friction, ClearanceKind kind = ClearanceKind::planar) {
  return {.clearance = kind, .friction = friction, .at_speed = at_speed};
}

Linkage with_stops(Linkage linkage) {
  for (Joint& joint : linkage.joints) {
    if (joint.type != JointType::revolute && joint.type != JointType::prismatic) continue;
    const double at = joint.position.empty() ? 0.0 : joint.position[0];
    JointStops& stop = joint.stop.emplace();
    stop.low = {at - 0.02};
    stop.high = {at + 0.03};
    stop.stiffness = {2e4};
  }
  return linkage;
}

Linkage rubbing_rsrrp() {
  Linkage linkage = rsrrp();
  for (Joint& joint : linkage.joints) {
    joint.friction = JointFriction{table_1_friction(), FrictionLoad::reaction, 0.01, 0.05, 3.0};
  }
  return linkage;
}

Linkage driven_rsrrp() {
  Linkage linkage = rsrrp();
  Motion motion;
  motion.name = "m";
  motion.joint = "A";
  motion.law = MotionLaw::sine;
  motion.amplitude = 0.8;
  motion.frequency = 1.5;
  linkage.motions = {motion};
  return linkage;
}

Linkage repeating_rsrrp() {
  Linkage linkage = rsrrp();
  add_repeating_loads("A", "coupler", 0.02, linkage);
  return linkage;
}

}  // namespace

TEST(LocatedBatch, The_clearance_sets_have_the_bits_and_contacts_of_runs_alone) {
  for (const auto& [at_speed, friction] :
       {std::pair{9.0, true}, std::pair{kFast, true}, std::pair{kFast, false}}) {
    expect_lanes_as_alone(rsup(clearance_set(at_speed, friction)), adaptive(0.3),
                          "clearance at " + std::to_string(at_speed));
  }
  expect_lanes_as_alone(rsup(clearance_set(kFast, true, ClearanceKind::spatial)), adaptive(0.2),
                        "spatial clearance");
  expect_lanes_as_alone(loose_slider_crank(ClearanceKind::planar, 50.0), adaptive(0.05),
                        "slider-crank");
}

TEST(LocatedBatch, Bearings_with_every_law_have_the_bits_of_runs_alone) {
  for (const ClearanceKind kind : {ClearanceKind::planar, ClearanceKind::spatial}) {
    JournalInBearing journal;
    journal.kind = kind;
    journal.velocity = {0.6, 0.2, 0.0};
    journal.turning = {kind == ClearanceKind::spatial ? 8.0 : 0.0, 0.0, 30.0};
    Clearance c = loose_bearing();
    c.stiffness = 1e7;
    c.friction = table_1_friction();
    for (const FreeBristle rule : {FreeBristle::reset, FreeBristle::relax, FreeBristle::hold}) {
      c.free_bristle = rule;
      expect_lanes_as_alone(journal_in_bearing(journal, c), adaptive(0.02), "bristles");
    }
    c.exponent = 1.4;
    c.approach = ApproachSpeed::greatest;
    c.points = ContactPoints::two;
    expect_lanes_as_alone(journal_in_bearing(journal, c), adaptive(0.02), "two points");
  }
}

TEST(LocatedBatch, Closures_of_every_type_and_model_have_the_bits_of_runs_alone) {
  for (const JointType type :
       {JointType::spherical, JointType::revolute, JointType::universal, JointType::prismatic,
        JointType::cylindrical, JointType::planar, JointType::fixed}) {
    const std::string name = "closure " + std::to_string(static_cast<int>(type));
    Linkage cut = random_closed_linkage(3, type, ClosureModel::cut);
    for (const auto s :
         {Stabilization::none, Stabilization::baumgarte, Stabilization::projection}) {
      cut.closures[0].stabilization = s;
      expect_lanes_as_alone(cut, adaptive(0.05), name, 1);
    }
    expect_lanes_as_alone(random_closed_linkage(4, type, ClosureModel::sde), adaptive(0.02), name,
                          1);
  }
}

TEST(LocatedBatch, Trees_stops_balls_motions_and_loads_have_the_bits_of_runs_alone) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    expect_lanes_as_alone(with_stops(random_tree(seed)), adaptive(0.1), "tree with stops");
  }
  RandomTree balls;
  balls.links = 3;
  balls.types = {JointType::spherical, JointType::free};
  expect_lanes_as_alone(with_quaternions(random_tree(5, balls)), adaptive(0.1), "quaternions");
  expect_lanes_as_alone(driven_rsrrp(), adaptive(0.2), "motion");
  expect_lanes_as_alone(repeating_rsrrp(), adaptive(0.1), "repeating loads");
  expect_lanes_as_alone(rubbing_rsrrp(), adaptive(0.05, 1e-4), "friction in joints");
  expect_lanes_as_alone(with_stops(spatial_slider_crank()), adaptive(0.3), "loop with stops");
}

// What written code cannot say of them the general loop does, for all lanes of the pack.
TEST(LocatedBatch, Redundant_rows_have_the_bits_of_runs_alone) {
  expect_lanes_as_alone(bennett(), adaptive(0.2), "Bennett");
  expect_lanes_as_alone(n_four_bar(2), adaptive(0.2), "two windows");
  Linkage projected = four_bar();
  projected.closures[0].stabilization = Stabilization::projection;
  expect_lanes_as_alone(projected, adaptive(0.2), "four-bar");
}

TEST(LocatedBatch, Flexible_links_have_the_bits_of_runs_alone) {
  Rsup flexible = clearance_set(kFast, true);
  flexible.segments = 2;
  expect_lanes_as_alone(rsup(flexible), adaptive(0.01, 1e-4), "flexible coupler", 1);
}

TEST(LocatedBatch, Implicit_runs_have_the_bits_of_runs_alone) {
  SimulationOptions options = adaptive(0.05);
  options.integrator = Integrator::stiff;
  expect_lanes_as_alone(rsup(clearance_set(kFast, true)), options, "stiff", 1);
}

TEST(LocatedBatch, Neither_order_nor_neighbours_change_a_bit) {
  const Linkage linkage = rsup(clearance_set(kFast, true));
  const SimulationOptions options = adaptive(0.3);
  for (const SimdLevel& level : step_loops()) {
    const int count = 2 * level.lanes + 1;
    std::vector<Case> there = make_cases(linkage, count, kInstants), back = there, odd = there;
    std::ranges::reverse(back);
    for (std::size_t i = 1; i < odd.size(); i += 2) {
      const double bad = i % 4 == 1 ? 1e300 : std::numeric_limits<double>::quiet_NaN();
      odd[i].model.parameters.bodies[BodyIndex(1)].mass = bad;
      odd[i].model.start.v[VelocityIndex(0)] = bad;
    }
    run_cases(there, options, level);
    run_cases(back, options, level);
    run_cases(odd, options, level);
    std::ranges::reverse(back);
    expect_same(there, back, "reversed, " + name_of_loop(level));
    for (std::size_t i = 0; i < odd.size(); ++i) {
      if (i % 2 == 1) {
        EXPECT_EQ(odd[i].outcome.cause, Cause::diverged);
      } else {
        EXPECT_EQ(difference(there[i], odd[i]), "") << name_of_loop(level) << ", case " << i;
      }
    }
  }
}

// Numbers that are lost on the way, and too stiff for the steps allowed.
TEST(LocatedBatch, A_lane_that_fails_ends_as_alone_and_leaves_the_others) {
  Linkage linkage = rsrrp();
  linkage.closures[0].model = ClosureModel::sde;
  SimulationOptions options = adaptive(0.2);
  options.step_limit = 2000;
  for (const SimdLevel& level : step_loops()) {
    std::vector<Case> lanes = make_cases(linkage, level.lanes + 5, kInstants);
    for (auto& s : lanes[1].model.parameters.springs) s.stiffness = 1e13;
    lanes[1].model.start.q[PositionIndex(0)] += 1e-3;
    lanes[3].model.start.v[VelocityIndex(0)] = 1e160;
    lanes[4].model.parameters.bodies[BodyIndex(2)].mass = -1.0;
    std::vector<Case> alone = lanes;
    run_cases(lanes, options, level);
    run_alone(alone, options, level);
    expect_same(lanes, alone, name_of_loop(level));
    EXPECT_EQ(lanes[1].outcome.cause, Cause::step_budget);
    EXPECT_EQ(lanes[3].outcome.cause, Cause::diverged);
    for (const std::size_t i : {std::size_t{0}, std::size_t{2}, lanes.size() - 1}) {
      EXPECT_EQ(lanes[i].outcome.cause, Cause::ok) << lanes[i].outcome.message;
    }
  }
}

TEST(LocatedBatch, Parameters_that_were_0_or_1_when_code_was_written_may_be_any_number) {
  const auto run_with = [](double aside, Kernels kernels) {
    std::vector<Case> cases = make_cases(rsrrp(), 6, kInstants);
    for (Case& c : cases) c.model.parameters.gravity.z += aside;
    SimdLevel level = choose_simd_level(nullptr, nullptr);
    level.kernels = kernels;
    run_cases(cases, adaptive(0.3), level);
    return cases;
  };
  for (const double aside : {0.0, 0.1, 0.0}) {
    expect_same(run_with(aside, Kernels::written), run_with(aside, Kernels::general),
                std::to_string(aside));
  }
}

TEST(LocatedBatch, All_cases_end_when_they_are_cancelled_or_out_of_time) {
  const SimulationOptions options = adaptive(100.0, 1e-9);
  const std::atomic<bool> cancelled = true;
  std::atomic<double> reached = -1.0;
  RunLimits stopped, hurried;
  stopped.cancelled = &cancelled;
  stopped.reached = &reached;
  hurried.timeout_s = 1e-9;
  for (const auto& [limits, cause] :
       {std::pair{stopped, Cause::cancelled}, std::pair{hurried, Cause::timeout}}) {
    const SimdLevel level = simd_level();
    std::vector<Case> cases = make_cases(rsrrp(), 2 * level.lanes + 1, kInstants);
    run_cases(cases, options, level, limits);
    for (const Case& c : cases) EXPECT_EQ(c.outcome.cause, cause);
  }
  EXPECT_GE(reached.load(), 0.0);
}

TEST(LocatedBatch, No_case_is_no_work) {
  std::vector<BatchCase> none;
  simulate_batch(compile(pendulum()).mechanism, adaptive(1.0), none);
  EXPECT_TRUE(none.empty());
}

}  // namespace linkstudy::testing::located_batch_test
