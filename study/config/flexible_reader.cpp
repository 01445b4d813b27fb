#include "study/config/flexible_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "study/config/beam_section.h"
#include "study/config/frame_reader.h"
#include "study/config/read_value.h"

namespace linkstudy {
namespace {

using Eigen::Vector3d;
using Kind = Tree::Kind;

// The inner diameter, once it is below the outer one.
double read_inner(Tree& section, double outer, const std::string& subject,
                  Diagnostics& diagnostics) {
  Tree* inner = section.find("inner");
  const double diameter = number_of(section, "inner", 0.5 * outer);
  const bool both_known = inner->is_valid() && section.find("outer")->is_valid();
  if (!both_known || diameter < outer) return diameter;
  diagnostics.add(inner->at,
                  fmt::format("{}flexible.section.inner must be below outer = {:.9g} m, got {:.9g} "
                              "m",
                              subject, outer, diameter),
                  "give both as diameters; a full section has shape = \"circle\"");
  inner->kind = Kind::invalid;
  return 0.5 * outer;
}

BeamSection read_section(Tree& section, const std::string& subject, Diagnostics& diagnostics) {
  const std::string shape = word_of(section, "shape");
  if (shape == "tube") {
    const double outer = number_of(section, "outer", 1.0);
    return tube_section(outer, read_inner(section, outer, subject, diagnostics));
  }
  if (shape == "rectangle") {
    return rectangle_section(number_of(section, "width", 1.0), number_of(section, "height", 1.0));
  }
  if (shape == "given") {
    return {number_of(section, "second_moment_y", 1.0), number_of(section, "second_moment_z", 1.0),
            number_of(section, "torsion_constant", 1.0)};
  }
  return circle_section(number_of(section, "diameter", 1.0));
}

// The axis of the link that makes the largest angle with the beam.
Vector3d choose_across(const Vector3d& along) {
  Eigen::Index least = 0;
  along.cwiseAbs().minCoeff(&least);
  return Vector3d::Unit(least);
}

Vector3d read_across(Tree& flexible, const Vector3d& along, const std::string& subject,
                     Diagnostics& diagnostics) {
  const Vector3d chosen = choose_across(along);
  if (flexible.find("across") == nullptr) {
    Tree axis = Tree::make_array();
    for (const double component : chosen) axis.items.push_back(Tree::make_number(component));
    relocate(flexible.set("across", std::move(axis)), flexible.at);
  }
  return read_direction(flexible.find("across"), chosen, subject + "flexible.across", diagnostics);
}

// Whether body and beam fit is a question only when both are what the user wrote.
bool is_body_known(const Tree& link, const Tree& flexible) {
  const auto known = [](const Tree& table, std::initializer_list<const char*> keys) {
    return std::ranges::all_of(keys, [&](const char* key) {
      const Tree* value = table.find(key);
      return value == nullptr || value->is_valid();
    });
  };
  return known(link, {"mass", "center_of_mass", "inertia", "inertia_at_origin"}) &&
         known(flexible, {"begin", "end", "across"});
}

}  // namespace

std::optional<FlexibleBeam> read_flexible(Tree& link_table, Diagnostics& diagnostics) {
  Tree* tree = link_table.find("flexible");
  if (tree == nullptr || !tree->is(Kind::table)) return std::nullopt;
  const std::string subject = title("link", link_table);
  FlexibleBeam beam;
  beam.segments = static_cast<int>(integer_of(*tree, "segments", beam.segments));
  beam.begin = read_vector(tree->find("begin"), beam.begin);
  beam.end = read_vector(tree->find("end"), beam.begin + Vector3d::UnitX());
  beam.across = read_across(*tree, beam.end - beam.begin, subject, diagnostics);
  beam.young = number_of(*tree, "young", 1.0);
  beam.shear = number_of(*tree, "shear", 1.0);
  beam.retardation = number_of(*tree, "retardation", 0.0);
  Tree* table = tree->find("section");
  const bool has_section = table != nullptr && table->is(Kind::table);
  const BeamSection section =
      has_section ? read_section(*table, subject, diagnostics) : circle_section(1.0);
  beam.second_moment_y = section.second_moment_y;
  beam.second_moment_z = section.second_moment_z;
  beam.torsion_constant = section.torsion_constant;
  const Tree* enabled = tree->find("enabled");
  const bool is_rigid = enabled != nullptr && enabled->is(Kind::boolean) && !enabled->boolean;
  if (is_rigid || !is_body_known(link_table, *tree)) return std::nullopt;
  return beam;
}

}  // namespace linkstudy
