// Models with known parameters, evaluated in this process, as the fits see them.
#pragma once

#include <functional>
#include <vector>

#include "study/calibrate/calibrate.h"

namespace linkstudy::calibration {

// y of the parameters, one value a sample.
using PlantedModel = std::function<std::vector<double>(const std::vector<double>&)>;

inline FitProblem one_series(std::vector<FitParameter> parameters, std::size_t samples) {
  return {std::move(parameters), {{"y", "", 1.0, 0, samples}}};
}

// Where `fails` says so, an evaluation diverges.
inline EvaluateBatch evaluate_with(PlantedModel model, std::vector<double> measured,
                                   std::function<bool(const std::vector<double>&)> fails = {}) {
  return [=, next = std::uint64_t{0}](const std::vector<std::vector<double>>& points) mutable {
    std::vector<FitAnswer> answers;
    for (const std::vector<double>& point : points) {
      FitAnswer answer{next++};
      if (fails && fails(point)) {
        answer.status = Cause::diverged;
        answer.message = "planted";
      } else {
        answer.residuals = model(point);
        for (std::size_t i = 0; i < measured.size(); ++i) answer.residuals[i] -= measured[i];
      }
      answers.push_back(std::move(answer));
    }
    return answers;
  };
}

}  // namespace linkstudy::calibration
