// The keys of a model, a table each, bound to the records they fill.
#pragma once

#include "core/topology/linkage_words.h"
#include "study/config/fields.h"
#include "study/config/model_reader.h"

namespace linkstudy {

// What a load is called: a drive after what it puts on its coordinate.
enum class LoadKind { torque, force, resistance, link_force, link_torque };

template <>
inline constexpr auto kWords<LoadKind> =
    make_words<LoadKind>({{LoadKind::torque, "torque", "on a joint coordinate that turns"},
                          {LoadKind::force, "force", "on one that shifts"},
                          {LoadKind::resistance, "resistance", "against the motion of one"},
                          {LoadKind::link_force, "link_force", "at a point of a link"},
                          {LoadKind::link_torque, "link_torque", "on a link"}});

// Position, and one of four ways to say a rotation.
Fields<Frame> frame_fields();
// The ways alone, where they apply.
Fields<Frame> rotation_fields(const Condition& only = {});
// [[link.shape]].
Fields<Solid> shape_fields();
// The law of LuGre.
Fields<Friction> friction_fields();
// [[link]] flexible.
Fields<FlexibleBeam> flexible_fields();

// Clearance and contact of a closure, two tables of one record.
Fields<Clearance> clearance_fields();
Fields<Clearance> contact_fields();

// A course of values in this unit.
using UnitsBy = std::function<std::vector<std::string>(const Tree& document, const Tree& element)>;
Fields<Course> course_fields(const std::string& unit, const UnitsBy& units_by);

// [[joint]], [[closure]], [[load]], [[spring]], [[motion]], [[coupling]], [simulation],
// [kinematics].
Fields<Joint> joint_fields();
Fields<Closure> closure_fields();
Fields<Load> load_fields();
Fields<PointSpring> point_spring_fields();
Fields<Motion> motion_fields();
Fields<Coupling> coupling_fields();
Fields<SimulationOptions> simulation_fields();
Fields<KinematicsOptions> kinematics_fields();

// format, kind and name, with which every file opens.
template <class Input>
void add_file_fields(Fields<Input>& fields, const std::string& kind) {
  fields.read("format", {.type = KeyType::integer,
                         .meaning = "version of the input format: 1",
                         .range = {.low = 1, .high = 1},
                         .required = true});
  fields.read("kind",
              {.type = KeyType::word, .meaning = "what the file describes", .required = true});
  fields.back().words.push_back(kind);
  fields.add("name", &Input::name, {.meaning = "title in tables and plots"});
}

}  // namespace linkstudy
