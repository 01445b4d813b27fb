// Whole steps written for AVX-512, whatever this machine can run: their bytes are read back by a
// disassembler and carried out in plain C++ (tests/support/disassembled.h), on states of runs.
// Every bit that the AVX2 code writes, in all eight lanes.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>

#include "core/base/flush_denormals.h"
#include "core/simulation/kernels.h"
#include "core/simulation/prepare.h"
#include "core/simulation/run_state.h"
#include "core/simulation/simulate.h"
#include "core/simulation/written_steps.h"
#include "tests/pack/shipped_models.h"
#include "tests/support/disassembled.h"
#include "tests/support/same_bits.h"

namespace linkstudy::testing::wide_steps_test {
namespace {

constexpr int kNarrow = 4, kWide = 8, kSteps = 1500, kBetween = 20;
using Frame = std::vector<double>;

// Frames of a run as they were before a step.
struct Seen {
  codegen::FrameCode::Function step = nullptr;
  std::size_t numbers = 0;
  int calls = 0;
  std::vector<Frame> frames;
} seen;

void see_and_step(double* frame) {
  if (seen.calls++ % kBetween == 0) seen.frames.emplace_back(frame, frame + seen.numbers);
  seen.step(frame);
}

Cause never(void*, double) {
  return Cause::ok;
}

// Four cases of a model, unlike each other, and the step written for them.
class Cases {
 public:
  Cases(const Model& model, const SimulationOptions& options) : model_(model), options_(options) {
    std::vector<double>& y = start_ = model.start.q;
    y.insert(y.end(), model.start.v.begin(), model.start.v.end());
    y.insert(y.end(), model.start.z.begin(), model.start.z.end());
    y.resize(static_cast<std::size_t>(state_size(model.mechanism)));
    for (std::size_t i = 0; i < kNarrow; ++i) {
      Parameters<double>& p = parameters_.at(i) = model.parameters;
      for (auto& b : p.bodies) b.mass *= 1.0 + 1e-3 * static_cast<double>(i);
      finals_.at(i) = start_;
      cases_.push_back(
          {&p, start_.data(), finals_.at(i).data(), &observers_.at(i), nullptr, &ends_.at(i)});
    }
    written_ = written_step(model.mechanism, cases_, {}, kSteps,
                            {InstructionSet::avx2, kNarrow, Kernels::written}, kNarrow);
  }

  const WrittenStep* written() const { return written_.get(); }
  bool touches() const { return ends_[0].contacts > 0.0; }

  std::vector<Frame> frames_of_a_run() {
    const WrittenStep& w = *written_;
    codegen::FrameNumbers frame(w.frame_slots * kNarrow);
    w.put_constants(frame.data());
    seen = {w.pages.front()->function(), static_cast<std::size_t>(w.frame_slots * kNarrow), 0, {}};
    codegen::FrameCode code({kNarrow, w.frame_slots, w.slots.end, w.slots.fine}, see_and_step);
    const StepCode step{&code, w.slots, frame.data(), 0, nullptr, nullptr, 0};
    const KernelRun run{
        0.0, make_step_grid(options_).h, kSteps, 100, options_.drift_limit, never, nullptr, &step};
    find_kernel(InstructionSet::avx2, kNarrow).run(model_.mechanism, run, cases_.data(), kNarrow);
    return std::move(seen.frames);
  }

 private:
  const Model& model_;
  const SimulationOptions& options_;
  std::vector<double> start_;
  std::array<Parameters<double>, kNarrow> parameters_;
  std::array<std::vector<double>, kNarrow> finals_;
  std::array<Observers, kNarrow> observers_;
  std::array<LaneEnd, kNarrow> ends_;
  std::vector<LaneCase> cases_;
  std::shared_ptr<const WrittenStep> written_;
};

class WideStep {
 public:
  // On one frame of 8 numbers a slot, or on two.
  WideStep(const Model& model, const WrittenStep& narrow, int frames)
      : narrow_(narrow), frames_(frames) {
    constexpr auto isa = InstructionSet::avx512;
    const StepTrace trace =
        trace_step(model.mechanism, model.parameters, narrow.known, {}, narrow.rows_may_depend);
    program_ =
        codegen::allocate(trace.graph, trace.slots.end, codegen::program_registers(isa, frames));
    const std::vector<std::vector<std::uint8_t>> code = {
        codegen::assemble(program_, isa, {kWide, program_.slots, frames})};
    code_ = Disassembled::read(code).front();
  }

