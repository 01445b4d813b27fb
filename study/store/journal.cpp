#include "study/store/journal.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "study/record/bytes.h"
#include "study/record/digest.h"
#include "study/store/directory.h"
#include "study/store/results_file.h"

namespace linkstudy {
namespace {

constexpr std::uint64_t kSyncRecords = 64;
constexpr std::chrono::milliseconds kSyncInterval{100};
constexpr const char* kRetried = "retried";
constexpr const char* kInput = "input_sha256";

template <class Item>
void replace_or_add(std::vector<Item>& items, Item item) {
  const auto found = std::ranges::find(items, item.name, &Item::name);
  if (found != items.end()) {
    *found = std::move(item);
  } else {
    items.push_back(std::move(item));
  }
}

// Sorts a record into the contents.
struct Collect {
  JournalContents& contents;
  std::map<std::string, std::size_t> trace_sets{};  // by name: there is one for each evaluation

  void operator()(Evaluation&& evaluation) const {
    contents.evaluations.push_back(std::move(evaluation));
    ++contents.evaluations_since_start;
  }
  void operator()(TraceSet&& set) {
    const auto [at, is_new] = trace_sets.emplace(set.name, contents.traces.size());
    if (is_new) {
      contents.traces.push_back(std::move(set));
    } else {
      contents.traces[at->second] = std::move(set);
    }
  }
  void operator()(NamedText&& text) {
    if (text.name == kRetried) {
      strike_out(from_bytes<std::vector<std::uint64_t>>(text.text));
    } else if (text.name == kInput) {
      contents.input_sha256 = text.text;
      forget_answers();
    } else {
      replace_or_add(contents.texts, std::move(text));
    }
  }
  void operator()(StoredReference&& reference) const {
    replace_or_add(contents.references, std::move(reference));
  }
  void operator()(ProvenanceRow&& row) const {
    contents.provenance.push_back(std::move(row));
    contents.evaluations_since_start = 0;
  }
  void operator()(StudyDescription&& description) const {
    contents.description = std::move(description);
  }

 private:
  // With their histories.
  void strike_out(const std::vector<std::uint64_t>& ids) {
    const std::set<std::uint64_t> all(ids.begin(), ids.end());
    const auto is_one = [&](const Evaluation& row) { return all.contains(row.point.id); };
    std::ranges::copy_if(contents.evaluations, std::back_inserter(contents.struck_out), is_one);
    std::erase_if(contents.evaluations, is_one);
    std::erase_if(contents.traces, [&](const TraceSet& set) {
      return set.evaluation >= 0 && all.contains(static_cast<std::uint64_t>(set.evaluation));
    });
    trace_sets.clear();
    for (std::size_t i = 0; i < contents.traces.size(); ++i) {
      trace_sets.emplace(contents.traces[i].name, i);
    }
    forget_answers();
  }

