#include "tests/support/trace_contact.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace linkstudy::testing {
namespace {

double loss_factor(const Clearance& c) {
  const double e = c.restitution;
  if (c.law == ContactLaw::lankarani_nikravesh) return 3.0 * (1.0 - e * e) / 4.0;
  if (c.law == ContactLaw::hunt_crossley) return 3.0 * (1.0 - e) / 2.0;
  return 8.0 * (1.0 - e) / (5.0 * e);
}

double stiffness_of(const Clearance& c) {
  if (c.stiffness) return *c.stiffness;
  const auto h = [](const Material& m) { return (1.0 - m.poisson * m.poisson) / m.young; };
  const double r_b = c.bearing_radius, r_j = r_b - c.radial;
  return 4.0 / (3.0 * (h(c.bearing) + h(c.journal))) * std::sqrt(r_b * r_j / (r_b - r_j));
}

// Where a point of the ground lies in a carried frame, how it moves with it, and dr/dq.
struct MaterialPoint {
  Eigen::Vector3d velocity;
  Matrix r_q;  // (3 x dof)
};

MaterialPoint material_point(const CarriedFrame& frame, const Eigen::Vector3d& ground) {
  Vector r(4);
  r << ground, 1.0;
  const Vector local = frame.T.partialPivLu().solve(r);
  MaterialPoint point;
  point.velocity = (frame.T_dot * local).head(3);
  point.r_q.resize(3, static_cast<int>(frame.T_i.size()));
  for (std::size_t i = 0; i < frame.T_i.size(); ++i) {
    point.r_q.col(static_cast<int>(i)) = (frame.T_i[i] * local).head(3);
  }
  return point;
}

// Coefficient of friction (14) and rate of the bristle (15).
double friction_coefficient(const Friction& f, double z, double v, double& z_rate) {
  const double sign = v > 0.0 ? 1.0 : v < 0.0 ? -1.0 : 0.0;
  const double g = f.mu_k + (f.mu_s - f.mu_k) * std::exp(-std::pow(v / f.v_s, 2));
  z_rate = v * (1.0 - f.sigma0 * z * sign / g);
  const double weight = f.v_d > 0.0 ? std::exp(-std::pow(v / f.v_d, 2)) : 1.0;
  return f.sigma0 * z + f.sigma1 * weight * z_rate + f.sigma2 * v;
}

}  // namespace

ContactResult contact_result(const TraceClosure& closure, const ClosureFrames& frames,
                             const OracleContact& contact) {
  const Clearance& c = closure.closure.clearance;
  if (c.kind != ClearanceKind::planar) throw std::invalid_argument("oracle: planar clearance only");
  const CarriedFrame& bearing = c.bearing_is_first ? frames.first : frames.second;
  const CarriedFrame& journal = c.bearing_is_first ? frames.second : frames.first;
  const Eigen::Vector3d axis = bearing.T.col(0).head(3);
  const auto across = [&](const Eigen::Vector3d& x) {
    return Eigen::Vector3d(x - axis * axis.dot(x));
  };
  const Eigen::Vector3d centre = bearing.T.col(3).head(3);
  const Eigen::Vector3d e = across(centre - journal.T.col(3).head(3));
  const Eigen::Vector3d e_dot = (bearing.T_dot - journal.T_dot).col(3).head(3);

  ContactResult result;
  result.generalised = Vector::Zero(static_cast<int>(bearing.T_i.size()));
  result.depth = e.norm() - c.radial;
  result.touches = result.depth > 0.0;
  if (!result.touches) return result;
  result.rate = e.dot(e_dot) / e.norm();
  const double elastic = stiffness_of(c) * std::pow(result.depth, c.exponent);
  double v0 = std::max(contact.approach, c.least_speed);
  if (c.approach == ApproachSpeed::greatest) v0 = std::max(v0, std::abs(result.rate));
  result.normal = std::max(elastic * (1.0 + loss_factor(c) * result.rate / v0), 0.0);
  result.stored = elastic * result.depth / (c.exponent + 1.0);

  const Eigen::Vector3d u = -e / e.norm(), t = axis.cross(u);
  result.point = centre + c.bearing_radius * u;
  const MaterialPoint on_bearing = material_point(bearing, result.point);
  const double apart = c.points == ContactPoints::two ? result.depth : 0.0;
  const MaterialPoint on_journal = material_point(journal, result.point + apart * u);
  result.sliding = t.dot(on_journal.velocity - on_bearing.velocity);
  if (c.friction) {
    result.friction = result.normal * friction_coefficient(*c.friction, contact.bristle,
                                                           result.sliding, result.bristle_rate);
  }
  const Eigen::Vector3d f = result.normal * u + result.friction * t;  // on the bearing
  result.generalised = (on_bearing.r_q - on_journal.r_q).transpose() * f;
  result.force = c.bearing_is_first ? f : Eigen::Vector3d(-f);
  result.dissipated_power =
      (result.normal - elastic) * result.rate + result.friction * result.sliding;
  return result;
}

}  // namespace linkstudy::testing
