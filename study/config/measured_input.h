// What simulated histories are compared with: measured data of a file, histories of earlier
// results, or, in a calibration, a run of the model itself.
#pragma once

#include <functional>

#include "study/config/measured_data.h"
#include "study/config/override.h"
#include "study/record/evaluation.h"

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

// One evaluation of earlier results.
struct ResultsInput {
  std::string directory;                    // as written
  std::optional<std::uint64_t> evaluation;  // none: the only one
  std::string load_case;
  std::string digest;  // of the results as they were read
};

struct MeasuredInput {
  std::string file;  // as written; empty: results, or a run of the model
  std::optional<ResultsInput> results;
  Location file_at;                          // of either
  std::vector<WantedColumn> columns;         // of either; of results without the time
  std::shared_ptr<const MeasuredData> data;  // of either
  std::vector<TraceInput> signals;           // of the run, or of results by the same names
  std::optional<TimeWindow> window;          // of the data's own time
  std::vector<SigmaInput> sigma;
  std::optional<double> weight;  // of residuals in SI units, in place of sigma
  // Added to the instants of the data, s; fitted where that is asked for.
  double time_offset = 0.0;
  bool fits_offset = false;
  Location offset_at;
};

// A file of measured data, or what is taken of earlier results, by its name in the study.
struct DataText {
  std::string name;
  std::string text;
  std::string digest{};  // of the results
};

// The histories of one evaluation, the time among them.
struct EarlierRun {
  std::vector<Trace> traces;
  std::string digest;  // of the results
};

// Reads what `measured.results` names in the results at `path`; nothing when anything was reported,
// at `measured.file_at`.
using ReadEarlierRun = std::function<std::optional<EarlierRun>(
    const std::string& path, const MeasuredInput& measured, Diagnostics& diagnostics)>;

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
