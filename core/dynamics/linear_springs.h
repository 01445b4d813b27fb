// Springs, end stops and loads over a coordinate whose force bends, as they are near one state:
// derivatives by differences do not see across their bends then.
#pragma once

#include <optional>

#include "core/model/compile.h"
#include "core/model/workspace.h"

namespace linkstudy {

// The model with every spring that bends (one-sided, or a table) and every load over a coordinate
// made a linear one of the same force, slope and damping at the state; nothing where there is none.
std::optional<Model> with_linear_springs(const Model& model, const State<double>& s,
                                         Workspace<double>& w);

// The same of end stops too, at rest: those that touch are linear springs, the others nothing.
std::optional<Model> with_linear_forces(const Model& model, const State<double>& s,
                                        Workspace<double>& w);

}  // namespace linkstudy
