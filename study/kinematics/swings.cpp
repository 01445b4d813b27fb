#include "study/kinematics/swings.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/numerics/bracketed_root.h"

namespace linkstudy {
namespace {

constexpr double kResting = 1e-9;  // rad or m
constexpr double kTurn = 2.0 * std::numbers::pi * (1.0 - 1e-9);
constexpr int kBisections = 60;  // of a golden section: below rounding

// Position, rate and second rate at an instant.
struct Knot {
  double t, q, v, a;
  bool is_known() const { return std::isfinite(v) && std::isfinite(a); }
};

// The quintic between two of them, 0 <= x <= 1.
class Quintic {
 public:
  Quintic(const Knot& a, const Knot& b) : h_(b.t - a.t) {
    c_[0] = a.q;
    c_[1] = h_ * a.v;
    c_[2] = 0.5 * h_ * h_ * a.a;
    const double e = b.q - a.q - c_[1] - c_[2];
    const double f = h_ * (b.v - a.v) - 2.0 * c_[2];
    const double g = 0.5 * h_ * h_ * (b.a - a.a);
    c_[3] = 10.0 * e - 4.0 * f + g;
    c_[4] = -15.0 * e + 7.0 * f - 2.0 * g;
    c_[5] = 6.0 * e - 3.0 * f + g;
  }
  double value(double x) const {
    return c_[0] + x * (c_[1] + x * (c_[2] + x * (c_[3] + x * (c_[4] + x * c_[5]))));
  }
  double slope(double x) const {
    return c_[1] + x * (2 * c_[2] + x * (3 * c_[3] + x * (4 * c_[4] + x * 5 * c_[5])));
  }

