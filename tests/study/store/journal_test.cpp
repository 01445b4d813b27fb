#include "study/store/journal.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <boost/crc.hpp>
#include <csignal>
#include <cstring>
#include <functional>
#include <random>
#include <thread>

#include "study/store/store_error.h"
#include "tests/study/store/sample/sample.h"
#include "tests/study/store/scratch.h"

namespace linkstudy::journal_test {
namespace {

using ::testing::HasSubstr;

const std::string& kInput = sample::kInputSha256;
const std::string kOtherInput(64, 'b');

// Every third of our evaluations failed, so that both shapes are in every file.
Evaluation evaluation(std::uint64_t id) {
  return id % 3 == 2 ? sample::failed_evaluation(id) : sample::evaluation(id);
}

class JournalFile : public Scratch {
 protected:
  std::filesystem::path path() const { return dir_ / kJournalName; }

  void write(std::uint64_t count) const {
    Journal journal(dir_, kInput, OpenMode::fresh);
    for (std::uint64_t id = 0; id < count; ++id) journal.append(evaluation(id));
  }

  // Rows 0 .. count - 1, bit for bit, and nothing else.
  void expect_rows(const JournalContents& contents, std::uint64_t count) const {
    ASSERT_EQ(contents.evaluations.size(), count);
    for (std::uint64_t id = 0; id < count; ++id) {
      expect_same(contents.evaluations[id], evaluation(id));
    }
  }
};

// End of each whole record of `count` evaluations, bytes from the start of the file.
std::vector<std::size_t> record_ends(std::uint64_t count) {
  std::vector<std::size_t> ends = {kJournalHeaderSize};
  for (std::uint64_t id = 0; id < count; ++id) {
    ends.push_back(ends.back() + encode_record(evaluation(id)).size());
  }
  return ends;
}

std::uint64_t whole_records(const std::vector<std::size_t>& ends, std::size_t bytes) {
  std::uint64_t count = 0;
  while (count + 1 < ends.size() && ends[count + 1] <= bytes) ++count;
  return count;
}

TEST_F(JournalFile, Gives_back_every_kind_of_record) {
  {
    Journal journal(dir_, kInput, OpenMode::resume);
    journal.append(sample::description());
    journal.append(sample::results().provenance[0]);
    journal.append(evaluation(1));
    journal.append(evaluation(2));
    journal.append(sample::traces("reference", -1, 50));
    journal.append(NamedText{"tuning/S", "{\"C0\": true}"});
    EXPECT_EQ(journal.appended(), 6u);
  }
  const JournalContents contents = read_journal(dir_);
  EXPECT_EQ(contents.input_sha256, kInput);
  EXPECT_EQ(contents.dropped_bytes, 0u);
  EXPECT_EQ(contents.evaluations_since_start, 2u);
  ASSERT_TRUE(contents.description);
  EXPECT_EQ(contents.description->seed, sample::description().seed);
  EXPECT_EQ(contents.description->parameters[2].long_name, "size of the drive");
  EXPECT_EQ(contents.description->responses[1].unit, "m");
  ASSERT_EQ(contents.evaluations.size(), 2u);
  expect_same(contents.evaluations[1], evaluation(2));
  ASSERT_EQ(contents.traces.size(), 1u);
  EXPECT_EQ(contents.traces[0].traces[1].values, sample::traces("", 0, 50).traces[1].values);
  ASSERT_EQ(contents.texts.size(), 1u);
  EXPECT_EQ(contents.texts[0].text, "{\"C0\": true}");
  ASSERT_EQ(contents.provenance.size(), 1u);
  EXPECT_EQ(contents.provenance[0].total, 4u);
  EXPECT_EQ(contents.provenance[0].time_unix_s, 1.7e9 + 0.25);
  EXPECT_EQ(contents.provenance[0].simd, "avx2");
  EXPECT_EQ(contents.provenance[0].lanes, 4u);
}

// The layout as the header of journal_record.h states it, taken apart by hand.
TEST_F(JournalFile, Has_the_layout_it_documents) {
  write(1);
  const std::string bytes = read_file(path());
  EXPECT_EQ(bytes.substr(0, 8), "linkstJ\n");
  EXPECT_EQ(bytes.substr(8, 4), std::string("\x03\0\0\0", 4));
  EXPECT_EQ(bytes.substr(12, 64), kInput);
  std::uint32_t length = 0;
  std::uint32_t sum = 0;
  std::memcpy(&length, &bytes[kJournalHeaderSize], 4);  // this test runs on little-endian machines
  std::memcpy(&sum, &bytes[kJournalHeaderSize + 4], 4);
  EXPECT_EQ(length, bytes.size() - kJournalHeaderSize - 8);
  boost::crc_32_type crc;
  crc.process_bytes(&bytes[kJournalHeaderSize], 4);
  crc.process_bytes(&bytes[kJournalHeaderSize + 8], length);
  EXPECT_EQ(sum, crc.checksum());
}

TEST_F(JournalFile, Of_a_repeated_id_the_last_record_counts) {
  {
    Journal journal(dir_, kInput, OpenMode::resume);
    journal.append(sample::failed_evaluation(1));
    journal.append(evaluation(0));
    journal.append(evaluation(1));
  }
  expect_rows(read_journal(dir_), 2);
}

TEST_F(JournalFile, A_torn_tail_is_dropped_at_every_byte) {
  constexpr std::uint64_t kCount = 4;
  write(kCount);
  const std::string bytes = read_file(path());
  const std::vector<std::size_t> ends = record_ends(kCount);
  ASSERT_EQ(ends.back(), bytes.size());
  for (std::size_t size = 0; size <= bytes.size(); ++size) {
    put(path(), bytes.substr(0, size));
    const std::uint64_t whole = whole_records(ends, size);
    {
      Journal journal(dir_, kInput, OpenMode::resume);
      expect_rows(journal.contents(), whole);
      journal.append(evaluation(whole));
    }
    const JournalContents contents = read_journal(dir_);
    expect_rows(contents, whole + 1);
    ASSERT_EQ(contents.dropped_bytes, 0u) << "cut at " << size;
  }
}

TEST_F(JournalFile, A_tail_of_zeros_is_no_record) {
  write(2);
  put(path(), read_file(path()) + std::string(4096, '\0'));
  const JournalContents contents = read_journal(dir_);
  expect_rows(contents, 2);
  EXPECT_EQ(contents.dropped_bytes, 4096u);
}

TEST_F(JournalFile, No_flipped_bit_is_ever_trusted) {
  constexpr std::uint64_t kCount = 3;
  write(kCount);
  const std::string bytes = read_file(path());
  const std::vector<std::size_t> ends = record_ends(kCount);
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    std::string damaged = bytes;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << bit % 8));
    if (bit / 8 < kJournalHeaderSize) {
      ASSERT_THROW(parse_journal(damaged, path()), StoreError) << "bit " << bit;
    } else {
      expect_rows(parse_journal(damaged, path()), whole_records(ends, bit / 8));
    }
  }
}

