#include "core/topology/check_linkage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace linkstudy::check_linkage_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Link make_link(const std::string& name) {
  Link link;
  link.name = name;
  link.mass = 1.0;
  link.inertia = Eigen::Matrix3d::Identity();
  return link;
}

Joint make_joint(const std::string& name, const std::string& parent, const std::string& child) {
  Joint joint;
  joint.name = name;
  joint.parent = parent;
  joint.child = child;
  return joint;
}

// ground -A- a -B- b, ground -C- c -D- d, c -E- e: two roots, one branch.
Linkage make_tree() {
  Linkage linkage;
  for (const char* name : {"a", "b", "c", "d", "e"}) linkage.links.push_back(make_link(name));
  linkage.joints = {make_joint("A", "ground", "a"), make_joint("B", "a", "b"),
                    make_joint("C", "ground", "c"), make_joint("D", "c", "d"),
                    make_joint("E", "c", "e")};
  return linkage;
}

Closure make_closure(const std::string& first, const std::string& second) {
  Closure closure;
  closure.name = "S";
  closure.first.link = first;
  closure.second.link = second;
  return closure;
}

Load make_drive(const std::string& joint) {
  Load load;
  load.name = "drive";
  load.joint = joint;
  load.course.shape = CourseShape::constant;
  return load;
}

std::vector<std::string> paths(const Linkage& linkage) {
  std::vector<std::string> result;
  for (const Problem& problem : check(linkage)) {
    EXPECT_FALSE(problem.message.empty());
    EXPECT_FALSE(problem.remedy.empty()) << problem.message;
    result.push_back(problem.path);
  }
  return result;
}

std::string only_message(const Linkage& linkage) {
  const std::vector<Problem> problems = check(linkage);
  EXPECT_EQ(problems.size(), 1u);
  return problems.empty() ? std::string() : problems.front().message;
}

TEST(Check, A_tree_with_branches_and_several_roots_is_right_in_any_order) {
  Linkage linkage = make_tree();
  linkage.closures = {make_closure("b", "d"), make_closure("ground", "e")};
  linkage.closures[1].name = "T";
  linkage.loads = {make_drive("A")};
  EXPECT_THAT(paths(linkage), IsEmpty());
  std::reverse(linkage.joints.begin(), linkage.joints.end());
  std::reverse(linkage.links.begin(), linkage.links.end());
  EXPECT_THAT(paths(linkage), IsEmpty());
}

TEST(Check, A_model_without_links_is_wrong) {
  EXPECT_THAT(paths(Linkage{}), ElementsAre("link"));
}

TEST(Check, Names_are_unique_legal_and_not_ground) {
  Linkage linkage = make_tree();
  linkage.links.push_back(make_link("a"));
  linkage.links.push_back(make_link("9b"));
  linkage.links.push_back(make_link("ground"));
  linkage.joints.push_back(make_joint("Z", "a", "9b"));
  linkage.joints[1].name = "A";
  linkage.loads = {make_drive("C"), make_drive("C")};
  linkage.points.assign(2, {"tip", "a", Eigen::Vector3d::Zero()});
  EXPECT_THAT(paths(linkage),
              ::testing::UnorderedElementsAre("link.5.name", "link.6.name", "link.7.name",
                                              "joint.1.name", "load.1.name", "point.1.name"));
}

TEST(Check, Values_of_a_namesake_are_addressed_by_position) {
  Linkage linkage = make_tree();
  linkage.links.push_back(make_link("a"));
  linkage.links.back().mass = -1.0;
  EXPECT_THAT(paths(linkage), ElementsAre("link.5.name", "link.5.mass"));
}

TEST(Check, A_link_without_a_joint_is_named) {
  Linkage linkage = make_tree();
  linkage.joints.erase(linkage.joints.begin() + 2);  // c, which carries d and e
  EXPECT_THAT(paths(linkage), ElementsAre("link.c"));
}

