#include "study/store/results_file.h"

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <functional>

#include "study/record/digest.h"
#include "study/store/file.h"
#include "study/store/group_file.h"
#include "study/store/store_error.h"
#include "study/store/utf8.h"
#include "tests/study/store/sample/sample.h"
#include "tests/study/store/scratch.h"

namespace linkstudy::results_file_test {
namespace {

using ::testing::HasSubstr;

class ResultsFile : public Scratch {
 protected:
  std::filesystem::path path() const { return dir_ / "results.h5"; }
};

void expect_same(const std::vector<TraceSet>& a, const std::vector<TraceSet>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].name, b[i].name);
    EXPECT_EQ(a[i].evaluation, b[i].evaluation);
    ASSERT_EQ(a[i].traces.size(), b[i].traces.size());
    for (std::size_t k = 0; k < a[i].traces.size(); ++k) {
      EXPECT_EQ(a[i].traces[k].name, b[i].traces[k].name);
      EXPECT_EQ(a[i].traces[k].unit, b[i].traces[k].unit);
      EXPECT_EQ(a[i].traces[k].values, b[i].traces[k].values);
    }
  }
}

TEST_F(ResultsFile, Gives_the_same_results_back) {
  const StudyResults written = sample::results();
  const std::string digest = write_results(path(), written);
  const StudyResults read = read_results(path());
  EXPECT_EQ(read.results_digest, digest);
  EXPECT_EQ(
      results_digest(read.description.parameters, read.description.responses, read.evaluations),
      digest);
  EXPECT_EQ(read.status, written.status);
  EXPECT_EQ(read.input_sha256, written.input_sha256);
  EXPECT_EQ(read.program_version, written.program_version);
  EXPECT_EQ(read.git_revision, written.git_revision);
  EXPECT_EQ(read.description.name, written.description.name);
  EXPECT_EQ(read.description.kind, written.description.kind);
  EXPECT_EQ(read.description.seed, written.description.seed);
  ASSERT_EQ(read.description.parameters.size(), 3u);
  EXPECT_EQ(read.description.parameters[0].path, "closure.S.sde.stiffness");
  EXPECT_EQ(read.description.parameters[1].unit, "");
  EXPECT_EQ(read.description.parameters[2].long_name, "size of the drive");
  ASSERT_EQ(read.description.responses.size(), 2u);
  EXPECT_EQ(read.description.responses[0].unit, "");
  EXPECT_EQ(read.description.responses[1].name, "gap_max_closure_S");
  ASSERT_EQ(read.evaluations.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    linkstudy::expect_same(read.evaluations[i], written.evaluations[i]);
  }
  expect_same(read.references, written.references);
  expect_same(read.traces, written.traces);
  ASSERT_EQ(read.provenance.size(), 2u);
  EXPECT_EQ(read.provenance[0].time_unix_s, written.provenance[0].time_unix_s);
  EXPECT_EQ(read.provenance[1].event, "resume");
  EXPECT_EQ(read.provenance[1].ranks, 2u);
  EXPECT_EQ(read.provenance[1].command, "linkstudy study");
  EXPECT_EQ(read.provenance[0].simd, "avx2");
  EXPECT_EQ(read.provenance[1].lanes, 8u);
  EXPECT_EQ(read.provenance[1].job, "12_3");
  EXPECT_EQ(read.provenance[1].restart, 1u);
  ASSERT_EQ(read.texts.size(), 2u);
  EXPECT_EQ(read.texts[0].text, written.texts[0].text);
}

TEST_F(ResultsFile, Keeps_tunings_of_any_shape) {
  write_results(path(), sample::results());
  const StudyResults read = read_results(path());
  ASSERT_EQ(read.answers.size(), 1u);
  const Table expected = sample::tuning();
  EXPECT_EQ(read.answers[0].tables.name, expected.name);
  EXPECT_THAT(read.answers[0].tables.attributes,
              ::testing::UnorderedElementsAreArray(expected.attributes));
  EXPECT_EQ(read.answers[0].tables.parts, expected.parts);
}

