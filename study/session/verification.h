// Results against the program: evaluations are run again from what the results hold of their input
// and compared with what is stored, and the answer (a certificate, a fit, orders of convergence) is
// judged anew from those that were run again and the rest as stored: searches are repeated.
// Rerun are: the evaluations that an answer and its certificate rest on (of a calibration all whose
// residuals are not stored: a file of results has those of the best alone), the first and the last,
// one of each cause of failure, those with the least and the greatest of every compared number,
// and, up to `count`, others drawn by the study's seed. What may end otherwise on a second try
// (timeout, exception, rank_lost) is left out.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "study/store/results.h"

namespace linkstudy {

struct VerifyOptions {
  std::size_t count = 8;
  bool all = false;
};

// A number that came out otherwise.
struct Disagreement {
  std::uint64_t evaluation = 0;
  std::string column;  // "status", or a response
  std::string stored;
  std::string found;
};

struct Verification {
  std::size_t stored = 0;            // evaluations
  std::vector<std::uint64_t> rerun;  // ids
  bool to_the_bit = true;            // false: the instruction sets round differently
  std::vector<Disagreement> disagreements;
  std::string answer;                  // "certified", "converged"; empty where there is none
  std::optional<std::string> refuted;  // why the answer does not hold
  std::vector<std::string> warnings;

  bool holds() const { return disagreements.empty() && !refuted; }
};

// Throws StoreError and InputError.
Verification verify_results(const StudyResults& results, const VerifyOptions& options);

// The ids that are run again, ascending; `needed` are those of a certificate.
std::vector<std::uint64_t> choose_evaluations(const StudyResults& results,
                                              const std::vector<std::uint64_t>& needed,
                                              const VerifyOptions& options);

}  // namespace linkstudy
