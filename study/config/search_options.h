// The keys of [search]: how a tune looks for its values.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace linkstudy {

struct SearchOptions {
  std::size_t scan = 16;  // log-spaced points over the range, ends included; of several values
                          // along the diagonal, and as many for each further one in the box
  std::size_t batch = 8;  // points asked for together; an input, never the rank count
  std::optional<std::size_t> max_evaluations;  // of each answer, never exceeded
  double resolution = 0.001;                   // decades, of both ends of the window
  double delta = 0.02;                         // k (1 - delta) must fail for k to count as minimal
  double gap = 0.1;           // of the proof for two and three values, decades of the objective
  double mu = 0.02;           // how far errors may be from monotone, of the same proof
  std::vector<double> steps;  // s, at which answers are wanted; none: that of the model
};

}  // namespace linkstudy