TEST(Check, A_wrong_reference_is_not_reported_again_as_a_lost_link) {
  Linkage linkage = make_tree();
  linkage.joints[2].child = "x";
  EXPECT_THAT(paths(linkage), ElementsAre("joint.C.child"));
  linkage = make_tree();
  linkage.joints[2].parent = "x";
  EXPECT_THAT(paths(linkage), ElementsAre("joint.C.parent"));
}

TEST(Check, A_link_hangs_on_one_joint) {
  Linkage linkage = make_tree();
  linkage.joints.push_back(make_joint("F", "b", "d"));
  EXPECT_THAT(paths(linkage), ElementsAre("joint.F.child"));
  EXPECT_THAT(only_message(linkage), HasSubstr("already the child of joint 'D'"));
}

TEST(Check, A_loop_that_never_reaches_ground_is_reported_once) {
  Linkage linkage = make_tree();
  linkage.joints[2].parent = "d";  // c - d - c, with e hanging on it
  EXPECT_THAT(paths(linkage), ElementsAre("joint.C"));
  EXPECT_THAT(only_message(linkage), HasSubstr("c - d - c"));
  linkage.joints[0].parent = "b";  // and a second loop a - b - a
  EXPECT_THAT(paths(linkage), ElementsAre("joint.A", "joint.C"));
}

TEST(Check, A_long_loop_is_followed_to_its_end) {
  const auto numbered = [](std::string name, int i) { return name.append(std::to_string(i)); };
  Linkage linkage;
  for (int i = 0; i < 500; ++i) {
    const std::string child = numbered("l", i);
    linkage.links.push_back(make_link(child));
    linkage.joints.push_back(make_joint(numbered("j", i), numbered("l", (i + 1) % 500), child));
  }
  EXPECT_THAT(paths(linkage), ElementsAre("joint.j0"));
}

TEST(Check, Ground_and_the_link_itself_cannot_be_carried) {
  Linkage linkage = make_tree();
  linkage.joints.push_back(make_joint("F", "a", "ground"));
  EXPECT_THAT(paths(linkage), ElementsAre("joint.F.child"));
  linkage = make_tree();
  linkage.joints[4].parent = "e";
  EXPECT_THAT(paths(linkage), ElementsAre("joint.E.child"));
}

TEST(Check, Masses_and_inertias_are_those_of_a_body) {
  Linkage linkage = make_tree();
  linkage.links[0].mass = 0.0;
  linkage.links[1].mass = std::nan("");
  linkage.links[2].inertia = Eigen::Vector3d(1, 1, 2.01).asDiagonal();
  linkage.links[3].inertia(0, 1) = linkage.links[3].inertia(1, 0) = 1.5;
  linkage.links[4].inertia(0, 1) = 0.1;
  EXPECT_THAT(paths(linkage), ElementsAre("link.a.mass", "link.b.mass", "link.c.inertia",
                                          "link.d.inertia", "link.e.inertia"));
  // A thin plate has equality, a slender rod nearly: both are bodies.
  linkage = make_tree();
  linkage.links[0].inertia = Eigen::Vector3d(1, 1, 2).asDiagonal();
  linkage.links[1].inertia = Eigen::Vector3d(0.0833, 0.0208, 0.1042).asDiagonal();
  linkage.links[2].inertia = Eigen::Vector3d(1, 1, 1e-9).asDiagonal();
  EXPECT_THAT(paths(linkage), IsEmpty());
}

TEST(Check, Rotations_are_proper) {
  Linkage linkage = make_tree();
  linkage.joints[0].frame.rotation(2, 2) = -1.0;
  linkage.joints[1].child_frame.rotation *= 1.00001;
  linkage.joints[2].frame.rotation *= 1.0 + 1e-7;  // within tolerance
  linkage.joints[3].frame.position[0] = std::numeric_limits<double>::infinity();
  linkage.closures = {make_closure("b", "d")};
  linkage.closures[0].second.frame.rotation.setZero();
  EXPECT_THAT(paths(linkage), ElementsAre("joint.A.frame.rotation", "joint.B.child_frame.rotation",
                                          "joint.D.frame.position", "closure.S.second.rotation"));
  EXPECT_THAT(check(linkage)[0].message, HasSubstr("reflection"));
}

