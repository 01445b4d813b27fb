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

// Whatever counts: a number or an index.
template <int Value>
struct Number {
  operator int() const { return Value; }
  template <class Tag>
  operator TypedIndex<Tag>() const {
    return TypedIndex<Tag>(Value);
  }
};
constexpr Number<0> zero;
constexpr Number<1> one;
constexpr Number<9> nine;

// One of everything.
MechanismStructure full_structure() {
  MechanismStructure m;
  m.bodies.resize(1);
  m.stages.push_back({BasicMotion::rz, zero, zero});
  m.v_parent = {VelocityIndex()};
  m.velocities.push_back({one, VelocityKind::rotation, zero});
  m.ball_q = {PositionIndex(0)};
  m.closures.resize(1);
  m.cut_rows.push_back({RowKind::rotation, zero, 0, 0, 1.0, 0});
  m.sde_rows = m.cut_rows;
  m.support = {VelocityIndex(0)};
  m.loads.push_back({LoadType::drive});
  m.joint_springs.push_back({zero, zero});
  m.point_springs.push_back({.first = zero, .second = one, .curve = {}, .course = {}});
  m.clearances.push_back({.closure = zero,
                          .bearing_first = false,
                          .hertz = false,
                          .contact_begin = zero,
                          .contact_end = one});
  m.contacts.push_back({zero, 0.0});
  m.stops.push_back(
      {.q = zero, .v = zero, .is_high = true, .hertz = true, .is_viscous = false, .contact = one});
  m.frictions.push_back({.body = one, .z = zero});
  m.constant_frictions.push_back({.body = one, .v = zero, .count = 1, .z = zero});
  m.loop_joints.push_back({.group = 0, .body = one});
  m.loop_rows.push_back(m.cut_rows.front());
  m.motions.push_back({.q = zero, .v = zero, .law = MotionLaw::speed});
  m.motion_support = {VelocityIndex(0)};
  m.couplings.resize(1);
  m.coupling_terms.push_back({zero, zero});
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
      {[](M& m) { m.bodies.front().parent = nine; },
       [](M& m) { m.bodies.front().stage_begin = nine; },
       [](M& m) { m.bodies.front().stage_end = nine; },
       [](M& m) { m.bodies.front().q_begin = nine; }, [](M& m) { m.bodies.front().q_count = nine; },
       [](M& m) { m.bodies.front().v_begin = nine; }, [](M& m) { m.bodies.front().v_count = nine; },
       [](M& m) { m.bodies.front().frame = RotationShape::identity; },
       [](M& m) { m.bodies.front().quarter.sign[2] = -1; },
       [](M& m) { m.bodies.front().offset = VectorShape::zero; },
       [](M& m) { m.bodies.front().center = VectorShape::zero; },
       [](M& m) { m.bodies.front().inertia = InertiaShape::isotropic; },
       [](M& m) { m.bodies.front().carries = true; },
       [](M& m) { m.bodies.front().shifted = false; },
       [](M& m) { m.bodies.front().rotates = false; },
       [](M& m) { m.bodies.front().gyrates = false; }});
  expect_each_counts<Stage>({[](M& m) { m.stages.front().motion = BasicMotion::tx; },
                             [](M& m) { m.stages.front().q = nine; },
                             [](M& m) { m.stages.front().v = nine; }});
  expect_each_counts<Velocity>({[](M& m) { m.velocities.front().body = nine; },
                                [](M& m) { m.velocities.front().kind = VelocityKind::screw; },
                                [](M& m) { m.velocities.front().stage = nine; },
                                [](M& m) { m.velocities.front().motion = nine; }});
}

