#include "core/simulation/trial_frame.h"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "core/model/parameter_numbers.h"
#include "core/simulation/kernels.h"

namespace linkstudy {
namespace {

constexpr long kFirstQuestion = 2048;  // evaluations of the equations of motion
constexpr long kEvaluationsPerTrial = 6;

}  // namespace

TrialFrame::TrialFrame(const Mechanism& m, std::span<const LaneCase> cases, const SimdLevel& level,
                       int lanes)
    : m_(m),
      cases_(cases),
      level_(level),
      lanes_(lanes),
      width_(slot_numbers(lanes)),
      observed_(m, *cases[0].observers),
      slots_(m, parameter_number_count(*cases[0].parameters),
             static_cast<int>(observed_.all().size())),
      frame_(slots_.count * width_),
      numbers_(frame_.data()),
      general_(find_kernel(level.isa, lanes)
                   .make_trials(
                       m,
                       {slots_, observed_.all().data(), static_cast<int>(observed_.all().size())},
                       cases.data(), static_cast<int>(cases.size()))),
      may_be_written_(why_not_written(level).empty()) {
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

void TrialFrame::try_steps(unsigned counting) {
  count_evaluations(kEvaluationsPerTrial * std::popcount(counting));
  if (written_ && run(*written_->code, slots_.fine, counting)) return;
  general_->try_steps(numbers_);
}

void TrialFrame::look_inside(unsigned counting) {
  count_evaluations(std::popcount(counting));
  if (written_ && run(*written_->inside, slots_.instant_fine, counting)) return;
  general_->look_inside(numbers_);
}

// For code that is right where cut rows depend on each other, or for none.
void TrialFrame::leave() {
  may_be_written_ = !m_.cut_rows.empty() && !written_->rows_may_depend;
  rows_may_depend_ = true;
  written_ = nullptr;
  failures_ = {};
  next_question_ = 0;
}

bool TrialFrame::run(codegen::FrameCode& code, int fine, unsigned counting) {
  code.run(numbers_);
  const bool all_fine = is_fine(fine, counting);
  if (failures_.note(all_fine)) leave();
  return all_fine;
}

void TrialFrame::count_evaluations(long count) {
  untold_ += count;
  if (written_ || !may_be_written_ || untold_ < next_question_) return;
  use(written_trial(m_, cases_, observed_.all(), untold_, level_, width_, rows_may_depend_));
  untold_ = 0;
  next_question_ = std::max(kFirstQuestion, 2 * next_question_);
}

void TrialFrame::use(std::shared_ptr<const WrittenStep> written) {
  if (!written) return;
  codegen::FrameNumbers wider(written->frame_slots * width_);
  std::copy_n(numbers_, slots_.count * width_, wider.data());
  written->put_constants(wider.data());
  frame_ = std::move(wider);
  numbers_ = frame_.data();
  written_ = std::move(written);
}

bool TrialFrame::is_fine(int slot, unsigned counting) const {
  for (int i = 0; i < lanes_; ++i) {
    const bool is_true = std::bit_cast<std::uint64_t>(get(i, slot)) != 0;
    if (!is_true && (counting >> i & 1u) != 0) return false;
  }
  return true;
}

}  // namespace linkstudy
