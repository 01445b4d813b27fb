// What an evaluation is, whatever file asks for it and under whatever id: SHA-256 over the resolved
// model of every load case at its point (all values, defaults filled in), the resolved model or the
// data of what it is compared with, and what is kept of a run (matches, responses, histories,
// residuals). Evaluations with equal keys have equal results from one program and instruction set.
// What only judges results does not count: tolerances, norms, limits, objectives, budgets, names of
// files; nor does how long a run may take.
//
// Limits that end a run and change nothing of one that they do not end stand apart, so that results
// under narrower ones count where they are wider now.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "study/evaluate/evaluator.h"

namespace linkstudy {

// simulation.step_limit ends as step_budget, simulation.drift_limit as constraint_drift.
struct RunCaps {
  double steps = 0.0;
  double drift = 0.0;  // m or rad

  bool operator==(const RunCaps&) const = default;
};

struct CaseKey {
  std::string digest;         // 64 hexadecimal digits; caps left out
  std::vector<RunCaps> caps;  // of each load case and, where it has one, of its reference run

  // With the caps: what names one result and no other.
  std::string with_caps() const;
};

// How the caps of one result are to those wanted now.
enum class CapChange { none, wider, narrower };
CapChange compare_caps(const CaseKey& before, const CaseKey& now);
// Whether a result under narrower caps may end otherwise under these.
bool is_ended_by_caps(Cause cause, const CaseKey& before, const CaseKey& now);

class CaseKeys {
 public:
  // `evaluator` outlives this. Throws ReferenceFailure.
  explicit CaseKeys(const Evaluator& evaluator);

  // Nothing where the point is no valid model.
  std::optional<CaseKey> of(const std::vector<Value>& values) const;
  // Of the reference run of a load case that has one.
  CaseKey of_reference(std::size_t load_case) const;

  // Of all points: what is kept of a run, as the input says it.
  const Tree& kept() const { return kept_; }
  // The resolved models of the references, in a table by load case; data are not among them.
  const Tree& references() const { return references_; }

 private:
  const Evaluator& evaluator_;
  Tree kept_;
  Tree references_;
  std::string common_;                                  // bytes of all that the points share
  std::vector<std::optional<RunCaps>> reference_caps_;  // by load case
};

}  // namespace linkstudy
