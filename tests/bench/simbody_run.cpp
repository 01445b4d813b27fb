#include "tests/bench/simbody_run.h"

#include <Simbody.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

namespace linkstudy::testing {
namespace {

SimTK::Vec3 vec3(const Eigen::Vector3d& v) {
  return {v[0], v[1], v[2]};
}

SimTK::Transform transform(const Frame& frame) {
  SimTK::Mat33 R;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) R(i, j) = frame.rotation(i, j);
  return {SimTK::Rotation(R), vec3(frame.position)};
}

// Simbody wants the inertia about the link's origin.
SimTK::Body::Rigid rigid_body(const Link& link) {
  const Eigen::Matrix3d& I = link.inertia;
  const SimTK::Inertia central(I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2));
  const SimTK::Vec3 center = vec3(link.center_of_mass);
  return SimTK::Body::Rigid(
      SimTK::MassProperties(link.mass, center, central.shiftFromMassCenter(-center, link.mass)));
}

using Bodies = std::map<std::string, SimTK::MobilizedBody>;

SimTK::MobilizedBody add_joint(const Joint& joint, const Link& link, SimTK::MobilizedBody& parent) {
  const SimTK::Transform in_parent = transform(joint.frame);
  const SimTK::Transform in_child = transform(joint.child_frame);
  const SimTK::Body::Rigid body = rigid_body(link);
  if (joint.type == JointType::revolute) {
    return SimTK::MobilizedBody::Pin(parent, in_parent, body, in_child);
  }
  if (joint.type != JointType::prismatic) throw std::logic_error("joint " + joint.name);
  // Simbody's slider moves along x, ours along z.
  const SimTK::Transform z_to_x(SimTK::Rotation(-SimTK::Pi / 2, SimTK::YAxis));
  return SimTK::MobilizedBody::Slider(parent, in_parent * z_to_x, body, in_child * z_to_x);
}

// Ramp drives and linear resistances of joints with one coordinate.
class JointLoads : public SimTK::Force::Custom::Implementation {
 public:
  JointLoads(const Linkage& linkage, const Bodies& joints) {
    for (const Load& load : linkage.loads) {
      const bool drive = load.type == LoadType::drive && load.course.shape == CourseShape::ramp;
      const bool resistance =
          load.type == LoadType::resistance && load.law.shape == ResistanceShape::linear;
      if (!drive && !resistance) throw std::logic_error("load " + load.name);
      loads_.push_back({joints.at(load.joint), load});
    }
  }

  void calcForce(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>&,
                 SimTK::Vector_<SimTK::Vec3>&, SimTK::Vector& mobility_forces) const override {
    for (const auto& [joint, load] : loads_) {
      const double force =
          load.type == LoadType::drive
              ? load.course.value * std::min(state.getTime() / load.course.duration, 1.0)
              : -load.law.value * joint.getOneU(state, 0) / load.law.at_speed;
      joint.applyOneMobilityForce(state, 0, force, mobility_forces);
    }
  }

  SimTK::Real calcPotentialEnergy(const SimTK::State&) const override { return 0.0; }

 private:
  std::vector<std::pair<SimTK::MobilizedBody, Load>> loads_;
};

// f = C d + B d_dot on the first link at its closure point, -f on the second at its own;
// d = r2 - r1 in ground axes.
class SpringDamper : public SimTK::Force::Custom::Implementation {
 public:
  SpringDamper(const Closure& closure, const Bodies& links)
      : first_(links.at(closure.first.link)),
        second_(links.at(closure.second.link)),
        first_station_(vec3(closure.first.frame.position)),
        second_station_(vec3(closure.second.frame.position)),
        stiffness_(SimTK::Vec3::getAs(closure.sde.stiffness.data())),
        damping_(SimTK::Vec3::getAs(closure.sde.damping.data())) {}

  void calcForce(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>& body_forces,
                 SimTK::Vector_<SimTK::Vec3>&, SimTK::Vector&) const override {
    SimTK::Vec3 r1, v1, r2, v2;
    first_.findStationLocationAndVelocityInGround(state, first_station_, r1, v1);
    second_.findStationLocationAndVelocityInGround(state, second_station_, r2, v2);
    const SimTK::Vec3 force =
        stiffness_.elementwiseMultiply(r2 - r1) + damping_.elementwiseMultiply(v2 - v1);
    first_.applyForceToBodyPoint(state, first_station_, force, body_forces);
    second_.applyForceToBodyPoint(state, second_station_, -force, body_forces);
  }

  SimTK::Real calcPotentialEnergy(const SimTK::State& state) const override {
    const SimTK::Vec3 d = second_.findStationLocationInGround(state, second_station_) -
                          first_.findStationLocationInGround(state, first_station_);
    return 0.5 * SimTK::dot(d, stiffness_.elementwiseMultiply(d));
  }

