#include "study/session/continuation.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "study/record/counted.h"
#include "study/record/transient.h"
#include "study/session/row_comparison.h"
#include "study/session/study_points.h"
#include "study/store/directory.h"
#include "study/store/results_file.h"

namespace linkstudy {
namespace {

constexpr const char* kElsewhere = "choose another directory with -o or overwrite it with --fresh";

using Causes = std::map<Cause, std::size_t>;

// "2 timeout, 1 rank_lost"
std::string shown_causes(const Causes& causes) {
  std::vector<std::string> parts;
  for (const auto& [cause, count] : causes) {
    parts.push_back(fmt::format("{} {}", count, name_of(cause)));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::optional<JournalContents> find_begun(const std::filesystem::path& directory) {
  if (!std::filesystem::exists(directory / kJournalName)) return std::nullopt;
  JournalContents contents = read_journal(directory);
  if (!contents.description) return std::nullopt;
  return contents;
}

class Continuation {
 public:
  Continuation(const SessionOptions& options, const std::filesystem::path& directory,
               const StudyIdentity& identity, const Evaluator& evaluator,
               const JournalContents& contents)
      : options_(options),
        directory_(directory),
        identity_(identity),
        evaluator_(evaluator),
        contents_(contents),
        is_same_(contents.input_sha256 == identity.input_sha256) {}

  std::string prepare() {
    if (!is_same_) {
      comparison_ = compare_rows(EarlierStudy(results_from(contents_)), evaluator_);
      require_allowed();
    }
    choose_retried();
    Journal journal(directory_, contents_.input_sha256, OpenMode::resume);
    if (!retried_.empty()) journal.append(retried_text(retried_));
    say_retried();
    if (is_moved()) {
      journal.sync();
      say_moved();
      set_journal_aside(directory_);
    } else if (!is_same_) {
      journal.append(identity_.description);
      journal.append(input_text(identity_.input_sha256));
      if (!comparison_.asks_the_same) say_extended(contents_.evaluations.size());
    }
    journal.sync();
    return fmt::format("{}", fmt::join(said_, "\nlinkstudy: "));
  }

 private:
  [[noreturn]] void refuse(const std::string& why, const std::string& remedy) const {
    throw StoreError(fmt::format("{}: {}; {}", directory_.string(), why, remedy));
  }

  void require_allowed() const {
    if (!comparison_.lost.empty()) {
      refuse("holds a study of another input, and " + comparison_.lost, kElsewhere);
    }
    if (comparison_.caps == CapChange::narrower) {
      refuse("its rows were run under wider limits (simulation.step_limit, simulation.drift_limit)",
             kElsewhere);
    }
    if (!comparison_.asks_the_same && !options_.extend) {
      refuse("its rows are all in this input, which asks for others too",
             "add them with --extend, or choose another directory with -o");
    }
    if (!comparison_.ended_by_caps.empty() && !options_.retry_failed) {
      refuse(fmt::format("{} of its rows ended by limits that are wider now",
                         comparison_.ended_by_caps.size()),
             "run them again with --retry-failed, or choose another directory with -o");
    }
  }

  // Rows may have to go under other ids: of a design whose points move, and of a search, which
  // takes another path from where an answer is another.
  bool is_moved() const {
    const bool is_design = has_design(evaluator_.input().kind);
    if (is_same_) return !is_design && !retried_.empty();
    return !is_design || !comparison_.is_in_place;
  }

  void say_extended(std::size_t kept) {
    kept -= std::min(kept, retried_.size());
    const std::uint64_t all = count_of(evaluator_.input());
    said_.push_back(fmt::format("extended: {} kept, {} to run",
                                kept == 1 ? "1 row is" : fmt::format("{} rows are", kept),
                                all - std::min<std::uint64_t>(all, kept)));
  }

  void say_moved() {
    const std::string aside =
        fmt::format("journal_{}.bin", earlier_journals(directory_).size() + 1);
    if (has_design(evaluator_.input().kind)) {
      say_extended(comparison_.kept);
      said_.back() += fmt::format("; the journal before is {}", aside);
      return;
    }
    const std::size_t rows = contents_.evaluations.size() - retried_.size();
    std::string text = "the search begins anew";
    if (rows > 0) {
      text += fmt::format(", and takes the {} of {} where it asks for them",
                          rows == 1 ? "row" : fmt::format("{} rows", rows), aside);
    }
    said_.push_back(std::move(text));
  }

  // By id, each once.
  void choose_retried() {
    if (!options_.retry_failed) return;
    const std::vector<std::uint64_t>& by_caps = comparison_.ended_by_caps;
    for (const Evaluation& row : contents_.evaluations) {
      if (row.status == Cause::ok) continue;
      const bool is_retried =
          is_transient(row.status) || std::ranges::find(by_caps, row.point.id) != by_caps.end();
      if (is_retried) retried_.push_back(row.point.id);
      ++(is_retried ? again_ : left_)[row.status];
    }
  }

  void say_retried() {
    if (!options_.retry_failed) return;
    std::string text = "no failed evaluation is run again";
    if (!retried_.empty()) {
      text = fmt::format("{} {} again ({})",
                         counted(static_cast<std::int64_t>(retried_.size()), "failed evaluation"),
                         retried_.size() == 1 ? "is run" : "are run", shown_causes(again_));
    }
    if (!left_.empty()) {
      text += fmt::format("; not repeated, since they would fail again: {}", shown_causes(left_));
    }
    said_.push_back(std::move(text));
  }

  const SessionOptions& options_;
  const std::filesystem::path& directory_;
  const StudyIdentity& identity_;
  const Evaluator& evaluator_;
  const JournalContents& contents_;
  bool is_same_;
  RowComparison comparison_;
  std::vector<std::uint64_t> retried_;
  Causes again_;
  Causes left_;
  std::vector<std::string> said_;
};

}  // namespace

std::string prepare_continuation(const SessionOptions& options,
                                 const std::filesystem::path& directory,
                                 const StudyIdentity& identity, const Evaluator& evaluator) {
  if (options.fresh || !(options.retry_failed || options.extend)) return {};
  const std::optional<JournalContents> contents = find_begun(directory);
  if (!contents) return {};
  return Continuation(options, directory, identity, evaluator, *contents).prepare();
}

void throw_other_input(const OtherInput& found, const SessionOptions& options) {
  if (!options.goes_on) throw found;
  throw StoreError(fmt::format(
      "{}; keep its rows with --extend where this input has them all (--retry-failed where only "
      "limits are wider), {}",
      found.fact(), kElsewhere));
}

}  // namespace linkstudy
