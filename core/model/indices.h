// What the indices of a mechanism count.
#pragma once

#include <type_traits>

#include "core/base/indices.h"
#include "core/base/typed_index.h"

namespace linkstudy {

using BodyIndex = TypedIndex<struct BodyTag>;          // bodies: 0 ground, parents before children
using StageIndex = TypedIndex<struct StageTag>;        // basic motions of tree joints, body by body
using PositionIndex = TypedIndex<struct PositionTag>;  // joint positions q
using VelocityIndex = TypedIndex<struct VelocityTag>;  // joint velocities v: degrees of freedom
using ClosureIndex = TypedIndex<struct ClosureTag>;    // closures of loops, of all models
using RowIndex = TypedIndex<struct RowTag>;            // cut rows; or rows of replacement joints
using CouplingIndex = TypedIndex<struct CouplingTag>;  // couplings of coordinates
using TermIndex = TypedIndex<struct TermTag>;          // terms of all couplings
using MotionIndex = TypedIndex<struct MotionTag>;      // coordinates whose motion is prescribed
using MotionSupportIndex = TypedIndex<struct MotionSupportTag>;  // velocities beside theirs, in all
using LoopJointIndex = TypedIndex<struct LoopJointTag>;          // joints that share reactions
using LoopRowIndex = TypedIndex<struct LoopRowTag>;              // rows of closures among them
using LoadIndex = TypedIndex<struct LoadTag>;                    // loads
using JointSpringIndex = TypedIndex<struct JointSpringTag>;      // springs in joints, by coordinate
using PointSpringIndex = TypedIndex<struct PointSpringTag>;      // springs between points
using SegmentIndex = TypedIndex<struct SegmentTag>;      // of piecewise linear courses, forces
using BendIndex = TypedIndex<struct BendTag>;            // springs whose stiffness may change
using KnotIndex = TypedIndex<struct KnotTag>;            // of the tables of motions
using ClearanceIndex = TypedIndex<struct ClearanceTag>;  // closures with clearance
using StopIndex = TypedIndex<struct StopTag>;            // end stops, one a side
using ContactIndex = TypedIndex<struct ContactTag>;      // of clearances, then of stops
using FrictionIndex = TypedIndex<struct FrictionTag>;    // joints with friction by reaction
using ConstantFrictionIndex = TypedIndex<struct ConstantFrictionTag>;  // rates that rub together
using BristleIndex = TypedIndex<struct BristleTag>;                    // bristles z of friction
using PointIndex = TypedIndex<struct PointTag>;                        // chosen points

inline constexpr BodyIndex kGroundBody{0};

// Positions, velocities and bristles as the step loop has them: anywhere in memory.
template <class Real>
using Positions = std::type_identity_t<IndexedPointer<PositionIndex, Real>>;
template <class Real>
using Velocities = std::type_identity_t<IndexedPointer<VelocityIndex, Real>>;
template <class Real>
using Bristles = std::type_identity_t<IndexedPointer<BristleIndex, Real>>;

}  // namespace linkstudy