TEST(Check, Start_values_match_the_coordinates) {
  Linkage linkage = make_tree();
  linkage.joints[0].position = {1.0, 2.0};
  linkage.joints[1].velocity = {1.0, 2.0};
  linkage.joints[2].type = JointType::spherical;
  linkage.joints[2].coordinates = RotationCoordinates::quaternion;
  linkage.joints[2].position = {1.0, 1.0, 0.0, 0.0};
  linkage.joints[3].type = JointType::free;
  linkage.joints[3].position.assign(6, 0.0);
  linkage.joints[4].type = JointType::screw;
  EXPECT_THAT(paths(linkage), ElementsAre("joint.A.initial.position", "joint.B.initial.velocity",
                                          "joint.C.initial.position", "joint.E.pitch"));
}

TEST(Check, Closures_connect_two_different_links_and_block_something) {
  Linkage linkage = make_tree();
  linkage.closures = {make_closure("b", "b"), make_closure("x", "d"),
                      make_closure("ground", "ground"), make_closure("b", "d")};
  for (std::size_t i = 0; i < 4; ++i) linkage.closures[i].name = "S" + std::to_string(i);
  linkage.closures[3].type = JointType::free;
  linkage.closures[3].alpha = -1.0;
  EXPECT_THAT(paths(linkage),
              ::testing::UnorderedElementsAre("closure.S0.second.link", "closure.S1.first.link",
                                              "closure.S2.second.link", "closure.S3.type",
                                              "closure.S3.cut.alpha"));
}

TEST(Check, A_spring_damping_element_is_stiff_somewhere_and_nowhere_negative) {
  Linkage linkage = make_tree();
  linkage.closures = {make_closure("b", "d")};
  linkage.closures[0].model = ClosureModel::sde;
  Sde& sde = linkage.closures[0].sde;
  EXPECT_THAT(paths(linkage), ElementsAre("closure.S.sde.stiffness"));
  sde.stiffness = {1, 1, 1, 0, 0, 0};
  EXPECT_THAT(paths(linkage), IsEmpty());
  sde.damping[kPsi] = -1.0;
  sde.damping_ratio = -0.1;
  EXPECT_THAT(paths(linkage),
              ElementsAre("closure.S.sde.damping.psi", "closure.S.sde.damping_ratio"));
  sde.damping[kPsi] = 0.0;
  sde.damping_ratio.reset();
  sde.form = SdeForm::three_springs;
  EXPECT_THAT(paths(linkage), IsEmpty());
  sde.directions.row(2) = sde.directions.row(1);
  EXPECT_THAT(paths(linkage), ElementsAre("closure.S.sde.directions"));
  sde.form = SdeForm::line_of_centres;
  linkage.closures[0].type = JointType::prismatic;
  EXPECT_THAT(paths(linkage), ElementsAre("closure.S.sde.form"));
}