  // Of narrow frames that fill the slots side by side.
  void expect_bits(const std::vector<const Frame*>& parts) const {
    const FlushDenormals flush;
    ASSERT_EQ(static_cast<int>(parts.size()) * kNarrow, frames_ * kWide);
    Frame wide(static_cast<std::size_t>(frames_ * program_.slots * kWide));
    for (int frame = 0; frame < frames_; ++frame) {
      for (const auto& c : program_.constants) {
        std::fill_n(wide.begin() + place(frame, c.slot), kWide, std::bit_cast<double>(c.bits));
      }
    }
    for (int part = 0; part < static_cast<int>(parts.size()); ++part) {
      const Frame& from = *parts[static_cast<std::size_t>(part)];
      for (int slot = 0; slot < narrow_.slots.end; ++slot) {
        std::copy_n(from.begin() + slot * kNarrow, kNarrow, wide.begin() + place_of(part, slot));
      }
    }
    code_.run(wide);
    for (int part = 0; part < static_cast<int>(parts.size()); ++part) {
      codegen::FrameNumbers expected(narrow_.frame_slots * kNarrow);
      const Frame& from = *parts[static_cast<std::size_t>(part)];
      std::copy(from.begin(), from.end(), expected.data());
      narrow_.pages.front()->function()(expected.data());
      // The step is the code's, in every lane: dependent rows and all.
      for (int k = 0; k < kNarrow; ++k) {
        const double fine = expected.data()[narrow_.slots.fine * kNarrow + k];
        ASSERT_NE(std::bit_cast<std::uint64_t>(fine), 0u) << "lane " << k;
      }
      for (int slot = 0; slot < narrow_.slots.end; ++slot) {
        for (int k = 0; k < kNarrow; ++k) {
          const double x = wide[static_cast<std::size_t>(place_of(part, slot) + k)];
          const double y = expected.data()[slot * kNarrow + k];
          ASSERT_TRUE(same_bits(x, y) || (std::isnan(x) && std::isnan(y)))
              << "slot " << slot << " lane " << part * kNarrow + k << ": " << x << " for " << y;
        }
      }
    }
  }

 private:
  int place(int frame, int slot) const { return (frame * program_.slots + slot) * kWide; }
  int place_of(int part, int slot) const {
    return place(part * kNarrow / kWide, slot) + part * kNarrow % kWide;
  }

  const WrittenStep& narrow_;
  const int frames_;
  codegen::Program program_;
  Disassembled code_;
};

}  // namespace

TEST(WideSteps, Of_every_shipped_model_have_the_bits_of_narrow_ones) {
  if (!machine_has(InstructionSet::avx2)) GTEST_SKIP() << "no AVX2 here";
  if (!has_disassembler()) GTEST_SKIP() << "no objdump here";
  int compared = 0, with_contacts = 0;
  for (const std::string& path : shipped_models()) {
    for (const ClosureModel closures : {ClosureModel::cut, ClosureModel::sde}) {
      ModelInput input = read_model(path);
      const bool changes = set_closures(closures, input.linkage);
      if (closures == ClosureModel::sde && !changes) continue;
      SCOPED_TRACE(path + (closures == ClosureModel::cut ? " cut" : " sde"));
      const Preparation p = prepare(input.linkage, input.options);
      ASSERT_EQ(p.cause, Cause::ok) << p.message;
      Cases cases(p.model, input.options);
      ASSERT_NE(cases.written(), nullptr);
      const std::vector<Frame> frames = cases.frames_of_a_run();
      ASSERT_GE(frames.size(), 2u);
      const Frame &first = frames.front(), &last = frames.back(), &second = frames[1],
                  &middle = frames[frames.size() / 2];
      WideStep(p.model, *cases.written(), 1).expect_bits({&first, &last});
      WideStep(p.model, *cases.written(), 1).expect_bits({&middle, &second});
      WideStep(p.model, *cases.written(), 2).expect_bits({&first, &last, &middle, &second});
      ++compared;
      with_contacts += cases.touches() ? 1 : 0;
    }
  }
  EXPECT_GE(compared, 30);
  EXPECT_GE(with_contacts, 1);
}

}  // namespace linkstudy::testing::wide_steps_test
