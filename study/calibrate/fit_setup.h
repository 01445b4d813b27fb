// A calibration file as a fit, and its points as those of the evaluator. Fitted values are the free
// [[parameter]]s in the order of the file, then the time offsets that are fitted.
#pragma once

#include "study/calibrate/fit_problem.h"
#include "study/evaluate/evaluator.h"

namespace linkstudy {

// Every [[parameter]], then the time offsets.
std::vector<Parameter> calibration_parameters(const StudyInput& input);

// Values of those: tied ones follow, fixed ones stay.
std::vector<Value> calibration_point(const StudyInput& input, const std::vector<double>& fitted);

// The lowest values, and data as they lie in time.
std::vector<double> first_fitted(const StudyInput& input);

// Runs references that stand for measurements, where they are missing. Throws as they do.
calibration::FitProblem make_fit_problem(Evaluator& evaluator);

FitOptions make_fit_options(const StudyInput& input);

// What is wrong with all experiments together: fewer samples than parameters, channels of several
// units without weights. Of data that are files only: runs come later.
void check_calibration(Evaluator& evaluator, Diagnostics& diagnostics);

}  // namespace linkstudy