TEST(Check, A_sliding_element_turns_with_its_first_end_unless_it_holds_all_directions_alike) {
  Linkage linkage = make_tree();
  linkage.closures = {make_closure("b", "d")};
  linkage.closures[0].model = ClosureModel::sde;
  Sde& sde = linkage.closures[0].sde;
  for (const JointType type : {JointType::prismatic, JointType::cylindrical, JointType::planar}) {
    linkage.closures[0].type = type;
    sde = {};
    sde.stiffness = {0, 5, 5, 1, 1, 1};
    EXPECT_THAT(paths(linkage), ElementsAre("closure.S.sde.axes"));
    EXPECT_THAT(only_message(linkage), HasSubstr("closure 'S': axes = \"ground\""));
    sde.axes = SdeAxes::first;
    EXPECT_THAT(paths(linkage), IsEmpty());
    sde.axes = SdeAxes::ground;
    sde.stiffness[kX] = 5;
    EXPECT_THAT(paths(linkage), IsEmpty());
    sde.damping[kY] = 0.5;
    EXPECT_THAT(paths(linkage), ElementsAre("closure.S.sde.axes"));
    sde.damping_ratio = 0.7;  // takes the place of damping
    EXPECT_THAT(paths(linkage), IsEmpty());
  }
  linkage.closures[0].type = JointType::revolute;  // no free translation: any axes, any stiffness
  sde.stiffness[kX] = 7;
  EXPECT_THAT(paths(linkage), IsEmpty());
}

TEST(Check, A_spring_of_a_joint_has_an_entry_for_each_coordinate_and_is_nowhere_negative) {
  Linkage linkage = make_tree();
  Joint& a = linkage.joints[0];
  a.stiffness = {1.0};
  a.damping = {0.0};
  a.rest = {-2.0};
  EXPECT_THAT(paths(linkage), IsEmpty());
  a.stiffness = {-1.0};
  a.damping = {std::nan("")};
  a.rest = {std::numeric_limits<double>::infinity()};
  EXPECT_THAT(paths(linkage), ElementsAre("joint.A.spring.stiffness", "joint.A.spring.damping",
                                          "joint.A.spring.rest"));
  a.stiffness = a.damping = a.rest = {1.0, 2.0};
  EXPECT_THAT(paths(linkage), ElementsAre("joint.A.spring.stiffness", "joint.A.spring.damping",
                                          "joint.A.spring.rest"));
}

TEST(Check, A_spring_of_a_ball_acts_on_angles_and_not_on_a_quaternion) {
  Linkage linkage = make_tree();
  Joint& a = linkage.joints[0];
  a.type = JointType::spherical;
  a.stiffness = {1.0, 2.0, -3.0};
  EXPECT_THAT(paths(linkage), ElementsAre("joint.A.spring.stiffness.2"));
  a.stiffness[2] = 3.0;
  EXPECT_THAT(paths(linkage), IsEmpty());
  a.coordinates = RotationCoordinates::quaternion;
  EXPECT_THAT(paths(linkage), ElementsAre("joint.A.spring"));
}

TEST(Check, Loads_name_an_existing_coordinate_or_link) {
  Linkage linkage = make_tree();
  linkage.loads.assign(5, make_drive("A"));
  for (std::size_t i = 0; i < 5; ++i) linkage.loads[i].name = "F" + std::to_string(i);
  linkage.loads[0].joint = "X";
  linkage.loads[1].coordinate = 1;
  linkage.loads[2].coordinate = -1;
  linkage.loads[3].type = LoadType::link_force;
  linkage.loads[3].link = "ground";
  linkage.loads[4].type = LoadType::link_torque;
  linkage.loads[4].link = "a";
  linkage.loads[4].direction = Eigen::Vector3d(1, 1, 0);
  EXPECT_THAT(paths(linkage), ::testing::UnorderedElementsAre("load.F0.joint", "load.F1.coordinate",
                                                              "load.F2.coordinate", "load.F3.link",
                                                              "load.F4.direction"));
}

TEST(Check, Courses_and_laws_have_positive_durations_and_speeds) {
  Linkage linkage = make_tree();
  linkage.loads.assign(4, make_drive("A"));
  for (std::size_t i = 0; i < 4; ++i) linkage.loads[i].name = "F" + std::to_string(i);
  linkage.loads[0].course.shape = CourseShape::ramp;
  linkage.loads[1].course.shape = CourseShape::table;
  linkage.loads[2].course = {CourseShape::table, 0.0, 0.0, {0.0, 2.0, 1.0}, {0.0, 0.0, 0.0}};
  linkage.loads[3].type = LoadType::resistance;
  linkage.loads[3].law.at_speed = 0.0;
  EXPECT_THAT(paths(linkage), ElementsAre("load.F0.course.duration", "load.F1.course.values",
                                          "load.F2.course.times.2", "load.F3.law.at_speed"));
}

