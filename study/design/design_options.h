// What a design is asked for: how the values of several parameters combine to points.
#pragma once

#include <cstdint>

#include "core/base/words.h"

namespace linkstudy {

enum class Design { grid, list, centered, vector, latin_hypercube, sobol, morris, saltelli };

template <>
inline constexpr auto kWords<Design> = make_words<Design>({
    {Design::grid, "grid", "every combination"},
    {Design::list, "list", "first with first, and so on"},
    {Design::centered, "centered", "one parameter at a time in steps around a centre"},
    {Design::vector, "vector", "equal steps of all parameters together, from first to last"},
    {Design::latin_hypercube, "latin_hypercube", "samples, one in each stratum of every parameter"},
    {Design::sobol, "sobol", "samples of a Sobol sequence"},
    {Design::morris, "morris", "trajectories for elementary effects: which parameters matter"},
    {Design::saltelli, "saltelli", "blocks for Sobol indices: shares of the variance"},
});

struct DesignOptions {
  Design type = Design::grid;
  std::uint64_t samples = 0;       // of latin_hypercube and sobol; of saltelli the number of blocks
  std::uint64_t steps = 0;         // of vector
  std::uint64_t trajectories = 0;  // of morris
  std::uint64_t levels = 4;        // of morris, even
  std::uint64_t seed = 1;

  bool operator==(const DesignOptions&) const = default;
};

// Points are drawn from distributions, not put together from values.
constexpr bool is_sampled(Design design) {
  return design == Design::latin_hypercube || design == Design::sobol || design == Design::morris ||
         design == Design::saltelli;
}

// Points come in blocks from which sensitivities are estimated.
constexpr bool is_sensitivity(Design design) {
  return design == Design::morris || design == Design::saltelli;
}

}  // namespace linkstudy
