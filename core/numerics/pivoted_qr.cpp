#include "core/numerics/pivoted_qr.h"

#include <algorithm>
#include <cmath>

namespace linkstudy {
namespace {

double dot(const double* a, const double* b, int begin, int end) {
  double sum = 0.0;
  for (int k = begin; k < end; ++k) sum += a[k] * b[k];
  return sum;
}

struct Longest {
  int column;
  double length;
};

Longest longest_column(int length, int count, int step, const double* columns) {
  Longest found{step, 0.0};
  double square = 0.0;
  for (int c = step; c < count; ++c) {
    const double* column = columns + c * length;
    const double candidate = dot(column, column, step, length);
    // Columns that rounding alone tells apart keep their order.
    if (candidate > square * (1.0 + 1e-12)) {
      square = candidate;
      found.column = c;
    }
  }
  found.length = std::sqrt(square);
  return found;
}

void exchange_columns(int length, int a, int b, double* columns, int* order) {
  if (a == b) return;
  std::swap_ranges(columns + a * length, columns + (a + 1) * length, columns + b * length);
  std::swap(order[a], order[b]);
}

void bring_largest_entry_up(int length, int count, int step, double* columns) {
  const double* pivot = columns + step * length;
  int largest = step;
  for (int k = step + 1; k < length; ++k) {
    if (std::fabs(pivot[k]) > std::fabs(pivot[largest])) largest = k;
  }
  if (largest == step) return;
  for (int c = 0; c < count; ++c)
    std::swap(columns[c * length + step], columns[c * length + largest]);
}

// Reflects the pivot column onto its entry `step`, and the columns behind it alike.
void reflect(int length, int count, int step, double norm, double* columns) {
  double* v = columns + step * length;
  const double diagonal = v[step] > 0.0 ? -norm : norm;
  const double scale = 1.0 / (norm * (norm + std::fabs(v[step])));
  v[step] -= diagonal;
  for (int c = step + 1; c < count; ++c) {
    double* x = columns + c * length;
    const double factor = scale * dot(v, x, step, length);
    for (int k = step; k < length; ++k) x[k] -= factor * v[k];
  }
  v[step] = diagonal;
}

}  // namespace

int factorize_pivoted(int length, int count, double tolerance, double* columns, int* order) {
  const int most = std::min(length, count);
  for (int step = 0; step < most; ++step) {
    const Longest pivot = longest_column(length, count, step, columns);
    if (!(pivot.length > tolerance)) return step;
    exchange_columns(length, step, pivot.column, columns, order);
    bring_largest_entry_up(length, count, step, columns);
    reflect(length, count, step, pivot.length, columns);
  }
  return most;
}

void solve_upper_transposed(int length, int n, const double* columns, double* x) {
  for (int i = 0; i < n; ++i) {
    const double* r = columns + i * length;
    x[i] = (x[i] - dot(r, x, 0, i)) / r[i];
  }
}

void solve_upper(int length, int n, const double* columns, double* x) {
  for (int i = n - 1; i >= 0; --i) {
    const double* r = columns + i * length;
    x[i] /= r[i];
    for (int k = 0; k < i; ++k) x[k] -= r[k] * x[i];
  }
}

}  // namespace linkstudy
