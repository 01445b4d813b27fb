#include "study/config/sde_reader.h"

#include <fmt/format.h>

#include "study/config/frame_reader.h"
#include "study/config/read_value.h"

namespace linkstudy {
namespace {

using Kind = Tree::Kind;
constexpr const char* kDirectionNames[kDirections] = {"x", "y", "z", "phi", "theta", "psi"};

std::array<double, kDirections> spread(double value, JointType type, double arm) {
  std::array<double, kDirections> components{};
  const unsigned blocked = blocked_directions(type);
  for (unsigned d = 0; d < kDirections; ++d) {
    if ((blocked >> d & 1u) == 0) continue;
    components[d] = d < kPhi ? value : value * arm * arm;
  }
  return components;
}

std::array<double, kDirections> read_components(const Tree* tree, JointType type, double arm) {
  if (tree == nullptr || !tree->is_valid()) return {};
  if (tree->is_numeric()) return spread(tree->as_number(), type, arm);
  std::array<double, kDirections> components = spread(number_of(*tree, "all", 0.0), type, arm);
  for (std::size_t d = 0; d < kDirections; ++d) {
    components[d] = number_of(*tree, kDirectionNames[d], components[d]);
  }
  return components;
}

// Not given: the axes that the free directions of the closure turn with, if it has any.
SdeAxes read_axes(Tree& sde, JointType type) {
  constexpr unsigned translations = 1u << kX | 1u << kY | 1u << kZ;
  const bool slides = (blocked_directions(type) & translations) != translations;
  if (sde.find("axes") == nullptr) {
    relocate(sde.set("axes", Tree::make_text(slides ? "first" : "ground")), sde.at);
  }
  return word_of(sde, "axes") == "first" ? SdeAxes::first : SdeAxes::ground;
}

}  // namespace

void read_sde(Tree& closure_table, Closure& closure, Diagnostics& diagnostics) {
  Tree* tree = closure_table.find("sde");
  const bool wanted = closure.model == ClosureModel::sde;
  if (tree == nullptr && wanted) {
    diagnostics.add(
        closure_table.find("model")->at,
        fmt::format("closure '{}': model = 'sde' needs the key sde.stiffness", closure.name),
        "add sde = { stiffness = 1.0e6, damping_ratio = 0.7 }");
    Tree reported;
    reported.at = closure_table.at;
    closure_table.set("sde", std::move(reported));
  }
  if (tree == nullptr || !tree->is(Kind::table)) return;
  Sde& sde = closure.sde;
  const std::string form = word_of(*tree, "form");
  if (form == "line_of_centres") sde.form = SdeForm::line_of_centres;
  if (form == "three_springs") sde.form = SdeForm::three_springs;
  sde.axes = read_axes(*tree, closure.type);
  const std::string tilt = word_of(*tree, "tilt");
  if (tilt == "linearized") sde.tilt = TiltMeasure::linearized;
  if (tilt == "angle") sde.tilt = TiltMeasure::angle;
  if (word_of(*tree, "start") == "given") sde.start = SdeStart::given;
  const double arm = number_of(*tree, "arm", 0.1);
  sde.stiffness = read_components(tree->find("stiffness"), closure.type, arm);
  sde.damping = read_components(tree->find("damping"), closure.type, arm);
  if (const Tree* ratio = tree->find("damping_ratio"); ratio != nullptr && ratio->is_numeric()) {
    sde.damping_ratio = ratio->as_number();
  }
  const Eigen::Matrix3d rows = read_matrix(tree->find("directions"), Eigen::Matrix3d::Identity());
  for (int i = 0; i < 3; ++i) {
    const double length = rows.row(i).stableNorm();
    if (length > 0.0) sde.directions.row(i) = rows.row(i) / length;
    if (!(length > 0.0)) sde.directions.row(i).setZero();
  }
}

}  // namespace linkstudy
