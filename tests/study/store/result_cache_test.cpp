// A cache of results: only whole entries of the same program and rounding count, whoever else
// writes or damages them.
#include "study/store/result_cache.h"

#include <gtest/gtest.h>

#include <thread>

#include "study/record/sha256.h"
#include "study/store/file.h"
#include "study/store/store_error.h"
#include "tests/study/store/scratch.h"

namespace linkstudy::testing::result_cache_test {
namespace {

const MadeBy kThis{std::string(64, 'a'), "fma"};
const MadeBy kNewer{std::string(64, 'b'), "fma"};
const MadeBy kBaseline{std::string(64, 'a'), "baseline"};
// Another program whose folder has the same name.
const MadeBy kTwin{std::string(16, 'a') + std::string(48, 'c'), "fma"};

std::string key_of(int i) {
  return sha256(std::to_string(i));
}

using CacheFolder = Scratch;

TEST_F(CacheFolder, Gives_back_what_was_kept_to_the_programs_that_would_make_the_same) {
  const std::filesystem::path directory = dir_ / "cache";
  ResultCache cache(directory, kThis);
  const std::string bytes("a result\0with a zero", 20);
  EXPECT_EQ(cache.find(key_of(1)).miss, CacheMiss::unknown);
  cache.keep(key_of(1), bytes);
  EXPECT_EQ(cache.find(key_of(1)).bytes, bytes);
  EXPECT_EQ(ResultCache(directory, kThis).find(key_of(1)).bytes, bytes);
  EXPECT_FALSE(cache.find(key_of(2)).bytes);
}

TEST_F(CacheFolder, Results_of_another_program_or_rounding_are_told_and_not_given) {
  ResultCache(dir_ / "cache", kThis).keep(key_of(1), "old");
  const std::pair<MadeBy, CacheMiss> others[] = {{kNewer, CacheMiss::other_program},
                                                 {kBaseline, CacheMiss::other_rounding},
                                                 {kTwin, CacheMiss::other_program}};
  for (const auto& [made_by, miss] : others) {
    ResultCache other(dir_ / "cache", made_by);
    const CacheAnswer answer = other.find(key_of(1));
    EXPECT_FALSE(answer.bytes);
    EXPECT_EQ(answer.miss, miss) << made_by.folder();
    EXPECT_EQ(other.find(key_of(2)).miss, CacheMiss::unknown);
    other.keep(key_of(1), "new");
    EXPECT_EQ(other.find(key_of(1)).bytes, "new");
  }
}

TEST_F(CacheFolder, No_damaged_entry_is_ever_given) {
  ResultCache cache(dir_ / "cache", kThis);
  cache.keep(key_of(1), "a result");
  const std::string whole = read_file(cache.path_of(key_of(1)));
  const auto found_in = [&](const std::string& bytes) {
    put(cache.path_of(key_of(1)), bytes);
    return cache.find(key_of(1));
  };
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string bytes = whole;
    bytes[i] = static_cast<char>(bytes[i] ^ 1);
    EXPECT_EQ(found_in(bytes).miss, CacheMiss::damaged) << "byte " << i;
    EXPECT_FALSE(found_in(bytes).bytes);
    EXPECT_FALSE(found_in(whole.substr(0, i)).bytes) << "cut at " << i;
  }
  EXPECT_FALSE(found_in(whole + "x").bytes);
  EXPECT_EQ(found_in(whole).bytes, "a result");
  // The entry of another key under this name.
  cache.keep(key_of(2), "another result");
  EXPECT_EQ(found_in(read_file(cache.path_of(key_of(2)))).miss, CacheMiss::damaged);
}

TEST_F(CacheFolder, Many_writers_of_the_same_keys_leave_whole_entries) {
  const std::filesystem::path directory = dir_ / "cache";
  const auto bytes_of = [](int i) { return std::string(1000 * static_cast<std::size_t>(i), 'x'); };
  std::vector<std::thread> writers;
  for (int writer = 0; writer < 4; ++writer) {
    writers.emplace_back([&] {
      ResultCache cache(directory, kThis);
      for (int i = 0; i < 50; ++i) {
        cache.keep(key_of(i), bytes_of(i));
        const CacheAnswer answer = cache.find(key_of(i));
        EXPECT_EQ(answer.bytes, bytes_of(i)) << i;
      }
    });
  }
  for (std::thread& writer : writers) writer.join();
  EXPECT_TRUE(std::filesystem::is_empty(directory / "unfinished"));
}

TEST_F(CacheFolder, A_directory_of_something_else_is_refused) {
  put(dir_ / "notes.txt", "text");
  EXPECT_THROW(ResultCache(dir_, kThis), StoreError);
  EXPECT_THROW(ResultCache(dir_ / "notes.txt", kThis), StoreError);
  EXPECT_FALSE(std::filesystem::exists(dir_ / "CACHEDIR.TAG"));
}

// What killed programs leave is removed a day later, and nothing that is younger.
TEST_F(CacheFolder, Old_unfinished_files_are_removed) {
  const std::filesystem::path unfinished = dir_ / "cache" / "unfinished";
  ResultCache(dir_ / "cache", kThis);
  put(unfinished / "old", "half");
  put(unfinished / "young", "half");
  const auto now = std::filesystem::file_time_type::clock::now();
  std::filesystem::last_write_time(unfinished / "old", now - std::chrono::hours(25));
  ResultCache(dir_ / "cache", kThis);
  EXPECT_FALSE(std::filesystem::exists(unfinished / "old"));
  EXPECT_TRUE(std::filesystem::exists(unfinished / "young"));
}

}  // namespace
}  // namespace linkstudy::testing::result_cache_test
