#include "study/store/status.h"

#include <algorithm>
#include <chrono>
#include <numeric>

#include "study/record/digest.h"
#include "study/store/file.h"
#include "study/store/results_file.h"

namespace linkstudy {
namespace {

double unix_time_s(std::chrono::system_clock::time_point time) {
  return std::chrono::duration<double>(time.time_since_epoch()).count();
}

std::optional<double> time_left(const JournalContents& contents, const StudyStatus& status,
                                double last_write_unix_s) {
  if (status.is_complete) return 0.0;
  if (contents.evaluations_since_start == 0) return std::nullopt;
  const std::uint64_t finished = std::min(status.finished(), status.total);
  const double elapsed = std::max(0.0, last_write_unix_s - contents.provenance.back().time_unix_s);
  return static_cast<double>(status.total - finished) * elapsed /
         static_cast<double>(contents.evaluations_since_start);
}

// A search is complete with its answer; how many evaluations that takes shows only then.
bool has_answer(const JournalContents& contents) {
  return std::ranges::any_of(
      contents.texts, [](const NamedText& text) { return answer_kind_of(text).has_value(); });
}

void find_total(const JournalContents& contents, StudyStatus& status) {
  const std::uint64_t finished = status.finished();
  status.total = contents.provenance.back().total;
  const std::string kind = contents.description ? contents.description->kind : "";
  status.is_search = kind == "tune" || kind == "calibrate";
  status.is_complete = status.is_search ? has_answer(contents) : finished >= status.total;
  if (status.is_search && status.is_complete) status.total = finished;
}

}  // namespace

double unix_time_s() {
  return unix_time_s(std::chrono::system_clock::now());
}

std::uint64_t StudyStatus::failed_count() const {
  return std::accumulate(failed.begin(), failed.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const auto& cause) { return sum + cause.second; });
}

StudyStatus summarize_status(const JournalContents& contents, double last_write_unix_s,
                             double now_unix_s) {
  StudyStatus status;
  for (const Evaluation& evaluation : contents.evaluations) {
    if (evaluation.status == Cause::ok) {
      ++status.done;
    } else {
      ++status.failed[evaluation.status];
    }
  }
  status.references = contents.references.size();
  if (contents.description) {
    status.digest = results_digest(contents.description->parameters,
                                   contents.description->responses, contents.evaluations);
  }
  status.last_write_age_s = std::max(0.0, now_unix_s - last_write_unix_s);
  if (!contents.provenance.empty()) {
    find_total(contents, status);
    status.started_unix_s = contents.provenance.front().time_unix_s;
    status.eta_s = time_left(contents, status, last_write_unix_s);
  }
  return status;
}

StudyStatus read_status(const std::filesystem::path& directory) {
  const JournalContents contents = read_journal(directory);
  const std::filesystem::path path = directory / kJournalName;
  const auto written = std::chrono::file_clock::to_sys(std::filesystem::last_write_time(path));
  StudyStatus status = summarize_status(
      contents, std::chrono::duration<double>(written.time_since_epoch()).count(), unix_time_s());
  status.running = is_locked(path);
  if (!status.running) status.dropped = dropped_text(contents, directory);
  return status;
}

}  // namespace linkstudy