TEST_F(JournalFile, Another_input_is_refused_until_the_user_says_fresh) {
  write(2);
  const std::string before = read_file(path());
  const std::string message =
      message_of<StoreError>([&] { Journal(dir_, kOtherInput, OpenMode::resume); });
  EXPECT_THAT(message, HasSubstr("another input"));
  EXPECT_THAT(message, HasSubstr("--fresh"));
  EXPECT_EQ(read_file(path()), before);
  put(dir_ / "results.h5", "of the old input");
  { Journal(dir_, kOtherInput, OpenMode::fresh).append(evaluation(0)); }
  EXPECT_EQ(read_journal(dir_).input_sha256, kOtherInput);
  EXPECT_FALSE(std::filesystem::exists(dir_ / "results.h5"));
}

TEST_F(JournalFile, A_file_that_is_not_ours_is_never_overwritten) {
  put(path(), "LPKSHHRH, a journal of somebody else");
  const std::string before = read_file(path());
  for (const OpenMode mode : {OpenMode::resume, OpenMode::fresh}) {
    EXPECT_THAT(message_of<StoreError>([&] { Journal(dir_, kInput, mode); }),
                HasSubstr("not a journal of linkstudy"));
  }
  EXPECT_EQ(read_file(path()), before);
}

TEST_F(JournalFile, Another_version_is_refused_by_name) {
  write(1);
  std::string bytes = read_file(path());
  bytes[8] = 9;
  boost::crc_32_type crc;
  crc.process_bytes(bytes.data(), 76);
  const std::uint32_t sum = crc.checksum();
  std::memcpy(&bytes[76], &sum, 4);
  put(path(), bytes);
  EXPECT_THAT(message_of<StoreError>([&] { Journal(dir_, kInput, OpenMode::resume); }),
              HasSubstr("journal version 9, this program reads version 3"));
}

