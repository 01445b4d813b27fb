// Friction of joints as the step loop has it, appended to a model.
#pragma once

#include "core/model/compile.h"

namespace linkstudy {

LugreParameters<double> lugre_parameters(const Friction& friction);

// The first of new bristles, which are not bent.
BristleIndex add_bristles(int count, Model& model);

// Of the joint that carries the body of this number.
void add_joint_friction(const Joint& joint, BodyIndex number, const Body& body, Model& model);

}  // namespace linkstudy
