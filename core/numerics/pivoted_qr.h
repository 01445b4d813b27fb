// Householder factorisation with exchanges, Pi A P = Q R, of a matrix A whose columns lie one after
// another: at every step the longest remaining column comes first, and in it the largest entry.
// With both exchanges the error is small in every row of A by itself, however differently the rows
// are scaled (Powell and Reid 1969; Cox and Higham 1998): a light link makes one row large and does
// not drown the others.
#pragma once

namespace linkstudy {

// Columns of `length` entries, `count` of them; order (count) names them and is permuted with them.
// Stops before the first column whose remaining part is not longer than `tolerance` and returns the
// number of columns done, the rank r. Column j then holds R_0j .. R_jj (j < r; the first r entries
// for j >= r) and below the diagonal nothing of use; |R_00| >= |R_11| >= ...
int factorize_pivoted(int length, int count, double tolerance, double* columns, int* order);

// x := R^-T x and x := R^-1 x with the leading (n, n) triangle of R.
void solve_upper_transposed(int length, int n, const double* columns, double* x);
void solve_upper(int length, int n, const double* columns, double* x);

}  // namespace linkstudy
