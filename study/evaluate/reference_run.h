// The run that [[match]] compares with, and the poses along it at which a case's spectrum is taken.
#pragma once

#include <stdexcept>
#include <string>

#include "core/simulation/prepare.h"
#include "study/metrics/run_metrics.h"

namespace linkstudy {

// The reference itself fails: an error of the whole study, not of its rows.
class ReferenceFailure : public std::runtime_error {
 public:
  ReferenceFailure(Cause cause, const std::string& message)
      : std::runtime_error(message), cause_(cause) {}
  Cause cause() const { return cause_; }

 private:
  Cause cause_;
};

// Number of poses kept of a reference run.
inline constexpr long kReferencePoses = 8;

// The study as the reference run of a load case sees it: an experiment's own run matches its
// signals.
StudyInput reference_view(const StudyInput& input, const LoadCaseInput& load_case);

// The model of that run, where reference_view is one. Throws ReferenceFailure.
ModelInput read_reference(const StudyInput& view, const LoadCaseInput& load_case);

// The reference with the values of each load case set, side by side where runs can share step
// loops; a record has the bits of a run alone. Throws ReferenceFailure, of the first that fails.
std::vector<ReferenceRecord> run_references(const StudyInput& study,
                                            std::span<const LoadCaseInput* const> load_cases,
                                            const RunLimits& limits);

// Highest eigenfrequency and smallest step limit of a prepared case at its start and at the
// reference's poses, as far as both have the same joints; along: whether they have.
struct KnownLimit {
  StepLimit worst;
  bool along = false;
};
KnownLimit find_known_limit(const Preparation& preparation, const ReferenceRecord* reference);

}  // namespace linkstudy
