// Lanes of any number on the slots of a frame: what is put in comes out at its place.
#include "core/simulation/written_lanes.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <optional>

#include "core/base/pack.h"

namespace linkstudy::testing::written_lanes_test {
namespace {

// y' = y + t in four lanes, past the three numbers of gravity; all is well where y is below 100.
template <int width>
void step(double* frame) {
  for (int k = 0; k < 4; ++k) {
    const double y = frame[7 * width + k];
    frame[9 * width + k] = y + frame[k];
    const std::uint64_t fine = y < 100.0 ? ~std::uint64_t{0} : 0;
    std::memcpy(frame + 12 * width + k, &fine, sizeof fine);
  }
}

template <class Real>
class Frames {
 public:
  // `instead`: of these, for the code to be left for.
  explicit Frames(Frames* instead = nullptr) {
    code_.code = &frame_code_;
    code_.slots.state = 7;
    code_.slots.next = 9;
    code_.slots.fine = 12;
    code_.frame = numbers_.data();
    code_.context = instead;
    if (instead != nullptr) {
      code_.instead = [](void* other) -> const StepCode* {
        return &static_cast<Frames*>(other)->code_;
      };
    }
    parameters_.gravity = {Real(0.0), Real(0.0), Real(-9.81)};
    shared_.emplace(&code_);
    lanes_.emplace(*shared_, 0, 0.25, 1.0, parameters_);
  }

  // Writes y' over y; true if all is well for the lanes asked for.
  bool step_all(double t, Real& y, unsigned asked) {
    const auto state = [&](auto&& f) { f(&y, std::size_t{1}); };
    lanes_->takes_other_code();
    lanes_->read(t, Real(0.0), state);
    shared_->run();
    const bool is_fine = (lanes_->fine() & asked) == asked;
    if (is_fine) lanes_->write_next(state);
    shared_->note(is_fine);
    return is_fine;
  }
  bool is_there() const { return lanes_->is_there(); }
  double& number(int slot) { return numbers_.data()[slot * width]; }

 private:
  static constexpr int width = slot_numbers(RealTraits<Real>::lanes);
  codegen::FrameNumbers numbers_{13 * width};
  static constexpr codegen::FrameCode::Frame kLayout{width, 13, 13, 12};
  codegen::FrameCode frame_code_{kLayout, step<width>};
  StepCode code_;
  Parameters<Real> parameters_;
  std::optional<SharedCode<Real>> shared_;
  std::optional<WrittenLanes<Real>> lanes_;
};

template <class Real>
void expect_own_lanes() {
  constexpr int lanes = RealTraits<Real>::lanes;
  Frames<Real> frames;
  Real y(0.0);
  for (int i = 0; i < lanes; ++i) set_lane(y, i, i == lanes - 1 ? 200.0 : 1.0 + i);
  const unsigned all = (1u << lanes) - 1u, but_last = all >> 1;
  EXPECT_FALSE(frames.step_all(0.5, y, all));
  EXPECT_EQ(lane(y, lanes - 1), 200.0);  // nothing has changed
  EXPECT_TRUE(frames.step_all(0.5, y, but_last));
  for (int i = 0; i < lanes - 1; ++i) EXPECT_EQ(lane(y, i), 1.5 + i);
}

}  // namespace

TEST(WrittenLanes, Are_one_four_or_eight) {
  expect_own_lanes<double>();
  expect_own_lanes<Pack<4, Baseline>>();
  expect_own_lanes<Pack<8, Baseline>>();
}

TEST(WrittenLanes, Leave_code_that_fails_more_often_than_one_time_in_four) {
  Frames<double> often, rarely;
  for (int i = 0; i < 100; ++i) {
    double y = i % 3 == 0 ? 200.0 : 0.0, z = i % 5 == 0 ? 200.0 : 0.0;
    often.step_all(0.0, y, 1u);
    rarely.step_all(0.0, z, 1u);
    EXPECT_EQ(often.is_there(), i < 63) << i;
    EXPECT_TRUE(rarely.is_there()) << i;
    if (!often.is_there()) break;
  }
  EXPECT_FALSE(often.is_there());
}

TEST(WrittenLanes, Leave_code_that_served_long_once_it_fails_in_a_row) {
  Frames<double> frames;
  for (int i = 0; i < 10000 + 64; ++i) {
    EXPECT_TRUE(frames.is_there()) << i;
    double y = i < 10000 ? 0.0 : 200.0;
    frames.step_all(0.0, y, 1u);
  }
  EXPECT_FALSE(frames.is_there());
}

TEST(WrittenLanes, Leave_it_for_other_code_with_all_that_stays_the_same) {
  Frames<double> other, first(&other);
  for (int i = 0; i < 63; ++i) {
    double y = 200.0;
    EXPECT_FALSE(first.step_all(0.5, y, 1u));
  }
  other.number(StepSlots::h) = 0.0;
  double y = 200.0;
  EXPECT_FALSE(first.step_all(0.5, y, 1u));
  EXPECT_TRUE(first.is_there());
  y = 3.0;
  EXPECT_TRUE(first.step_all(0.5, y, 1u));
  EXPECT_EQ(other.number(StepSlots::h), 0.25);
  EXPECT_EQ(other.number(StepSlots::parameters + 2), -9.81);
  EXPECT_EQ(y, 3.5);
  EXPECT_EQ(other.number(7), 3.0);
}

}  // namespace linkstudy::testing::written_lanes_test
