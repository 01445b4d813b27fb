// Points of the unit cube that sampled designs take, u in (0, 1)^k (of morris in [0, 1]^k): pure
// functions of seed, k and id.
#pragma once

#include <cstdint>
#include <vector>

#include "study/design/design_options.h"

namespace linkstudy {

// Latin hypercube of n samples: every parameter has one sample in each of its n strata
// [i/n, (i+1)/n). Of n = m 2^g samples, m odd, the first m 2^j are the Latin hypercube of so many:
// twice the samples keep those that there were, and add one to the free half of every stratum.
std::vector<double> latin_hypercube_point(const DesignOptions& design, std::size_t k,
                                          std::uint64_t id);

// Sobol sequence (Boost.Random, direction numbers of Joe and Kuo 2008) from its zero point on, with
// a random digital shift: all bits of a parameter's numbers are combined by exclusive or with bits
// of the seed. It is a (t, m, s) net as the sequence itself is; no sample is a corner.
std::vector<double> sobol_point(const DesignOptions& design, std::size_t k, std::uint64_t id);
inline constexpr std::size_t kMostSobolParameters = 3667;

// Trajectories of Morris (Technometrics 33, 1991): k + 1 points each, on a grid of p levels
// 0, 1/(p-1), .., 1; from one to the next a single parameter moves by +-p/(2(p-1)), in random
// order.
std::vector<double> morris_point(const DesignOptions& design, std::size_t k, std::uint64_t id);

// Blocks A, AB_1 .. AB_k, B of k + 2 points (Saltelli et al., Comput. Phys. Commun. 181, 2010): A
// and B are the halves of a Sobol point of 2k numbers, AB_i is A with number i of B.
std::vector<double> saltelli_point(const DesignOptions& design, std::size_t k, std::uint64_t id);

// Points of a trajectory or block.
constexpr std::uint64_t block_size(Design design, std::uint64_t k) {
  return design == Design::morris ? k + 1 : design == Design::saltelli ? k + 2 : 1;
}

}  // namespace linkstudy
