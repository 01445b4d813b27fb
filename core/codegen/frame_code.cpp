#include "core/codegen/frame_code.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/base/isa.h"

namespace linkstudy::codegen {
namespace {

constexpr int kNarrow = native_lanes(InstructionSet::avx2);

std::atomic<int> distrusted{0};

// Which not-a-number comes out of two is left to the order of operands.
bool same_number(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) ||
         (std::isnan(a) && std::isnan(b));
}

bool same_mask(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

bool is_true(double mask) {
  return std::bit_cast<std::uint64_t>(mask) != 0;
}

enum class Verdict { same, differ, open };

// Of one frame. Open where in some part of the lanes none is fine.
Verdict judge(const FrameCode::Frame& f, const double* a, const double* b) {
  std::vector<char> is_seen(static_cast<std::size_t>(f.slot_numbers / kNarrow), 0);
  for (int k = 0; k < f.slot_numbers; ++k) {
    const int fine = f.fine * f.slot_numbers + k;
    if (!same_mask(a[fine], b[fine])) return Verdict::differ;
    if (!is_true(a[fine])) continue;
    for (int i = k; i < f.compared * f.slot_numbers; i += f.slot_numbers)
      if (i != fine && !same_number(a[i], b[i])) return Verdict::differ;
    is_seen[static_cast<std::size_t>(k / kNarrow)] = 1;
  }
  const bool all_seen = std::find(is_seen.begin(), is_seen.end(), 0) == is_seen.end();
  return all_seen ? Verdict::same : Verdict::open;
}

// Differs where one frame does, and is open where one is.
Verdict judge_all(const FrameCode::Frame& f, const double* a, const double* b) {
  Verdict all = Verdict::same;
  for (int i = 0; i < f.frames && all != Verdict::differ; ++i) {
    const int at = i * f.slots * f.slot_numbers;
    const Verdict one = judge(f, a + at, b + at);
    if (one != Verdict::same) all = one;
  }
  return all;
}

}  // namespace

int distrusted_count() {
  return distrusted.load(std::memory_order_relaxed);
}

void FrameCode::run(double* frame) {
  switch (trust()) {
    case Trust::earned:
      return wide_(frame);
    case Trust::none:
      return run_narrow(frame);
    case Trust::untried:
      return compare(frame);
  }
}

void FrameCode::run_narrow(double* frame) const {
  for (int i = 0; i < frame_.frames; ++i, frame += frame_.slots * frame_.slot_numbers) {
    for (int k = 0; k < frame_.slot_numbers; k += kNarrow) narrow_(frame + k);
  }
}

void FrameCode::compare(double* frame) {
  const int numbers = frame_.frames * frame_.slots * frame_.slot_numbers;
  FrameNumbers other(numbers);
  std::copy_n(frame, numbers, other.data());
  wide_(other.data());
  run_narrow(frame);
  const Verdict verdict = judge_all(frame_, other.data(), frame);
  Trust before = Trust::untried;
  if (verdict == Verdict::same) trust_.compare_exchange_strong(before, Trust::earned);
  if (verdict == Verdict::differ && trust_.exchange(Trust::none) != Trust::none) ++distrusted;
}

}  // namespace linkstudy::codegen
