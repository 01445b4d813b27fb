// The reference linkage R1 as a model file, and ways to damage it.
#pragma once

#include <fstream>
#include <string>

#include "study/config/model_document.h"
#include "tests/support/rsrrp_text.h"

namespace linkstudy::test {

// Link masses and inertias as in the reference set, closure S as a cut joint with an sde beside it.
extern const std::string kRsrrp;

// The same with a revolute clearance closure S, a spring and friction in A, a flexible coupler.
std::string real_joints_text();

// A file in the test's scratch folder.
std::string write_file(const std::string& name, const std::string& text);

// Reads, sets and checks a model text as "model.toml".
std::optional<ModelInput> read_text(const std::string& text, Diagnostics& diagnostics,
                                    std::span<const Override> overrides = {});

Override set(const std::string& assignment);

// The model of a text that must be right, with "path=value" texts set.
ModelInput read_good(const std::string& text, const std::vector<std::string>& sets = {});

}  // namespace linkstudy::test