TEST(SameStructure, Counts_every_member_of_motions_and_couplings) {
  expect_each_counts<MotionStructure>({[](M& m) { m.motions.front().q = nine; },
                                       [](M& m) { m.motions.front().v = nine; },
                                       [](M& m) { m.motions.front().law = MotionLaw::sine; },
                                       [](M& m) { m.motions.front().rises = true; },
                                       [](M& m) { m.motions.front().knot_begin = nine; },
                                       [](M& m) { m.motions.front().knot_end = nine; },
                                       [](M& m) { m.motions.front().support_begin = nine; },
                                       [](M& m) { m.motions.front().support_end = nine; }});
  expect_each_counts<CouplingStructure>({[](M& m) { m.couplings.front().row = nine; },
                                         [](M& m) { m.couplings.front().term_begin = nine; },
                                         [](M& m) { m.couplings.front().term_end = nine; },
                                         [](M& m) { m.couplings.front().support_begin = nine; },
                                         [](M& m) { m.couplings.front().support_end = nine; }});
  expect_each_counts<CouplingTermStructure>({[](M& m) { m.coupling_terms.front().q = nine; },
                                             [](M& m) { m.coupling_terms.front().v = nine; }});
}

TEST(SameStructure, Counts_every_member_of_a_closure_and_its_rows) {
  expect_each_counts<ClosureStructure>(
      {[](M& m) { m.closures.front().first = nine; },
       [](M& m) { m.closures.front().second = nine; },
       [](M& m) { m.closures.front().model = ClosureModel::sde; },
       [](M& m) { m.closures.front().stabilization = Stabilization::baumgarte; },
       [](M& m) { m.closures.front().row_begin = nine; },
       [](M& m) { m.closures.front().row_end = nine; },
       [](M& m) { m.closures.front().last_1 = nine; },
       [](M& m) { m.closures.front().last_2 = nine; },
       [](M& m) { m.closures.front().support_begin = nine; },
       [](M& m) { m.closures.front().support_end = nine; },
       [](M& m) { m.closures.front().needs_frames = true; },
       [](M& m) { m.closures.front().has_line = true; },
       [](M& m) { m.closures.front().point_rows = true; },
       [](M& m) { m.closures.front().is_rod = true; },
       [](M& m) { m.closures.front().point_1 = VectorShape::zero; },
       [](M& m) { m.closures.front().point_2 = VectorShape::zero; }});
  expect_each_counts<Row>({[](M& m) { m.sde_rows.front().kind = RowKind::line_of_centres; },
                           [](M& m) { m.sde_rows.front().closure = nine; },
                           [](M& m) { m.sde_rows.front().axis = nine; },
                           [](M& m) { m.sde_rows.front().other = nine; },
                           [](M& m) { m.sde_rows.front().sign = -1.0; },
                           [](M& m) { m.sde_rows.front().direction = nine; },
                           [](M& m) { m.sde_rows.front().coupling = nine; }});
}

