#include "tests/mechanisms/bennett.h"

#include <cmath>

#include "tests/mechanisms/frames.h"
#include "tests/mechanisms/joint_at.h"

namespace linkstudy::testing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Link bar(const std::string& name, double mass, double length) {
  const double J = mass * length * length / 12.0;
  return {name, mass, Vector3d(length / 2, 0, 0), Vector3d(0.01 * J, J, J).asDiagonal()};
}

// Tx(length) Rx(twist), and its inverse.
Frame along(double length, double twist) {
  return {rotation_about(0, twist), Vector3d(length, 0, 0)};
}
Frame back(double length, double twist) {
  return {rotation_about(0, -twist), Vector3d(-length, 0, 0)};
}

Frame as_closure_axis(Frame frame) {
  frame.rotation = frame.rotation * x_along_z();
  return frame;
}

}  // namespace

double BennettGeometry::b() const {
  return a * std::sin(beta) / std::sin(alpha);
}

Linkage bennett(const BennettGeometry& g) {
  const double b = g.b();
  const double product = std::sin((g.beta + g.alpha) / 2) / std::sin((g.beta - g.alpha) / 2);
  const double second = 2 * std::atan(product / std::tan(g.crank / 2));
  const double second_rate = -g.rate * std::sin(second) / std::sin(g.crank);
  Linkage linkage;
  linkage.name = "bennett";
  linkage.gravity = Vector3d(0, -9.81, 0);
  linkage.links = {bar("crank", 1.0, g.a), bar("coupler", 1.5, b), bar("follower", 1.0, -g.a)};
  linkage.joints = {pivot_at("A", kGround, "crank", {}, g.crank, g.rate),
                    pivot_at("B", "crank", "coupler", along(g.a, g.alpha), second, second_rate),
                    pivot_at("D", kGround, "follower", back(b, g.beta), second, second_rate)};
  Closure C;
  C.name = "C";
  C.type = JointType::revolute;
  C.first = {"coupler", as_closure_axis(along(b, g.beta))};
  C.second = {"follower", as_closure_axis(back(g.a, g.alpha))};
  linkage.closures = {C};
  return linkage;
}

}  // namespace linkstudy::testing
