#include "core/simulation/motion_start.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/kinematics/assembly.h"
#include "core/model/undriven.h"
#include "core/numerics/rank.h"

namespace linkstudy {
namespace {

constexpr double kSameStart = 1e-3;  // of a stated value: stated ones are rounded

// "a, b"
std::string names_of(const Mechanism& m) {
  std::string text;
  for (const std::string& name : m.motion_names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::string shown(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", x);
  return text;
}

struct ClosureRanks {
  int all = 0;     // independent equations of the cut joints
  int beside = 0;  // that are so with the driven coordinates at rest
  int moving = 0;  // coordinates that are not driven
};

ClosureRanks ranks_of(const Model& model) {
  const std::vector<int> moving = undriven_velocities(model.mechanism);
  ClosureRanks ranks{0, 0, static_cast<int>(moving.size())};
  if (model.mechanism.cut_row_count() == 0) return ranks;
  const Eigen::MatrixXd j =
      compute_closure_equations(model.mechanism, model.parameters, model.start).jacobian;
  ranks.all = numerical_rank(j, kRankTolerance).rank;
  if (!moving.empty()) ranks.beside = numerical_rank(j(Eigen::all, moving), kRankTolerance).rank;
  return ranks;
}

}  // namespace

std::string overdriven_text(const Model& model) {
  if (model.mechanism.motions.empty()) return {};
  const ClosureRanks ranks = ranks_of(model);
  if (ranks.beside == ranks.all) return {};
  return "the motions (" + names_of(model.mechanism) + ") drive " +
         std::to_string(ranks.all - ranks.beside) +
         " more than the closures leave free at the start: leave one out, or start elsewhere if "
         "this is a dead position";
}

std::vector<std::string> motion_warnings(const Linkage& linkage, const Model& model) {
  std::vector<std::string> texts;
  const Mechanism& m = model.mechanism;
  for (const MotionIndex i : indices_of(m.motions)) {
    const Motion& motion = linkage.motions[static_cast<std::size_t>(i.value())];
    const auto joint = std::find_if(linkage.joints.begin(), linkage.joints.end(),
                                    [&](const Joint& j) { return j.name == motion.joint; });
    const auto k = static_cast<std::size_t>(motion.coordinate);
    const auto compare = [&](const char* what, const std::vector<double>& given, double begins) {
      if (k >= given.size() || given[k] == 0.0) return;
      if (std::abs(given[k] - begins) <= kSameStart * std::abs(given[k])) return;
      texts.push_back("motion '" + motion.name + "' begins with the " + what + " " + shown(begins) +
                      " of joint '" + joint->name + "', not with its initial " + shown(given[k]));
    };
    compare("position", joint->position, model.start.q[m.motions[i].q]);
    compare("velocity", joint->velocity, model.start.v[m.motions[i].v]);
  }
  if (m.motions.empty()) return texts;
  const ClosureRanks ranks = ranks_of(model);
  if (ranks.moving == ranks.all) {
    texts.push_back("every freedom of the linkage is driven (" + names_of(m) +
                    "): the run is an inverse dynamics");
  }
  return texts;
}

}  // namespace linkstudy