TEST(SameStructure, Counts_every_member_of_contacts_friction_springs_and_loads) {
  expect_each_counts<ClearanceStructure>(
      {[](M& m) { m.clearances.front().closure = nine; },
       [](M& m) { m.clearances.front().bearing_first = true; },
       [](M& m) { m.clearances.front().hertz = true; },
       [](M& m) { m.clearances.front().approach = ApproachSpeed::greatest; },
       [](M& m) { m.clearances.front().points = ContactPoints::two; },
       [](M& m) { m.clearances.front().free_bristle = FreeBristle::hold; },
       [](M& m) { m.clearances.front().contact_begin = nine; },
       [](M& m) { m.clearances.front().contact_end = nine; }});
  expect_each_counts<ContactStructure>({[](M& m) { m.contacts.front().clearance = nine; },
                                        [](M& m) { m.contacts.front().side = 0.5; },
                                        [](M& m) { m.contacts.front().z = nine; },
                                        [](M& m) { m.contacts.front().stop = nine; }});
  expect_each_counts<StopStructure>(
      {[](M& m) { m.stops.front().q = nine; }, [](M& m) { m.stops.front().v = nine; },
       [](M& m) { m.stops.front().is_high = false; }, [](M& m) { m.stops.front().hertz = false; },
       [](M& m) { m.stops.front().is_viscous = true; },
       [](M& m) { m.stops.front().approach = ApproachSpeed::greatest; },
       [](M& m) { m.stops.front().contact = nine; }});
  expect_each_counts<JointFrictionStructure>(
      {[](M& m) { m.frictions.front().body = nine; }, [](M& m) { m.frictions.front().turn = nine; },
       [](M& m) { m.frictions.front().slide = nine; }, [](M& m) { m.frictions.front().z = nine; }});
  expect_each_counts<ConstantFrictionStructure>(
      {[](M& m) { m.constant_frictions.front().body = nine; },
       [](M& m) { m.constant_frictions.front().v = nine; },
       [](M& m) { m.constant_frictions.front().count = nine; },
       [](M& m) { m.constant_frictions.front().turns = true; },
       [](M& m) { m.constant_frictions.front().has_angles = true; },
       [](M& m) { m.constant_frictions.front().z = nine; }});
  expect_each_counts<JointSpring>({[](M& m) { m.joint_springs.front().q = nine; },
                                   [](M& m) { m.joint_springs.front().v = nine; },
                                   [](M& m) { m.joint_springs.front().curve.end = nine; },
                                   [](M& m) { m.joint_springs.front().bend = nine; }});
  expect_each_counts<PointSpringStructure>(
      {[](M& m) { m.point_springs.front().first = nine; },
       [](M& m) { m.point_springs.front().second = nine; },
       [](M& m) { m.point_springs.front().acts = SpringActs::tension; },
       [](M& m) { m.point_springs.front().curve.end = nine; },
       [](M& m) { m.point_springs.front().is_driven = true; },
       [](M& m) { m.point_springs.front().course.q = nine; },
       [](M& m) { m.point_springs.front().bend = nine; }});
  expect_each_counts<CurveStructure>({[](M& m) { m.point_springs.front().curve.begin = nine; },
                                      [](M& m) { m.point_springs.front().curve.end = nine; }});
  expect_each_counts<LoadStructure>(
      {[](M& m) { m.loads.front().type = LoadType::resistance; },
       [](M& m) { m.loads.front().v = nine; }, [](M& m) { m.loads.front().body = nine; },
       [](M& m) { m.loads.front().follows_link = true; },
       [](M& m) { m.loads.front().course.shape = CourseShape::ramp; },
       [](M& m) { m.loads.front().law = ResistanceShape::quadratic; }});
  expect_each_counts<CourseStructure>(
      {[](M& m) { m.loads.front().course.shape = CourseShape::ramp; },
       [](M& m) { m.loads.front().course.q = nine; },
       [](M& m) { m.loads.front().course.repeats = true; },
       [](M& m) { m.loads.front().course.begin = nine; },
       [](M& m) { m.loads.front().course.end = nine; },
       [](M& m) { m.loads.front().course.bend = nine; }});
}

TEST(SameStructure, Counts_every_member_of_a_joint_that_shares_reactions) {
  expect_each_counts<LoopJoint>({[](M& m) { m.loop_joints.front().group = nine; },
                                 [](M& m) { m.loop_joints.front().body = nine; },
                                 [](M& m) { m.loop_joints.front().closure = nine; },
                                 [](M& m) { m.loop_joints.front().counts = false; }});
}

TEST(SameStructure, Counts_every_list_and_number_of_a_mechanism) {
  expect_each_counts<MechanismStructure>({[](M& m) { m.nq = nine; },
                                          [](M& m) { m.nv = nine; },
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
                                          [](M& m) { m.knots = nine; },
                                          [](M& m) { m.couplings.clear(); },
                                          [](M& m) { m.coupling_terms.clear(); },
                                          [](M& m) { m.nz = nine; },
                                          [](M& m) { m.table_segments = nine; },
                                          [](M& m) { m.bent_springs = nine; },
                                          [](M& m) { m.projects = true; },
                                          [](M& m) { m.loop_joints.clear(); },
                                          [](M& m) { m.loop_rows.clear(); }});
}

TEST(SameStructure, Leaves_names_and_chosen_points_aside) {
  Mechanism a;
  Mechanism b;
  b.link_names = {"crank"};
  b.closure_names = {"S"};
  b.point_bodies = {BodyIndex(1)};
  EXPECT_TRUE(same_structure(a, b));
}

}  // namespace
}  // namespace linkstudy::same_structure_test