 private:
  SimTK::MobilizedBody first_, second_;
  SimTK::Vec3 first_station_, second_station_, stiffness_, damping_;
};

}  // namespace

class SimbodyRun::System {
 public:
  explicit System(const Linkage& linkage) : matter_(system_), forces_(system_) {
    forces_.setNumberOfThreads(1);
    SimTK::Force::Gravity(forces_, matter_, vec3(linkage.gravity));
    add_links(linkage);
    add_closure(linkage.closures.at(0));
    system_.realizeTopology();
    state_ = system_.getDefaultState();
    system_.realizeModel(state_);
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      joints_[i].setOneQ(state_, 0, linkage.joints[i].position.at(0));
    }
    const SimTK::Vector& y = state_.getY();
    start_.assign(&y[0], &y[0] + y.size());
    for (auto* v : {&y_, &stage_, &k1_, &k2_, &k3_, &k4_}) *v = start_;
  }

  void restart() {
    t_ = 0.0;
    y_ = start_;
  }

  // Classical Runge-Kutta.
  void advance(double h, long steps) {
    for (long i = 0; i < steps; ++i) {
      slope(t_, y_, k1_);
      slope(t_ + 0.5 * h, add(0.5 * h, k1_), k2_);
      slope(t_ + 0.5 * h, add(0.5 * h, k2_), k3_);
      slope(t_ + h, add(h, k3_), k4_);
      for (std::size_t j = 0; j < y_.size(); ++j) {
        y_[j] += h / 6.0 * (k1_[j] + 2.0 * k2_[j] + 2.0 * k3_[j] + k4_[j]);
      }
      t_ += h;
    }
  }

  std::vector<double> positions() {
    set(t_, y_);
    std::vector<double> q;
    for (const SimTK::MobilizedBody& joint : joints_) q.push_back(joint.getOneQ(state_, 0));
    return q;
  }

 private:
  void add_links(const Linkage& linkage) {
    links_[kGround] = matter_.Ground();
    Bodies by_joint;
    for (const Joint& joint : linkage.joints) {
      const auto link = std::find_if(linkage.links.begin(), linkage.links.end(),
                                     [&](const Link& l) { return l.name == joint.child; });
      joints_.push_back(add_joint(joint, *link, links_.at(joint.parent)));
      links_[joint.child] = by_joint[joint.name] = joints_.back();
    }
    SimTK::Force::Custom(forces_, new JointLoads(linkage, by_joint));  // takes it over
  }

  void add_closure(const Closure& closure) {
    if (closure.type != JointType::spherical) throw std::logic_error("closure " + closure.name);
    if (closure.model == ClosureModel::sde) {
      SimTK::Force::Custom(forces_, new SpringDamper(closure, links_));  // takes it over
    } else {
      SimTK::Constraint::Ball(links_.at(closure.first.link), vec3(closure.first.frame.position),
                              links_.at(closure.second.link), vec3(closure.second.frame.position));
    }
  }

  void set(double t, const std::vector<double>& y) {
    state_.updTime() = t;
    SimTK::Vector& target = state_.updY();
    for (std::size_t j = 0; j < y.size(); ++j) target[static_cast<int>(j)] = y[j];
  }

  void slope(double t, const std::vector<double>& y, std::vector<double>& dy) {
    set(t, y);
    system_.realize(state_, SimTK::Stage::Acceleration);
    const SimTK::Vector& source = state_.getYDot();
    for (std::size_t j = 0; j < dy.size(); ++j) dy[j] = source[static_cast<int>(j)];
  }

  const std::vector<double>& add(double h, const std::vector<double>& k) {
    for (std::size_t j = 0; j < stage_.size(); ++j) stage_[j] = y_[j] + h * k[j];
    return stage_;
  }

  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_;
  SimTK::GeneralForceSubsystem forces_;
  SimTK::State state_;
  Bodies links_;
  std::vector<SimTK::MobilizedBody> joints_;  // in the order of Linkage::joints
  double t_ = 0.0;
  std::vector<double> start_, y_, stage_, k1_, k2_, k3_, k4_;
};

SimbodyRun::SimbodyRun(const Linkage& linkage) : system_(std::make_unique<System>(linkage)) {}
SimbodyRun::~SimbodyRun() = default;

void SimbodyRun::restart() {
  system_->restart();
}

void SimbodyRun::advance(double h, long steps) {
  system_->advance(h, steps);
}

std::vector<double> SimbodyRun::positions() {
  return system_->positions();
}

std::string simbody_version() {
  int major = 0, minor = 0, build = 0;
  SimTK_version_simbody(&major, &minor, &build);
  return std::to_string(major) + "." + std::to_string(minor);
}

}  // namespace linkstudy::testing
