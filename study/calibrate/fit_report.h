// What a calibration concludes, with the other values of its best point and the data it rests on;
// as tables and as one JSON object.
#pragma once

#include "study/calibrate/calibrate.h"
#include "study/record/evaluation.h"
#include "study/record/table.h"

namespace linkstudy::calibration {

// A value of the best point that is not fitted: "tied", "fixed" or "derived".
struct OtherValue {
  std::string name;
  double value = 0.0;
  std::string unit;
  std::string role;
};

// One series of the problem.
struct MeasuredSeries {
  std::string experiment;
  std::string channel;
  std::vector<double> times, values;
};

struct FitReport {
  FitResult fit;
  std::vector<OtherValue> others;
  std::vector<MeasuredSeries> data;  // by series of the problem; instants on the clock of the run
};

// "estimates" (a row each value), "correlations" (a row each pair), "data" (figures of each
// series), "starts" (the waterfall, best first), "profiles", "residuals".
std::vector<Table> make_tables(const FitReport& report);

// Two lines or three: verdict, what nothing determines, how it was found.
std::string write_verdict(const FitReport& report);

// One line; NaN and infinity as null.
std::string write_json(const FitReport& report, const std::string& digest);

}  // namespace linkstudy::calibration
