#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "core/model/mechanism.h"

namespace linkstudy::same_structure_test {
namespace {

// Something that any member can be made from, to count the members of an aggregate.
struct Anything {
  template <class Member>
  operator Member() const;
};

template <class Struct, std::size_t... I>
constexpr bool takes(std::index_sequence<I...>) {
  return requires {
    Struct{(static_cast<void>(I), Anything())...};
  };
}

template <class Struct, std::size_t N = 40>
constexpr std::size_t count_members() {
  if constexpr (takes<Struct>(std::make_index_sequence<N>())) {
    return N;
  } else {
    return count_members<Struct, N - 1>();
  }
}

// One of everything.
MechanismStructure full_structure() {
  MechanismStructure m;
  m.bodies.resize(1);
  m.stages.push_back({BasicMotion::rz, 0, 0});
  m.v_parent = {-1};
  m.velocities.push_back({1, VelocityKind::rotation, 0});
  m.ball_q = {0};
  m.closures.resize(1);
  m.cut_rows.push_back({RowKind::rotation, 0, 0, 0, 1.0, 0});
  m.sde_rows = m.cut_rows;
  m.support = {0};
  m.loads.push_back({LoadType::drive});
  m.joint_springs.push_back({0, 0});
  m.point_springs.push_back({.first = 0, .second = 1, .curve = {}, .course = {}});
  m.clearances.push_back(
      {.closure = 0, .bearing_first = false, .hertz = false, .contact_begin = 0, .contact_end = 1});
  m.contacts.push_back({0, 0.0});
  m.stops.push_back(
      {.q = 0, .v = 0, .is_high = true, .hertz = true, .is_viscous = false, .contact = 1});
  m.frictions.push_back({.body = 1, .z = 0});
  m.constant_frictions.push_back({.body = 1, .v = 0, .count = 1, .z = 0});
  m.loop_joints.push_back({.group = 0, .body = 1});
  m.loop_rows = m.cut_rows;
  m.motions.push_back({.q = 0, .v = 0, .law = MotionLaw::speed});
  m.motion_support = {0};
  m.couplings.resize(1);
  m.coupling_terms.push_back({0, 0});
  return m;
}

using Change = std::function<void(MechanismStructure&)>;
using M = MechanismStructure;

// A change of every member, and that these are all.
template <class Struct>
void expect_each_counts(const std::vector<Change>& changes) {
  EXPECT_EQ(changes.size(), count_members<Struct>()) << "a member without its change";
  for (std::size_t i = 0; i < changes.size(); ++i) {
    MechanismStructure changed = full_structure();
    EXPECT_TRUE(same_structure(changed, full_structure()));
    changes[i](changed);
    EXPECT_FALSE(same_structure(changed, full_structure())) << "member " << i;
  }
}

TEST(SameStructure, Counts_every_member_of_a_body_and_its_joint) {
  expect_each_counts<Body>(
      {[](M& m) { m.bodies[0].parent = 9; }, [](M& m) { m.bodies[0].stage_begin = 9; },
       [](M& m) { m.bodies[0].stage_end = 9; }, [](M& m) { m.bodies[0].q_begin = 9; },
       [](M& m) { m.bodies[0].q_count = 9; }, [](M& m) { m.bodies[0].v_begin = 9; },
       [](M& m) { m.bodies[0].v_count = 9; },
       [](M& m) { m.bodies[0].frame = RotationShape::identity; },
       [](M& m) { m.bodies[0].quarter.sign[2] = -1; },
       [](M& m) { m.bodies[0].offset = VectorShape::zero; },
       [](M& m) { m.bodies[0].center = VectorShape::zero; },
       [](M& m) { m.bodies[0].inertia = InertiaShape::isotropic; },
       [](M& m) { m.bodies[0].carries = true; }, [](M& m) { m.bodies[0].shifted = false; },
       [](M& m) { m.bodies[0].rotates = false; }, [](M& m) { m.bodies[0].gyrates = false; }});
  expect_each_counts<Stage>({[](M& m) { m.stages[0].motion = BasicMotion::tx; },
                             [](M& m) { m.stages[0].q = 9; }, [](M& m) { m.stages[0].v = 9; }});
  expect_each_counts<Velocity>({[](M& m) { m.velocities[0].body = 9; },
                                [](M& m) { m.velocities[0].kind = VelocityKind::screw; },
                                [](M& m) { m.velocities[0].stage = 9; },
                                [](M& m) { m.velocities[0].motion = 9; }});
}

TEST(SameStructure, Counts_every_member_of_motions_and_couplings) {
  expect_each_counts<MotionStructure>(
      {[](M& m) { m.motions[0].q = 9; }, [](M& m) { m.motions[0].v = 9; },
       [](M& m) { m.motions[0].law = MotionLaw::sine; }, [](M& m) { m.motions[0].rises = true; },
       [](M& m) { m.motions[0].knot_begin = 9; }, [](M& m) { m.motions[0].knot_end = 9; },
       [](M& m) { m.motions[0].support_begin = 9; }, [](M& m) { m.motions[0].support_end = 9; }});
  expect_each_counts<CouplingStructure>(
      {[](M& m) { m.couplings[0].row = 9; }, [](M& m) { m.couplings[0].term_begin = 9; },
       [](M& m) { m.couplings[0].term_end = 9; }, [](M& m) { m.couplings[0].support_begin = 9; },
       [](M& m) { m.couplings[0].support_end = 9; }});
  expect_each_counts<CouplingTermStructure>(
      {[](M& m) { m.coupling_terms[0].q = 9; }, [](M& m) { m.coupling_terms[0].v = 9; }});
}

TEST(SameStructure, Counts_every_member_of_a_closure_and_its_rows) {
  expect_each_counts<ClosureStructure>(
      {[](M& m) { m.closures[0].first = 9; }, [](M& m) { m.closures[0].second = 9; },
       [](M& m) { m.closures[0].model = ClosureModel::sde; },
       [](M& m) { m.closures[0].stabilization = Stabilization::baumgarte; },
       [](M& m) { m.closures[0].row_begin = 9; }, [](M& m) { m.closures[0].row_end = 9; },
       [](M& m) { m.closures[0].last_1 = 9; }, [](M& m) { m.closures[0].last_2 = 9; },
       [](M& m) { m.closures[0].support_begin = 9; }, [](M& m) { m.closures[0].support_end = 9; },
       [](M& m) { m.closures[0].needs_frames = true; }, [](M& m) { m.closures[0].has_line = true; },
       [](M& m) { m.closures[0].point_rows = true; }, [](M& m) { m.closures[0].is_rod = true; },
       [](M& m) { m.closures[0].point_1 = VectorShape::zero; },
       [](M& m) { m.closures[0].point_2 = VectorShape::zero; }});
  expect_each_counts<Row>(
      {[](M& m) { m.sde_rows[0].kind = RowKind::line_of_centres; },
       [](M& m) { m.sde_rows[0].closure = 9; }, [](M& m) { m.sde_rows[0].axis = 9; },
       [](M& m) { m.sde_rows[0].other = 9; }, [](M& m) { m.sde_rows[0].sign = -1.0; },
       [](M& m) { m.sde_rows[0].direction = 9; }});
}

TEST(SameStructure, Counts_every_member_of_contacts_friction_springs_and_loads) {
  expect_each_counts<ClearanceStructure>(
      {[](M& m) { m.clearances[0].closure = 9; },
       [](M& m) { m.clearances[0].bearing_first = true; },
       [](M& m) { m.clearances[0].hertz = true; },
       [](M& m) { m.clearances[0].approach = ApproachSpeed::greatest; },
       [](M& m) { m.clearances[0].points = ContactPoints::two; },
       [](M& m) { m.clearances[0].free_bristle = FreeBristle::hold; },
       [](M& m) { m.clearances[0].contact_begin = 9; },
       [](M& m) { m.clearances[0].contact_end = 9; }});
  expect_each_counts<ContactStructure>(
      {[](M& m) { m.contacts[0].clearance = 9; }, [](M& m) { m.contacts[0].side = 0.5; },
       [](M& m) { m.contacts[0].z = 9; }, [](M& m) { m.contacts[0].stop = 9; }});
  expect_each_counts<StopStructure>({[](M& m) { m.stops[0].q = 9; }, [](M& m) { m.stops[0].v = 9; },
                                     [](M& m) { m.stops[0].is_high = false; },
                                     [](M& m) { m.stops[0].hertz = false; },
                                     [](M& m) { m.stops[0].is_viscous = true; },
                                     [](M& m) { m.stops[0].approach = ApproachSpeed::greatest; },
                                     [](M& m) { m.stops[0].contact = 9; }});
  expect_each_counts<JointFrictionStructure>(
      {[](M& m) { m.frictions[0].body = 9; }, [](M& m) { m.frictions[0].turn = 9; },
       [](M& m) { m.frictions[0].slide = 9; }, [](M& m) { m.frictions[0].z = 9; }});
  expect_each_counts<ConstantFrictionStructure>(
      {[](M& m) { m.constant_frictions[0].body = 9; }, [](M& m) { m.constant_frictions[0].v = 9; },
       [](M& m) { m.constant_frictions[0].count = 9; },
       [](M& m) { m.constant_frictions[0].turns = true; },
       [](M& m) { m.constant_frictions[0].has_angles = true; },
       [](M& m) { m.constant_frictions[0].z = 9; }});
  expect_each_counts<JointSpring>(
      {[](M& m) { m.joint_springs[0].q = 9; }, [](M& m) { m.joint_springs[0].v = 9; },
       [](M& m) { m.joint_springs[0].curve.end = 9; }, [](M& m) { m.joint_springs[0].bend = 9; }});
  expect_each_counts<PointSpringStructure>(
      {[](M& m) { m.point_springs[0].first = 9; }, [](M& m) { m.point_springs[0].second = 9; },
       [](M& m) { m.point_springs[0].acts = SpringActs::tension; },
       [](M& m) { m.point_springs[0].curve.end = 9; },
       [](M& m) { m.point_springs[0].is_driven = true; },
       [](M& m) { m.point_springs[0].course.q = 9; }, [](M& m) { m.point_springs[0].bend = 9; }});
  expect_each_counts<CurveStructure>({[](M& m) { m.point_springs[0].curve.begin = 9; },
                                      [](M& m) { m.point_springs[0].curve.end = 9; }});
  expect_each_counts<LoadStructure>(
      {[](M& m) { m.loads[0].type = LoadType::resistance; }, [](M& m) { m.loads[0].v = 9; },
       [](M& m) { m.loads[0].body = 9; }, [](M& m) { m.loads[0].follows_link = true; },
       [](M& m) { m.loads[0].course.shape = CourseShape::ramp; },
       [](M& m) { m.loads[0].law = ResistanceShape::quadratic; }});
  expect_each_counts<CourseStructure>(
      {[](M& m) { m.loads[0].course.shape = CourseShape::ramp; },
       [](M& m) { m.loads[0].course.q = 9; }, [](M& m) { m.loads[0].course.repeats = true; },
       [](M& m) { m.loads[0].course.begin = 9; }, [](M& m) { m.loads[0].course.end = 9; },
       [](M& m) { m.loads[0].course.bend = 9; }});
}

TEST(SameStructure, Counts_every_member_of_a_joint_that_shares_reactions) {
  expect_each_counts<LoopJoint>(
      {[](M& m) { m.loop_joints[0].group = 9; }, [](M& m) { m.loop_joints[0].body = 9; },
       [](M& m) { m.loop_joints[0].closure = 9; }, [](M& m) { m.loop_joints[0].counts = false; }});
}

TEST(SameStructure, Counts_every_list_and_number_of_a_mechanism) {
  expect_each_counts<MechanismStructure>({[](M& m) { m.nq = 9; },
                                          [](M& m) { m.nv = 9; },
                                          [](M& m) { m.bodies.emplace_back(); },
                                          [](M& m) { m.stages.clear(); },
                                          [](M& m) { m.v_parent.clear(); },
                                          [](M& m) { m.velocities.clear(); },
                                          [](M& m) { m.ball_q.clear(); },
                                          [](M& m) { m.closures.clear(); },
                                          [](M& m) { m.cut_rows.clear(); },
                                          [](M& m) { m.sde_rows.clear(); },
                                          [](M& m) { m.support.clear(); },
                                          [](M& m) { m.loads.clear(); },
                                          [](M& m) { m.joint_springs.clear(); },
                                          [](M& m) { m.point_springs.clear(); },
                                          [](M& m) { m.clearances.clear(); },
                                          [](M& m) { m.contacts.clear(); },
                                          [](M& m) { m.stops.clear(); },
                                          [](M& m) { m.frictions.clear(); },
                                          [](M& m) { m.constant_frictions.clear(); },
                                          [](M& m) { m.motions.clear(); },
                                          [](M& m) { m.motion_support.clear(); },
                                          [](M& m) { m.knots = 9; },
                                          [](M& m) { m.couplings.clear(); },
                                          [](M& m) { m.coupling_terms.clear(); },
                                          [](M& m) { m.nz = 9; },
                                          [](M& m) { m.table_segments = 9; },
                                          [](M& m) { m.bent_springs = 9; },
                                          [](M& m) { m.projects = true; },
                                          [](M& m) { m.loop_joints.clear(); },
                                          [](M& m) { m.loop_rows.clear(); }});
}

TEST(SameStructure, Leaves_names_and_chosen_points_aside) {
  Mechanism a;
  Mechanism b;
  b.link_names = {"crank"};
  b.closure_names = {"S"};
  b.point_bodies = {1};
  EXPECT_TRUE(same_structure(a, b));
}

}  // namespace
}  // namespace linkstudy::same_structure_test
