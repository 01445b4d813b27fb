#include "study/session/deadline.h"

#include <algorithm>

#include "study/store/status.h"

namespace linkstudy {
namespace {

using Clock = std::chrono::steady_clock;

bool is_past(const std::optional<RunDeadline::Time>& time) {
  return time && Clock::now() >= *time;
}

}  // namespace

bool RunDeadline::forbids_to_begin() const {
  return is_past(begin_until);
}

bool RunDeadline::is_over() const {
  return is_past(cancel_at);
}

RunDeadline find_deadline(std::optional<double> walltime_s, const BatchJob& job,
                          RunDeadline::Time start) {
  if (!walltime_s && job.end_unix_s) walltime_s = std::max(0.0, *job.end_unix_s - unix_time_s());
  if (!walltime_s) return {};
  const double margin = std::clamp(0.1 * *walltime_s, 0.1, 60.0);
  const auto at = [&](double seconds) {
    return start + std::chrono::duration_cast<Clock::duration>(
                       std::chrono::duration<double>(std::min(seconds, 1e9)));
  };
  return {at(*walltime_s - margin), at(*walltime_s - 0.5 * margin)};
}

}  // namespace linkstudy
