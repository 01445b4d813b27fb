// Wide code is trusted after it has written what the narrow code writes, and never where it
// differs.
#include "core/codegen/frame_code.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace linkstudy::testing::frame_code_test {
namespace {

using codegen::FrameCode;
using codegen::FrameNumbers;
using codegen::Trust;

// Slots: an input, its square, a mask (where it is above zero), a constant, a place for other
// things.
constexpr int kInput = 0, kSquare = 1, kFine = 2, kConstant = 3, kOther = 4, kSlots = 5;
constexpr int kLanes = 8;
constexpr FrameCode::Frame kFrame{kLanes, kSlots, kOther, kFine};

int narrow_calls = 0, wide_calls = 0;

void square(double* frame, int lanes) {
  for (int k = 0; k < lanes; ++k) {
    const double x = frame[kInput * kLanes + k];
    frame[kSquare * kLanes + k] = x * x;
    frame[kFine * kLanes + k] = std::bit_cast<double>(x > 0.0 ? ~std::uint64_t{0} : 0);
    frame[kOther * kLanes + k] = lanes;  // the same for no two codes
  }
}
void narrow(double* frame) {
  ++narrow_calls;
  square(frame, 4);
}
void wide(double* frame) {
  ++wide_calls;
  square(frame, kLanes);
}
// Wrong by the last bit in one lane.
template <int slot, int lane>
void wrong(double* frame) {
  wide(frame);
  double& x = frame[slot * kLanes + lane];
  x = std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) ^ 1);
}

// The squares after a run on these numbers.
std::vector<double> run(FrameCode& code, const std::vector<double>& inputs) {
  FrameNumbers frame(kSlots * kLanes);
  std::copy(inputs.begin(), inputs.end(), frame.data() + kInput * kLanes);
  narrow_calls = wide_calls = 0;
  code.run(frame.data());
  return {frame.data() + kSquare * kLanes, frame.data() + (kSquare + 1) * kLanes};
}

const std::vector<double> kNumbers = {1, 2, 3, 4, 5, 6, 7, 8};
const std::vector<double> kSquares = {1, 4, 9, 16, 25, 36, 49, 64};

void expect_distrust(FrameCode::Function function) {
  FrameCode code(kFrame, narrow, function);
  const int before = codegen::distrusted_count();
  EXPECT_EQ(run(code, kNumbers), kSquares);
  EXPECT_EQ(code.trust(), Trust::none);
  EXPECT_EQ(codegen::distrusted_count(), before + 1);
  EXPECT_EQ(run(code, kNumbers), kSquares);
  EXPECT_EQ(wide_calls, 0);
  EXPECT_EQ(narrow_calls, 2);
  EXPECT_EQ(codegen::distrusted_count(), before + 1);  // said once
}

}  // namespace

TEST(FrameCode, Trusts_wide_code_that_writes_the_same) {
  FrameCode code(kFrame, narrow, wide);
  EXPECT_EQ(run(code, kNumbers), kSquares);
  EXPECT_EQ(narrow_calls, 2);
  EXPECT_EQ(wide_calls, 1);
  EXPECT_EQ(code.trust(), Trust::earned);
  EXPECT_EQ(run(code, kNumbers), kSquares);
  EXPECT_EQ(narrow_calls, 0);
  EXPECT_EQ(wide_calls, 1);
}

TEST(FrameCode, Falls_back_where_a_bit_of_any_lane_differs_and_gives_the_narrow_codes_numbers) {
  expect_distrust(wrong<kSquare, 0>);
  expect_distrust(wrong<kSquare, 7>);
  expect_distrust(wrong<kFine, 5>);
  expect_distrust(wrong<kInput, 3>);
  expect_distrust(wrong<kConstant, 6>);
}

TEST(FrameCode, Does_the_parts_of_a_slot_where_there_is_no_wide_code) {
  FrameCode code(kFrame, narrow);
  EXPECT_EQ(run(code, kNumbers), kSquares);
  EXPECT_EQ(narrow_calls, 2);
}

// A call of wide code does both frames.
template <int wrong_frame>
void wide_on_two(double* frames) {
  for (int i = 0; i < 2; ++i) {
    (i == wrong_frame ? wrong<kSquare, 2> : wide)(frames + i * kSlots * kLanes);
  }
}

TEST(FrameCode, Does_and_compares_all_frames) {
  FrameCode::Frame two = kFrame;
  two.frames = 2;
  FrameCode right(two, narrow, wide_on_two<-1>), first(two, narrow, wide_on_two<0>),
      second(two, narrow, wide_on_two<1>);
  for (FrameCode* code : {&right, &first, &second}) {
    FrameNumbers frames(2 * kSlots * kLanes);
    for (int i = 0; i < 2; ++i) {
      std::copy(kNumbers.begin(), kNumbers.end(), frames.data() + (i * kSlots + kInput) * kLanes);
    }
    narrow_calls = 0;
    code->run(frames.data());
    EXPECT_EQ(narrow_calls, 4);
    for (int i = 0; i < 2; ++i) {
      const double* squares = frames.data() + (i * kSlots + kSquare) * kLanes;
      EXPECT_EQ(std::vector<double>(squares, squares + kLanes), kSquares);
    }
    EXPECT_EQ(code->trust(), code == &right ? Trust::earned : Trust::none);
  }
}

// Lanes of which the code says nothing prove nothing.
TEST(FrameCode, Decides_when_both_parts_have_a_lane_that_counts) {
  FrameCode code(kFrame, narrow, wrong<kSquare, 7>);
  std::vector<double> numbers = {1, 2, 3, 4, -5, -6, -7, -8};
  EXPECT_EQ(run(code, numbers), kSquares);
  EXPECT_EQ(code.trust(), Trust::untried);
  numbers[4] = 5;  // lane 7 is still not looked at
  run(code, numbers);
  EXPECT_EQ(code.trust(), Trust::earned);
  FrameCode other(kFrame, narrow, wrong<kSquare, 7>);
  numbers[7] = 8;
  EXPECT_EQ(run(other, numbers), kSquares);
  EXPECT_EQ(other.trust(), Trust::none);
}

// Which not-a-number comes out of two is left to the order of operands.
TEST(FrameCode, Takes_what_is_no_number_for_the_same) {
  const auto other_sign = [](double* frame) {
    wide(frame);
    for (int k = 0; k < kLanes; ++k) frame[kSquare * kLanes + k] = -frame[kSquare * kLanes + k];
  };
  const auto none = [](double* frame) {
    square(frame, 4);
    for (int k = 0; k < 4; ++k) {
      frame[kSquare * kLanes + k] = std::numeric_limits<double>::quiet_NaN();
    }
  };
  const auto none_other_sign = [](double* frame) {
    square(frame, kLanes);
    for (int k = 0; k < kLanes; ++k) {
      frame[kSquare * kLanes + k] = -std::numeric_limits<double>::quiet_NaN();
    }
  };
  FrameCode same(kFrame, none, none_other_sign), differ(kFrame, narrow, other_sign);
  run(same, kNumbers);
  run(differ, kNumbers);
  EXPECT_EQ(same.trust(), Trust::earned);
  EXPECT_EQ(differ.trust(), Trust::none);
}

}  // namespace linkstudy::testing::frame_code_test
