// A directory of one test, removed with it, and comparisons of records.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <bit>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "study/record/evaluation.h"

namespace linkstudy {

class Scratch : public testing::Test {
 protected:
  Scratch() {
    std::string pattern = (std::filesystem::temp_directory_path() / "linkstudy_XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no scratch directory");
    dir_ = pattern;
  }
  ~Scratch() override { std::filesystem::remove_all(dir_); }

  void put(const std::filesystem::path& path, std::string_view bytes) const {
    std::ofstream(path, std::ios::binary) << bytes;
  }

  std::filesystem::path dir_;
};

// The message of the exception that `act` throws; fails the test when it throws none.
template <class Exception, class Act>
std::string message_of(Act act) {
  try {
    act();
  } catch (const Exception& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

// Equal to the bit; NaN equals NaN.
inline bool same(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

inline void expect_same(const Evaluation& a, const Evaluation& b) {
  EXPECT_EQ(a.point.id, b.point.id);
  EXPECT_EQ(a.point.values, b.point.values);
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.message, b.message);
  EXPECT_TRUE(std::ranges::equal(a.responses, b.responses, same)) << "evaluation " << a.point.id;
  EXPECT_EQ(a.attempts, b.attempts);
  EXPECT_EQ(a.parent, b.parent);
  EXPECT_EQ(a.wall_s, b.wall_s);
  EXPECT_EQ(a.rank, b.rank);
  EXPECT_EQ(a.host, b.host);
}

// What records of evaluations do not hold.
inline void expect_same_derived(const Evaluation& a, const Evaluation& b) {
  EXPECT_EQ(a.derived.size(), b.derived.size());
  for (std::size_t i = 0; i < std::min(a.derived.size(), b.derived.size()); ++i) {
    EXPECT_EQ(a.derived[i].name, b.derived[i].name);
    EXPECT_EQ(a.derived[i].unit, b.derived[i].unit);
    EXPECT_EQ(a.derived[i].values, b.derived[i].values);
  }
}

}  // namespace linkstudy
