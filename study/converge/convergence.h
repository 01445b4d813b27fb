// The answer of `linkstudy converge`: a ladder for each quantity and each refined value. Of two
// refined values the first is judged at every value of the second, the second at the finest of the
// first.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/simulation/cause.h"
#include "study/config/study_input.h"
#include "study/converge/needed_size.h"
#include "study/converge/refinement.h"

namespace linkstudy::convergence {

// response: a [[response]]; error: a [[match]], relative to its reference; series: a [[series]].
enum class QuantityKind { response, error, series };

// Where a row of a ladder comes from.
struct LevelSource {
  double size = 0.0;  // the refined value
  std::uint64_t evaluation = 0;
  Cause status = Cause::ok;
  double steps = kUnknown;
  double wall_s = 0.0;
};

struct QuantityLadder {
  std::string quantity;  // as its column is called, or the channel of a history
  std::string unit;
  QuantityKind kind = QuantityKind::response;
  std::string over;  // path of the refined value
  std::string over_unit;
  std::string at;  // "closure.S.sde.stiffness = 1e+06 N/m"; empty where one value is refined
  bool at_finest = true;
  std::vector<LevelSource> levels;  // by row of the refinement
  Refinement refinement;
  double reference = kUnknown;  // what the reference has of it
  double wanted = kUnknown;     // relative error
  double needed = kUnknown;     // the refined value at which the error is that
  NeededBy needed_by = NeededBy::nothing;
};

// The value that suffices for every quantity, beside the one the model has.
struct NeededValue {
  std::string path;
  std::string unit;
  double needed = kUnknown;
  NeededBy by = NeededBy::nothing;
  std::string quantity;  // that decides
  double wanted = kUnknown;
  double own = kUnknown;       // of the model
  double fineness = kUnknown;  // times that the model is finer than needed
  std::size_t unknown = 0;     // quantities that do not tell
};

struct Convergence {
  std::string name;
  std::vector<QuantityLadder> ladders;
  std::vector<NeededValue> needed;  // by refined value

  bool is_settled() const;
};

}  // namespace linkstudy::convergence

namespace linkstudy {

template <>
inline constexpr auto kWords<convergence::QuantityKind> =
    make_words<convergence::QuantityKind>({{convergence::QuantityKind::response, "response"},
                                           {convergence::QuantityKind::error, "error"},
                                           {convergence::QuantityKind::series, "series"}});

}  // namespace linkstudy
