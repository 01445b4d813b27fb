// An evaluator of a study file, as the session makes it of designs.
#pragma once

#include <memory>
#include <string>

#include "study/evaluate/evaluator.h"

namespace linkstudy {

// Null with diagnostics where the study is wrong.
inline std::unique_ptr<Evaluator> read_evaluator(const std::string& path,
                                                 Diagnostics& diagnostics) {
  std::optional<StudyInput> input = read_study(path, {}, diagnostics);
  if (!input) return nullptr;
  std::vector<Parameter> parameters;
  std::vector<Value> first;
  for (const VaryInput& vary : input->vary) {
    parameters.push_back(vary.parameter);
    first.push_back(vary.values.front());
  }
  return Evaluator::make(std::move(*input), parameters, first, diagnostics);
}

}  // namespace linkstudy