  void forget_answers() {
    std::erase_if(contents.texts, [](const NamedText& text) { return answer_kind_of(text); });
  }
};

void require_readable(const JournalHeader& header, const std::filesystem::path& path) {
  if (header.state == HeaderState::foreign) {
    throw StoreError(fmt::format("{}: not a journal of linkstudy; choose another directory with -o",
                                 path.string()));
  }
  if (header.state == HeaderState::damaged) {
    throw StoreError(
        fmt::format("{}: the header is damaged; overwrite the study with --fresh", path.string()));
  }
  if (header.state == HeaderState::other_version) {
    throw StoreError(fmt::format(
        "{}: journal version {}, this program reads version {}; continue with the program that "
        "wrote it or overwrite the study with --fresh",
        path.string(), header.version, kJournalVersion));
  }
}

// An older program must not meet records that it does not know.
void require_continuable(const JournalContents& contents, const std::filesystem::path& path) {
  if (contents.version == kJournalVersion) return;
  throw StoreError(fmt::format(
      "{}: journal version {}, this program continues version {} and reads the older one only for "
      "status and export; continue with the program that wrote it, choose another directory with "
      "-o or overwrite the study with --fresh",
      path.string(), contents.version, kJournalVersion));
}

File open_and_lock(const std::filesystem::path& directory) {
  File file(directory / kJournalName, O_RDWR | O_CREAT);
  if (!file.try_lock()) {
    throw StoreError(
        fmt::format("{}: another run is writing here; wait for it or choose another directory "
                    "with -o",
                    directory.string()));
  }
  return file;
}

}  // namespace

JournalContents parse_journal(std::string_view bytes, const std::filesystem::path& path) {
  JournalContents contents;
  const JournalHeader header = decode_header(bytes);
  require_readable(header, path);
  if (header.state == HeaderState::torn) {
    contents.dropped_bytes = bytes.size();
    return contents;
  }
  contents.version = header.version;
  contents.input_sha256 = header.input_sha256;
  std::size_t at = kJournalHeaderSize;
  Collect collect{contents};
  while (true) {
    const std::string_view payload = next_payload(bytes.substr(at));
    if (payload.empty()) break;
    std::visit(collect, decode_payload(payload));
    at += kRecordPrefixSize + payload.size();
  }
  contents.evaluations = latest_by_id(std::move(contents.evaluations));
  contents.struck_out = latest_by_id(std::move(contents.struck_out));
  contents.valid_bytes = at;
  contents.dropped_bytes = bytes.size() - at;
  return contents;
}

JournalContents read_journal(const std::filesystem::path& directory) {
  const std::filesystem::path path = directory / kJournalName;
  if (!std::filesystem::is_directory(directory)) {
    throw StoreError(fmt::format("{}: {}", directory.string(),
                                 std::filesystem::exists(directory)
                                     ? "is no results directory but a file"
                                     : "there is no such directory"));
  }
  if (!std::filesystem::exists(path)) {
    throw StoreError(
        fmt::format("{}: holds no study ({} is missing); name a directory that -o made",
                    directory.string(), kJournalName));
  }
  return parse_journal(read_file(path), path);
}

NamedText retried_text(const std::vector<std::uint64_t>& ids) {
  return {kRetried, to_bytes(ids)};
}

NamedText input_text(const std::string& input_sha256) {
  return {kInput, input_sha256};
}

std::string dropped_text(const JournalContents& contents, const std::filesystem::path& directory) {
  if (contents.dropped_bytes == 0) return {};
  return fmt::format(
      "{}: the last {} bytes are torn or damaged and count as not there; {} evaluations are left, "
      "and what is missing is run again",
      (directory / kJournalName).string(), contents.dropped_bytes, contents.evaluations.size());
}

Journal::Journal(const std::filesystem::path& directory, const std::string& input_sha256,
                 OpenMode mode)
    : file_(open_and_lock(directory)) {
  const std::string header = encode_header(input_sha256);
  const JournalHeader found = decode_header(file_.read_all());
  // Even --fresh overwrites nothing that is not ours.
  const bool overwrite = mode == OpenMode::fresh && found.state != HeaderState::foreign;
  if (overwrite) remove_earlier_journals(directory);
  if (overwrite || found.state == HeaderState::torn) {
    start(header);
    contents_.input_sha256 = input_sha256;
  } else {
    resume(input_sha256);
  }
}

Journal::~Journal() {
  try {
    if (!failed_ && appended_ != acknowledged_) sync();
  } catch (const StoreError&) {
    // The records are not acknowledged; whoever needs to know calls sync().
  }
}

void Journal::start(const std::string& header) {
  remove_derived_files(file_.path().parent_path());
  file_.truncate(0);
  file_.write_all(header);
  file_.sync();
  sync_directory(file_.path().parent_path());
  end_ = header.size();
}

void Journal::resume(const std::string& input_sha256) {
  contents_ = parse_journal(file_.read_all(), file_.path());
  require_continuable(contents_, file_.path());
  if (contents_.input_sha256 != input_sha256) {
    const std::string kind = contents_.description ? contents_.description->kind : "";
    throw OtherInput(
        fmt::format("{}: holds a study of another input (of linkstudy {}, digest {}..., yours is "
                    "{}...)",
                    file_.path().parent_path().string(), kind.empty() ? "study" : kind,
                    contents_.input_sha256.substr(0, 12), input_sha256.substr(0, 12)),
        "choose another directory with -o or overwrite it with --fresh");
  }
  end_ = contents_.valid_bytes;
  file_.truncate(end_);
  file_.sync();
}

void Journal::require_usable() const {
  if (failed_) {
    throw StoreError(
        fmt::format("{}: takes no more records after an error of writing", file_.path().string()));
  }
}

void Journal::append(const JournalRecord& record) {
  require_usable();
  const std::string bytes = encode_record(record);
  try {
    file_.write_all(bytes);
  } catch (const StoreError&) {
    failed_ = true;
    file_.truncate(end_);
    throw;
  }
  end_ += bytes.size();
  if (appended_ == acknowledged_) oldest_unsynced_ = Clock::now();
  ++appended_;
  if (appended_ - acknowledged_ >= kSyncRecords) {
    sync();
  } else {
    sync_if_due();
  }
}

void Journal::sync() {
  require_usable();
  try {
    file_.sync_data();
  } catch (const StoreError&) {
    failed_ = true;  // the kernel forgets what it could not write: a second try proves nothing
    throw;
  }
  acknowledged_ = appended_;
}

void Journal::sync_if_due() {
  if (appended_ != acknowledged_ && Clock::now() - oldest_unsynced_ >= kSyncInterval) sync();
}

}  // namespace linkstudy
