// A kinematic analysis as an HDF5 file that xarray and h5py open (study/store/group_file.h):
//   /            what kinematics --json tells, as attributes; program and input
//   /kinematics  axis time; the columns of kinematics_table, NaN where a rate is missing
//   /poses       axis time; the columns of pose_table
//   /singular    a row a singular position: kind, time, joint.NAME.q of the drives, quality, z, h,
//   h_R,
//                joints
//   /swings      a row a joint coordinate: least, greatest, where
//   /transmission   a row a position: transmission angles, of loops that have one
//   /loops       a row a basic loop: closure, joints, elements, rank, conditioning
#pragma once

#include "study/config/model_reader.h"
#include "study/kinematics/result.h"
#include "study/record/findings.h"
#include "study/record/table.h"

namespace linkstudy {

// The tables that --h5 and results have in common: poses, singular, swings, transmission (where
// something is driven) and loops.
std::vector<Table> kinematics_tables(const ModelInput& input, const Model& closed,
                                     const KinematicsResult& result);

// The counts and extremes of it, each with its name, unit and meaning; NaN where there is none.
std::vector<FoundNumber> kinematics_numbers(const KinematicsResult& result);

Table kinematics_group(const ModelInput& input, const Model& closed, const KinematicsResult& result,
                       const std::string& command);

}  // namespace linkstudy
