#include "tests/mechanisms/repeating_loads.h"

namespace linkstudy::testing {

void add_repeating_loads(const std::string& joint, const std::string& link, double size,
                         Linkage& linkage) {
  Load drive;
  drive.name = "saw";
  drive.joint = joint;
  drive.course = {CourseShape::table, 0.0, 0.0, {0.001, 0.004, 0.009}, {0.0, size, 0.3 * size}};
  drive.course.period = 0.01;
  Load press;
  press.name = "press";
  press.type = LoadType::link_force;
  press.link = link;
  press.point = {0.02, 0.01, 0.0};
  press.direction = Eigen::Vector3d(0.6, 0.0, -0.8);
  press.course = {CourseShape::table, 0.0, 0.0, {}, {size, -0.5 * size, 0.8 * size}};
  press.course.over = JointCoordinate{joint, 0};
  press.course.positions = {-0.4, 0.3, 0.9};
  press.course.period = 1.7;
  Load twist = press;
  twist.name = "twist";
  twist.type = LoadType::link_torque;
  twist.follows_link = true;
  twist.course = {CourseShape::smooth, 0.1 * size, 0.02, {}, {}};
  twist.course.period = 0.03;
  PointSpring cylinder;
  cylinder.name = "cylinder_over";
  cylinder.first = {kGround, {0.4, -0.3, 0.2}};
  cylinder.second = {link, {0.0, 0.02, 0.01}};
  cylinder.course = Course{CourseShape::table, 0.0, 0.0, {}, {-size, 0.4 * size, size}};
  cylinder.course->over = JointCoordinate{joint, 0};
  cylinder.course->positions = {-0.6, 0.1, 0.7};
  for (const Load& load : {drive, press, twist}) linkage.loads.push_back(load);
  linkage.springs.push_back(cylinder);
}

}  // namespace linkstudy::testing