// Records of kind 4 end before the job: the shape that version 2 wrote.
TEST_F(JournalFile, Of_the_older_version_is_read_and_not_continued) {
  write(2);
  std::string bytes = read_file(path());
  bytes[8] = 2;
  boost::crc_32_type crc;
  crc.process_bytes(bytes.data(), 76);
  const std::uint32_t sum = crc.checksum();
  std::memcpy(&bytes[76], &sum, 4);
  ProvenanceRow row = sample::results().provenance[0];
  row.job = "";
  std::string old_row = encode_record(row);
  old_row.resize(old_row.size() - 12);  // length of an empty text, restart
  old_row[kRecordPrefixSize] = 4;
  const auto length = static_cast<std::uint32_t>(old_row.size() - kRecordPrefixSize);
  std::memcpy(old_row.data(), &length, 4);
  boost::crc_32_type record_crc;
  record_crc.process_bytes(old_row.data(), 4);
  record_crc.process_bytes(old_row.data() + kRecordPrefixSize, length);
  const std::uint32_t record_sum = record_crc.checksum();
  std::memcpy(&old_row[4], &record_sum, 4);
  put(path(), bytes + old_row);
  const JournalContents contents = read_journal(dir_);
  expect_rows(contents, 2);
  ASSERT_EQ(contents.provenance.size(), 1u);
  EXPECT_EQ(contents.provenance[0].command, row.command);
  EXPECT_EQ(contents.provenance[0].lanes, row.lanes);
  EXPECT_THAT(message_of<StoreError>([&] { Journal(dir_, kInput, OpenMode::resume); }),
              HasSubstr("journal version 2, this program continues version 3"));
}

TEST_F(JournalFile, Gives_back_reference_runs_and_the_job_of_a_start) {
  {
    Journal journal(dir_, kInput, OpenMode::resume);
    ProvenanceRow row = sample::results().provenance[1];
    row.job = "12_3";
    row.restart = 2;
    journal.append(row);
    journal.append(StoredReference{"", std::string("\0\xff", 2)});
    journal.append(StoredReference{"fast", "older"});
    journal.append(StoredReference{"fast", "newer"});
  }
  const JournalContents contents = read_journal(dir_);
  EXPECT_EQ(contents.provenance.at(0).job, "12_3");
  EXPECT_EQ(contents.provenance.at(0).restart, 2u);
  ASSERT_EQ(contents.references.size(), 2u);
  EXPECT_EQ(contents.references[0].bytes, std::string("\0\xff", 2));
  EXPECT_EQ(contents.references[1].bytes, "newer");
}

TEST_F(JournalFile, A_second_writer_is_refused_while_the_first_lives) {
  {
    Journal first(dir_, kInput, OpenMode::resume);
    first.append(evaluation(0));
    EXPECT_TRUE(is_locked(path()));
    for (const OpenMode mode : {OpenMode::resume, OpenMode::fresh}) {
      EXPECT_THAT(message_of<StoreError>([&] { Journal(dir_, kInput, mode); }),
                  HasSubstr("another run is writing here"));
    }
    first.append(evaluation(1));
  }
  EXPECT_FALSE(is_locked(path()));
  expect_rows(Journal(dir_, kInput, OpenMode::resume).contents(), 2);
}

TEST_F(JournalFile, Sixty_four_records_or_a_tenth_of_a_second_are_synced_unasked) {
  Journal journal(dir_, kInput, OpenMode::resume);
  const auto start = std::chrono::steady_clock::now();
  for (std::uint64_t id = 0; id < 63; ++id) journal.append(evaluation(id));
  if (std::chrono::steady_clock::now() - start < std::chrono::milliseconds(100)) {
    EXPECT_EQ(journal.acknowledged(), 0u);
  }
  journal.append(evaluation(63));
  EXPECT_EQ(journal.acknowledged(), 64u);
  journal.append(evaluation(64));
  std::this_thread::sleep_for(std::chrono::milliseconds(120));
  journal.sync_if_due();
  EXPECT_EQ(journal.acknowledged(), 65u);
  journal.append(evaluation(65));
  journal.sync();
  EXPECT_EQ(journal.acknowledged(), 66u);
}