// As a session journals them: what is derived before its evaluation, a tuning as two texts.
TEST_F(ResultsFile, Has_the_same_derived_numbers_and_tunings_by_journal_and_by_file) {
  const StudyResults written = sample::results();
  Table tuning = sample::tuning();
  tuning.attributes = {{"answer", std::string("{}")}};
  {
    Journal journal(dir_, sample::kInputSha256, OpenMode::resume);
    journal.append(written.description);
    for (const std::size_t i : {2, 0, 3, 1}) {
      const Evaluation& one = written.evaluations[i];
      if (!one.derived.empty()) journal.append(derived_set(one));
      journal.append(one);
    }
    for (const NamedText& text : answer_texts({AnswerKind::tuning, tuning})) journal.append(text);
  }
  const StudyResults found = read_stored(dir_);
  write_results(path(), found);
  for (const StudyResults& read : {found, read_stored(path())}) {
    ASSERT_EQ(read.evaluations.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
      linkstudy::expect_same(read.evaluations[i], written.evaluations[i]);
      expect_same_derived(read.evaluations[i], written.evaluations[i]);
    }
    EXPECT_TRUE(read.traces.empty());
    ASSERT_EQ(read.answers.size(), 1u);
    EXPECT_EQ(read.answers[0].tables, tuning);
  }
}

// Journals of older programs have the JSON object of a tuning only.
TEST_F(ResultsFile, Lends_a_directory_the_tables_of_a_tuning_that_its_journal_lacks) {
  const StudyResults results = sample::results();
  {
    Journal journal(dir_, sample::kInputSha256, OpenMode::resume);
    journal.append(results.description);
    journal.append(NamedText{"tuning/S", "{}"});
  }
  write_results(path(), results);
  EXPECT_EQ(read_stored(dir_).answers.at(0).tables.parts, sample::tuning().parts);
  std::filesystem::remove(path());
  EXPECT_TRUE(read_stored(dir_).answers.at(0).tables.parts.empty());
}

TEST_F(ResultsFile, Is_the_same_whether_it_comes_from_memory_or_from_the_journal) {
  const StudyResults written = sample::results();
  {
    Journal journal(dir_, sample::kInputSha256, OpenMode::resume);
    journal.append(written.description);
    journal.append(written.provenance[0]);
    for (const std::size_t i : {3, 0, 2, 1}) journal.append(written.evaluations[i]);
    journal.append(written.references[0]);
    journal.append(written.traces[0]);
    journal.append(written.texts[0]);
    journal.append(NamedText{"tuning/S", "{\"C0\": true}"});
  }
  const StudyResults found = results_from(read_journal(dir_));
  EXPECT_EQ(write_results(dir_ / "a.h5", found), write_results(dir_ / "b.h5", written));
  const StudyResults read = read_results(dir_ / "a.h5");
  expect_same(read.references, written.references);
  expect_same(read.traces, written.traces);
  EXPECT_EQ(read.git_revision, written.git_revision);
  ASSERT_EQ(read.answers.size(), 1u);
  EXPECT_EQ(read.answers[0].tables.attributes,
            (std::vector<Attribute>{{"answer", std::string("{\"C0\": true}")}}));
}

TEST_F(ResultsFile, Of_a_study_without_rows_opens) {
  StudyResults empty;
  empty.description = sample::description();
  write_results(path(), empty);
  const StudyResults read = read_results(path());
  EXPECT_TRUE(read.evaluations.empty());
  EXPECT_EQ(read.description.parameters.size(), 3u);
  EXPECT_EQ(read.status, RunStatus::running);
}

TEST_F(ResultsFile, Fills_responses_that_are_missing_and_refuses_points_that_do_not_fit) {
  StudyResults results = sample::results();
  results.evaluations[2].responses.clear();
  EXPECT_EQ(write_results(path(), results), write_results(path(), sample::results()));
  EXPECT_EQ(read_results(path()).evaluations[2].responses.size(), 2u);
  results.evaluations[1].point.values[1] = 3.0;
  EXPECT_THAT(message_of<std::invalid_argument>([&] { write_results(path(), results); }),
              HasSubstr("'closure.S.model'"));
}

// A name like that of an outcome, and two that differ in their dots only.
TEST_F(ResultsFile, Keeps_names_apart_that_would_collide_in_the_file) {
  StudyResults results;
  results.description.parameters = {{"status", "m", "s"}, {"a.b", "m", "x"}, {"a_b", "m", "y"}};
  Evaluation evaluation;
  evaluation.point.values = {1.0, 2.0, 3.0};
  results.evaluations = {evaluation};
  write_results(path(), results);
  const StudyResults read = read_results(path());
  ASSERT_EQ(read.description.parameters.size(), 3u);
  EXPECT_EQ(read.description.parameters[2].path, "a_b");
  EXPECT_EQ(read.evaluations[0].point.values, evaluation.point.values);
}

