// Everything `kinematics` finds out about a model.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/kinematics/loop_equations.h"
#include "study/kinematics/swings.h"

namespace linkstudy {

// A basic loop with its proper elements, chosen at the start.
struct LoopResult {
  BasicLoop loop;
  ProperElements proper;
  double least_conditioning = 0.0;   // of the same elements over the course
  std::vector<double> conditioning;  // at every position
};

struct KinematicsResult {
  AssemblyReport assembly;
  MobilityReport mobility;
  std::optional<KinematicsCourse> course;  // nothing where there is nothing to drive
  std::optional<DrivenLinkage> driven;
  DriveRanks ranks;  // at the start
  int branch = 0;    // there
  DriveCycle cycle;
  std::vector<LoopResult> loops;
  std::vector<Swing> swings;
  std::vector<TransmissionAngles> transmission;  // of the loops that have one
  std::vector<int> freedoms;  // at every position to first order, nv - rank J (mobility.h)
};

// The channels of the driven coordinates, "joint.A.q", "joint.U.q.1".
std::vector<std::string> driven_channels(const DrivenLinkage& driven);

// More drives than freedoms whose courses do not agree with the closures.
bool contradicts(const KinematicsResult& result);
// What the exit code tells: the model was assembled, and the drives, if any, led somewhere.
bool is_followed(const KinematicsResult& result);
// Why not, in words; empty where it is.
std::string blocked_text(const KinematicsResult& result);
// The course ended where angles of a joint are singular, which says nothing of the linkage.
bool ends_at_singular_angles(const KinematicsResult& result);

KinematicsResult analyse_kinematics(const CourseRequest& request, const KinematicsOptions& declared,
                                    const Model& closed);

}  // namespace linkstudy
