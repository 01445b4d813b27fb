// Runs of results again, with everything that can be seen of them: all channels, and where every
// link is. Results keep numbers and the histories that were asked for; the run itself comes from
// the input that they hold, by the same equations and steps.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/simulation/prepare.h"
#include "core/spatial/euler_parameters.h"
#include "study/store/results.h"

namespace linkstudy {

inline constexpr std::size_t kMostRows = 20000;  // of the histories of a run made again
inline constexpr std::size_t kMostPoses = 1200;  // of a mechanism in motion
inline constexpr double kLongestAgain = 120.0;   // s, of a run, unless told otherwise

struct MovingRun {
  std::string title;                           // "evaluation 50", "reference"
  std::string load_case;                       // or empty
  TraceSet histories;                          // "time" and all channels
  std::string ended;                           // cause and message, or empty
  Linkage linkage;                             // as it is stepped: flexible links in their elements
  std::vector<std::string> links;              // ground first
  std::vector<double> times;                   // of the poses, s
  std::vector<ShortenedDualQuaternion> poses;  // (times, links) in ground
  std::vector<std::string> driven;             // channels of the coordinates that a course drives
};

struct MovingRuns {
  std::vector<MovingRun> runs;     // the reference, if there is one, last
  std::vector<std::string> notes;  // why there is no more to see
};

// The evaluation that a report shows unless told which: that of the answer, or the one with the
// least of its largest errors, or the last that ended well. Nothing where none did.
std::optional<std::uint64_t> choose_shown(const StudyResults& results);

// That one in a line: "evaluation 12, closure.S.sde.stiffness = 812945 N/m, largest error 2 %";
// empty where there is none.
std::string best_text(const StudyResults& results);

// The positions of a kinematic analysis, or the equilibrium, found again; what cannot is a note.
MovingRuns show_analysis(const StudyResults& results, AnswerKind kind);

// Runs one evaluation and its reference, in the load case that binds or the first; each ends after
// `timeout_s`. What cannot be run is a note. Throws UsageError where there is no such evaluation.
MovingRuns run_again(const StudyResults& results, std::optional<std::uint64_t> evaluation,
                     double timeout_s);

}  // namespace linkstudy
