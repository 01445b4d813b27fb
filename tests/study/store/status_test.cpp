#include "study/store/status.h"

#include <gmock/gmock.h>

#include "study/store/directory.h"
#include "study/store/store_error.h"
#include "tests/study/store/sample/sample.h"
#include "tests/study/store/scratch.h"

namespace linkstudy::status_test {
namespace {

using ::testing::HasSubstr;

class Directory : public Scratch {};

TEST_F(Directory, Is_created_with_its_parents_and_taken_when_empty) {
  prepare_directory(dir_ / "a" / "b");
  EXPECT_TRUE(std::filesystem::is_directory(dir_ / "a" / "b"));
  prepare_directory(dir_ / "a" / "b");
}

TEST_F(Directory, With_other_content_is_refused_and_left_alone) {
  put(dir_ / "thesis.tex", "years of work");
  EXPECT_THAT(message_of<StoreError>([&] { prepare_directory(dir_); }), HasSubstr("thesis.tex"));
  EXPECT_EQ(read_file(dir_ / "thesis.tex"), "years of work");
  EXPECT_THAT(message_of<StoreError>([&] { prepare_directory(dir_ / "thesis.tex"); }),
              HasSubstr("is a file"));
  EXPECT_THROW(prepare_directory(dir_ / "thesis.tex" / "below"), StoreError);
}

TEST_F(Directory, With_a_study_is_taken_whatever_the_user_put_beside_it) {
  { Journal(dir_, sample::kInputSha256, OpenMode::resume); }
  put(dir_ / "notes.txt", "mine");
  prepare_directory(dir_);
}

TEST_F(Directory, Of_a_study_that_ended_before_its_journal_is_taken) {
  put(dir_ / "resolved.toml", "format = 1\n");
  put(dir_ / "results.h5.tmp", "half");
  put(dir_ / "linkstudy.log", "");
  prepare_directory(dir_);
  remove_derived_files(dir_);
  EXPECT_FALSE(std::filesystem::exists(dir_ / "results.h5.tmp"));
  EXPECT_FALSE(std::filesystem::exists(dir_ / "resolved.toml"));
  EXPECT_TRUE(std::filesystem::exists(dir_ / "linkstudy.log"));
}

TEST_F(Directory, With_results_and_no_journal_is_refused_unless_fresh) {
  for (const char* name : {"results.h5", "report.html"}) {
    for (const bool torn : {false, true}) {
      SCOPED_TRACE(name);
      put(dir_ / name, "weeks of work");
      if (torn) put(dir_ / "journal.bin", "linkstJ");
      EXPECT_THAT(message_of<StoreError>([&] { prepare_directory(dir_); }), HasSubstr("--fresh"));
      EXPECT_EQ(read_file(dir_ / name), "weeks of work");
      prepare_directory(dir_, true);
      std::filesystem::remove(dir_ / name);
      std::filesystem::remove(dir_ / "journal.bin");
    }
  }
}

class Status : public Scratch {};

TEST_F(Status, Tells_what_a_damaged_journal_has_lost) {
  {
    Journal journal(dir_, sample::kInputSha256, OpenMode::resume);
    journal.append(sample::evaluation(0));
    journal.append(sample::evaluation(1));
  }
  EXPECT_EQ(read_status(dir_).dropped, "");
  std::string bytes = read_file(dir_ / "journal.bin");
  bytes[bytes.size() - 5] ^= 1;
  put(dir_ / "journal.bin", bytes);
  EXPECT_THAT(read_status(dir_).dropped, HasSubstr("1 evaluations are left"));
  EXPECT_EQ(read_status(dir_).done, 1u);
}

TEST_F(Status, Counts_of_a_running_and_of_a_dead_study_agree) {
  StudyStatus running;
  {
    Journal journal(dir_, sample::kInputSha256, OpenMode::resume);
    ProvenanceRow start = sample::results().provenance[0];
    start.total = 10;
    start.time_unix_s = unix_time_s();
    journal.append(start);
    journal.append(sample::evaluation(0));
    journal.append(sample::failed_evaluation(1));
    Evaluation late = sample::failed_evaluation(4);
    late.status = Cause::timeout;
    journal.append(late);
    running = read_status(dir_);
  }
  const StudyStatus dead = read_status(dir_);
  EXPECT_TRUE(running.running);
  EXPECT_FALSE(dead.running);
  for (const StudyStatus& status : {running, dead}) {
    EXPECT_EQ(status.total, 10u);
    EXPECT_EQ(status.done, 1u);
    EXPECT_EQ(status.failed_count(), 2u);
    EXPECT_EQ(status.failed.at(Cause::diverged), 1u);
    EXPECT_EQ(status.failed.at(Cause::timeout), 1u);
    EXPECT_GE(status.last_write_age_s, 0.0);
    EXPECT_LT(status.last_write_age_s, 60.0);
    ASSERT_TRUE(status.eta_s);
  }
}

// By hand: 6 of 10 were there, 2 more in the 8 s since the resume, 2 are left: 8 s.
TEST_F(Status, Time_left_goes_by_the_latest_start) {
  JournalContents contents;
  for (std::uint64_t id = 0; id < 8; ++id) contents.evaluations.push_back(sample::evaluation(id));
  contents.provenance = {{"start", 100.0, 10, 1, "", "", "", ""},
                         {"resume", 5000.0, 10, 1, "", "", "", ""}};
  contents.evaluations_since_start = 2;
  const StudyStatus status = summarize_status(contents, 5008.0, 5011.0);
  EXPECT_EQ(status.started_unix_s, 100.0);
  EXPECT_EQ(status.last_write_age_s, 3.0);
  ASSERT_TRUE(status.eta_s);
  EXPECT_DOUBLE_EQ(*status.eta_s, 8.0);
  contents.evaluations_since_start = 0;
  EXPECT_FALSE(summarize_status(contents, 5008.0, 5011.0).eta_s);
  contents.provenance.back().total = 8;
  EXPECT_EQ(summarize_status(contents, 5008.0, 5011.0).eta_s, 0.0);
}

TEST_F(Status, Of_a_search_counts_to_its_budget_until_it_has_its_answer) {
  const std::map<std::string, std::string> answers = {{"tune", "tuning/lowest"},
                                                      {"calibrate", "calibration/calibration"}};
  for (const auto& [kind, answer] : answers) {
    JournalContents contents;
    contents.description = sample::results().description;
    contents.description->kind = kind;
    for (std::uint64_t id = 0; id < 20; ++id) {
      contents.evaluations.push_back(sample::evaluation(id));
    }
    contents.provenance = {{"start", 100.0, 200, 1, "", "", "", ""}};
    contents.evaluations_since_start = 20;
    StudyStatus status = summarize_status(contents, 140.0, 141.0);
    EXPECT_EQ(status.total, 200u);
    EXPECT_FALSE(status.is_complete);
    ASSERT_TRUE(status.eta_s);
    EXPECT_DOUBLE_EQ(*status.eta_s, 360.0);  // 20 in 40 s, 180 left
    contents.texts.push_back({answer, "{}"});
    status = summarize_status(contents, 140.0, 141.0);
    EXPECT_TRUE(status.is_complete) << kind;
    EXPECT_EQ(status.total, 20u);
    EXPECT_EQ(status.eta_s, 0.0);
  }
}

TEST_F(Status, Of_no_study_is_an_error_that_says_so) {
  EXPECT_THAT(message_of<StoreError>([&] { read_status(dir_); }), HasSubstr("holds no study"));
}

TEST_F(Status, Of_a_study_killed_at_once_is_nothing_done) {
  put(dir_ / kJournalName, "linkst");
  const StudyStatus status = read_status(dir_);
  EXPECT_EQ(status.total, 0u);
  EXPECT_EQ(status.done, 0u);
  EXPECT_FALSE(status.eta_s);
}

}  // namespace
}  // namespace linkstudy::status_test
