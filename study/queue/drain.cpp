#include "study/queue/drain.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "study/config/study_input.h"
#include "study/queue/enough_time.h"
#include "study/record/bytes.h"
#include "study/report/console.h"
#include "study/schedule/progress.h"
#include "study/schedule/stop_signals.h"
#include "study/session/exit_code.h"
#include "study/session/failure.h"
#include "study/store/status.h"

namespace linkstudy::queue {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kSettledS = 2.0;  // a file that cannot be read and is younger is being written
// With more of an allocation left another one gives no more time.
constexpr double kWhole = 0.9;
constexpr std::chrono::milliseconds kPause{200};

double seconds_until(Clock::time_point time) {
  return std::chrono::duration<double>(time - Clock::now()).count();
}

// Rank 0's side: which entry is next, and how it ended.
class Chooser {
 public:
  Chooser(Transport& ranks, const DrainOptions& options, const DrainWork& work)
      : ranks_(ranks),
        options_(options),
        work_(work),
        folder_(options.folder),
        start_unix_s_(unix_time_s()),
        allocation_s_(time_left()),
        idle_since_(Clock::now()) {}

  // Waits for one; nothing when the queue ends here.
  std::optional<Entry> next() {
    for (;;) {
      if (is_ending()) return std::nullopt;
      if (std::optional<Entry> entry = choose()) return entry;
      if (!is_any_unsettled_ && -seconds_until(idle_since_) >= options_.wait_s) return std::nullopt;
      std::this_thread::sleep_for(kPause);
    }
  }

  void finish(const Entry& entry, const EntryAnswer& answer) {
    record_.end = EntryEnd{answer.code, answer.verdict, unix_time_s()};
    hold_->write(record_);
    hold_.reset();
    const double took_s = record_.end->unix_s - record_.begun_unix_s;
    say(fmt::format("{} {} after {}{}{}", entry.name, describe(answer.code), duration_text(took_s),
                    answer.verdict.empty() ? "" : ": ", answer.verdict));
    idle_since_ = Clock::now();
  }

  // The gravest of all entries that nobody works on.
  int exit_code() {
    int gravest = kDone;
    for (const Entry& entry : folder_.entries()) gravest = std::max(gravest, code_of(entry));
    return gravest;
  }

 private:
  struct Handled {
    std::string version;
    std::string input_sha256{};        // "" where it could not be read
    std::optional<double> needed_s{};  // of one that is left for another allocation
    double unix_s = 0.0;               // when it was looked at
  };

  static std::string describe(int code) {
    if (code == kDone) return "is done";
    if (code == kExitResumable) return "is interrupted";
    return fmt::format("ended with exit code {}", code);
  }

  void say(const std::string& text) const {
    print_err(
        fmt::format("linkstudy: {}{}{}\n", options_.name, options_.name.empty() ? "" : ": ", text));
  }

  bool is_ending() const { return stop_level() > 0 || options_.deadline.forbids_to_begin(); }

  double time_left() const {
    const auto& until = options_.deadline.begin_until;
    return until ? seconds_until(*until) : 1e300;
  }

  bool is_handled(const Entry& entry) const {
    const auto found = handled_.find(entry.name);
    return found != handled_.end() && found->second.version == entry.version &&
           !found->second.needed_s;
  }

  int code_of(const Entry& entry) {
    if (is_held(entry)) return kDone;
    const std::optional<EntryRecord> record = read_record(entry);
    const bool is_same = is_handled(entry) || (record && record->version == entry.version);
    if (is_same && record && record->end) return record->end->exit_code;
    return entry.kind ? kExitResumable : kDone;
  }

  // Whether another allocation would end what this one has no time for.
  bool fits_another(double needed_s) const {
    return needed_s <= allocation_s_ && has_begun_ && time_left() < kWhole * allocation_s_;
  }

  std::optional<Entry> choose() {
    std::optional<Entry> longest;  // than any allocation
    bool is_other_left = false;
    is_any_unsettled_ = false;
    for (const Entry& entry : folder_.entries()) {
      if (is_handled(entry)) continue;
      if (!entry.kind && std::abs(entry.age_s) < kSettledS) {
        is_any_unsettled_ = true;
        continue;
      }
      hold_ = EntryHold::take(entry);
      if (!hold_) continue;
      if (is_to_begin(entry)) return begin(entry);
      hold_.reset();
      const std::optional<double> needed_s = handled_[entry.name].needed_s;
      if (!needed_s) continue;
      is_other_left |= fits_another(*needed_s);
      if (!fits_another(*needed_s) && !longest) longest = entry;
    }
    if (!longest || is_other_left) return std::nullopt;
    hold_ = EntryHold::take(*longest);
    return hold_ ? begin(*longest) : std::nullopt;
  }