TEST(Check, Courses_that_repeat_have_room_in_their_period_and_tables_what_they_go_over) {
  Linkage linkage = make_tree();
  linkage.loads.assign(9, make_drive("A"));
  for (std::size_t i = 0; i < 9; ++i) {
    Course& course = linkage.loads[i].course;
    linkage.loads[i].name = "F" + std::to_string(i);
    course = {CourseShape::table, 0.0, 0.0, {}, {0.0, 1.0}};
    course.over = JointCoordinate{"A", 0};
    course.positions = {-1.0, 1.0};
    course.period = 2.0 * (1.0 - 1e-15);
  }
  EXPECT_THAT(paths(linkage), IsEmpty());
  const auto course = [&](std::size_t i) -> Course& { return linkage.loads[i].course; };
  course(0).period = 1.9;
  course(1).period = 0.0;
  course(2).positions = {0.0};
  course(2).values = {0.0};
  course(3).positions.swap(course(3).times);
  course(4).over.reset();
  course(5).over->joint = "X";
  course(6).over->coordinate = 1;
  course(7).positions = {1.0, -1.0};
  course(8) = {CourseShape::ramp, 1.0, 0.5, {}, {}};
  course(8).period = 0.4;
  EXPECT_THAT(
      paths(linkage),
      ::testing::UnorderedElementsAre(
          "load.F0.course.period", "load.F1.course.period", "load.F2.course.period",
          "load.F3.course.times", "load.F4.course.positions", "load.F5.course.over.joint",
          "load.F6.course.over.coordinate", "load.F7.course.positions.1", "load.F8.course.period"));
}

TEST(Check, A_point_is_on_a_link_or_on_ground_at_a_finite_place) {
  Linkage linkage = make_tree();
  linkage.points.assign(4, {"", "a", Eigen::Vector3d::Ones()});
  for (std::size_t i = 0; i < 4; ++i) linkage.points[i].name = "P" + std::to_string(i);
  linkage.points[0].link = "ground";
  linkage.points[1].link = "f";
  linkage.points[2].position.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(paths(linkage), ElementsAre("point.P1.link", "point.P2.position"));
  linkage.points.resize(2);
  EXPECT_THAT(only_message(linkage), HasSubstr("point 'P1': link is not a link, got 'f'"));
}

TEST(Check, Every_wrong_size_of_a_shape_is_located) {
  Linkage linkage = make_tree();
  Solid thin{.diameter = 0.0, .frame = {}}, point{.end = Eigen::Vector3d::Zero(), .frame = {}};
  Solid flat{.kind = SolidKind::box, .diameter = 0.0, .sides = {1.0, -1.0, 0.0}, .frame = {}};
  Solid lost{.kind = SolidKind::sphere, .end = Eigen::Vector3d::Zero(), .frame = {}};
  lost.frame.position.x() = std::numeric_limits<double>::infinity();
  Solid skew{.kind = SolidKind::box, .frame = {}};
  skew.frame.rotation(0, 1) = 0.1;
  linkage.links[1].shape = {thin, point, flat, lost, skew};
  EXPECT_THAT(paths(linkage), ElementsAre("link.b.shape.0.diameter", "link.b.shape.1.end",
                                          "link.b.shape.2.sides.1", "link.b.shape.2.sides.2",
                                          "link.b.shape.3.position", "link.b.shape.4.rotation"));
  linkage.links[1].shape = {point};
  EXPECT_EQ(only_message(linkage), "link 'b': shape 0: begin and end are the same point [0, 0, 0]");
}

}  // namespace
}  // namespace linkstudy::check_linkage_test
