#include "study/design/samples.h"

#include <bit>
#include <boost/random/sobol.hpp>
#include <map>
#include <numeric>
#include <utility>

#include "study/design/random_stream.h"

namespace linkstudy {
namespace {

// What random numbers are for.
enum Purpose : std::uint64_t { kStratum, kHalf, kRest, kShift, kOrder, kStart };

// Strata are halved until there are more than any design has points.
constexpr std::uint64_t kFinestStrata = std::uint64_t{1} << 30;

// One number of a Latin hypercube. Strata of level l are m 2^l; the sample that a stratum of level
// l has lies, one level further, in the half that a bit of the seed says, and the sample that joins
// it in the other.
double latin_hypercube_number(std::uint64_t seed, std::uint64_t n, std::uint64_t parameter,
                              std::uint64_t id) {
  std::uint64_t strata = n >> std::countr_zero(n);
  std::uint64_t level = 0;
  const auto half_of = [&](std::uint64_t stratum) {
    return RandomStream(seed, {kHalf, parameter, level}).bits(stratum) >> 63;
  };
  std::uint64_t before = 0;  // samples of the levels before the one that brings this
  while (id >= (before == 0 ? strata : 2 * before)) {
    before = before == 0 ? strata : 2 * before;
    ++level;
  }
  const std::uint64_t joined = before == 0 ? strata : before;
  std::uint64_t stratum =
      permuted(RandomStream(seed, {kStratum, parameter, level}), joined, id - before);
  if (before > 0) {
    stratum = 2 * stratum + (1 - half_of(stratum));
    strata = 2 * before;
  }
  while (strata < kFinestStrata) {
    ++level;
    stratum = 2 * stratum + half_of(stratum);
    strata *= 2;
  }
  // 20 bits: the sum is exact.
  const std::uint64_t rest = RandomStream(seed, {kRest, parameter}).bits(id) >> 44;
  const double within = (static_cast<double>(rest) + 0.5) * 0x1p-20;
  return (static_cast<double>(stratum) + within) / static_cast<double>(strata);
}

// Its direction numbers are made once for points of a length.
boost::random::sobol& sequence_of(std::size_t k) {
  thread_local std::map<std::size_t, boost::random::sobol> known;
  return known.try_emplace(k, k).first->second;
}

// Boost's sequence leaves the zero point out.
std::vector<std::uint64_t> sobol_bits(std::size_t k, std::uint64_t id) {
  std::vector<std::uint64_t> bits(k, 0);
  if (id == 0) return bits;
  boost::random::sobol& sequence = sequence_of(k);
  sequence.seed(id - 1);
  sequence.generate(bits.begin(), bits.end());
  return bits;
}

}  // namespace

std::vector<double> latin_hypercube_point(const DesignOptions& design, std::size_t k,
                                          std::uint64_t id) {
  std::vector<double> u(k);
  for (std::size_t i = 0; i < k; ++i) {
    u[i] = latin_hypercube_number(design.seed, design.samples, i, id);
  }
  return u;
}

std::vector<double> sobol_point(const DesignOptions& design, std::size_t k, std::uint64_t id) {
  const std::vector<std::uint64_t> bits = sobol_bits(k, id);
  const RandomStream shift(design.seed, {kShift});
  std::vector<double> u(k);
  for (std::size_t i = 0; i < k; ++i) u[i] = to_unit(bits[i] ^ shift.bits(i));
  return u;
}

std::vector<double> morris_point(const DesignOptions& design, std::size_t k, std::uint64_t id) {
  const std::uint64_t trajectory = id / (k + 1);
  const std::uint64_t moved = id % (k + 1);
  std::vector<std::size_t> order(k);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const RandomStream shuffle(design.seed, {kOrder, trajectory});
  for (std::size_t i = k; i > 1; --i) std::swap(order[i - 1], order[shuffle.below(i, i)]);
  const RandomStream start(design.seed, {kStart, trajectory});
  const std::uint64_t half = design.levels / 2;
  std::vector<double> u(k);
  for (std::uint64_t place = 0; place < k; ++place) {
    const std::size_t i = order[place];
    const std::uint64_t low = start.below(half, 2 * i);
    const bool begins_low = (start.bits(2 * i + 1) >> 63) == 0;
    const bool is_low = begins_low == (place >= moved);
    u[i] = static_cast<double>(is_low ? low : low + half) / static_cast<double>(design.levels - 1);
  }
  return u;
}

std::vector<double> saltelli_point(const DesignOptions& design, std::size_t k, std::uint64_t id) {
  const std::uint64_t member = id % (k + 2);
  const std::vector<double> both = sobol_point(design, 2 * k, id / (k + 2));
  const auto b = both.begin() + static_cast<std::ptrdiff_t>(k);
  if (member == k + 1) return {b, both.end()};
  std::vector<double> u(both.begin(), b);
  if (member > 0) u[member - 1] = both[k + member - 1];
  return u;
}

}  // namespace linkstudy
