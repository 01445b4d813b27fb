// When a study or tune must stop by itself to end within its wall time W (--walltime, else what
// Slurm says is left of the job). With a margin m = W / 10, at least 0.1 s and at most 60 s: from
// W - m on no work is begun, at W - m / 2 what is in flight is cancelled.
#pragma once

#include <chrono>
#include <optional>

#include "study/schedule/batch_job.h"

namespace linkstudy {

struct RunDeadline {
  using Time = std::chrono::steady_clock::time_point;

  std::optional<Time> begin_until;
  std::optional<Time> cancel_at;

  bool forbids_to_begin() const;
  bool is_over() const;
};

// `start`: when the program started.
RunDeadline find_deadline(std::optional<double> walltime_s, const BatchJob& job,
                          RunDeadline::Time start);

}  // namespace linkstudy
