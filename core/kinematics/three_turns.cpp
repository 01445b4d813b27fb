#include "core/kinematics/three_turns.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "core/kinematics/forward_kinematics.h"
#include "core/kinematics/scaled_closures.h"
#include "core/spatial/to_eigen.h"

namespace linkstudy {
namespace {

bool turns_about_an_axis(BasicMotion motion) {
  return motion == BasicMotion::rx || motion == BasicMotion::ry || motion == BasicMotion::rz;
}

// First stage of three turns in a row, or none.
StageIndex first_of_three(const Mechanism& m, const Body& body) {
  int run = 0;
  for (const StageIndex i : stages_of(body)) {
    run = turns_about_an_axis(m.stages[i].motion) ? run + 1 : 0;
    if (run == 3) return i - 2;
  }
  return {};
}

// The middle angles of joints of which `fails` holds, with their values.
template <class Fails>
std::vector<std::string> name_angles(const Mechanism& m, Positions<const double> q,
                                     const Fails& fails) {
  std::vector<std::string> angles;
  for (const BodyIndex b : bodies_outwards(m)) {
    const Body& body = m.bodies[b];
    const StageIndex first = first_of_three(m, body);
    if (!first.exists()) continue;
    const Stage& middle = m.stages[first + 1];
    if (!fails(middle)) continue;
    char text[64];
    std::snprintf(text, sizeof text, ".%d = %.6g deg", middle.v - body.v_begin,
                  q[middle.q] * 180.0 / std::numbers::pi);
    angles.push_back("joint." + m.joint_names[b] + text);
  }
  return angles;
}

}  // namespace

Eigen::MatrixXd take_columns_by_turns(const Model& model, const State<double>& s,
                                      const Eigen::MatrixXd& jacobian,
                                      const std::vector<int>& columns) {
  constexpr double kRounding = 1e-9;
  const Mechanism& m = model.mechanism;
  Workspace<double> w = make_workspace<double>(m);
  update_kinematics(m, model.parameters, s.q.data(), s.v.data(), w);
  const auto has = [&](VelocityIndex v) {
    return std::count(columns.begin(), columns.end(), v.value()) > 0;
  };
  Eigen::MatrixXd j = jacobian;
  for (const BodyIndex b : bodies_outwards(m)) {
    const StageIndex stage = first_of_three(m, m.bodies[b]);
    if (!stage.exists()) continue;
    const VelocityIndex v = m.stages[stage].v;
    if (!has(v) || !has(v + 1) || !has(v + 2)) continue;
    Eigen::Matrix3d axes;
    for (int k = 0; k < 3; ++k) axes.col(k) = to_eigen(w.axes[v + k]);
    if (std::abs(axes.determinant()) < kRounding) continue;
    const Eigen::Matrix3d child = to_eigen(w.bodies[b].R_WB);
    j.middleCols<3>(v.value()) = jacobian.middleCols<3>(v.value()) * (axes.inverse() * child);
  }
  return take_columns(j, columns);
}

std::vector<std::string> singular_angles(const Mechanism& m, Positions<const double> q,
                                         double least) {
  return name_angles(m, q,
                     [&](const Stage& middle) { return std::abs(std::cos(q[middle.q])) < least; });
}

std::vector<std::string> lost_angles(const Mechanism& m, Positions<const double> q,
                                     Velocities<const double> v) {
  constexpr double kNear = 0.1;       // cos theta
  constexpr double kCancels = 0.1;    // of the larger rate, what is left of both
  constexpr double kOutgrown = 10.0;  // times the rate of theta, which stays what it was
  return name_angles(m, q, [&](const Stage& middle) {
    const auto rate = [&](int k) { return std::abs(v[middle.v + k]); };
    const double larger = std::max(rate(-1), rate(1));
    const bool cancels = std::abs(rate(1) - rate(-1)) < kCancels * larger;
    return std::abs(std::cos(q[middle.q])) < kNear || (cancels && larger > kOutgrown * rate(0));
  });
}

std::string singular_angles_text(const std::vector<std::string>& angles) {
  std::string text;
  for (const std::string& angle : angles) text += (text.empty() ? "" : ", ") + angle;
  if (text.empty()) return text;
  return text + ": the angles of a joint are singular at 90 deg; use coordinates = \"quaternion\"";
}

}  // namespace linkstudy
