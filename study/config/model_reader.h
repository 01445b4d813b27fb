// A validated model tree as a Linkage and the options of a run: filled by the rows of the key
// tables, then judged by the checks of core/topology, their paths turned into places in the file.
#pragma once

#include "core/kinematics/drive_course.h"
#include "core/simulation/options.h"
#include "core/topology/linkage.h"
#include "study/config/effect.h"

namespace linkstudy {

struct ModelInput {
  Linkage linkage;
  Linkage rigid;  // with every flexible link as one rigid link
  SimulationOptions options;
  KinematicsOptions kinematics;
  std::string name = "unnamed";
  Tree resolved;  // every default and override filled in: the text of resolved.toml
  std::vector<Ineffective> ineffective;  // what was written and has none, whatever the verb
};

// `model` comes from validate(); start positions are filled in. With reports, the result has
// harmless values in their places.
ModelInput read_model(Tree model, Diagnostics& diagnostics);

// The place of a dotted path such as "joint.A.parent", or of its nearest existing part.
// `reported` tells whether a value on the way was reported before.
Location locate(const Tree& document, const std::string& path, bool* reported = nullptr);

}  // namespace linkstudy
