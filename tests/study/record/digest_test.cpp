#include "study/record/digest.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <set>

#include "study/record/bytes.h"
#include "study/record/sha256.h"

namespace linkstudy::digest_test {
namespace {

const std::vector<Parameter> kParameters = {{"closure.S.sde.stiffness", "N/m", "stiffness"},
                                            {"closure.S.model", "", "closure model"}};
const std::vector<Response> kResponses = {{"error", "1", "relative error"}, {"gap", "m", "gap"}};

std::vector<Evaluation> some_evaluations(std::size_t count) {
  std::vector<Evaluation> evaluations(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double x = 1.0 / (1.0 + static_cast<double>(i));
    evaluations[i].point = {i, {1e6 * x, std::string(i % 2 == 0 ? "cut" : "sde")}};
    evaluations[i].responses = {x * x, -x};
  }
  return evaluations;
}

std::string digest(const std::vector<Evaluation>& evaluations) {
  return results_digest(kParameters, kResponses, evaluations);
}

// FIPS 180-4 example vectors (NIST, "SHA-256 example", one block, two blocks, empty, a million a).
TEST(Digest, SHA_256_gives_the_published_vectors) {
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  Sha256 in_pieces;
  for (int i = 0; i < 1000; ++i) in_pieces.update(std::string(1000, 'a'));
  EXPECT_EQ(in_pieces.finish(), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

// The stream written out by hand from the description in bytes.h.
TEST(Digest, The_encoding_is_little_endian_with_lengths) {
  ByteWriter out;
  out(std::uint8_t{0xfe}, std::uint32_t{0x01020304u}, std::int64_t{-2}, -0.5, std::string("ab"));
  const std::string expected(
      "\xfe\x04\x03\x02\x01\xfe\xff\xff\xff\xff\xff\xff\xff"
      "\x00\x00\x00\x00\x00\x00\xe0\xbf\x02\x00\x00\x00\x00\x00\x00\x00"
      "ab",
      31);
  EXPECT_EQ(out.bytes(), expected);
  ByteReader in(out.bytes());
  EXPECT_EQ(in.read<std::uint8_t>(), 0xfe);
  EXPECT_EQ(in.read<std::uint32_t>(), 0x01020304u);
  EXPECT_EQ(in.read<std::int64_t>(), -2);
  EXPECT_EQ(in.read<double>(), -0.5);
  EXPECT_EQ(in.read<std::string>(), "ab");
  EXPECT_TRUE(in.at_end());
  EXPECT_THROW(in.read<std::uint8_t>(), std::out_of_range);
}

TEST(Digest, The_order_of_arrival_does_not_matter) {
  std::vector<Evaluation> evaluations = some_evaluations(100);
  const std::string in_order = digest(evaluations);
  std::mt19937 random(7);
  for (int i = 0; i < 20; ++i) {
    std::ranges::shuffle(evaluations, random);
    EXPECT_EQ(digest(evaluations), in_order);
  }
}

TEST(Digest, Where_and_how_long_it_ran_does_not_matter) {
  std::vector<Evaluation> evaluations = some_evaluations(3);
  const std::string before = digest(evaluations);
  evaluations[1].wall_s = 12.5;
  evaluations[1].rank = 3;
  evaluations[1].host = "n2";
  evaluations[1].attempts = 2;
  EXPECT_EQ(digest(evaluations), before);
}

TEST(Digest, Every_input_and_output_matters) {
  const std::vector<std::function<void(Evaluation&)>> changes = {
      [](Evaluation&) {},
      [](Evaluation& e) { e.point.id = 17; },
      [](Evaluation& e) { e.point.values[0] = std::nextafter(5e5, 1e6); },
      [](Evaluation& e) { e.point.values[1] = std::string("cut"); },
      [](Evaluation& e) { e.status = Cause::diverged; },
      [](Evaluation& e) { e.responses[0] = std::nextafter(0.25, 1.0); },
      [](Evaluation& e) { e.responses[1] = std::numeric_limits<double>::quiet_NaN(); },
      [](Evaluation& e) { e.responses[1] = 0.0; },
      [](Evaluation& e) { e.responses[1] = -0.0; },
      [](Evaluation& e) { e.parent = 0; },
      [](Evaluation& e) { e.message = "stopped"; },
  };
  std::set<std::string> seen;
  for (const auto& change : changes) {
    std::vector<Evaluation> evaluations = some_evaluations(3);
    change(evaluations[1]);
    seen.insert(digest(evaluations));
  }
  EXPECT_EQ(seen.size(), changes.size());
  const std::vector<Evaluation> evaluations = some_evaluations(3);
  seen.insert(results_digest({{"a", "N/m", ""}, {"b", "", ""}}, kResponses, evaluations));
  seen.insert(results_digest(kParameters, {{"error", "1", ""}, {"gap", "mm", ""}}, evaluations));
  EXPECT_EQ(seen.size(), changes.size() + 2);
}

TEST(Digest, Every_NaN_is_the_same_and_so_is_a_missing_response) {
  std::vector<Evaluation> evaluations = some_evaluations(2);
  evaluations[1].responses = {0.25, std::numeric_limits<double>::quiet_NaN()};
  const std::string before = digest(evaluations);
  evaluations[1].responses[1] = std::bit_cast<double>(std::uint64_t{0xfff0000000000123u});
  EXPECT_EQ(digest(evaluations), before);
  evaluations[1].responses.pop_back();
  EXPECT_EQ(digest(evaluations), before);
  evaluations[1].responses = {0.25, 1.0, 2.0};
  EXPECT_THROW(digest(evaluations), std::invalid_argument);
}

TEST(Digest, Of_several_evaluations_with_one_id_the_last_counts) {
  std::vector<Evaluation> evaluations = some_evaluations(4);
  const std::string once = digest(evaluations);
  Evaluation failed = evaluations[2];
  failed.status = Cause::rank_lost;
  failed.responses.clear();
  evaluations.insert(evaluations.begin() + 1, failed);
  EXPECT_EQ(digest(evaluations), once);
  const std::vector<Evaluation> latest = latest_by_id(evaluations);
  ASSERT_EQ(latest.size(), 4u);
  EXPECT_EQ(latest[2].status, Cause::ok);
  EXPECT_EQ(latest[3].point.id, 3u);
}

TEST(Digest, The_input_digest_sees_where_a_text_ends) {
  EXPECT_NE(input_sha256({"ab", "c"}), input_sha256({"a", "bc"}));
  EXPECT_NE(input_sha256({"abc"}), input_sha256({"abc", ""}));
  EXPECT_EQ(input_sha256({"abc"}), input_sha256({"abc"}));
  EXPECT_EQ(input_sha256({}).size(), 64u);
}

}  // namespace
}  // namespace linkstudy::digest_test
