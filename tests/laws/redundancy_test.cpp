// Cut joints whose rows depend on each other: what the run of such a linkage must keep, and what
// its multipliers must not depend on.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/mechanisms/bennett.h"
#include "tests/mechanisms/four_bar.h"
#include "tests/mechanisms/n_four_bar.h"
#include "tests/mechanisms/rsrrp.h"
#include "tests/mechanisms/spatial_slider_crank.h"
#include "tests/support/engine_probe.h"
#include "tests/support/near.h"

namespace linkstudy::testing::redundancy_test {
namespace {

Linkage stabilized(Linkage linkage, Stabilization stabilization) {
  for (Closure& c : linkage.closures) {
    c.model = ClosureModel::cut;
    c.stabilization = stabilization;
  }
  return linkage;
}

Linkage bennett_with(double rate, Stabilization stabilization) {
  BennettGeometry geometry;
  geometry.rate = rate;
  return stabilized(bennett(geometry), stabilization);
}

void scale_lengths(double f, Linkage& linkage) {
  linkage.gravity *= f;
  for (Link& link : linkage.links) {
    link.center_of_mass *= f;
    link.inertia *= f * f;
  }
  for (Joint& joint : linkage.joints) {
    joint.frame.position *= f;
    joint.child_frame.position *= f;
    if (joint.type != JointType::prismatic) continue;
    for (double& x : joint.position) x *= f;
    for (double& x : joint.velocity) x *= f;
  }
  for (Closure& c : linkage.closures) {
    c.first.frame.position *= f;
    c.second.frame.position *= f;
  }
}

void scale_masses(double f, Linkage& linkage) {
  for (Link& link : linkage.links) {
    link.mass *= f;
    link.inertia *= f;
  }
}

void expect_forces(const Linkage& linkage, const Linkage& other, double force, double torque) {
  EngineProbe engine(linkage), changed(other);
  for (const Closure& c : linkage.closures) {
    const std::string name = "closure." + c.name;
    const Eigen::Vector3d f = engine.vector(name + ".force");
    EXPECT_GT(f.norm(), 0.1);
    EXPECT_TRUE(near_relative(changed.vector(name + ".force") / force, f, 1e-9)) << linkage.name;
    const Eigen::Vector3d n = engine.vector(name + ".torque");
    EXPECT_TRUE(near_absolute(changed.vector(name + ".torque") / torque, n, 1e-9 * (1 + n.norm())))
        << linkage.name;
  }
}

std::vector<Linkage> redundant_linkages() {
  Linkage unloaded = stabilized(rsrrp_revolute(), Stabilization::none);
  unloaded.loads.clear();
  return {four_bar(), bennett(), unloaded};
}

}  // namespace

// In the stages of a step the loop is open by h^2, and the dependent rows are not quite dependent:
// counted as independent they would lock the linkage.
TEST(Redundancy, A_Bennett_linkage_keeps_its_energy_to_fourth_order) {
  // To and fro, and round and round; the latter drifts apart without stabilisation.
  for (const auto& [rate, stabilization] : {std::pair{3.0, Stabilization::none},
                                            {3.0, Stabilization::baumgarte},
                                            {3.0, Stabilization::projection},
                                            {15.0, Stabilization::baumgarte},
                                            {15.0, Stabilization::projection}}) {
    const Model model = compile(bennett_with(rate, stabilization));
    const SimulationOutcome coarse = run(model, steps_of(2e-3, 2.0, 1e-2));
    const SimulationOutcome fine = run(model, steps_of(1e-3, 2.0, 1e-2));
    SCOPED_TRACE(std::to_string(rate) + " " + std::to_string(static_cast<int>(stabilization)));
    ASSERT_EQ(coarse.cause, Cause::ok) << coarse.message;
    ASSERT_EQ(fine.cause, Cause::ok) << fine.message;
    for (const SimulationOutcome& end : {coarse, fine}) {
      EXPECT_EQ(end.least_rank, 2);
      EXPECT_EQ(end.greatest_rank, 2);
    }
    EXPECT_LT(fine.energy_residual_max, 1e-7 * fine.energy_scale);
    EXPECT_GT(fine.energy_scale, 1.0);
    const double order = std::log2(coarse.energy_residual_max / fine.energy_residual_max);
    EXPECT_GT(order, 3.8);
    EXPECT_LT(order, 4.3);
  }
}

TEST(Redundancy, A_Bennett_linkage_arrives_at_the_same_pose_with_any_stabilisation) {
  const auto pose = [](Stabilization stabilization) {
    const SimulationOutcome end =
        run(compile(bennett_with(3.0, stabilization)), steps_of(1e-3, 2.0));
    return Eigen::Map<const Eigen::Vector3d>(end.final_state.q.data()).eval();
  };
  const Eigen::Vector3d none = pose(Stabilization::none);
  EXPECT_TRUE(near_absolute(pose(Stabilization::baumgarte), none, 1e-7));
  EXPECT_TRUE(near_absolute(pose(Stabilization::projection), none, 1e-7));
  // Opposite angles of a Bennett linkage are equal: joints B and D.
  EXPECT_NEAR(none[1], none[2], 1e-7);
}

TEST(Redundancy, A_link_of_a_millionth_of_a_gram_costs_no_row) {
  for (Linkage linkage : {spatial_slider_crank(), four_bar()}) {
    const SimulationOutcome usual = run(compile(linkage), steps_of(1e-3, 1.0, 1e-2));
    Link& coupler = linkage.links[1];
    coupler.inertia *= 1e-9 / coupler.mass;
    coupler.mass = 1e-9;
    const SimulationOutcome light = run(compile(linkage), steps_of(1e-3, 1.0, 1e-2));
    ASSERT_EQ(light.cause, Cause::ok) << light.message;
    EXPECT_EQ(light.least_rank, usual.least_rank) << linkage.name;
    EXPECT_EQ(light.greatest_rank, usual.greatest_rank) << linkage.name;
    EXPECT_LT(light.energy_residual_max, 1e-4 * light.energy_scale) << linkage.name;
  }
}

// A light link makes much of the little that a drift leaves independent (core/closures/
// clear_rows.h): the rank must not follow it. Translations and rotations close the first, in one
// loop, and the second, in two; their ranks are 2 and 4 however they are weighed.
TEST(Redundancy, Light_links_do_not_make_drift_independent) {
  const Linkage one = stabilized(bennett(), Stabilization::none);
  const Linkage two = stabilized(n_four_bar(2), Stabilization::none);
  for (const auto& [linkage, rank] : {std::pair{&one, 2}, {&two, 4}}) {
    for (const double drift : {0.0, 1e-8, 1e-6, 1e-5, 1e-4}) {
      for (const double part : {1.0, 1e-3, 1e-6, 1e-9}) {
        for (std::size_t light = 0; light < linkage->links.size(); ++light) {
          Linkage changed = *linkage;
          shake(changed, 1 + light, drift, 0.0);
          changed.links[light].mass *= part;
          changed.links[light].inertia *= part;
          const SimulationOutcome end = run(compile(changed), steps_of(1e-9, 1e-9));
          EXPECT_EQ(end.least_rank, rank) << linkage->name << drift << " " << part << " " << light;
          EXPECT_EQ(end.greatest_rank, rank) << linkage->name;
        }
      }
    }
  }
}

// The lighter the coupler, the nearer to a massless one, in proportion.
TEST(Redundancy, Accelerations_settle_as_a_link_loses_its_mass) {
  for (Linkage linkage : {spatial_slider_crank(), four_bar()}) {
    const auto crank = [&](double mass) {
      Link& coupler = linkage.links[1];
      coupler.inertia *= mass / coupler.mass;
      coupler.mass = mass;
      return EngineProbe(linkage).at("joint.A.a");
    };
    const double milli = crank(1e-3), micro = crank(1e-6), nano = crank(1e-9);
    EXPECT_NEAR((milli - nano) / (micro - nano), 1e3, 30.0) << linkage.name;
  }
}

TEST(Redundancy, A_start_without_stabilisation_is_warned_of_and_told_the_remedy) {
  const auto warned = [](Stabilization stabilization) {
    const Preparation p = prepare(bennett_with(3.0, stabilization), steps_of(1e-3, 1.0));
    EXPECT_EQ(p.cause, Cause::ok) << p.message;
    return std::count_if(p.warnings.begin(), p.warnings.end(), [](const std::string& text) {
      return text.find("projection") != std::string::npos;
    });
  };
  EXPECT_EQ(warned(Stabilization::none), 1);
  EXPECT_EQ(warned(Stabilization::baumgarte), 0);
  EXPECT_EQ(warned(Stabilization::projection), 0);
}

TEST(Redundancy, Multipliers_do_not_depend_on_the_unit_of_length) {
  for (const Linkage& linkage : redundant_linkages()) {
    Linkage millimetres = linkage;
    scale_lengths(1e3, millimetres);
    expect_forces(linkage, millimetres, 1e3, 1e6);
  }
}

TEST(Redundancy, Multipliers_do_not_depend_on_the_unit_of_mass) {
  for (const Linkage& linkage : redundant_linkages()) {
    Linkage grams = linkage;
    scale_masses(1e3, grams);
    expect_forces(linkage, grams, 1e3, 1e3);
  }
}

}  // namespace linkstudy::testing::redundancy_test
