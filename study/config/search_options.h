// The keys of [search]: how a tune looks for its value.
#pragma once

#include <cstddef>

namespace linkstudy {

struct SearchOptions {
  std::size_t scan = 16;              // log-spaced points over the range, ends included
  std::size_t batch = 8;              // points asked for together; an input, never the rank count
  std::size_t max_evaluations = 200;  // never exceeded
  double resolution = 0.001;          // decades, of both ends of the window
  double delta = 0.02;                // k (1 - delta) must fail for k to count as minimal
};

}  // namespace linkstudy