 private:
  double h_;
  std::array<double, 6> c_{};
};

const std::vector<double>& numbers_of(const Table& table, const std::string& name) {
  return std::get<std::vector<double>>(find_column(table, name)->values);
}

// "joint.D.v.1" of "joint.D.q.1"
std::string rate_name(const std::string& coordinate, char rate) {
  std::string name = coordinate;
  name[name.find(".q", name.find('.') + 1) + 1] = rate;
  return name;
}

std::vector<Knot> knots_of(const Table& course, const std::string& coordinate) {
  const auto& t = numbers_of(course, "time");
  const auto& q = numbers_of(course, coordinate);
  const auto& v = numbers_of(course, rate_name(coordinate, 'v'));
  const auto& a = numbers_of(course, rate_name(coordinate, 'a'));
  std::vector<Knot> knots;
  for (std::size_t i = 0; i < t.size(); ++i) knots.push_back({t[i], q[i], v[i], a[i]});
  return knots;
}

void see(double t, double q, Swing& swing) {
  if (q < swing.least.value) swing.least = {q, t, {}};
  if (q > swing.greatest.value) swing.greatest = {q, t, {}};
}

void see_between(const Knot& a, const Knot& b, Swing& swing) {
  if (!a.is_known() || !b.is_known() || !(a.v * b.v < 0.0)) return;
  const Quintic between(a, b);
  const auto slope = [&](double x) { return between.slope(x); };
  const double first = between.slope(0.0), last = between.slope(1.0);
  const double x = bracket_root(slope, 0.0, 1.0, first, last).first;
  see(a.t + x * (b.t - a.t), between.value(x), swing);
}

// "D" of "joint.D.q.1"
std::string owner_of(const std::string& coordinate) {
  const std::size_t first = coordinate.find('.') + 1;
  return coordinate.substr(first, coordinate.find('.', first) - first);
}

bool is_on_ground(const Mechanism& m, const std::string& coordinate) {
  const auto index = [](const std::vector<std::string>& names, const std::string& name) {
    return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
  };
  const std::string owner = owner_of(coordinate);
  if (coordinate.starts_with("joint."))
    return m.bodies[BodyIndex(index(m.joint_names, owner))].parent == kGroundBody;
  const ClosureStructure& c = m.closures[ClosureIndex(index(m.closure_names, owner))];
  return c.first == kGroundBody || c.second == kGroundBody;
}

bool is_coordinate(const Column& column) {
  const std::size_t second = column.name.find('.', column.name.find('.') + 1);
  const bool is_position = second != std::string::npos && column.name[second + 1] == 'q';
  return is_position && (column.unit == "rad" || column.unit == "m") &&
         !column.name.starts_with("point.");
}

// State between two poses, each coordinate by its quintic. Without quaternions.
State<double> between(const DrivenPose& a, const DrivenPose& b, double t) {
  State<double> s = a.s;
  const double x = (t - a.time) / (b.time - a.time);
  for (std::size_t i = 0; i < s.q.size(); ++i) {
    s.q[PositionIndex(i)] =
        Quintic({a.time, a.s.q[PositionIndex(i)], a.s.v[VelocityIndex(i)], a.a[i]},
                {b.time, b.s.q[PositionIndex(i)], b.s.v[VelocityIndex(i)], b.a[i]})
            .value(x);
  }
  return s;
}

// The least angle next to a position that has the least of all, by golden sections.
SwingEnd refine_least(const TransmissionLoop& loop, const DriveCycle& cycle, std::size_t least,
                      const std::vector<double>& angles) {
  SwingEnd best{angles[least], cycle.poses[least].time, {}};
  const State<double>& any = cycle.poses[least].s;
  if (any.q.size() != any.v.size()) return best;
  constexpr double kGoldenPart = 0.6180339887498949;
  for (const std::size_t i : {least, least + 1}) {
    if (i == 0 || i >= cycle.poses.size()) continue;
    const DrivenPose &a = cycle.poses[i - 1], &b = cycle.poses[i];
    if (a.is_singular || b.is_singular) continue;
    const auto angle = [&](double t) { return loop.angle(between(a, b, t)); };
    double low = a.time, high = b.time;
    for (int k = 0; k < kBisections; ++k) {
      const double first = high - kGoldenPart * (high - low);
      const double second = low + kGoldenPart * (high - low);
      (angle(first) < angle(second) ? high : low) = angle(first) < angle(second) ? second : first;
    }
    const double t = 0.5 * (low + high);
    if (angle(t) < best.value) best = {angle(t), t, {}};
  }
  return best;
}

}  // namespace

std::vector<Swing> find_swings(const Mechanism& mechanism, const KinematicsCourse& path,
                               const std::vector<std::string>& driven, const Table& course) {
  std::vector<Swing> swings;
  if (row_count(course) == 0) return swings;
  for (const Column& column : course.columns) {
    if (!is_coordinate(column)) continue;
    const std::vector<Knot> knots = knots_of(course, column.name);
    Swing swing;
    swing.coordinate = column.name;
    swing.is_angle = column.unit == "rad";
    swing.is_on_ground = is_on_ground(mechanism, column.name);
    swing.is_driven = std::ranges::count(driven, column.name) > 0;
    swing.least = swing.greatest = {knots.front().q, knots.front().t, {}};
    for (std::size_t i = 0; i < knots.size(); ++i) {
      see(knots[i].t, knots[i].q, swing);
      if (i > 0) see_between(knots[i - 1], knots[i], swing);
    }
    for (SwingEnd* end : {&swing.least, &swing.greatest})
      end->drive = path.path.position(end->time);
    const double way = swing.greatest.value - swing.least.value;
    swing.motion = way <= kResting                  ? JointMotion::rests
                   : swing.is_angle && way >= kTurn ? JointMotion::turns
                                                    : JointMotion::swings;
    swings.push_back(std::move(swing));
  }
  return swings;
}

std::vector<TransmissionAngles> find_transmission_angles(const Model& closed,
                                                         const KinematicsCourse& path,
                                                         const DriveCycle& cycle,
                                                         const State<double>& start) {
  std::vector<TransmissionAngles> all;
  if (path.drives.size() != 1 || cycle.poses.empty()) return all;
  for (const BasicLoop& loop : find_basic_loops(closed.mechanism)) {
    const auto found = TransmissionLoop::find(closed, loop, path.drives.front(), start);
    if (!found) continue;
    TransmissionAngles one{found->output(), {}, {}};
    for (const DrivenPose& pose : cycle.poses) one.angle.push_back(found->angle(pose.s));
    const auto least =
        static_cast<std::size_t>(std::ranges::min_element(one.angle) - one.angle.begin());
    one.least = refine_least(*found, cycle, least, one.angle);
    one.least.drive = path.path.position(one.least.time);
    all.push_back(std::move(one));
  }
  return all;
}

}  // namespace linkstudy
