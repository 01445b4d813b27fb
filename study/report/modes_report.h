// Modes about an equilibrium for people and programs.
#pragma once

#include <string>
#include <vector>

#include "core/dynamics/modes.h"
#include "study/record/table.h"

namespace linkstudy {

// A row a mode, the slowest first: frequency, damping ratio, decay, and of every coordinate how far
// it swings and its phase.
Table modes_table(const Mechanism& m, const std::vector<Mode>& modes);

// The slowest `count`, a line each, with the coordinates that swing most.
std::string modes_text(const Mechanism& m, const std::vector<Mode>& modes, int count);

// [{"frequency": Hz, "damping_ratio": .., "decay": 1/s, "shape": {"joint.A": [re, im], ..}}, ..]
std::string modes_json(const Mechanism& m, const std::vector<Mode>& modes);

}  // namespace linkstudy
