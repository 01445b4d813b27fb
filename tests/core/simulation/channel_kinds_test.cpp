// What is said of a channel: there for every one, and true of the coordinates of every joint.
#include "core/simulation/channel_kinds.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "core/model/compile.h"
#include "tests/mechanisms/rsrrp.h"
#include "tests/support/free_bodies.h"

namespace linkstudy::testing::channel_kinds_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using ::testing::HasSubstr;

Linkage one_joint(JointType type, RotationCoordinates coordinates) {
  Linkage linkage;
  linkage.links = {{"body", 1.0, Vector3d::Zero(), Matrix3d::Identity()}};
  Joint joint;
  joint.name = "J";
  joint.type = type;
  joint.coordinates = coordinates;
  joint.pitch = 0.01;
  joint.parent = kGround;
  joint.child = "body";
  joint.frame.rotation = Eigen::AngleAxisd(0.4, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  linkage.joints = {joint};
  return linkage;
}

// The axis that a text ends its first phrase with: "turn of the child about the new y" is y.
Vector3d axis_in(const std::string& text) {
  for (const char* before : {"about the new ", "along the new ", "about ", "along "}) {
    const std::size_t at = text.find(before);
    if (at == std::string::npos) continue;
    const char axis = text[at + std::string(before).size()];
    return Vector3d::Unit(axis - 'x');
  }
  ADD_FAILURE() << "no axis in: " << text;
  return Vector3d::Zero();
}

// The motion of the texts, one coordinate after the other, in the joint frame of the parent.
struct Told {
  Matrix3d R = Matrix3d::Identity();
  Vector3d p = Vector3d::Zero();
};

Told told_motion(const Mechanism& m, const Eigen::VectorXd& q) {
  Told told;
  for (const Channel& channel : list_channels(m)) {
    if (channel.quantity != Quantity::q) continue;
    const std::string text = describe_channel(m, channel);
    const Vector3d axis = axis_in(text);
    const double value = q[channel.index];
    if (text.starts_with("turn")) {
      told.R = told.R * Eigen::AngleAxisd(value, axis).toRotationMatrix();
      if (text.find("advances") != std::string::npos) told.p += told.R * axis * value * 0.01;
    } else {
      told.p += told.R * axis * value;
    }
  }
  return told;
}

TEST(ChannelKinds, The_order_of_coordinates_is_told_as_it_is) {
  for (const JointType type :
       {JointType::revolute, JointType::prismatic, JointType::cylindrical, JointType::universal,
        JointType::spherical, JointType::planar, JointType::free}) {
    const Linkage linkage = one_joint(type, RotationCoordinates::zyx);
    const Mechanism m = compile(linkage).mechanism;
    Eigen::VectorXd q(m.nq);
    for (int i = 0; i < m.nq; ++i) q[i] = 0.3 + 0.2 * i;
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(m.nv);
    const LinkMotion motion = motion_of(link_motions(linkage, q, none, none), "body");
    const Told told = told_motion(m, q);
    const Matrix3d& frame = linkage.joints[0].frame.rotation;
    EXPECT_LT((motion.R - frame * told.R).norm(), 1e-13) << static_cast<int>(type);
    EXPECT_LT((motion.p - frame * told.p).norm(), 1e-13) << static_cast<int>(type);
  }
}

// With a quaternion the rates are told to be in the body frame: turned there, they are those that
// the oracle has in ground axes.
TEST(ChannelKinds, Rates_of_quaternions_are_told_as_they_are) {
  const Linkage linkage = one_joint(JointType::spherical, RotationCoordinates::quaternion);
  const Mechanism m = compile(linkage).mechanism;
  const Eigen::VectorXd q = Eigen::Vector4d(0.5, 0.1, -0.7, 0.5).normalized();
  const Vector3d v(0.3, -1.1, 0.6);
  const LinkMotion motion = motion_of(link_motions(linkage, q, v, Vector3d::Zero()), "body");
  Vector3d told = Vector3d::Zero();
  std::string parameters;
  for (const Channel& channel : list_channels(m)) {
    const std::string text = describe_channel(m, channel);
    if (channel.quantity == Quantity::q) {
      EXPECT_THAT(text, HasSubstr("Euler parameter"));
      parameters += text[std::string("Euler parameter ").size()];
    }
    if (channel.quantity != Quantity::v) continue;
    EXPECT_THAT(text, HasSubstr("body frame"));
    told += axis_in(text) * v[channel.index];
  }
  EXPECT_EQ(parameters, "wxyz");
  EXPECT_LT((motion.R * told - motion.omega).norm(), 1e-13);
}

TEST(ChannelKinds, Every_channel_has_a_unit_of_its_kind_and_a_meaning) {
  for (const Linkage& linkage : {rsrrp(), one_joint(JointType::free, RotationCoordinates::zyx)}) {
    const Mechanism m = compile(linkage).mechanism;
    for (const Channel& channel : list_channels(m)) {
      EXPECT_FALSE(describe_channel(m, channel).empty()) << channel.name;
      const std::string unit(kind_of(channel.quantity).unit);
      EXPECT_NE(("|" + unit + "|").find("|" + channel.unit + "|"), std::string::npos)
          << channel.name;
      EXPECT_THAT(channel.name, HasSubstr(std::string(kind_of(channel.quantity).label)));
    }
  }
}

TEST(ChannelKinds, A_name_alone_is_the_group_of_everything_under_it) {
  const std::vector<Channel> all = list_channels(compile(rsrrp()).mechanism);
  EXPECT_EQ(find_channel_group(all, "joint.A").size(), 15u);  // q v a, four vectors
  EXPECT_EQ(find_channel_group(all, "closure.S").size(), 9u);
  EXPECT_EQ(find_channel_group(all, "energy").size(), 5u);
  EXPECT_EQ(find_channel_group(all, "closure.S.force").size(), 3u);
  EXPECT_EQ(find_channel_group(all, "joint.A.q").size(), 1u);
  for (const char* none : {"", "joint.AA", "joint.A.forc", "energ", "."}) {
    EXPECT_TRUE(find_channel_group(all, none).empty()) << none;
  }
  for (const Channel& channel : find_channel_group(all, "joint.A")) {
    EXPECT_TRUE(channel.name.starts_with("joint.A.")) << channel.name;
  }
}

}  // namespace
}  // namespace linkstudy::testing::channel_kinds_test
