// Files of all kinds but "model": which model, what is varied, tuned, fitted or refined, what is
// compared and kept. Every parameter path is checked against the model, every value converted to
// its unit. Names of signals are not judged here; `at` is the place for whoever does.
#pragma once

#include "study/config/fit_options.h"
#include "study/config/measured_input.h"
#include "study/config/model_document.h"
#include "study/config/search_options.h"
#include "study/design/axis.h"
#include "study/design/design_options.h"

namespace linkstudy {

enum class ErrorNorm { max, rms };
enum class ErrorScale { component, vector };
enum class Reduction { max, min, max_abs, rms, mean, last };
enum class FailurePolicy { record, abort };
// Where a refined value leads.
enum class RefineLimit { zero, infinity };

template <>
inline constexpr auto kWords<ErrorNorm> = make_words<ErrorNorm>(
    {{ErrorNorm::max, "max", "largest"}, {ErrorNorm::rms, "rms", "root-mean-square"}});
template <>
inline constexpr auto kWords<ErrorScale> =
    make_words<ErrorScale>({{ErrorScale::component, "component", "each component's reference"},
                            {ErrorScale::vector, "vector", "that of the vector"}});
template <>
inline constexpr auto kWords<Reduction> = make_words<Reduction>({{Reduction::max, "max"},
                                                                 {Reduction::min, "min"},
                                                                 {Reduction::max_abs, "max_abs"},
                                                                 {Reduction::rms, "rms"},
                                                                 {Reduction::mean, "mean"},
                                                                 {Reduction::last, "last"}});
template <>
inline constexpr auto kWords<FailurePolicy> =
    make_words<FailurePolicy>({{FailurePolicy::record, "record", "note it and go on"},
                               {FailurePolicy::abort, "abort", "stop"}});

template <>
inline constexpr auto kWords<RefineLimit> = make_words<RefineLimit>(
    {{RefineLimit::zero, "zero", "finer is smaller: h is the value"},
     {RefineLimit::infinity, "infinity", "finer is larger: h is 1 / value"}});

// What is compared with: a run of a model, or measured data.
struct ReferenceInput {
  std::shared_ptr<const ModelDocument> model;  // of a run; the study's own where no other is named
  std::vector<Override> set;
  std::optional<MeasuredInput> measured;
  Location at;

  bool is_run() const { return !measured; }
};

// Numbers are in parameter.unit.
struct VaryInput : Axis {
  Location at;
};

// What a [[refine]] says beyond its parameter and its values, which are a VaryInput.
struct RefineInput {
  RefineLimit limit = RefineLimit::zero;
  std::optional<double> formal_order;
};

// The last full turns of a joint, up to the end of the run (study/metrics/cycle.h).
struct CycleInput {
  std::string of;  // channel of its angle
  long turns = 1;
  Location at;  // of `of`
};

// Where an extreme is reached: when, and what another channel has there.
struct PlaceInput {
  std::string channel;  // empty: the instant alone
  Location at;
};

struct MatchInput {
  std::string signal;
  std::string reference_signal;  // without sign
  double reference_sign = 1.0;   // -1: written with '-'
  ErrorNorm norm = ErrorNorm::max;
  ErrorScale scale = ErrorScale::component;
  std::vector<double> tolerance;     // of a tune one for each answer that is wanted
  std::optional<TimeWindow> window;  // none: the whole run
  std::optional<CycleInput> cycle;   // of the reference run, in place of a window
  double floor = 0.05;
  Location at;            // of signal
  Location reference_at;  // of reference_signal
};

struct ResponseInput {
  std::string name;
  std::string signal;
  Reduction reduce = Reduction::max;
  std::optional<TimeWindow> window;
  std::optional<CycleInput> cycle;  // in place of a window
  std::optional<PlaceInput> where;
  Location at;       // of signal
  Location name_at;  // of name
};

// What is best among the points that match, where it is not the least sum of log10.
struct ObjectiveInput {
  std::string of;  // path of a tuned value, or a response
  bool maximizes = false;
  Location at;
};

// A response, or a number that is kept of every run, that a tuned point must keep within a bound.
struct LimitInput {
  std::string response;
  std::optional<Tree> at_most;  // a number in the response's unit, or a text with a unit
  std::optional<Tree> at_least;
  Location at;  // of response
};

// A time history that a refinement compares from level to level.
struct SeriesInput {
  std::string signal;
  ErrorNorm norm = ErrorNorm::max;
  std::optional<TimeWindow> window;
  Location at;  // of signal
};

// A load case; in a calibration an experiment, with what was measured in it.
struct LoadCaseInput {
  std::string name;
  std::vector<Override> set;
  Location at;
  std::optional<MeasuredInput> measured = {};
  // What this load case is compared with in place of the common reference; of an experiment a run
  // that stands for measurements.
  std::optional<ReferenceInput> reference = {};
};

struct TuneInput {
  Parameter parameter;
  bool is_logarithmic = true;
  double low = 0.0;
  double high = 0.0;
  Location at;
};

// A number of failed evaluations, or a share of all in percent.
struct FailureLimit {
  double value = 0.0;
  bool is_percent = false;
};

struct RunOptions {
  std::uint64_t seed = 1;
  std::optional<double> timeout;  // s
  std::optional<FailureLimit> max_failures;
  FailurePolicy on_failure = FailurePolicy::record;
};

struct StudyInput {
  FileKind kind = FileKind::study;
  std::string name = "unnamed";
  std::string file;
  std::shared_ptr<const ModelDocument> model;
  std::optional<ReferenceInput> reference;
  std::vector<Override> base_set;
  DesignOptions design;
  std::vector<VaryInput> vary;
  std::vector<RefineInput> refine;  // by vary
  std::vector<TuneInput> tune;
  std::vector<CalibratedInput> calibrated;
  std::vector<MatchInput> match;
  std::vector<ResponseInput> response;
  std::optional<ObjectiveInput> objective;
  std::vector<LimitInput> limit;
  std::vector<TraceInput> trace;  // those of series among them
  std::vector<SeriesInput> series;
  double wanted_error = 1e-3;  // of a refinement, relative
  double rounding = 2e-12;     // likewise: less is rounding
  std::vector<LoadCaseInput> load_case;
  SearchOptions search;
  FitOptions fit;
  RunOptions run;
  Tree resolved;
  std::vector<Diagnostic> remarks;  // warnings and notes
};

// What results keep of their input: with all defaults, and with what --set replaced.
struct ResolvedTexts {
  std::string study;
  std::string model;
  std::string reference;       // its model; empty where that is the same
  std::vector<DataText> data;  // each once
};
// The input of results again, without the files it was read from; `file` is the name in messages.
std::optional<StudyInput> read_study(const ResolvedTexts& texts, const std::string& file,
                                     Diagnostics& diagnostics);

// `set` are --set overrides: those of the study's own keys (run.seed, search.scan, ...) go there,
// all others to what they name (precedence.h). Without `earlier` a file that names earlier results
// is refused.
std::optional<StudyInput> read_study(const std::string& path, std::span<const Override> set,
                                     Diagnostics& diagnostics, const ReadEarlierRun& earlier = {});

}  // namespace linkstudy
