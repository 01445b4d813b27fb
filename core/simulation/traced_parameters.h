// Parameters of a structure as inputs of a trace.
#pragma once

#include <cstdint>
#include <vector>

#include "core/codegen/traced.h"
#include "core/model/parameter_numbers.h"

namespace linkstudy {

// What is known of a parameter in every case: 0, 1 or -1, or nothing.
enum class Known : std::int8_t { varies, zero, one, minus_one };

inline Traced traced_parameter(codegen::Graph& graph, int slot, Known known) {
  switch (known) {
    case Known::zero:
      return Traced(0.0);
    case Known::one:
      return Traced(1.0);
    case Known::minus_one:
      return Traced(-1.0);
    case Known::varies:
      break;
  }
  return Traced::from(graph.input(slot));
}

// `known`: by number of for_parameter_numbers; `sizes`: parameters of any case. The first is read
// from `slot`, which becomes the one after the last.
inline Parameters<Traced> traced_parameters(codegen::Graph& graph, const Parameters<double>& sizes,
                                            const std::vector<Known>& known, int& slot) {
  Parameters<Traced> p;
  for_parameter_lists([](auto& to, const auto& from) { to.resize(from.size()); }, p, sizes);
  auto next = known.begin();
  for_parameter_numbers<Traced>(p, [&](Traced* x, std::size_t n) {
    for (std::size_t k = 0; k < n; ++k) x[k] = traced_parameter(graph, slot++, *next++);
  });
  return p;
}

}  // namespace linkstudy
