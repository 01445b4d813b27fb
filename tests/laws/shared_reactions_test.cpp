// Redundant reactions shared among all joints of the loops: against closed forms, and against all
// joints cut at once (tests/support/least_reactions.h).
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/flexible/rigid_finite_elements.h"
#include "tests/mechanisms/bennett.h"
#include "tests/mechanisms/four_bar.h"
#include "tests/mechanisms/placed_linkage.h"
#include "tests/support/engine_probe.h"
#include "tests/support/least_reactions.h"
#include "tests/support/near.h"
#include "tests/support/random.h"
#include "tests/support/same_bits.h"
#include "tests/support/trace_model.h"

namespace linkstudy::testing::shared_reactions_test {
namespace {

using Eigen::Vector3d;

SimulationOptions sharing(SimulationOptions options) {
  options.redundant_reactions = RedundantReactions::loops;
  return options;
}

Model prepared(const Linkage& linkage, const SimulationOptions& options) {
  Preparation p = prepare(linkage, options);
  EXPECT_EQ(p.cause, Cause::ok) << linkage.name << ": " << p.message;
  return std::move(p.model);
}

// A start as a run sees it.
struct Start {
  InstantOfMotion motion;
  JointWrenches reactions;
};

Vector stacked(const Model& model, const Linkage& linkage, const std::string& part) {
  std::vector<std::string> signals;
  for (const int j : tree_order(linkage)) {
    const Joint& joint = linkage.joints[static_cast<std::size_t>(j)];
    if (velocity_count(joint.type) > 0) signals.push_back("joint." + joint.name + part);
  }
  return run(model, steps_of(1e-9, 1e-9), signals).values.row(0);
}

Start start_of(const Linkage& linkage, RedundantReactions way) {
  SimulationOptions options = steps_of(1e-9, 1e-9);
  options.redundant_reactions = way;
  const Model model = prepared(linkage, options);
  Start s{
      {stacked(model, linkage, ".q"), stacked(model, linkage, ".v"), stacked(model, linkage, ".a")},
      {}};
  const auto add = [&](const std::string& owner, const std::string& name) {
    s.reactions[name] = run(model, options, {owner + name + ".force", owner + name + ".torque"})
                            .values.row(0)
                            .transpose();
  };
  for (const Joint& joint : linkage.joints) add("joint.", joint.name);
  for (const Closure& c : linkage.closures) add("closure.", c.name);
  return s;
}

::testing::AssertionResult same_reactions(const JointWrenches& a, const JointWrenches& b,
                                          double tolerance) {
  double size = 0.0, error = 0.0;
  for (const auto& [name, f] : a) {
    size = std::max(size, f.norm());
    error = std::max(error, (f - b.at(name)).norm());
  }
  if (a.size() == b.size() && size > 1.0 && error <= tolerance * size) {
    return ::testing::AssertionSuccess();
  }
  auto failure = ::testing::AssertionFailure() << "error " << error << " of " << size;
  for (const auto& [name, f] : a) {
    failure << "\n" << name << " " << f.transpose() << " | " << b.at(name).transpose();
  }
  return failure;
}

// Links of any mass, none in the plane of the joints, under weight from aside.
Linkage loaded(Linkage linkage, double rate, std::uint64_t seed = 7) {
  Random random(seed);
  linkage.gravity = {2.0, -9.0, 4.0};
  for (Link& link : linkage.links) {
    link.mass = 1.0 + 0.5 * random.within(1.0);
    for (double& x : link.center_of_mass) x += random.within(0.2);
    link.inertia = Vector3d(0.02, 0.03, 0.04).asDiagonal();
  }
  linkage.joints[0].hold = true;
  linkage.joints[0].velocity = {rate};
  for (Closure& c : linkage.closures) {
    c.model = ClosureModel::cut;
    c.stabilization = Stabilization::projection;
  }
  return linkage;
}

// A frame on two joints, 1 m apart.
Linkage on_two(JointType type, double damping) {
  Linkage linkage = PlacedLinkage("on_two")
                        .add("L", type, kGround, "frame", {{-0.5, 0, 0}, Vector3d::UnitX()})
                        .close("R", type, "frame", kGround, {{0.5, 0, 0}, Vector3d::UnitX()})
                        .linkage();
  if (damping > 0.0) linkage.joints[0].damping = {damping};
  return linkage;
}

// A parallelogram whose coupler rests on three cranks: two loops that share joints.
Linkage three_cranks() {
  return PlacedLinkage("three_cranks")
      .add("A", JointType::revolute, kGround, "left", {{0, 0, 0}})
      .add("B", JointType::revolute, "left", "coupler", {{0.1, 0.3, 0}})
      .add("C", JointType::revolute, kGround, "middle", {{0.4, 0, 0.1}})
      .add("D", JointType::revolute, kGround, "right", {{0.9, 0, 0}})
      .close("E", JointType::revolute, "coupler", "middle", {{0.5, 0.3, 0.1}})
      .close("F", JointType::revolute, "right", "coupler", {{1.0, 0.3, 0}})
      .linkage();
}

// A pendulum on the coupler is on no loop.
Linkage with_pendulum(Linkage linkage) {
  const Linkage pendulum = PlacedLinkage("p")
                               .add("P", JointType::spherical, "coupler", "bob", {{0.2, 0.1, 0.3}})
                               .linkage();
  linkage.links.push_back(pendulum.links[0]);
  linkage.joints.push_back(pendulum.joints[0]);
  return linkage;
}

// A link bolted twice to a pendulum.
Linkage bolted() {
  return PlacedLinkage("bolted")
      .add("A", JointType::revolute, kGround, "arm", {{0, 0, 0}})
      .add("B", JointType::fixed, "arm", "plate", {{0.5, 0.1, 0}})
      .close("C", JointType::fixed, "plate", "arm", {{0.8, -0.1, 0.2}})
      .linkage();
}

Linkage turning_bennett(double rate) {
  Linkage linkage = bennett();
  for (Joint& joint : linkage.joints) joint.velocity[0] *= rate / 3.0;
  linkage.closures[0].model = ClosureModel::cut;
  return linkage;
}

struct Redundant {
  Linkage linkage;
  std::set<std::string> bridges;
};

std::vector<Redundant> redundant_linkages(double rate) {
  return {{loaded(on_two(JointType::revolute, 2.0), rate), {}},
          {loaded(on_two(JointType::prismatic, 0.0), rate), {}},
          {loaded(planar_4r(), rate), {}},
          {loaded(three_cranks(), rate), {}},
          {turning_bennett(rate), {}},
          {loaded(sarrus(), rate), {}},
          {loaded(spherical_4r(), rate), {}},
          {loaded(triangle(), 0.0), {}},
          {loaded(bolted(), rate), {"A"}},
          {loaded(with_pendulum(planar_4r()), rate), {"P"}}};
}

// The same linkage with another joint cut: of one loop whose links are chained from ground on
// either side. `order` of joints round the loop; each bears on the link after it.
struct RoundLoop {
  std::vector<std::string> joints;
  std::vector<JointPlace> places;
  std::vector<std::string> links;  // links[i] between joints i and i + 1; the last joint to ground
};

RoundLoop four_bar_loop() {
  return {{"A", "B", "C", "D"},
          {{{0, 0, 0}}, {{0.1, 0.05, 0.02}}, {{0.35, 0.3, 0}}, {{0.4, 0, -0.05}}},
          {"crank", "coupler", "rocker"}};
}

Linkage cut_at(const RoundLoop& loop, std::size_t cut, double rate) {
  PlacedLinkage builder("cut at " + loop.joints[cut]);
  const std::size_t n = loop.joints.size();
  const auto link = [&](std::size_t i) { return i < n - 1 ? loop.links[i] : std::string(kGround); };
  for (std::size_t i = 0; i < cut; ++i) {
    builder.add(loop.joints[i], JointType::revolute, i == 0 ? kGround : link(i - 1), link(i),
                loop.places[i]);
  }
  for (std::size_t i = n; --i > cut;) {
    builder.add(loop.joints[i], JointType::revolute, link(i), link(i - 1), loop.places[i]);
  }
  builder.close(loop.joints[cut], JointType::revolute, link(cut),
                cut == 0 ? kGround : link(cut - 1), loop.places[cut]);
  Linkage linkage = builder.linkage();
  linkage.gravity = {2.0, -9.0, 4.0};
  for (Link& l : linkage.links) {  // by name, not by order
    const double x = static_cast<double>(l.name.size());
    l.mass = 0.5 + 0.1 * x;
    l.center_of_mass = Vector3d(0.03 * x, 0.02 * x, 0.5 - 0.1 * x);
    l.inertia = Vector3d(0.02, 0.03, 0.04).asDiagonal();
  }
  // Whatever is cut, the motion is that with the last joint turning at `rate`.
  for (Joint& joint : linkage.joints) {
    if (joint.name == loop.joints.back()) {
      joint.velocity = {-rate};
      joint.hold = true;
    }
  }
  for (Closure& c : linkage.closures) c.stabilization = Stabilization::projection;
  return linkage;
}

// Reactions on the link after each joint.
JointWrenches on_links_after(const Linkage& linkage, const RoundLoop& loop,
                             const JointWrenches& reactions) {
  JointWrenches turned = reactions;
  for (const Joint& joint : linkage.joints) {
    const auto i = static_cast<std::size_t>(
        std::find(loop.joints.begin(), loop.joints.end(), joint.name) - loop.joints.begin());
    const bool after = i < loop.links.size() && joint.child == loop.links[i];
    if (!after) turned[joint.name] = -turned[joint.name];
  }
  return turned;
}

}  // namespace

// m g at 0.3 m from the middle of two hinges 2 a = 1 m apart: half of the moment M = 0.3 m g is
// borne by forces +-M / (4 a), half by moments M / 4 (least of (a F)^2 + M^2).
TEST(SharedReactions, Two_hinges_on_one_axis_share_a_weight_as_worked_out_by_hand) {
  Linkage linkage = on_two(JointType::revolute, 2.0);
  linkage.gravity = {0, -9.81, 0};
  linkage.links[0].mass = 10.0;
  linkage.links[0].center_of_mass = {0.3, -0.4, 0};
  const auto shared = start_of(linkage, RedundantReactions::loops).reactions;
  const double weight = 98.1, M = 0.3 * weight;
  Vector6 left, right;
  left << 0, weight / 2 - M / 2, 0, 0, 0, M / 4;
  right << 0, weight / 2 + M / 2, 0, 0, 0, M / 4;
  EXPECT_TRUE(near_absolute(shared.at("L"), left, 1e-12 * weight));
  EXPECT_TRUE(near_absolute(shared.at("R"), right, 1e-12 * weight));
  const auto cut = start_of(linkage, RedundantReactions::cut).reactions;
  EXPECT_EQ(cut.at("R").norm(), 0.0) << "the cut joint alone has nothing to bear";
}

TEST(SharedReactions, All_joints_cut_at_once_bear_the_same) {
  for (const double rate : {0.0, 4.0}) {
    for (const auto& [linkage, bridges] : redundant_linkages(rate)) {
      SCOPED_TRACE(linkage.name + " at " + std::to_string(rate));
      const Start start = start_of(linkage, RedundantReactions::loops);
      EXPECT_TRUE(
          same_reactions(least_reactions(linkage, start.motion, bridges), start.reactions, 1e-9));
      const Start cut = start_of(linkage, RedundantReactions::cut);
      EXPECT_FALSE(same_reactions(cut.reactions, start.reactions, 1e-3)) << "nothing to share";
    }
  }
}

TEST(SharedReactions, It_does_not_matter_which_joint_is_cut) {
  const RoundLoop loop = four_bar_loop();
  for (const double rate : {0.0, 5.0}) {
    const auto cut_there = [&](std::size_t i) {
      const Linkage linkage = cut_at(loop, i, rate);
      return on_links_after(linkage, loop, start_of(linkage, RedundantReactions::loops).reactions);
    };
    const auto reference = cut_there(0);
    for (std::size_t i = 1; i + 1 < loop.joints.size(); ++i) {
      EXPECT_TRUE(same_reactions(reference, cut_there(i), 1e-9)) << loop.joints[i];
    }
  }
}

TEST(SharedReactions, Units_of_length_and_mass_do_not_matter) {
  constexpr double kLength = 1e3, kMass = 1e3;  // mm, g
  for (const auto& [linkage, bridges] : redundant_linkages(0.0)) {
    Linkage other = linkage;
    other.gravity *= kLength;
    for (Link& link : other.links) {
      link.mass *= kMass;
      link.center_of_mass *= kLength;
      link.inertia *= kMass * kLength * kLength;
    }
    for (Joint& joint : other.joints) {
      joint.frame.position *= kLength;
      joint.child_frame.position *= kLength;
      for (double& b : joint.damping) b *= kMass * kLength * kLength;
    }
    for (Closure& c : other.closures) {
      c.first.frame.position *= kLength;
      c.second.frame.position *= kLength;
    }
    auto scaled = start_of(other, RedundantReactions::loops).reactions;
    for (auto& [name, f] : scaled) {
      f.head<3>() /= kMass * kLength;
      f.tail<3>() /= kMass * kLength * kLength;
    }
    EXPECT_TRUE(
        same_reactions(start_of(linkage, RedundantReactions::loops).reactions, scaled, 1e-9))
        << linkage.name;
  }
}

TEST(SharedReactions, The_order_of_joints_and_closures_does_not_matter) {
  const Linkage linkage = loaded(three_cranks(), 3.0);
  Linkage other = linkage;
  std::swap(other.joints[0], other.joints[3]);
  std::swap(other.closures[0], other.closures[1]);
  EXPECT_TRUE(same_reactions(start_of(linkage, RedundantReactions::loops).reactions,
                             start_of(other, RedundantReactions::loops).reactions, 1e-10));
}

TEST(SharedReactions, Loops_apart_do_not_feel_each_other) {
  const Linkage one = loaded(planar_4r(), 2.0);
  Linkage both = one, far = loaded(on_two(JointType::revolute, 0.0), 0.0);
  both.links.push_back(far.links[0]);
  both.links.back().center_of_mass = {30, 0, 2};
  for (Frame* f : {&far.joints[0].frame, &far.joints[0].child_frame, &far.closures[0].first.frame,
                   &far.closures[0].second.frame}) {
    f->position *= 40.0;
  }
  both.joints.push_back(far.joints[0]);
  both.closures.push_back(far.closures[0]);
  const auto alone = start_of(one, RedundantReactions::loops).reactions;
  auto beside = start_of(both, RedundantReactions::loops).reactions;
  EXPECT_GT(beside.at("R").norm(), 1.0);
  for (const char* name : {"L", "R"}) beside.erase(name);
  EXPECT_TRUE(same_reactions(alone, beside, 1e-10));
}

// A beam along the axis of its two hinges: its weight along itself is borne by half at either end,
// however many parts it has, and the joints inside carry what hangs on them.
TEST(SharedReactions, Joints_inside_a_flexible_link_bear_what_the_others_leave) {
  constexpr double kWeight = 20.0;
  for (const int parts : {2, 5}) {
    Linkage linkage = on_two(JointType::revolute, 0.0);
    linkage.gravity = {-kWeight / 2.0, 0, 0};
    linkage.links[0] = {"frame", 2.0, Vector3d::Zero(),
                        Vector3d(1e-3, 1.0 / 6, 1.0 / 6).asDiagonal()};
    FlexibleBeam beam;
    beam.segments = parts;
    beam.begin = {-0.5, 0, 0};
    beam.end = {0.5, 0, 0};
    beam.young = 2e11;
    beam.shear = 8e10;
    beam.second_moment_y = beam.second_moment_z = 1e-8;
    beam.torsion_constant = 2e-8;
    linkage.links[0].flexible = beam;
    const auto reactions =
        start_of(expand_flexible_links(linkage), RedundantReactions::loops).reactions;
    EXPECT_NEAR(reactions.at("L")[0], kWeight / 2, 1e-9) << parts;
    EXPECT_NEAR(reactions.at("R")[0], kWeight / 2, 1e-9) << parts;
    for (int k = 1; k <= parts; ++k) {
      const double outboard = kWeight * (parts - k + 0.5) / parts;
      EXPECT_NEAR(reactions.at("frame_sde" + std::to_string(k))[0], outboard - kWeight / 2, 1e-9);
    }
  }
}

TEST(SharedReactions, The_motion_has_the_same_bits) {
  for (const auto& [linkage, bridges] : redundant_linkages(4.0)) {
    for (const Integrator integrator : {Integrator::rk4, Integrator::adaptive}) {
      SimulationOptions options = steps_of(1e-3, 0.1, 1e-2);
      options.integrator = integrator;
      const SimulationOutcome cut = run(prepared(linkage, options), options);
      const SimulationOutcome loops = run(prepared(linkage, sharing(options)), sharing(options));
      ASSERT_EQ(cut.cause, Cause::ok) << linkage.name << cut.message;
      EXPECT_TRUE(same_bits(cut.final_state.q, loops.final_state.q)) << linkage.name;
      EXPECT_TRUE(same_bits(cut.final_state.v, loops.final_state.v)) << linkage.name;
      EXPECT_EQ(cut.redundant, loops.redundant);
      EXPECT_EQ(cut.least_rank, loops.least_rank);
    }
  }
}

TEST(SharedReactions, What_is_not_redundant_keeps_its_bits) {
  for (const Linkage& linkage : {loaded(rssr(), 2.0), loaded(rccc(), 2.0)}) {
    const Start cut = start_of(linkage, RedundantReactions::cut);
    const Start loops = start_of(linkage, RedundantReactions::loops);
    for (const auto& [name, f] : cut.reactions) {
      const Vector6& g = loops.reactions.at(name);
      EXPECT_TRUE(same_bits({f.data(), f.data() + 6}, {g.data(), g.data() + 6})) << name;
    }
  }
}

// Along a run by either integrator, where poses are closed again by projection.
TEST(SharedReactions, Constant_and_adaptive_steps_agree_along_a_run) {
  const Linkage linkage = loaded(three_cranks(), 4.0);
  SimulationOptions options = sharing(steps_of(5e-4, 0.5, 5e-2));
  const std::vector<std::string> signals = {"joint.A.force", "joint.C.torque", "closure.E.force",
                                            "closure.F.torque"};
  const Samples fixed = run(prepared(linkage, options), options, signals);
  options.integrator = Integrator::adaptive;
  options.relative_tolerance = 1e-11;
  options.absolute_tolerance = 1e-13;
  const Samples adaptive = run(prepared(linkage, options), options, signals);
  ASSERT_EQ(fixed.values.rows(), 11);
  // Of the classical steps, fourth order.
  EXPECT_TRUE(near_absolute(fixed.values, adaptive.values, 1e-6 * adaptive.values.norm()));
}

TEST(SharedReactions, Lanes_have_the_bits_of_a_lone_run) {
  const Linkage linkage = loaded(three_cranks(), 4.0);
  const SimulationOptions options = sharing(steps_of(1e-3, 0.05, 1e-2));
  const SimdLevel level = choose_simd_level(nullptr, nullptr);
  const auto count = static_cast<std::size_t>(level.lanes);
  std::vector<Model> models;
  for (std::size_t i = 0; i < count; ++i) {
    Linkage other = linkage;
    other.links[0].mass += 0.1 * static_cast<double>(i);
    models.push_back(prepared(other, options));
  }
  const Series everything{list_channels(models[0].mechanism), {0, 50, 10}, {}};
  std::vector<Observers> together(count), alone(count);
  std::vector<BatchCase> cases;
  for (std::size_t i = 0; i < count; ++i) {
    together[i].series = alone[i].series = {everything};
    cases.push_back({&models[i].parameters, &models[i].start, &together[i], {}});
    simulate(models[i].mechanism, models[i].parameters, models[i].start, options, alone[i]);
  }
  simulate_batch(models[0].mechanism, options, cases, {}, level);
  for (std::size_t i = 0; i < count; ++i) {
    ASSERT_EQ(together[i].series[0].rows(), 6u);
    EXPECT_TRUE(same_bits(together[i].series[0].values, alone[i].series[0].values)) << i;
  }
}

// Friction brakes by the reactions that are reported: with shared ones the motion, too, does not
// depend on which joint is cut. With the multipliers of one cut joint it does.
TEST(SharedReactions, Joint_friction_feels_shared_reactions_whichever_joint_is_cut) {
  const RoundLoop loop = four_bar_loop();
  const auto acceleration = [&](std::size_t cut, RedundantReactions way) {
    Linkage linkage = cut_at(loop, cut, 5.0);
    for (Joint& joint : linkage.joints) {
      if (joint.name != "D") continue;
      JointFriction f;
      f.law = {.mu_s = 0.2, .mu_k = 0.2, .v_s = 0.01, .sigma0 = 200.0};
      f.radius = 0.05;
      f.length = 0.1;
      joint.friction = f;
    }
    SimulationOptions options = steps_of(1e-9, 1e-9);
    options.redundant_reactions = way;
    const Samples s =
        run(prepared(linkage, options), options, {"joint.D.a", "joint.D.normal_load"});
    EXPECT_GT(s.values(0, 1), 1.0);
    return s.values(0, 0);
  };
  const double reference = acceleration(0, RedundantReactions::loops);
  for (const std::size_t cut : {1, 2}) {
    EXPECT_NEAR(acceleration(cut, RedundantReactions::loops), reference,
                1e-8 * std::abs(reference));
  }
  EXPECT_GT(
      std::abs(acceleration(0, RedundantReactions::cut) - acceleration(2, RedundantReactions::cut)),
      1e-3 * std::abs(reference));
}

TEST(SharedReactions, The_warning_says_which_way_was_taken) {
  const auto warning = [](RedundantReactions way) {
    SimulationOptions options = steps_of(1e-3, 1.0);
    options.redundant_reactions = way;
    for (const std::string& text : prepare(four_bar(), options).warnings) {
      if (text.find("redundant") != std::string::npos) return text;
    }
    return std::string();
  };
  EXPECT_NE(warning(RedundantReactions::cut).find("redundant_reactions = \"cut\""),
            std::string::npos);
  const std::string loops = warning(RedundantReactions::loops);
  EXPECT_NE(loops.find("redundant_reactions = \"loops\""), std::string::npos);
  for (const char* name : {"joint.A", "joint.B", "joint.D", "closure.C"}) {
    EXPECT_NE(loops.find(name), std::string::npos) << name;
  }
}

}  // namespace linkstudy::testing::shared_reactions_test
