#include "study/queue/enough_time.h"

#include <algorithm>
#include <exception>

#include "core/base/isa.h"
#include "study/plan/forecast.h"
#include "study/session/study_points.h"
#include "study/store/journal.h"
#include "study/store/status.h"
#include "study/store/store_error.h"

namespace linkstudy::queue {
namespace {

constexpr double kProbeS = 0.5;

std::uint64_t count_finished(const Entry& entry) {
  std::error_code failed;
  if (!std::filesystem::exists(entry.results / kJournalName, failed)) return 0;
  return linkstudy::read_status(entry.results).finished();
}

}  // namespace

std::optional<double> time_needed(const Entry& entry, const StudyInput& input, int ranks,
                                  double at_most) {
  try {
    Diagnostics diagnostics;
    const auto evaluator = make_evaluator(input, diagnostics);
    if (!evaluator) return std::nullopt;
    evaluator->set_timeout(at_most);
    // Of one process: the others of this machine wait meanwhile, and none is begun for it.
    const plan::Forecast forecast =
        plan::make_forecast(*evaluator, {ranks, simd_level().lanes, 1, kProbeS});
    const auto certain = static_cast<double>(forecast.work.points.size());
    if (certain == 0.0) return 0.0;
    const double left = std::max(0.0, certain - static_cast<double>(count_finished(entry)));
    return forecast.asked.wall_s * left / certain;
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

}  // namespace linkstudy::queue
