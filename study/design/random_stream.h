// Random numbers by position: number i of the stream of a key, without those before it. The
// generator is SplitMix64 (Steele, Lea and Flood, OOPSLA 2014), whose state is a counter: number i
// is a bijective mix of key + (i + 1) g, g odd. Nothing here depends on ranks or on an order.
#pragma once

#include <cstdint>
#include <initializer_list>

namespace linkstudy {

class RandomStream {
 public:
  // The stream of a seed and what it is for: a purpose, a parameter, a level.
  RandomStream(std::uint64_t seed, std::initializer_list<std::uint64_t> purpose);

  std::uint64_t bits(std::uint64_t i) const;
  // In 0 .. n - 1, for n < 2^32.
  std::uint64_t below(std::uint64_t n, std::uint64_t i) const;

 private:
  std::uint64_t key_;
};

// The upper 52 bits as a number strictly between 0 and 1, the middle of its interval.
inline double to_unit(std::uint64_t bits) {
  return (static_cast<double>(bits >> 12) + 0.5) * 0x1p-52;
}

// Where a random permutation of 0 .. n - 1 puts i, for n < 2^32, without the others: the
// swap-or-not shuffle of Hoang, Morris and Rogaway (CRYPTO 2012). In every round i and K - i (mod
// n) change places or not, K and the choice being random.
std::uint64_t permuted(const RandomStream& stream, std::uint64_t n, std::uint64_t i);

}  // namespace linkstudy
