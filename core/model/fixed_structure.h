// Structure known when a program is compiled: a type with the members of Mechanism that the step
// loop reads, all static and constant. Its source text is written from a compiled model, so that
// any model file can have a step loop of its own (study/specialize).
#pragma once

#include <string>

#include "core/base/walk.h"
#include "core/model/mechanism.h"

namespace linkstudy {

// C++ source of `struct NAME` for a mechanism.
std::string write_fixed_structure(const Mechanism& mechanism, const std::string& name);

// The structure of a type as a mechanism without names.
template <FixedStructure M>
Mechanism to_mechanism() {
  const auto list = [](const auto& a) { return std::vector(a.begin(), a.end()); };
  Mechanism m;
  m.nq = M::nq;
  m.nv = M::nv;
  m.bodies = list(M::bodies);
  m.stages = list(M::stages);
  m.v_parent = list(M::v_parent);
  m.velocities = list(M::velocities);
  m.ball_q = list(M::ball_q);
  m.closures = list(M::closures);
  m.cut_rows = list(M::cut_rows);
  m.sde_rows = list(M::sde_rows);
  m.support = list(M::support);
  m.loads = list(M::loads);
  m.joint_springs = list(M::joint_springs);
  m.clearances = list(M::clearances);
  m.contacts = list(M::contacts);
  m.frictions = list(M::frictions);
  m.nz = M::nz;
  m.projects = M::projects;
  return m;
}

}  // namespace linkstudy
