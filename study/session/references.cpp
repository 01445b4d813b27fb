#include "study/session/references.h"

#include <fmt/format.h>

#include <chrono>
#include <future>
#include <stdexcept>

#include "study/evaluate/reference_bytes.h"
#include "study/schedule/stop_signals.h"
#include "study/session/interrupted.h"
#include "study/session/warnings.h"

namespace linkstudy {
namespace {

using Clock = std::chrono::steady_clock;

// A reference that is longer is run again by the next start.
constexpr std::size_t kMostStoredBytes = std::size_t{1} << 30;

std::string title_of(const Evaluator& evaluator, std::size_t i) {
  const std::string& name = evaluator.load_case_name(i);
  return name.empty() ? "reference run" : fmt::format("reference run of load case '{}'", name);
}

bool take_bytes(Evaluator& evaluator, std::size_t i, const std::string& bytes,
                spdlog::logger& log) {
  try {
    evaluator.set_reference(i, decode_reference(bytes));
    return true;
  } catch (const std::out_of_range& error) {
    log.warn("{} as it is kept is not used: {}", title_of(evaluator, i), error.what());
    return false;
  }
}

void warn(const std::string& title, const std::vector<std::string>& warnings, spdlog::logger& log) {
  for (const std::string& text : warnings) say_warning(fmt::format("{}: {}", title, text), log);
}

// In a thread of its own, so that a stop signal is seen while it runs.
void run_one(Evaluator& evaluator, std::size_t i, const RunDeadline& deadline,
             spdlog::logger& log) {
  if (stop_level() > 0 || deadline.forbids_to_begin()) throw Interrupted();
  std::future<void> running = std::async(std::launch::async, [&] { evaluator.run_reference(i); });
  bool cancelled = false;
  while (running.wait_for(std::chrono::milliseconds(20)) != std::future_status::ready) {
    if (cancelled || (stop_level() < kStopCancel && !deadline.is_over())) continue;
    cancelled = true;
    evaluator.cancel();
    log.warn("{} cancelled by {}", title_of(evaluator, i),
             stop_level() > 0 ? "a stop signal" : "the end of the wall time");
  }
  try {
    running.get();
  } catch (const ReferenceFailure& failure) {
    if (failure.cause() == Cause::cancelled) throw Interrupted();
    throw;
  }
}

void keep(const Evaluator& evaluator, std::size_t i, std::string bytes, StudyRecord& record,
          spdlog::logger& log) {
  if (bytes.size() > kMostStoredBytes) {
    log.warn("{} is not kept for later starts: {} MB are too long for the journal",
             title_of(evaluator, i), bytes.size() / 1000000);
    return;
  }
  record.add_reference({evaluator.load_case_name(i), std::move(bytes)});
}

}  // namespace

void run_references(Evaluator& evaluator, StudyRecord& record, KnownRows& known,
                    const RunDeadline& deadline, spdlog::logger& log) {
  for (std::size_t i = 0; i < evaluator.load_case_count(); ++i) {
    if (!evaluator.has_reference(i)) continue;
    const StoredReference* stored = record.reference(evaluator.load_case_name(i));
    if (stored != nullptr && take_bytes(evaluator, i, stored->bytes, log)) continue;
    std::optional<KnownReference> one = known.find_reference(i);
    if (one && take_bytes(evaluator, i, one->bytes, log)) {
      log.info("{} is taken from an earlier one", title_of(evaluator, i));
      warn(title_of(evaluator, i), one->warnings, log);
      keep(evaluator, i, std::move(one->bytes), record, log);
      continue;
    }
    const auto begin = Clock::now();
    run_one(evaluator, i, deadline, log);
    const ReferenceRecord& run = evaluator.run_reference(i);
    warn(title_of(evaluator, i), run.warnings, log);
    KnownReference made{encode_reference(run), run.warnings};
    known.keep_reference(i, made);
    keep(evaluator, i, std::move(made.bytes), record, log);
    log.info("{} took {:.3g} s", title_of(evaluator, i),
             std::chrono::duration<double>(Clock::now() - begin).count());
  }
}

void share_references(Evaluator& evaluator, Transport& transport) {
  if (transport.size() == 1) return;
  for (std::size_t i = 0; i < evaluator.load_case_count(); ++i) {
    if (!evaluator.has_reference(i)) continue;
    const bool is_first = transport.rank() == 0;
    std::string bytes = is_first ? encode_reference(evaluator.run_reference(i)) : "";
    transport.broadcast(bytes);
    if (!is_first) evaluator.set_reference(i, decode_reference(bytes));
  }
}

}  // namespace linkstudy
