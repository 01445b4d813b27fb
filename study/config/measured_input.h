// What simulated histories are compared with: measured data of a file, or, in a calibration, a run
// of the model itself.
#pragma once

#include "study/config/measured_data.h"
#include "study/config/override.h"

namespace linkstudy {

struct TimeWindow {
  double first = 0.0;  // s
  double last = 0.0;   // s
  Location at = {};
};

struct TraceInput {
  std::string signal;
  Location at;
};

// One standard deviation of the error of a channel, or of every channel of a vector.
struct SigmaInput {
  std::string signal;
  Tree value;  // a number in the channel's unit, or a text with a unit
  Location at;
};

struct MeasuredInput {
  std::string file;  // as written; empty: a run of the model
  Location file_at;
  std::vector<WantedColumn> columns;         // of the file
  std::shared_ptr<const MeasuredData> data;  // of the file
  std::vector<TraceInput> signals;           // of the run
  std::optional<TimeWindow> window;          // of the data's own time
  std::vector<SigmaInput> sigma;
  std::optional<double> weight;  // of residuals in SI units, in place of sigma
  // Added to the instants of the data, s; fitted where that is asked for.
  double time_offset = 0.0;
  bool fits_offset = false;
  Location offset_at;
};

// A file of measured data, by its name in the study.
struct DataText {
  std::string name;
  std::string text;
};

// [[parameter]] of a calibration.
enum class ParameterRole { free, fixed, tied };

struct CalibratedInput {
  Parameter parameter;
  ParameterRole role = ParameterRole::free;
  bool is_logarithmic = false;
  double low = 0.0;  // of a free one
  double high = 0.0;
  std::optional<double> start;
  double fixed = 0.0;
  std::size_t leader = 0;  // of a tied one: the free one it follows, by position
  double factor = 1.0;     // times the leader
  Location at;
};

}  // namespace linkstudy
