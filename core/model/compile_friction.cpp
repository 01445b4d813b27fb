#include "core/model/compile_friction.h"

namespace linkstudy {
namespace {

void add_constant_friction(const Joint& joint, BodyIndex number, const Body& body, Model& model) {
  const JointFriction& f = *joint.friction;
  const bool is_ball = joint.coordinates == RotationCoordinates::quaternion;
  const auto rub = [&](int first, int count, std::array<double, 3> arm, bool turns) {
    const bool has_angles = turns && count == 3 && !is_ball;
    model.mechanism.constant_frictions.push_back(
        {number, body.v_begin + first, count, turns, has_angles, add_bristles(count, model)});
    model.parameters.constant_frictions.push_back({lugre_parameters(f.law), arm, f.preload});
  };
  const double r = f.radius;
  switch (joint.type) {
    case JointType::revolute:
    case JointType::screw:
      return rub(0, 1, {r, 0, 0}, true);
    case JointType::prismatic:
      return rub(0, 1, {1, 0, 0}, false);
    case JointType::cylindrical:
      return rub(0, 2, {r, 1, 0}, true);
    case JointType::universal:
      rub(0, 1, {r, 0, 0}, true);
      return rub(1, 1, {r, 0, 0}, true);
    case JointType::spherical:
      return rub(0, 3, {r, r, r}, true);
    case JointType::planar:
      rub(0, 2, {1, 1, 0}, false);
      if (r > 0.0) rub(2, 1, {r, 0, 0}, true);
      return;
    case JointType::free:
      rub(0, 3, {1, 1, 1}, false);
      if (r > 0.0) rub(3, 3, {r, r, r}, true);
      return;
    case JointType::fixed:
    case JointType::pin_in_slot:
    case JointType::rod:
      return;
  }
}

}  // namespace

LugreParameters<double> lugre_parameters(const Friction& f) {
  return {f.mu_s, f.mu_k, f.v_s, f.sigma0, f.sigma1, f.sigma2, f.v_d};
}

BristleIndex add_bristles(int count, Model& model) {
  const BristleIndex first(model.mechanism.nz);
  model.mechanism.nz += count;
  model.start.z.resize(static_cast<std::size_t>(model.mechanism.nz), 0.0);
  return first;
}

void add_joint_friction(const Joint& joint, BodyIndex number, const Body& body, Model& model) {
  const JointFriction& f = *joint.friction;
  if (f.load == FrictionLoad::constant) return add_constant_friction(joint, number, body, model);
  JointFrictionStructure s{.body = number, .z = add_bristles(body.v_count, model)};
  if (joint.type != JointType::prismatic) s.turn = body.v_begin;
  if (joint.type != JointType::revolute) s.slide = body.v_begin + (body.v_count - 1);
  model.mechanism.frictions.push_back(s);
  const auto inverse = [](double x) { return x > 0.0 ? 1.0 / x : 0.0; };
  model.parameters.frictions.push_back(
      {lugre_parameters(f.law), f.radius, inverse(f.length), inverse(f.radius), f.preload});
}

}  // namespace linkstudy
