// A path of a study file that names one value of the model, and a range of it.
#pragma once

#include "study/config/model_document.h"

namespace linkstudy {

struct NamedParameter {
  Parameter parameter;
  const KeyRow* row = nullptr;
};

// Nothing when it was reported.
std::optional<NamedParameter> find_named_parameter(const ModelDocument& document, const Tree& path,
                                                   Diagnostics& diagnostics);

struct NamedRange {
  bool is_logarithmic = false;
  double low = 0.0;
  double high = 0.0;
  std::vector<Tree> limits;  // as written
};

// { log = [low, high] } or { lin = [low, high] }; nothing when it was reported. `deed`: what is
// done with it, "tuned".
std::optional<NamedRange> read_named_range(Tree& range, const NamedParameter& of,
                                           const Location& at, const std::string& deed,
                                           Diagnostics& diagnostics);

}  // namespace linkstudy
