#include "core/codegen/written_code.h"

#include <sys/mman.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <limits>
#include <vector>

#include "core/base/flush_denormals.h"
#include "core/codegen/frame_code.h"

namespace linkstudy::codegen {
namespace {

constexpr std::size_t kPlaces = 5;
constexpr double kAlike = 1.05;  // ratio of two times; two slow places are hardly so

// Of one call, once it is under way.
double least_seconds(WrittenCode::Function function, double* frame) {
  using Clock = std::chrono::steady_clock;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 24; ++i) {
    const auto begin = Clock::now();
    function(frame);
    const std::chrono::duration<double> spent = Clock::now() - begin;
    least = std::min(least, spent.count());
  }
  return least;
}

}  // namespace

std::unique_ptr<WrittenCode> WrittenCode::place(std::span<const std::uint8_t> code,
                                                Protect protect) {
  if (code.empty()) return nullptr;
  void* pages =
      ::mmap(nullptr, code.size(), PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (pages == MAP_FAILED) return nullptr;
  std::unique_ptr<WrittenCode> placed(new WrittenCode(pages, code.size()));
  std::memcpy(pages, code.data(), code.size());
  if ((protect ? protect : ::mprotect)(pages, code.size(), PROT_READ | PROT_EXEC) != 0) {
    return nullptr;
  }
  return placed;
}

std::unique_ptr<WrittenCode> WrittenCode::place_well(std::span<const std::uint8_t> code,
                                                     int frame_numbers) {
  const FlushDenormals flush;
  FrameNumbers frame(frame_numbers);
  std::fill_n(frame.data(), frame_numbers, 1.0);
  std::vector<std::unique_ptr<WrittenCode>> places;  // all at once, or the same page comes again
  const auto by_time = [](const auto& a, const auto& b) { return a->call_s_ < b->call_s_; };
  while (places.size() < kPlaces) {
    places.push_back(place(code));
    if (!places.back()) return nullptr;
    places.back()->call_s_ = least_seconds(places.back()->function(), frame.data());
    std::ranges::sort(places, by_time);
    if (places.size() > 1 && places[1]->call_s_ < kAlike * places[0]->call_s_) break;
  }
  return std::move(places.front());
}

WrittenCode::~WrittenCode() {
  ::munmap(pages_, size_);
}

WrittenCode::Function WrittenCode::function() const {
  return reinterpret_cast<Function>(pages_);
}

}  // namespace linkstudy::codegen
