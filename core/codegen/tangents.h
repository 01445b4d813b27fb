// Derivatives of what a graph computes with respect to some of its inputs, exact but for rounding:
// every operation y = f(a, b, c) of the graph adds
//   dy = f_a da + f_b db + f_c dc
// (forward differentiation; Griewank and Walther, Evaluating Derivatives, sec. 3.1), in all
// directions at once. What the graph chooses between is differentiated where it is chosen; where
// that has a corner the derivative is that of the branch taken, and at the corner of |a| and the
// branch point of sqrt(a) it is 0, the middle of both sides. Sums with 2^52 and more round to whole
// numbers and do not vary.
#pragma once

#include <array>
#include <vector>

#include "core/codegen/graph.h"

namespace linkstudy::codegen {

class Tangents {
 public:
  // `varied`: slots of inputs, a column each. Keeps nothing of the graph.
  Tangents(const Graph& graph, const std::vector<int>& varied);

  // The outputs in the graph's order, and where: `slots` holds the inputs (Graph::input). False
  // where the graph does not hold (Graph::require); nothing is known then.
  bool update(const std::vector<double>& slots);

  int rows() const { return static_cast<int>(outputs_.size()); }
  int columns() const { return columns_; }
  double value(int row) const;
  // d output / d varied input, after update().
  double derivative(int row, int column) const {
    return derivatives_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                        static_cast<std::size_t>(column)];
  }

 private:
  static constexpr int kWidth = 8;  // columns that are carried along together
  using Row = std::array<double, kWidth>;
  struct Operation {
    Node node;    // operands are places in values_
    bool varies;  // with any varied input
    bool rounds;  // to whole numbers
  };
  struct Term {
    int operation;
    std::array<int, 3> operands;  // places in tangents_; 0: does not vary here
  };

  void compute_values(const std::vector<double>& slots);
  void carry(const std::vector<Term>& block);

  int columns_;
  std::vector<Operation> operations_;
  std::vector<int> inputs_;                // of each column its operation, -1: not used
  std::vector<int> outputs_;               // operations
  int required_;                           // operation
  std::vector<std::vector<Term>> blocks_;  // of kWidth columns
  std::vector<double> values_;             // of operations
  std::vector<std::array<double, 3>> partials_;
  std::vector<Row> tangents_;        // row 0 is zero
  std::vector<double> derivatives_;  // (rows, columns)
};

}  // namespace linkstudy::codegen
