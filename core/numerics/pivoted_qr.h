// Householder factorisation with exchanges, Pi A P = Q R, of a matrix A whose columns lie one after
// another: at every step the longest remaining column comes first, and in it the largest entry.
// With both exchanges the error is small in every row of A by itself, however differently the rows
// are scaled (Powell and Reid 1969; Cox and Higham 1998): a light link makes one row large and does
// not drown the others.
//
// Exchanges are made lane by lane, as masks say, so that lanes with different orders and ranks go
// side by side, and a trace holds for any of them. Nothing is fused: one lane has the bits of
// `double` on every machine.
#pragma once

#include <algorithm>

#include "core/base/real.h"

namespace linkstudy {

// Exchanges a[k] and b[k], k < n, where the mask is true.
template <class Mask, class Real>
inline void exchange_where(const Mask& mask, int n, Real* a, Real* b) {
  if (!any(mask)) return;
  for (int k = 0; k < n; ++k) {
    const Real x = a[k];
    a[k] = select(mask, b[k], x);
    b[k] = select(mask, x, b[k]);
  }
}

// Exchanges item `step` of n, each of `length` numbers, with the item behind it that `with` names.
template <class Real>
inline void exchange_items(int length, int n, int step, const Real& with, Real* items) {
  for (int c = step + 1; c < n; ++c) {
    exchange_where(with == Real(static_cast<double>(c)), length, items + step * length,
                   items + c * length);
  }
}

template <class Real>
inline Real plain_dot(const Real* a, const Real* b, int begin, int end) {
  Real sum(0.0);
  for (int k = begin; k < end; ++k) sum = sum + a[k] * b[k];
  return sum;
}

template <class Real>
struct LongestColumn {
  Real column, length;
};

template <class Real>
inline LongestColumn<Real> longest_column(int length, int count, int step, const Real* columns) {
  Real found(static_cast<double>(step)), square(0.0);
  for (int c = step; c < count; ++c) {
    const Real* column = columns + c * length;
    const Real candidate = plain_dot(column, column, step, length);
    // Columns that rounding alone tells apart keep their order.
    const auto is_longer = candidate > square * Real(1.0 + 1e-12);
    square = select(is_longer, candidate, square);
    found = select(is_longer, Real(static_cast<double>(c)), found);
  }
  return {found, sqrt(square)};
}

template <class Real>
inline void bring_largest_entry_up(int length, int count, int step, Real* columns) {
  const Real* pivot = columns + step * length;
  Real found(static_cast<double>(step)), largest = abs(pivot[step]);
  for (int k = step + 1; k < length; ++k) {
    const auto is_larger = abs(pivot[k]) > largest;
    largest = select(is_larger, abs(pivot[k]), largest);
    found = select(is_larger, Real(static_cast<double>(k)), found);
  }
  for (int k = step + 1; k < length; ++k) {
    const auto is_it = found == Real(static_cast<double>(k));
    if (!any(is_it)) continue;
    for (int c = step; c < count; ++c) {
      Real* column = columns + c * length;
      exchange_where(is_it, 1, column + step, column + k);
    }
  }
}

// Reflects the pivot column onto its entry `step`, and the columns behind it alike.
template <class Real>
inline void reflect(int length, int count, int step, const Real& norm, Real* columns) {
  Real* v = columns + step * length;
  const Real diagonal = select(v[step] > Real(0.0), -norm, norm);
  const Real scale = Real(1.0) / (norm * (norm + abs(v[step])));
  v[step] = v[step] - diagonal;
  for (int c = step + 1; c < count; ++c) {
    Real* x = columns + c * length;
    const Real factor = scale * plain_dot(v, x, step, length);
    for (int k = step; k < length; ++k) x[k] = x[k] - factor * v[k];
  }
  v[step] = diagonal;
}

// Columns of `length` entries, `count` of them. The rank r, which is returned, ends before the
// first column whose remaining part is not longer than `tolerance`. Column j then holds R_0j ..
// R_jj (j < r; the first r entries for j >= r) and below that nothing of use; |R_00| >= |R_11| >=
// ... exchanged (the lesser of both): the column that came in the place of column s at step s,
// behind it or itself.
template <class Real>
inline Real factorize_pivoted(int length, int count, const Real& tolerance, Real* columns,
                              Real* exchanged) {
  const int most = std::min(length, count);
  for (int step = 0; step < most; ++step) exchanged[step] = Real(static_cast<double>(step));
  Real rank(0.0);
  auto goes_on = rank == rank;
  for (int step = 0; step < most; ++step) {
    const LongestColumn<Real> pivot = longest_column(length, count, step, columns);
    goes_on = goes_on && pivot.length > tolerance;
    if (!any(goes_on)) break;
    rank = select(goes_on, Real(static_cast<double>(step + 1)), rank);
    exchanged[step] = pivot.column;
    exchange_items(length, count, step, pivot.column, columns);
    bring_largest_entry_up(length, count, step, columns);
    reflect(length, count, step, pivot.length, columns);
  }
  return rank;
}

// x := R^-T x and x := R^-1 x with the leading (n, n) triangle of R, of which the first `rank` rows
// and columns count; x is zero beyond.
template <class Real>
inline void solve_upper_transposed(int length, int n, const Real& rank, const Real* columns,
                                   Real* x) {
  for (int i = 0; i < n; ++i) {
    const Real* r = columns + i * length;
    const Real solved = (x[i] - plain_dot(r, x, 0, i)) / r[i];
    x[i] = select(Real(static_cast<double>(i)) < rank, solved, Real(0.0));
  }
}

template <class Real>
inline void solve_upper(int length, int n, const Real& rank, const Real* columns, Real* x) {
  for (int i = n - 1; i >= 0; --i) {
    const Real* r = columns + i * length;
    const auto counts = Real(static_cast<double>(i)) < rank;
    x[i] = select(counts, x[i] / r[i], Real(0.0));
    if (!any(counts)) continue;
    for (int k = 0; k < i; ++k) x[k] = select(counts, x[k] - r[k] * x[i], x[k]);
  }
}

}  // namespace linkstudy
