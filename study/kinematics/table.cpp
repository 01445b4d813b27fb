#include "study/kinematics/table.h"

#include <fmt/format.h>

#include <limits>

#include "core/kinematics/link_poses.h"
#include "core/kinematics/point_motion.h"
#include "core/simulation/channels.h"
#include "study/kinematics/report.h"

namespace linkstudy {
namespace {

using Eigen::VectorXd;

// Columns and cells in one order: every part adds its columns once and its cells row by row.
class TableBuilder {
 public:
  TableBuilder(const Model& closed, const KinematicsResult& result)
      : closed_(closed), result_(result) {
    for (const Channel& channel : list_channels(closed.mechanism)) {
      const bool is_wanted = channel.quantity == Quantity::q || channel.quantity == Quantity::v ||
                             channel.quantity == Quantity::a;
      if (is_wanted) channels_.push_back(channel);
    }
    for (const ClosureIndex i : indices_of(closed.mechanism.closures)) {
      cut_joints_.push_back(cut_joint_of(closed.mechanism, i));
    }
  }

  Table build() {
    add_columns();
    for (std::size_t row = 0; row < result_.cycle.poses.size(); ++row) {
      const DrivenPose& pose = result_.cycle.poses[row];
      std::vector<double> cells = {pose.time};
      add_joints(pose, cells);
      add_closures(pose, cells);
      add_points(pose, cells);
      cells.push_back(pose.quality);
      cells.push_back(pose.residual);
      cells.push_back(result_.freedoms[row]);
      for (const LoopResult& loop : result_.loops) cells.push_back(loop.conditioning[row]);
      append_row(table_, cells);
    }
    return std::move(table_);
  }

 private:
  const Mechanism& mechanism() const { return closed_.mechanism; }

  void add_columns() {
    table_.columns.push_back({"time", "s"});
    for (const Channel& channel : channels_) table_.columns.push_back({channel.name, channel.unit});
    for (std::size_t i = 0; i < cut_joints_.size(); ++i) add_closure_columns(i);
    for (const std::string& name : mechanism().point_names) add_point_columns(name);
    table_.columns.push_back({"quality", "1"});
    table_.columns.push_back({"residual", "1"});
    table_.columns.push_back({"mobility", "1"});
    for (const LoopResult& loop : result_.loops) {
      table_.columns.push_back({cut_of(loop.loop) + ".conditioning", "1"});
    }
  }

  void add_closure_columns(std::size_t i) {
    const CutJoint& joint = cut_joints_[i];
    const auto add = [&](const char* quantity, int count, const char* of_shift,
                         const char* of_turn) {
      for (int k = 0; k < count; ++k) {
        const bool shifts = k < static_cast<int>(joint.shifts.size());
        const std::string number = count > 1 ? fmt::format(".{}", k) : "";
        table_.columns.push_back(
            {fmt::format("closure.{}.{}{}", mechanism().closure_names[ClosureIndex(i)], quantity,
                         number),
             shifts ? of_shift : of_turn});
      }
    };
    add("q", joint.position_count(), "m", joint.turns == 3 ? "1" : "rad");
    add("v", joint.velocity_count(), "m/s", "rad/s");
    add("a", joint.velocity_count(), "m/s^2", "rad/s^2");
  }

  void add_point_columns(const std::string& name) {
    const std::pair<const char*, const char*> quantities[] = {
        {"position", "m"}, {"velocity", "m/s"}, {"acceleration", "m/s^2"}};
    for (const auto& [quantity, unit] : quantities) {
      for (const char* axis : {"x", "y", "z"}) {
        table_.columns.push_back({fmt::format("point.{}.{}.{}", name, quantity, axis), unit});
      }
    }
  }

  static double rate(const DrivenPose& pose, double value) {
    return pose.is_singular ? std::numeric_limits<double>::quiet_NaN() : value;
  }

  void add_joints(const DrivenPose& pose, std::vector<double>& cells) const {
    for (const Channel& channel : channels_) {
      const auto i = static_cast<std::size_t>(channel.index);
      if (channel.quantity == Quantity::q) {
        cells.push_back(pose.s.q[PositionIndex(i)]);
      } else {
        cells.push_back(
            rate(pose, channel.quantity == Quantity::v ? pose.s.v[VelocityIndex(i)] : pose.a[i]));
      }
    }
  }

  void add_closures(const DrivenPose& pose, std::vector<double>& cells) {
    std::vector<CutJointMotion> motions = cut_joint_motions(
        mechanism(), closed_.parameters, pose.s.q.data(), pose.s.v.data(), pose.a.data());
    before_.resize(motions.size());
    for (std::size_t i = 0; i < motions.size(); ++i) {
      VectorXd& q = motions[i].position;
      if (before_[i].size() > 0) continue_position(cut_joints_[i], before_[i], q);
      before_[i] = q;
      for (const double x : q) cells.push_back(x);
      for (const double x : motions[i].velocity) cells.push_back(rate(pose, x));
      for (const double x : motions[i].acceleration) cells.push_back(rate(pose, x));
    }
  }

  void add_points(const DrivenPose& pose, std::vector<double>& cells) const {
    for (const PointMotion& point : point_motions(mechanism(), closed_.parameters, pose.s.q.data(),
                                                  pose.s.v.data(), pose.a.data())) {
      const auto add = [&](const Vec3<double>& a, bool is_rate) {
        for (const double x : {a.x, a.y, a.z}) cells.push_back(is_rate ? rate(pose, x) : x);
      };
      add(point.position, false);
      add(point.velocity, true);
      add(point.acceleration, true);
    }
  }

  const Model& closed_;
  const KinematicsResult& result_;
  std::vector<Channel> channels_;
  std::vector<CutJoint> cut_joints_;
  std::vector<VectorXd> before_;  // positions of the cut joints in the last row
  Table table_;
};

}  // namespace

Table kinematics_table(const Model& closed, const KinematicsResult& result) {
  return TableBuilder(closed, result).build();
}

Table pose_table(const Linkage& linkage, const Model& closed, const KinematicsResult& result) {
  const std::vector<std::string>& names = closed.mechanism.link_names;
  Table table;
  table.columns.push_back({"time", "s"});
  for (std::size_t b = 1; b < names.size(); ++b) {
    for (const char* part :
         {"e.w", "e.x", "e.y", "e.z", "position.x", "position.y", "position.z"}) {
      table.columns.push_back(
          {fmt::format("link.{}.{}", names[b], part), *part == 'e' ? "1" : "m"});
    }
  }
  std::vector<ShortenedDualQuaternion> before;
  for (const DrivenPose& pose : result.cycle.poses) {
    std::vector<ShortenedDualQuaternion> links = link_poses(linkage, closed, pose.s);
    std::vector<double> cells = {pose.time};
    for (std::size_t b = 1; b < links.size(); ++b) {
      if (!before.empty() && before[b].e.dot(links[b].e) < 0.0) links[b].e *= -1.0;
      for (const double x : links[b].e) cells.push_back(x);
      for (const double x : links[b].r) cells.push_back(x);
    }
    before = std::move(links);
    append_row(table, cells);
  }
  return table;
}

}  // namespace linkstudy