// Runs `act` in a child whose files may not grow past `bytes`: the kernel writes what still fits
// and then fails, as a full disk does. True when the act did as it should.
bool with_full_disk(rlim_t bytes, const std::function<bool()>& act) {
  const pid_t child = ::fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit = {bytes, bytes};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    ::_exit(act() ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

TEST_F(JournalFile, A_full_disk_is_an_error_and_leaves_whole_records) {
  constexpr std::uint64_t kFit = 5;
  const std::vector<std::size_t> ends = record_ends(kFit + 1);
  for (std::size_t limit = ends[kFit]; limit < ends[kFit + 1]; limit += 7) {
    EXPECT_TRUE(with_full_disk(limit, [&] {
      Journal journal(dir_, kInput, OpenMode::fresh);
      for (std::uint64_t id = 0; id < kFit; ++id) journal.append(evaluation(id));
      int errors = 0;
      for (int i = 0; i < 2; ++i) {
        try {
          journal.append(evaluation(kFit));
        } catch (const StoreError&) {
          ++errors;
        }
      }
      return errors == 2 && journal.appended() == kFit;
    })) << limit;
    const JournalContents contents = read_journal(dir_);
    expect_rows(contents, kFit);
    EXPECT_EQ(contents.dropped_bytes, 0u);
  }
}

// Appends from `next` on until it is killed; after each sync tells the pipe how many rows are
// acknowledged in all.
[[noreturn]] void append_until_killed(const std::filesystem::path& dir, int pipe) {
  Journal journal(dir, kInput, OpenMode::resume);
  const std::uint64_t first = journal.contents().evaluations.size();
  std::uint64_t told = 0;
  for (std::uint64_t id = first;; ++id) {
    journal.append(evaluation(id));
    if (id % 7 == 0) journal.sync();
    if (journal.acknowledged() != told) {
      told = journal.acknowledged();
      const std::uint64_t rows = first + told;
      if (::write(pipe, &rows, sizeof rows) != sizeof rows) ::_exit(1);
    }
  }
}

std::uint64_t last_told(int pipe) {
  std::uint64_t rows = 0;
  std::uint64_t last = 0;
  while (::read(pipe, &rows, sizeof rows) == sizeof rows) last = rows;
  return last;
}

TEST_F(JournalFile, Sixty_kills_lose_no_acknowledged_row) {
  constexpr int kKills = 60;
  std::mt19937 random(20);
  std::uniform_int_distribution<int> microseconds(0, 20000);
  std::uint64_t acknowledged = 0;
  std::uint64_t told_in_all = 0;
  for (int kill = 0; kill < kKills; ++kill) {
    std::array<int, 2> pipe{};
    ASSERT_EQ(::pipe(pipe.data()), 0);
    const pid_t writer = ::fork();
    if (writer == 0) {
      ::close(pipe[0]);
      append_until_killed(dir_, pipe[1]);
    }
    ::close(pipe[1]);
    if (kill % 2 == 1) {  // every other kill after an acknowledgement, however slow the disk is
      pollfd told_something{pipe[0], POLLIN, 0};
      ASSERT_EQ(::poll(&told_something, 1, 10000), 1);
    }
    std::this_thread::sleep_for(std::chrono::microseconds(microseconds(random)));
    ::kill(writer, SIGKILL);
    int status = 0;
    ::waitpid(writer, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status)) << "the writer ended by itself";
    const std::uint64_t told = last_told(pipe[0]);
    ::close(pipe[0]);
    told_in_all += told > 0;
    acknowledged = std::max(acknowledged, told);
    const JournalContents contents =
        parse_journal(std::filesystem::exists(path()) ? read_file(path()) : "", path());
    ASSERT_GE(contents.evaluations.size(), acknowledged);
    for (std::uint64_t id = 0; id < contents.evaluations.size(); ++id) {
      ASSERT_EQ(contents.evaluations[id].point.id, id);
    }
  }
  const JournalContents contents = read_journal(dir_);
  expect_rows(contents, contents.evaluations.size());
  EXPECT_GE(told_in_all, kKills / 2) << "the kills came before anything was written";
}

// Rows that are run again count from then on only, with what they had tried before.
TEST_F(JournalFile, Rows_struck_out_are_not_there_until_they_are_written_again) {
  write(4);
  {
    Journal journal(dir_, kInput, OpenMode::resume);
    journal.append(TraceSet{"evaluation_2", 2, {{"time", "s", {0.0}}}});
    journal.append(NamedText{"convergence/ladder", "{}"});
    journal.append(retried_text({0, 2}));
  }
  JournalContents contents = read_journal(dir_);
  ASSERT_EQ(contents.evaluations.size(), 2u);
  EXPECT_EQ(contents.evaluations[0].point.id, 1u);
  EXPECT_EQ(contents.evaluations[1].point.id, 3u);
  ASSERT_EQ(contents.struck_out.size(), 2u);
  EXPECT_EQ(contents.struck_out[1].attempts, evaluation(2).attempts);
  EXPECT_TRUE(contents.traces.empty());
  EXPECT_TRUE(contents.texts.empty()) << "no answer rests on them";
  {
    Journal journal(dir_, kInput, OpenMode::resume);
    journal.append(evaluation(2));
  }
  contents = read_journal(dir_);
  ASSERT_EQ(contents.evaluations.size(), 3u);
  expect_same(contents.evaluations[1], evaluation(2));
}

TEST_F(JournalFile, A_study_goes_on_with_the_input_that_has_all_its_rows) {
  write(3);
  {
    Journal journal(dir_, kInput, OpenMode::resume);
    journal.append(input_text(kOtherInput));
  }
  EXPECT_EQ(read_journal(dir_).input_sha256, kOtherInput);
  EXPECT_THROW(Journal(dir_, kInput, OpenMode::resume), OtherInput);
  const Journal journal(dir_, kOtherInput, OpenMode::resume);
  expect_rows(journal.contents(), 3);
}

}  // namespace
}  // namespace linkstudy::journal_test
