// What a ladder of refinements tells about one quantity. Class first, numbers only where the class
// allows them. Of three neighbours with sizes h1 < h2 < h3 and differences e21 = f2 - f1, e32 = f3
// - f2:
//   floor        a difference is rounding, or of the noise that the finest levels show
//   monotone     e21 e32 > 0 and the differences fall as some h^p, p > 0 (observed_order.h)
//   oscillatory  e21 e32 < 0 and |e21| < |e32|
//   divergent    neither
// and only of monotone ones, with r = h2 / h1 (Roache 1994; Celik et al. 2008):
//   extrapolated      f1 + (f1 - f2) / (r^p - 1)
//   uncertainty       Fs |f1 - f2| / (r^q - 1),   Fs = 1.25, q = p
//   GCI               uncertainty / |f1|; of relative errors the uncertainty
//   asymptotic ratio  GCI32 / (r21^p GCI21), 1 where all three are asymptotic
// Fs = 3 and q = the formal order where p exceeds twice the formal one, and where there are two
// levels only, which show no order. Of the whole ladder:
//   noise        differences of changing sign that do not fall: something else than the refined
//                value decides
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/base/words.h"
#include "study/converge/fit_order.h"

namespace linkstudy::convergence {

enum class Behaviour { monotone, oscillatory, divergent, floor, noise, untold };

}  // namespace linkstudy::convergence

namespace linkstudy {

template <>
inline constexpr auto kWords<convergence::Behaviour> =
    make_words<convergence::Behaviour>({{convergence::Behaviour::monotone, "monotone"},
                                        {convergence::Behaviour::oscillatory, "oscillatory"},
                                        {convergence::Behaviour::divergent, "divergent"},
                                        {convergence::Behaviour::floor, "floor"},
                                        {convergence::Behaviour::noise, "noise"},
                                        {convergence::Behaviour::untold, "untold"}});

}  // namespace linkstudy

namespace linkstudy::convergence {

inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kLeastRatio = 1.3;  // of neighbours; below it differences are mostly noise

// One quantity over a ladder. `change[i]` is the difference between level i and the next coarser
// one with values, its sign relative to the others: of numbers value[i] - value[before], of time
// histories the norm of their difference (series_difference.h).
struct Ladder {
  std::vector<double> h;       // coarse to fine
  std::vector<double> value;   // NaN where the level failed
  std::vector<double> change;  // NaN where there is none
  std::vector<double> error;   // against a reference; NaN, or empty, where there is none
  double scale = 1.0;          // what rounding is relative to
  bool is_relative = false;    // values are relative errors already: GCI is the uncertainty itself
  bool has_limit = true;       // values approach a number that can be extrapolated
};

// Of numbers in any order of h. `scale`: the greatest magnitude of the values, unless given.
Ladder make_ladder(std::vector<Level> levels, std::optional<double> limit = {},
                   std::optional<double> scale = {});

struct RefinementOptions {
  double formal_order = kUnknown;
  double floor = 2e-12;  // differences below this fraction of the scale are rounding
};

// A level, with what it and its two coarser neighbours tell.
struct RefinementRow {
  double h = 0.0;
  double value = kUnknown;
  double change = kUnknown;
  double ratio = kUnknown;  // h of the coarser neighbour / h
  Behaviour behaviour = Behaviour::untold;
  double order = kUnknown;
  double extrapolated = kUnknown;
  double uncertainty = kUnknown;
  double gci = kUnknown;
  double asymptotic_ratio = kUnknown;
  double error = kUnknown;
  double error_order = kUnknown;
  bool is_floor = false;  // its change is rounding or noise
};

struct Refinement {
  std::vector<RefinementRow> rows;  // coarse to fine
  Behaviour behaviour = Behaviour::untold;
  double formal_order = kUnknown;
  // Of the finest three levels above the floor.
  double order = kUnknown;
  double extrapolated = kUnknown;
  double uncertainty = kUnknown;
  double gci = kUnknown;
  double safety_factor = kUnknown;
  std::size_t finest = 0;       // row that they belong to
  std::size_t asymptotic = 0;   // levels that show the same order, from there on
  std::optional<OrderFit> fit;  // over those
  double difference_order = kUnknown;
  double noise = 0.0;  // greatest change among those that are floor
  std::vector<std::string> remarks;

  // An order that is known, or a floor that is reached: what more levels would not change.
  bool is_settled() const;
};

Refinement judge_refinement(const Ladder& ladder, const RefinementOptions& options = {});

}  // namespace linkstudy::convergence
