// A least-squares fit in full: starts, the best of them, its intervals, identifiability, a second
// method, and figures of the residuals. The same numbers for any way the batches are evaluated.
#pragma once

#include <string_view>

#include "study/calibrate/cross_check.h"
#include "study/calibrate/profile.h"
#include "study/calibrate/residual_figures.h"
#include "study/calibrate/starts.h"

namespace linkstudy::calibration {

// structurally_flat: the residuals do not change along a direction that it takes part in, and its
// profile does not rise to the bounds. practically_not: its interval does not end within the
// bounds.
enum class Identifiability { identifiable, practically_not, structurally_flat };
enum class FitStatus { fitted, ambiguous, failed };
enum class AtBound { no, low, high };

}  // namespace linkstudy::calibration

namespace linkstudy {

template <>
inline constexpr auto kWords<calibration::Identifiability> =
    make_words<calibration::Identifiability>(
        {{calibration::Identifiability::identifiable, "identifiable"},
         {calibration::Identifiability::practically_not, "practically not"},
         {calibration::Identifiability::structurally_flat, "structurally flat"}});
template <>
inline constexpr auto kWords<calibration::FitStatus> =
    make_words<calibration::FitStatus>({{calibration::FitStatus::fitted, "fitted"},
                                        {calibration::FitStatus::ambiguous, "ambiguous"},
                                        {calibration::FitStatus::failed, "failed"}});
template <>
inline constexpr auto kWords<calibration::AtBound> =
    make_words<calibration::AtBound>({{calibration::AtBound::no, "no"},
                                      {calibration::AtBound::low, "low"},
                                      {calibration::AtBound::high, "high"}});

}  // namespace linkstudy

namespace linkstudy::calibration {

// NaN where there is no such end within the bounds.
struct Interval {
  double low = 0.0;
  double high = 0.0;
};

struct Estimate {
  double value = 0.0;
  double standard_error = 0.0;  // of the value; of a logarithmic parameter value times that of ln
  Interval linear;              // exp of an interval of ln for a logarithmic parameter
  Interval profile;
  ProfileEnd low_end = ProfileEnd::unknown;
  ProfileEnd high_end = ProfileEnd::unknown;
  AtBound at_bound = AtBound::no;
  Identifiability identifiability = Identifiability::identifiable;
  std::string combination;  // of a flat one: what changes together
};

struct ProfileRow {
  std::size_t parameter = 0;
  double value = 0.0;
  double rise = 0.0;  // S - S_min, in units of that at the end of an interval
  std::vector<double> others;
};

struct FitResult {
  FitProblem problem;
  FitOptions options;
  FitStatus status = FitStatus::failed;
  std::string reason;
  std::vector<Estimate> estimates;
  double sum = 0.0;  // S at the best point
  std::uint64_t evaluation = 0;
  std::vector<double> residuals;
  ResidualFigures figures;
  Matrix correlation;
  std::vector<double> singular_values;
  std::vector<std::string> flat;  // directions along which nothing changes
  std::vector<StartReport> starts;
  std::vector<ProfileRow> profiles;
  CrossCheck check;
  std::size_t evaluations = 0;
  std::size_t failed = 0;
  std::size_t rounds = 0;
};

FitResult calibrate(const FitProblem& problem, const FitOptions& options, EvaluateBatch evaluate);

}  // namespace linkstudy::calibration
