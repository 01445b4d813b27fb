// What every joint coordinate does along the course: how far it swings, where its ends are; and the
// transmission angle (core/kinematics/transmission_angle.h). Between positions a coordinate is the
// quintic through position, velocity and acceleration at both, so that ends are found to the
// sixth power of the spacing; beside singular positions, where there are no rates, ends are those
// of positions.
#pragma once

#include <string>
#include <vector>

#include "core/kinematics/transmission_angle.h"
#include "study/kinematics/course.h"
#include "study/record/table.h"

namespace linkstudy {

enum class JointMotion { rests, swings, turns };

// One end of a swing.
struct SwingEnd {
  double value = 0.0;     // rad or m
  double time = 0.0;      // s
  Eigen::VectorXd drive;  // rad or m
};

struct Swing {
  std::string coordinate;  // "joint.D.q", "closure.P.q.1"
  bool is_angle = true;
  bool is_on_ground = false;  // a joint of ground
  bool is_driven = false;
  JointMotion motion = JointMotion::swings;  // turns: a full turn or more
  SwingEnd least, greatest;
};

// `course`: a row a position (kinematics_table); `driven`: channels of driven coordinates.
std::vector<Swing> find_swings(const Mechanism& mechanism, const KinematicsCourse& path,
                               const std::vector<std::string>& driven, const Table& course);

// Of one loop along the course.
struct TransmissionAngles {
  std::string output;         // "joint.D"
  std::vector<double> angle;  // rad, at every position
  SwingEnd least;
};

std::vector<TransmissionAngles> find_transmission_angles(const Model& closed,
                                                         const KinematicsCourse& path,
                                                         const DriveCycle& cycle,
                                                         const State<double>& start);

}  // namespace linkstudy
