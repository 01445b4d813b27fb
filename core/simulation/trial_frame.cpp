#include "core/simulation/trial_frame.h"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "core/model/parameter_numbers.h"
#include "core/simulation/kernels.h"

namespace linkstudy {
namespace {

constexpr long kQuestionEvery = 256;  // trials
constexpr long kTrial = 64;           // runs before code may be left
constexpr long kMostFailures = 4;     // one in so many is too much

int parameter_count(const Parameters<double>& p) {
  std::size_t count = 0;
  for_parameter_numbers<double>(p, [&](const double*, std::size_t n) { count += n; });
  return static_cast<int>(count);
}

}  // namespace

TrialFrame::TrialFrame(const Mechanism& m, std::span<const LaneCase> cases, const SimdLevel& level,
                       int lanes)
    : m_(m),
      cases_(cases),
      level_(level),
      lanes_(lanes),
      width_(slot_numbers(lanes)),
      slots_(m, parameter_count(*cases[0].parameters)),
      frame_(slots_.count * width_),
      numbers_(frame_.data()),
      general_(find_kernel(level.isa, lanes)
                   .make_trials(m, slots_, cases.data(), static_cast<int>(cases.size()))),
      next_question_(level.kernels == Kernels::written ? 0 : kQuestionEvery) {
  for (int i = 0; i < width_; ++i) {
    set_case(i, cases[std::min(static_cast<std::size_t>(i), cases.size() - 1)]);
  }
}

// Lanes beyond those of the kernel are there to go along.
void TrialFrame::set_case(int lane, const LaneCase& c) {
  if (lane < lanes_) general_->set_parameters(lane, *c.parameters);
  int slot = TrialSlots::parameters;
  for_parameter_numbers<double>(*c.parameters, [&](const double* x, std::size_t n) {
    put(lane, slot, static_cast<int>(n), x);
    slot += static_cast<int>(n);
  });
  put(lane, slots_.y, state_size(m_), c.y);
}

void TrialFrame::run(unsigned active) {
  if (untold_ >= next_question_) ask_for_code();
  untold_ += std::popcount(active);
  if (written_ && !left_) {
    written_->code->run(numbers_);
    ++tried_;
    if (is_fine(active)) return;
    ++failed_;
    left_ = tried_ >= kTrial && kMostFailures * failed_ > tried_;
  }
  general_->run(numbers_);
}

void TrialFrame::ask_for_code() {
  if (!written_) use(written_trial(m_, cases_, untold_, level_, width_));
  untold_ = 0;
  next_question_ = kQuestionEvery;
}

void TrialFrame::use(std::shared_ptr<const WrittenStep> written) {
  if (!written) return;
  codegen::FrameNumbers wider(written->frame_slots * width_);
  std::copy_n(numbers_, slots_.count * width_, wider.data());
  for (const auto& [slot, bits] : written->constants) {
    std::fill_n(wider.data() + slot * width_, width_, std::bit_cast<double>(bits));
  }
  frame_ = std::move(wider);
  numbers_ = frame_.data();
  written_ = std::move(written);
}

bool TrialFrame::is_fine(unsigned active) const {
  for (int i = 0; i < lanes_; ++i) {
    const bool is_true = std::bit_cast<std::uint64_t>(get(i, slots_.fine)) != 0;
    if (!is_true && (active >> i & 1u) != 0) return false;
  }
  return true;
}

}  // namespace linkstudy
