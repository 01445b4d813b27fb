#include "study/design/random_stream.h"

#include <algorithm>
#include <bit>

namespace linkstudy {
namespace {

constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15;  // 2^64 over the golden ratio, odd

constexpr std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EB;
  return x ^ (x >> 31);
}

// Pairs of points are as good as independent after 3 log2(n) rounds; the rest is for small n.
std::uint64_t round_count(std::uint64_t n) {
  return 3 * static_cast<std::uint64_t>(std::bit_width(n)) + 24;
}

}  // namespace

RandomStream::RandomStream(std::uint64_t seed, std::initializer_list<std::uint64_t> purpose)
    : key_(mixed(seed + kGolden)) {
  for (const std::uint64_t one : purpose) key_ = mixed(key_ ^ mixed(one + kGolden)) + kGolden;
}

std::uint64_t RandomStream::bits(std::uint64_t i) const {
  return mixed(key_ + (i + 1) * kGolden);
}

std::uint64_t RandomStream::below(std::uint64_t n, std::uint64_t i) const {
  return ((bits(i) >> 32) * n) >> 32;
}

std::uint64_t permuted(const RandomStream& stream, std::uint64_t n, std::uint64_t i) {
  const std::uint64_t rounds = round_count(n);
  for (std::uint64_t round = 0; round < rounds; ++round) {
    const std::uint64_t k = stream.below(n, 2 * round);
    const std::uint64_t other = k >= i ? k - i : k + n - i;
    const std::uint64_t pair = std::max(i, other);  // the same for both
    const bool swaps = (mixed(stream.bits(2 * round + 1) + pair * kGolden) & 1) != 0;
    if (swaps) i = other;
  }
  return i;
}

}  // namespace linkstudy