TEST_F(ResultsFile, Names_in_the_file_are_letters_digits_and_underscores) {
  EXPECT_EQ(dataset_name("closure.S.sde.stiffness"), "closure_S_sde_stiffness");
  EXPECT_EQ(dataset_name("4-bar"), "n4_bar");
  EXPECT_EQ(dataset_name("_x"), "n_x");
  EXPECT_EQ(dataset_name("\u00e4"), "n__");
  EXPECT_EQ(dataset_name(""), "n");
}

// Valid and invalid sequences of the Unicode Standard, table 3-7.
TEST_F(ResultsFile, Texts_become_valid_utf8) {
  EXPECT_EQ(valid_utf8("\u00e4\u20ac\U0001F600z"), "\u00e4\u20ac\U0001F600z");
  EXPECT_EQ(valid_utf8("a\xff"
                       "b"),
            "a\uFFFDb");
  EXPECT_EQ(valid_utf8("\xc0\x80"), "\uFFFD\uFFFD");
  EXPECT_EQ(valid_utf8("\xed\xa0\x80"), "\uFFFD\uFFFD\uFFFD");
  EXPECT_EQ(valid_utf8("\xe2\x82"), "\uFFFD\uFFFD");
  EXPECT_EQ(valid_utf8(std::string_view("a\0b", 3)), "a\uFFFDb");
}

TEST_F(ResultsFile, What_is_no_results_file_is_refused) {
  put(path(), "not HDF5 at all");
  EXPECT_THAT(message_of<StoreError>([&] { read_results(path()); }), HasSubstr("results.h5"));
  Table other;
  other.attributes = {{"format", std::string("something else")}};
  write_group_file(path(), other);
  EXPECT_THAT(message_of<StoreError>([&] { read_results(path()); }),
              HasSubstr("not a results file of linkstudy"));
  EXPECT_THROW(read_results(dir_ / "missing.h5"), StoreError);
}

// Another process opens the file again and again while this one replaces it a hundred times: it
// always finds a whole one.
TEST_F(ResultsFile, A_reader_never_sees_a_part) {
  StudyResults results = sample::results();
  write_results(path(), results);
  const pid_t reader = ::fork();
  if (reader == 0) {
    ::alarm(60);
    int reads = 0;
    try {
      while (read_results(path()).status != RunStatus::interrupted) ++reads;
    } catch (const std::exception&) {
      ::_exit(1);
    }
    ::_exit(reads > 0 ? 0 : 2);
  }
  for (int i = 0; i < 100; ++i) {
    results.description.seed = static_cast<std::uint64_t>(i);
    write_results(path(), results);
  }
  results.status = RunStatus::interrupted;
  write_results(path(), results);
  int status = 0;
  ::waitpid(reader, &status, 0);
  EXPECT_EQ(status, 0);
}

// Every limit from nothing to nearly the whole file: always an error, the old file stays, and no
// part of the new one.
TEST_F(ResultsFile, A_full_disk_is_an_error_and_keeps_the_old_file) {
  write_results(path(), sample::results());
  const std::string before = read_file(path());
  StudyResults changed = sample::results();
  changed.evaluations[0].responses[0] = 42.0;
  for (rlim_t limit = 0; limit < before.size(); limit += 3000) {
    const pid_t child = ::fork();
    if (child == 0) {
      std::signal(SIGXFSZ, SIG_IGN);
      const rlimit files = {limit, limit};
      ::setrlimit(RLIMIT_FSIZE, &files);
      try {
        write_results(path(), changed);
      } catch (const StoreError&) {
        std::exit(3);  // not _exit: closing the library must come to an end too
      }
      ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 3) << limit << " status " << status;
    ASSERT_EQ(read_file(path()), before);
    ASSERT_FALSE(std::filesystem::exists(dir_ / "results.h5.tmp"));
  }
}

TEST_F(ResultsFile, A_text_is_replaced_whole_or_not_at_all) {
  const std::filesystem::path text = dir_ / "resolved.toml";
  write_file_atomically(text, "first");
  write_file_atomically(text, "second");
  EXPECT_EQ(read_file(text), "second");
  EXPECT_FALSE(std::filesystem::exists(dir_ / "resolved.toml.tmp"));
  EXPECT_THROW(write_file_atomically(dir_ / "no" / "where", "x"), StoreError);
  std::filesystem::create_directory(dir_ / "taken");
  put(dir_ / "taken" / "content", "x");
  EXPECT_THROW(write_file_atomically(dir_ / "taken", "x"), StoreError);
  EXPECT_FALSE(std::filesystem::exists(dir_ / "taken.tmp"));
}

}  // namespace
}  // namespace linkstudy::results_file_test
