// What a tuner claims about its point k*, each claim with the evaluations it rests on, so that
// `verify` can run them again and judge anew.
//   C0  k* is feasible at the base step and at half of it
//   C1  k* is minimal in each variable: k_i (1 - delta) alone is rejected (fails at one step); of a
//       largest value k_i / (1 - delta); of a linear range k_i -+ delta of it, or its end. What the
//       objective leaves free is then also moved by the neighbourhood to either side. Of a
//       response: both of every variable, as far as the range goes, are rejected or not better
//   C2  no point of the declared scan below k* (smaller objective) is accepted
//   C3  the error falls in k about k*: f = log10 max(error / tolerance) drops from the lower
//       neighbour to k* and from k* to the upper one by more than the noise. Noise is the larger
//       of |f(h) - f(h/2)| at k* and the largest rise of f between evaluated points in between.
//       Of several variables each decides some components only: f must drop up to k* along each,
//       and beyond k* may stay. Claimed of variables in the objective; of a largest one f rises.
//   C4  of two and three variables: nothing lower by more than the gap, if errors are monotone
//       (monotone_proof.h)
// A claim is certified, refuted (an evaluation says otherwise), or inconclusive (an evaluation is
// missing, ended by a cause that may be the machine's, or the noise hides it). The verdict is
// refuted if any claim is, else inconclusive if any is, else certified.
//
// make_certificate and check_certificate judge by the same rules from the listed evaluations only.
#pragma once

#include <functional>
#include <optional>
#include <string_view>

#include "core/base/words.h"

#include "study/tune/evaluation_log.h"

namespace linkstudy::tuning {

enum class Verdict { certified, refuted, inconclusive };

}  // namespace linkstudy::tuning

namespace linkstudy {

template <>
inline constexpr auto kWords<tuning::Verdict> =
    make_words<tuning::Verdict>({{tuning::Verdict::certified, "certified"},
                                 {tuning::Verdict::refuted, "refuted"},
                                 {tuning::Verdict::inconclusive, "inconclusive"}});

}  // namespace linkstudy

namespace linkstudy::tuning {

struct Claim {
  std::string name;       // "C0"
  std::string statement;  // one line
  std::vector<std::uint64_t> evaluations;
  Verdict verdict = Verdict::inconclusive;
  std::string reason;
};

// What the claims are about: everything needed to judge them again.
struct CertificateTerms {
  std::vector<double> point;  // k*, (n)
  std::vector<TunedVariable> variables;
  std::vector<MatchComponent> components;
  std::optional<ResponseObjective> response = {};
  double objective = 0.0;  // at k*
  double delta = 0.0;
  double neighbourhood = 0.0;
  std::vector<std::vector<double>> scan;              // the declared scan
  std::vector<std::vector<double>> lower_neighbours;  // of C3, one per variable
  std::vector<std::vector<double>> upper_neighbours;
  bool has_proof = false;  // claims C4
  double gap = 0.0;        // of C4, decades
  double mu = 0.0;         // least of C4
  double slack = 0.0;      // resolution of the gap
};

struct Certificate {
  CertificateTerms terms;
  std::vector<Claim> claims;
  Verdict verdict = Verdict::inconclusive;
  std::string reason;  // empty when certified
};

// The terms for a point: neighbours lie `neighbourhood` decades below along each axis, and above by
// that or by half the window's margin there, whichever is less; never outside the declared range.
CertificateTerms make_terms(const EvaluationLog& log, const std::vector<double>& point,
                            const std::vector<double>& margins,
                            const std::vector<std::vector<double>>& scan);

// The evaluations the claims need, in a fixed order. Points of the scan below k* that match at the
// base step are asked for at half of it as well, and so is k_i (1 - delta).
std::vector<Request> list_requests(const CertificateTerms& terms, const EvaluationLog& log);

Certificate make_certificate(const CertificateTerms& terms, const EvaluationLog& log);

// The evaluation with this id, as recorded or as run again.
using Lookup = std::function<std::optional<Observation>(std::uint64_t id)>;

// Judges every claim again. A claim whose recorded verdict is not reached again is refuted, and so
// is then the certificate.
Certificate check_certificate(const Certificate& certificate, const Lookup& lookup);

}  // namespace linkstudy::tuning
