// What a design of blocks tells of every quantity and parameter: elementary effects of morris,
// Sobol indices of saltelli.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "study/design/design_options.h"
#include "study/record/evaluation.h"
#include "study/sensitivity/bootstrap.h"
#include "study/sensitivity/failure_region.h"

namespace linkstudy::sensitivity {

inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// What the interval of an estimate says.
enum class Finding { acts, indistinct, none, untold };

struct Estimate {
  double value = kUnknown;
  Interval interval{kUnknown, kUnknown};
  Finding finding = Finding::untold;
  double needed = kUnknown;  // of an indistinct one: blocks that would settle it
};

struct ParameterSensitivity {
  std::size_t parameter = 0;  // by position
  Estimate main;              // mu, or the index of first order
  Estimate total;             // mu*, or the total index
  double sigma = kUnknown;    // of morris
};

struct QuantitySensitivity {
  std::string name;
  std::string unit;
  std::size_t blocks = 0;       // that are complete
  std::size_t left_out = 0;     // with an evaluation that failed or has no such number
  double mean = kUnknown;       // of saltelli
  double deviation = kUnknown;  // likewise
  std::vector<ParameterSensitivity> parameters;
};

struct Sensitivity {
  std::string name;
  Design design = Design::saltelli;
  std::vector<Parameter> parameters;
  std::vector<QuantitySensitivity> quantities;
  std::size_t evaluations = 0;
  std::size_t failed = 0;
  std::vector<FailureRegion> failures;
};

}  // namespace linkstudy::sensitivity

namespace linkstudy {

template <>
inline constexpr auto kWords<sensitivity::Finding> = make_words<sensitivity::Finding>({
    {sensitivity::Finding::acts, "acts"},
    {sensitivity::Finding::indistinct, "not distinguishable from 0"},
    {sensitivity::Finding::none, "no effect in any block"},
    {sensitivity::Finding::untold, "untold"},
});

}  // namespace linkstudy
