// Closures of the oracle: derivatives by finite differences, generalised forces against the power
// of the reported wrenches, and reactions of all tree joints by free bodies.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/mechanisms/frames.h"
#include "tests/mechanisms/random_linkages.h"
#include "tests/support/free_bodies.h"
#include "tests/support/near.h"
#include "tests/support/trace_formulas.h"

namespace linkstudy::testing::oracle_closure_test {
namespace {

const std::vector<JointType> kClosureTypes = {
    JointType::spherical,   JointType::revolute, JointType::universal, JointType::prismatic,
    JointType::cylindrical, JointType::planar,   JointType::fixed};

struct SdeCase {
  SdeForm form;
  SdeAxes axes;
  TiltMeasure tilt;
};

std::vector<SdeCase> sde_cases() {
  std::vector<SdeCase> cases;
  for (const SdeForm form :
       {SdeForm::directional, SdeForm::line_of_centres, SdeForm::three_springs}) {
    for (const SdeAxes axes : {SdeAxes::ground, SdeAxes::first}) {
      for (const TiltMeasure tilt : {TiltMeasure::axis, TiltMeasure::linearized}) {
        cases.push_back({form, axes, tilt});
      }
    }
  }
  return cases;
}

Sde full_sde(const SdeCase& c) {
  Sde sde;
  sde.form = c.form;
  sde.axes = c.axes;
  sde.tilt = c.tilt;
  sde.stiffness = {300, 500, 700, 20, 30, 40};
  sde.damping = {3, 5, 7, 0.2, 0.3, 0.4};
  sde.directions << 1, 0, 0, 0.6, 0.8, 0, 0, 0.6, 0.8;
  return sde;
}

ClosureResult element(const TraceModel& model, const Vector& q, const Vector& v) {
  const auto transforms = link_transforms(model, q);
  return sde_result(model.closures[0], closure_frames(model, model.closures[0], transforms, v));
}

// Both wrenches of a closure on the links it joins.
std::vector<ExternalWrench> wrenches_of(const Closure& closure, const ClosureResult& result) {
  return {{closure.first.link, result.point_first, result.force, result.torque},
          {closure.second.link, result.point_second, -result.force, -result.torque}};
}

double power(const std::vector<ExternalWrench>& wrenches, const std::vector<LinkMotion>& motions) {
  double sum = 0.0;
  for (const ExternalWrench& wrench : wrenches) {
    const LinkMotion& link = motion_of(motions, wrench.link);
    sum += wrench.force.dot(link.v + link.omega.cross(wrench.point - link.p)) +
           wrench.torque.dot(link.omega);
  }
  return sum;
}

// What drives and resistances put on the coordinates.
Vector joint_loads(TraceModel model, double t, const Vector& q, const Vector& v) {
  std::erase_if(model.loads, [](const TraceLoad& load) {
    return load.load.type == LoadType::link_force || load.load.type == LoadType::link_torque;
  });
  return generalised_loads(model, link_transforms(model, q), t, v);
}

// Power of a joint's reaction at unit speed of one of the joint's coordinates.
double reaction_power(const Joint& joint, const JointReaction& reaction,
                      const std::vector<LinkMotion>& unit) {
  const LinkMotion& child = motion_of(unit, joint.child);
  double sum = reaction.force.dot(child.v + child.omega.cross(reaction.origin - child.p)) +
               reaction.torque.dot(child.omega);
  if (joint.parent == kGround) return sum;
  const LinkMotion& parent = motion_of(unit, joint.parent);
  return sum - reaction.force.dot(parent.v + parent.omega.cross(reaction.origin - parent.p)) -
         reaction.torque.dot(parent.omega);
}

void expect_reactions_do_no_work(const Linkage& linkage) {
  const TraceModel model = make_trace_model(linkage);
  const double t = 0.3;
  const Vector& q = model.q0;
  const Vector& v = model.v0;
  const OracleResult solved = oracle_acceleration(model, t, q, v);
  const auto motions = link_motions(linkage, q, v, solved.qdd);
  std::vector<ExternalWrench> wrenches = load_wrenches(linkage, motions, t);
  for (std::size_t c = 0; c < linkage.closures.size(); ++c) {
    for (const auto& w : wrenches_of(linkage.closures[c], solved.closures[c]))
      wrenches.push_back(w);
  }
  const Reactions reactions = joint_reactions(linkage, motions, wrenches);
  const Vector expected = joint_loads(model, t, q, v);
  Vector actual(model.dof);
  double size = 1.0;
  for (const Joint& joint : linkage.joints) {
    const int first = coordinate_index(model, joint.name);
    const JointReaction& reaction = reaction_of(reactions, joint.name);
    size = std::max({size, reaction.force.norm(), reaction.torque.norm()});
    for (int k = 0; k < velocity_count(joint.type); ++k) {
      const Vector e = Vector::Unit(model.dof, first + k);
      actual[first + k] = reaction_power(joint, reaction, link_motions(linkage, q, e, 0.0 * e));
    }
  }
  EXPECT_TRUE(near_absolute(actual, expected, 1e-11 * size)) << linkage.name;
  EXPECT_LT(reactions.residual, 1e-11 * size);
}

// Two frames one about the other: first fixed on the ground, second turned by R.
ClosureFrames turned(const Eigen::Matrix3d& R) {
  Linkage linkage = sde_pair(1, JointType::revolute, full_sde({}));
  const TraceModel model = make_trace_model(linkage);
  const auto transforms = link_transforms(model, model.q0);
  const Transform T1 = transforms[0].T;
  TraceClosure closure = model.closures[0];
  closure.first.frame = Transform::Identity(4, 4);
  closure.second.frame = inverse_transform(transforms[1].T) * T1 * transform({R, {0, 0, 0}});
  return closure_frames(model, closure, transforms, model.v0);
}

}  // namespace

TEST(OracleClosure, Rows_have_the_derivatives_of_their_deformations) {
  const double h = 1e-6;
  for (const JointType type : kClosureTypes) {
    const TraceModel model = make_trace_model(random_closed_linkage(5, type, ClosureModel::cut));
    const Vector q = model.q0 + 0.05 * model.v0;  // away from the closed pose
    const Constraints here = cut_constraints(model, q, model.v0);
    EXPECT_EQ(here.value.size(), __builtin_popcount(blocked_directions(type)));
    Matrix J(here.value.size(), model.dof);
    for (int i = 0; i < model.dof; ++i) {
      const Vector dq = h * Vector::Unit(model.dof, i);
      J.col(i) = (cut_constraints(model, q + dq, model.v0).value -
                  cut_constraints(model, q - dq, model.v0).value) /
                 (2 * h);
    }
    EXPECT_TRUE(near_absolute(here.jacobian, J, 1e-8));
    const Matrix J_dot = (cut_constraints(model, q + h * model.v0, model.v0).jacobian -
                          cut_constraints(model, q - h * model.v0, model.v0).jacobian) /
                         (2 * h);
    EXPECT_TRUE(near_absolute(here.velocity_terms, J_dot * model.v0, 1e-8));
  }
}

TEST(OracleClosure, A_cut_loop_stays_closed_while_it_moves) {
  for (const JointType type : kClosureTypes) {
    const TraceModel model = make_trace_model(random_closed_linkage(2, type, ClosureModel::cut));
    const OracleState start = start_state(model);
    EXPECT_LT(cut_constraints(model, start.q, start.v).value.norm(), 1e-12);
    const OracleState end = rk4(model, 1e-3, 50, start);
    EXPECT_GT((end.q - start.q).norm(), 1e-2);
    const Constraints c = cut_constraints(model, end.q, end.v);
    EXPECT_LT(c.value.norm(), 1e-8) << static_cast<int>(type);
    EXPECT_LT((c.jacobian * end.v).norm(), 1e-7) << static_cast<int>(type);
  }
}

TEST(OracleClosure, Reactions_by_free_bodies_do_no_work_in_the_joints) {
  for (int seed = 0; seed < 10; ++seed) {
    expect_reactions_do_no_work(random_tree(seed));
    for (const JointType type : kClosureTypes) {
      expect_reactions_do_no_work(random_closed_linkage(seed, type, ClosureModel::cut));
      expect_reactions_do_no_work(random_closed_linkage(seed, type, ClosureModel::sde));
    }
  }
}

TEST(OracleClosure, An_undamped_element_pulls_down_its_energy) {
  const double h = 1e-6;
  for (const SdeCase& c : sde_cases()) {
    Sde sde = full_sde(c);
    sde.damping = {};
    const TraceModel model = make_trace_model(sde_pair(4, JointType::fixed, sde));
    Vector gradient(model.dof);
    for (int i = 0; i < model.dof; ++i) {
      const Vector dq = h * Vector::Unit(model.dof, i);
      gradient[i] = (element(model, model.q0 + dq, model.v0).energy -
                     element(model, model.q0 - dq, model.v0).energy) /
                    (2 * h);
    }
    EXPECT_GT(gradient.norm(), 1.0);
    EXPECT_TRUE(near_relative(element(model, model.q0, model.v0).generalised, -gradient, 1e-8));
  }
}

TEST(OracleClosure, An_element_acts_with_the_power_of_its_wrenches) {
  for (const JointType type : {JointType::fixed, JointType::universal}) {
    for (const SdeCase& c : sde_cases()) {
      const Linkage linkage = sde_pair(6, type, full_sde(c), 0.3);
      const TraceModel model = make_trace_model(linkage);
      const ClosureResult result = element(model, model.q0, model.v0);
      for (int i = 0; i < model.dof; ++i) {
        const Vector e = Vector::Unit(model.dof, i);
        EXPECT_NEAR(result.generalised[i],
                    power(wrenches_of(linkage.closures[0], result),
                          link_motions(linkage, model.q0, e, 0.0 * e)),
                    1e-11);
      }
    }
  }
}

TEST(OracleClosure, Damping_takes_what_the_element_reports) {
  for (const SdeCase& c : sde_cases()) {
    Sde sde = full_sde(c);
    sde.stiffness = {};
    const TraceModel model = make_trace_model(sde_pair(8, JointType::fixed, sde));
    const ClosureResult result = element(model, model.q0, model.v0);
    EXPECT_GT(result.dissipated_power, 1e-2);
    EXPECT_NEAR(result.generalised.dot(model.v0), -result.dissipated_power, 1e-12);
  }
}

TEST(OracleClosure, Both_axes_agree_for_equal_stiffnesses_without_damping) {
  Sde sde;
  sde.stiffness = {400, 400, 400, 0, 0, 0};
  const TraceModel ground = make_trace_model(sde_pair(9, JointType::spherical, sde));
  sde.axes = SdeAxes::first;
  const TraceModel first = make_trace_model(sde_pair(9, JointType::spherical, sde));
  EXPECT_TRUE(near_relative(element(ground, ground.q0, ground.v0).generalised,
                            element(first, first.q0, first.v0).generalised, 1e-13));
}

TEST(OracleClosure, Three_springs_along_the_axes_are_the_directional_element) {
  const SdeCase directional{SdeForm::directional, SdeAxes::first, TiltMeasure::axis};
  const SdeCase springs{SdeForm::three_springs, SdeAxes::first, TiltMeasure::axis};
  Sde sde = full_sde(springs);
  sde.directions.setIdentity();
  const TraceModel a = make_trace_model(sde_pair(3, JointType::fixed, full_sde(directional)));
  const TraceModel b = make_trace_model(sde_pair(3, JointType::fixed, sde));
  EXPECT_TRUE(
      near_relative(element(a, a.q0, a.v0).generalised, element(b, b.q0, b.v0).generalised, 1e-13));
}

TEST(OracleClosure, Elements_in_axes_of_a_link_keep_the_momentum_of_a_pair) {
  Sde sde = full_sde({SdeForm::directional, SdeAxes::first, TiltMeasure::axis});
  const Linkage linkage = sde_pair(12, JointType::fixed, sde);
  const TraceModel model = make_trace_model(linkage);
  const OracleState start = start_state(model);
  const OracleState end = rk4(model, 2.5e-4, 400, start);
  const auto at = [&](const OracleState& s) {
    return momentum(linkage, link_motions(linkage, s.q, s.v, 0.0 * s.v));
  };
  EXPECT_TRUE(near_absolute(at(end).linear, at(start).linear, 1e-9));
  EXPECT_TRUE(near_absolute(at(end).angular, at(start).angular, 1e-9));
  EXPECT_LT(total_energy(model, end), total_energy(model, start));
}

TEST(OracleClosure, The_axis_measure_resists_both_tilts_at_any_turn_and_the_printed_one_does_not) {
  const double tilt = 1e-4;
  for (const double turn : {0.0, 0.5 * M_PI, 170 * M_PI / 180}) {
    for (const int axis : {1, 2}) {  // a tilt of the second x axis about y or z of the first frame
      const ClosureFrames f = turned(rotation_about(axis, tilt) * rotation_about(0, turn));
      const auto size = [&](TiltMeasure measure) {
        const double a = rotation_row(f, kTheta, measure, JointType::revolute).d;
        const double b = rotation_row(f, kPsi, measure, JointType::revolute).d;
        return std::hypot(a, b) / tilt;
      };
      EXPECT_NEAR(size(TiltMeasure::axis), 1.0, 1e-7);
      const double printed = axis == 1 ? std::abs(std::cos(turn)) : std::hypot(1.0, std::sin(turn));
      EXPECT_NEAR(size(TiltMeasure::linearized), printed, 1e-3);
    }
  }
}

TEST(OracleClosure, A_turn_about_the_two_axes_of_a_universal_joint_is_free) {
  const ClosureFrames f = turned(rotation_about(0, 0.7) * rotation_about(1, -0.4));
  EXPECT_NEAR(rotation_row(f, kPsi, TiltMeasure::axis, JointType::universal).d, 0.0, 1e-15);
  const ClosureFrames g = turned(rotation_about(2, 1e-3));
  EXPECT_NEAR(rotation_row(g, kPsi, TiltMeasure::axis, JointType::universal).d, 1e-3, 1e-9);
}

TEST(OracleClosure, A_damping_ratio_follows_the_mass_it_moves) {
  Linkage linkage;
  linkage.links = {{"block", 3.0, {0, 0, 0}, Eigen::Matrix3d::Identity()}};
  Joint slide;
  slide.name = "slide";
  slide.type = JointType::prismatic;
  slide.parent = kGround;
  slide.child = "block";
  linkage.joints = {slide};
  Closure spring;
  spring.name = "spring";
  spring.model = ClosureModel::sde;
  spring.first.link = "block";
  spring.second.link = kGround;
  spring.sde.stiffness[kZ] = 1200.0;
  spring.sde.damping_ratio = 0.7;
  linkage.closures = {spring};
  EXPECT_NEAR(make_trace_model(linkage).closures[0].damping[kZ], 2 * 0.7 * std::sqrt(1200.0 * 3.0),
              1e-10);
}

}  // namespace linkstudy::testing::oracle_closure_test
