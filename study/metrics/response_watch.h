// What observers watch for the [[response]] of a run, and the numbers they come to: extremes and
// means over time windows are summed while the run goes (observers.h); over the last turns of a
// joint they are taken from the history of every step once it has ended, since only then it is
// known where these begin.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/simulation/simulate.h"
#include "study/metrics/study_signals.h"

namespace linkstudy {

class ResponseWatch {
 public:
  // Adds observers behind those that are there.
  ResponseWatch(const StudyInput& input, const StudySignals& signals, const StepGrid& grid,
                Observers& observers);

  std::size_t series_count() const { return series_count_; }

  // Why a run that has ended has not the turns that are asked for, or nothing.
  std::optional<std::string> missing_turn(const Observers& observers) const;

  // By [[response]]: the number of each channel; where it asks for it, the instants of the
  // extremes, and what the other channel has there (response_list.h).
  std::vector<std::vector<double>> reduce(const Observers& observers) const;

 private:
  struct Watched {
    ResponseInput response;
    std::size_t channels = 0;
    std::size_t first = 0;  // reduction; of a cycle the series, then that of the angle
  };

  std::vector<ChannelReduction> reductions_of(const Watched& one, const Observers& observers) const;

  StepGrid grid_;
  std::vector<Watched> watched_;
  std::size_t series_count_ = 0;
};

}  // namespace linkstudy