  std::optional<Entry> begin(const Entry& entry) {
    Handled& handled = handled_[entry.name];
    handled.needed_s.reset();
    handled.unix_s = unix_time_s();
    has_begun_ = true;
    record_ = {handled.input_sha256, entry.version, ranks_.host(), getpid(),
               ranks_.size(),        handled.unix_s};
    hold_->write(record_);
    say(fmt::format("{} begins", entry.name));
    return entry;
  }

  // It is held. Where it cannot be read the run says why.
  bool is_to_begin(const Entry& entry) {
    Handled& handled = handled_[entry.name];
    const std::optional<EntryRecord> before = read_record(entry);
    const bool is_known = handled.version == entry.version && handled.needed_s;
    if (is_known && !(before && before->begun_unix_s > handled.unix_s)) {
      return *handled.needed_s <= time_left();
    }
    handled = {.version = entry.version, .unix_s = unix_time_s()};
    try {
      const StudyInput input = work_.read(entry);
      handled.input_sha256 = work_.identify(input, ranks_);
      if (has_ended(before, handled.input_sha256)) return false;
      return has_time(entry, input, handled);
    } catch (const std::exception&) {
      return true;
    }
  }

  bool has_ended(const std::optional<EntryRecord>& before, const std::string& input_sha256) const {
    if (!before || !before->end || before->input_sha256 != input_sha256) return false;
    const int code = before->end->exit_code;
    // What kept it from beginning or from being written may have passed.
    if (code == kExitResumable || code == kInputError || code == kInternalError) return false;
    return !options_.retries || before->end->unix_s >= start_unix_s_;
  }

  bool has_time(const Entry& entry, const StudyInput& input, Handled& handled) {
    if (!options_.deadline.begin_until) return true;
    const double left_s = time_left();
    const std::optional<double> needed_s = time_needed(entry, input, ranks_.size(), left_s);
    if (!needed_s || *needed_s <= time_left()) return true;
    handled.needed_s = needed_s;
    say(fmt::format("{} takes about {}, {} are left: {}", entry.name, duration_text(*needed_s),
                    duration_text(left_s),
                    fits_another(*needed_s) ? "it waits for another allocation" : "it comes last"));
    return false;
  }

  Transport& ranks_;
  const DrainOptions& options_;
  const DrainWork& work_;
  Folder folder_;
  double start_unix_s_;
  double allocation_s_;
  Clock::time_point idle_since_;
  std::map<std::string, Handled> handled_;
  bool has_begun_ = false;         // any entry
  bool is_any_unsettled_ = false;  // a file that is being written
  std::optional<EntryHold> hold_;  // of the entry in hand
  EntryRecord record_;
};

// What rank 0 has chosen, for all; nothing when the queue ends.
std::optional<Entry> share(const std::optional<Entry>& entry, Transport& ranks) {
  std::string bytes;
  if (entry)
    bytes = to_bytes(std::vector{entry->name, entry->file.string(), entry->results.string(),
                                 entry->record.string(),
                                 std::string(entry->kind ? name_of(*entry->kind) : "")});
  ranks.broadcast(bytes);
  if (bytes.empty()) return std::nullopt;
  const auto parts = from_bytes<std::vector<std::string>>(bytes);
  return Entry{parts[0], parts[1], parts[2], parts[3], find_word<FileKind>(parts[4])};
}

}  // namespace

int drain(Transport& ranks, const DrainOptions& options, const DrainWork& work) {
  std::optional<Chooser> chooser;
  int code = kDone;
  bool has_failed = false;
  // Rank 0 alone: where it cannot go on all leave together.
  const auto guard = [&](const auto& step) {
    if (ranks.rank() != 0 || has_failed) return;
    try {
      step();
    } catch (...) {
      const Failure failure = describe_failure(std::current_exception());
      print_err(failure.text);
      code = std::max(code, failure.code);
      has_failed = true;
    }
  };
  guard([&] { chooser.emplace(ranks, options, work); });
  for (;;) {
    std::optional<Entry> chosen;
    guard([&] { chosen = chooser->next(); });
    const std::optional<Entry> entry = share(chosen, ranks);
    if (!entry) break;
    int ended = -1;
    const auto end = [&](const EntryAnswer& answer) {
      ended = answer.code;
      guard([&] { chooser->finish(*entry, answer); });
    };
    const int agreed = work.run(*entry, ranks, end);
    if (ended < 0) end({agreed, ""});
    if (agreed > ended) code = std::max(code, agreed);
  }
  guard([&] { code = std::max(code, chooser->exit_code()); });
  return ranks.agree_exit_code(code);
}

}  // namespace linkstudy::queue
