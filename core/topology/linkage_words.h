// The words of the enumerations of a linkage (core/base/words.h), and of the directions of a
// closure.
#pragma once

#include "core/base/words.h"
#include "core/topology/linkage.h"

namespace linkstudy {

template <>
inline constexpr auto kWords<SolidKind> =
    make_words<SolidKind>({{SolidKind::cylinder, "cylinder", "a round bar, a pin, a disc"},
                           {SolidKind::box, "box", "a flat bar, a plate, a block"},
                           {SolidKind::sphere, "sphere"}});

template <>
inline constexpr auto kWords<JointType> = make_words<JointType>(
    {{JointType::revolute, "revolute"},
     {JointType::prismatic, "prismatic"},
     {JointType::cylindrical, "cylindrical"},
     {JointType::universal, "universal"},
     {JointType::spherical, "spherical"},
     {JointType::planar, "planar"},
     {JointType::free, "free"},
     {JointType::fixed, "fixed"},
     {JointType::screw, "screw"},
     {JointType::pin_in_slot, "pin_in_slot",
      "a point of second on the x axis of first, turning freely"},
     {JointType::rod, "rod", "the points of both ends at the distance `length`"}});

template <>
inline constexpr auto kWords<FrictionLoad> = make_words<FrictionLoad>(
    {{FrictionLoad::reaction, "reaction", "of the joint's own reaction and the preload"},
     {FrictionLoad::constant, "constant", "the preload alone, in joints of every type"}});

template <>
inline constexpr auto kWords<RotationCoordinates> =
    make_words<RotationCoordinates>({{RotationCoordinates::zyx, "zyx", "angles psi theta phi"},
                                     {RotationCoordinates::quaternion, "quaternion", "w x y z"}});

template <>
inline constexpr auto kWords<ClosureModel> = make_words<ClosureModel>(
    {{ClosureModel::cut, "cut", "exact, by multipliers"},
     {ClosureModel::sde, "sde", "by a spring-damping element"},
     {ClosureModel::clearance, "clearance", "a journal in a wider bearing"}});

template <>
inline constexpr auto kWords<Stabilization> =
    make_words<Stabilization>({{Stabilization::none, "none"},
                               {Stabilization::baumgarte, "baumgarte"},
                               {Stabilization::projection, "projection"}});

template <>
inline constexpr auto kWords<SdeForm> = make_words<SdeForm>(
    {{SdeForm::directional, "directional", "one element a direction"},
     {SdeForm::line_of_centres, "line_of_centres", "one along the line of centres"},
     {SdeForm::three_springs, "three_springs", "three along `directions`"}});

template <>
inline constexpr auto kWords<SdeAxes> =
    make_words<SdeAxes>({{SdeAxes::ground, "ground"}, {SdeAxes::first, "first", "the first end"}});

template <>
inline constexpr auto kWords<TiltMeasure> = make_words<TiltMeasure>(
    {{TiltMeasure::axis, "axis",
      "sines of the tilt of the x axis, at any turn of the joint; alone about one axis the moment "
      "is (k/2) sin 2 phi, at most k/2, with the energy k/2 sin^2 phi"},
     {TiltMeasure::linearized, "linearized", "sines too; joint turned up to 45 deg"},
     {TiltMeasure::angle, "angle",
      "rotation vector (x y z of first), moment k phi, energy k/2 phi^2 up to half a turn, where "
      "it "
      "changes sign; for fixed, prismatic, spherical"}});

template <>
inline constexpr auto kWords<SdeStart> =
    make_words<SdeStart>({{SdeStart::closed, "closed",
                           "a run begins with the stiff directions (stiffness above 0 where the "
                           "type blocks) shut and at "
                           "rest"},
                          {SdeStart::given, "given", "deflected and moving as the joints say"}});

template <>
inline constexpr auto kWords<ClearanceKind> = make_words<ClearanceKind>(
    {{ClearanceKind::planar, "planar", "axes stay parallel, one contact"},
     {ClearanceKind::spatial, "spatial",
      "the journal's axis may skew, a contact at either end of the bearing; in both nothing moves "
      "along the axis"}});

template <>
inline constexpr auto kWords<FreeBristle> =
    make_words<FreeBristle>({{FreeBristle::reset, "reset", "zero"},
                             {FreeBristle::relax, "relax", "by z' = -(sigma0 / sigma1) z"},
                             {FreeBristle::hold, "hold", "kept"}});

template <>
inline constexpr auto kWords<ContactPoints> = make_words<ContactPoints>(
    {{ContactPoints::one, "one", "on both at one point of the bearing's surface"},
     {ContactPoints::two, "two",
      "on each at its own surface, a penetration apart, as printed (the two forces then are a "
      "couple)"}});

template <>
inline constexpr auto kWords<CourseShape> =
    make_words<CourseShape>({{CourseShape::ramp, "ramp", "min(t/duration, 1)"},
                             {CourseShape::smooth, "smooth", "3 s^2 - 2 s^3"},
                             {CourseShape::constant, "constant"},
                             {CourseShape::table, "table"}});

template <>
inline constexpr auto kWords<ResistanceShape> = make_words<ResistanceShape>(
    {{ResistanceShape::linear, "linear", "value v/at_speed"},
     {ResistanceShape::quadratic, "quadratic", "value v|v|/at_speed^2"}});

// What a closure can be, in the order in which it is shown: all that block a direction.
inline constexpr std::array kClosureTypes = {
    JointType::spherical, JointType::revolute,    JointType::universal,
    JointType::prismatic, JointType::cylindrical, JointType::planar,
    JointType::fixed,     JointType::pin_in_slot, JointType::rod};

// What a joint of the tree can be.
inline constexpr std::array kTreeJointTypes = {
    JointType::revolute,  JointType::prismatic, JointType::cylindrical,
    JointType::universal, JointType::spherical, JointType::planar,
    JointType::free,      JointType::fixed,     JointType::screw};

// The end of a clearance that carries the bearing, Clearance::bearing_is_first.
inline constexpr auto kBearingEnds = make_words<bool>({{false, "second"}, {true, "first"}});

// Axes of the direction of a load, Load::follows_link.
inline constexpr auto kLoadAxes = make_words<bool>({{false, "ground"}, {true, "link"}});

// Of Direction.
inline constexpr std::array<const char*, kDirections> kDirectionNames = {"x",   "y",     "z",
                                                                         "phi", "theta", "psi"};

}  // namespace linkstudy
