// The scan of several variables: points along the diagonal of the box, from its lowest to its
// highest corner, and points that fill the box evenly: the additive recurrence with the generalised
// golden ratio g_n (the root of g^(n+1) = g + 1), u_ij = frac(1/2 + i g_n^-j) [M. Roberts 2018].
#pragma once

#include "study/tune/scan_window.h"

namespace linkstudy::tuning {

// `scan` points on the diagonal, and as many for each further variable in the box.
std::vector<std::vector<double>> make_box_scan(const TuningProblem& problem, std::size_t scan);

// Every point evaluated at the base step, in the order asked, with its side. A finite failing point
// failed by its step where half of it brings it at least half the way to matching, or where it lies
// above a matching point along every axis.
std::vector<ScanPoint> classify_box(const EvaluationLog& log,
                                    const std::vector<std::vector<double>>& scan);

}  // namespace linkstudy::tuning
