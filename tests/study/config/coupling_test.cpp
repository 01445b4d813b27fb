// Couplings as they are written and read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "config_text.h"
#include "wrong_text.h"

namespace linkstudy::coupling_test {
namespace {

using test::kRsrrp;
using test::read_good;
using test::Wrong;

const char* const kCouplings = R"(
[[coupling]]
name = "rack"
terms = [{ joint = "P", factor = 1.0 }, { joint = "A", coordinate = 0, factor = -0.02 }]
offset = "25 cm"
[[coupling]]
name = "belt"
terms = [{ joint = "Q" }, { joint = "R", factor = -3.0 }]
)";

TEST(Coupling, Is_read_key_by_key) {
  const std::vector<Coupling> couplings = read_good(kRsrrp + kCouplings).linkage.couplings;
  ASSERT_EQ(couplings.size(), 2u);
  ASSERT_EQ(couplings[0].terms.size(), 2u);
  EXPECT_EQ(couplings[0].terms[1].joint, "A");
  EXPECT_EQ(couplings[0].terms[1].factor, -0.02);
  EXPECT_EQ(couplings[0].offset, 0.25);
  EXPECT_EQ(couplings[1].terms[0].factor, 1.0);
  EXPECT_FALSE(couplings[1].offset);
  const auto offset = read_good(kRsrrp + kCouplings, {"coupling.rack.offset=\"30 cm\""});
  EXPECT_EQ(offset.linkage.couplings[0].offset, 0.3);
}

class WrongCoupling : public ::testing::TestWithParam<Wrong> {};

const Wrong kWrong[] = {
    {"unknown_joint", "joint = \"Q\"", "joint = @\"QQ\"",
     "coupling 'belt': joint does not exist, got 'QQ'", "did you mean 'Q'?"},
    {"coordinate_beyond", "coordinate = 0", "coordinate = @2",
     "coupling 'rack': joint 'A' has 1 coordinates, counted from 0, got 2"},
    {"one_term", "[{ joint = \"Q\" }, { joint = \"R\", factor = -3.0 }]", "@[{ joint = \"Q\" }]",
     "coupling 'belt': terms must be two or more, got 1"},
    {"twice", "joint = \"R\", factor", "joint = @\"Q\", factor",
     "coupling 'belt': the coordinate is in the terms twice"},
    {"zero", "factor = -3.0", "factor = @0.0",
     "coupling 'belt': factor must be finite and not zero"},
    {"radians_of_a_rack", "offset = \"25 cm\"", "offset = @\"25 deg\"",
     "offset must be in m here, got a value in rad"},
    {"no_terms", "terms = [{ joint = \"Q\" }, { joint = \"R\", factor = -3.0 }]\n", "",
     "coupling 'belt': terms is missing"},
    {"same_name", "name = \"belt\"", "name = @\"rack\"", "the name 'rack' is used twice"},
};

TEST_P(WrongCoupling, Gives_one_error_at_the_marked_place) {
  const Wrong& wrong = GetParam();
  if (std::string(wrong.what) == "no_terms") {
    Diagnostics diagnostics;
    test::read_text(test::replaced(kRsrrp + kCouplings, wrong.from, wrong.to), diagnostics);
    EXPECT_THAT(to_string(diagnostics), ::testing::HasSubstr(wrong.message));
    return;
  }
  test::expect_one_error(kRsrrp + kCouplings, wrong);
}

std::string name_of_case(const ::testing::TestParamInfo<Wrong>& info) {
  return info.param.what;
}

INSTANTIATE_TEST_SUITE_P(Couplings, WrongCoupling, ::testing::ValuesIn(kWrong), name_of_case);

TEST(Coupling, Beside_shared_reactions_is_refused) {
  Diagnostics diagnostics;
  const Override shared = test::set("simulation.redundant_reactions=\"loops\"");
  test::read_text(kRsrrp + kCouplings, diagnostics, {&shared, 1});
  EXPECT_THAT(to_string(diagnostics), ::testing::HasSubstr("does not know couplings"));
}

}  // namespace
}  // namespace linkstudy::coupling_test
