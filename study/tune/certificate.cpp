#include "study/tune/certificate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "study/tune/judge_claim.h"
#include "study/tune/monotone_proof.h"
#include "study/tune/scan_window.h"
#include "study/tune/variable_axis.h"

namespace linkstudy::tuning {
namespace {

// Ids of both steps at a point, as far as they were evaluated.
void add_ids(const EvaluationLog& log, const std::vector<double>& x, Claim& claim) {
  for (const double factor : {1.0, 0.5}) {
    if (const Observation* observation = log.find(x, factor)) {
      claim.evaluations.push_back(observation->answer.id);
    }
  }
}

bool between(const CertificateTerms& terms, const std::vector<double>& x, std::size_t i) {
  return is_below(terms.lower_neighbours[i], x) && is_below(x, terms.upper_neighbours[i]);
}

Claim collect_minimality(const CertificateTerms& terms, const EvaluationLog& log) {
  Claim claim{"C1", minimality_statement(terms), {}, {}, {}};
  for (const std::vector<double>& x : points_about(terms)) add_ids(log, x, claim);
  return claim;
}

Claim collect_scan(const CertificateTerms& terms, const EvaluationLog& log) {
  Claim claim{"C2", "nothing of the declared scan below k* matches", {}, {}, {}};
  for (const std::vector<double>& x : scan_below(terms)) add_ids(log, x, claim);
  return claim;
}

Claim collect_neighbourhood(const CertificateTerms& terms, const EvaluationLog& log) {
  Claim claim{"C3", "the error falls in k about k* by more than the noise", {}, {}, {}};
  for (std::size_t i = 0; i < terms.point.size(); ++i) {
    if (terms.variables[i].weight == 0.0) continue;
    for (const Observation& observation : log.observations()) {
      const Request& request = observation.request;
      const bool inside = between(terms, request.x, i);
      if (inside && (request.step_factor == 1.0 || request.x == terms.point)) {
        claim.evaluations.push_back(observation.answer.id);
      }
    }
  }
  return claim;
}

Claim collect_proof(const CertificateTerms& terms, const EvaluationLog& log) {
  Claim claim{
      "C4",
      fmt::format("nothing lower by more than {:g} decades if errors are monotone", terms.gap),
      {},
      {},
      {}};
  // The audit is over all of them.
  for (const Observation& seen : log.observations()) claim.evaluations.push_back(seen.answer.id);
  return claim;
}

void conclude(Certificate& certificate) {
  certificate.verdict = Verdict::certified;
  certificate.reason.clear();
  for (const Verdict worst : {Verdict::refuted, Verdict::inconclusive}) {
    for (const Claim& claim : certificate.claims) {
      if (claim.verdict == worst) {
        certificate.verdict = worst;
        certificate.reason = claim.name + ": " + claim.reason;
        return;
      }
    }
  }
}

}  // namespace

CertificateTerms make_terms(const EvaluationLog& log, const std::vector<double>& point,
                            const std::vector<double>& margins,
                            const std::vector<std::vector<double>>& scan) {
  const TuningProblem& problem = log.problem();
  const TuningOptions& options = log.options();
  CertificateTerms terms;
  terms.point = point;
  terms.variables = problem.variables;
  terms.components = problem.components;
  terms.response = problem.response;
  terms.objective = compute_objective(problem, point, log.find(point, 1.0)->answer);
  terms.delta = options.delta;
  terms.neighbourhood = options.neighbourhood;
  terms.scan = scan;
  terms.has_proof = can_be_proven(problem);
  terms.gap = options.gap;
  terms.mu = options.mu;
  terms.slack = options.resolution;
  for (std::size_t i = 0; i < point.size(); ++i) {
    const TunedVariable& variable = problem.variables[i];
    const double into = std::min(options.neighbourhood, 0.5 * margins[i]);
    const bool is_largest = variable.weight < 0.0;
    const double down = is_largest ? into : options.neighbourhood;
    const double up = is_largest ? options.neighbourhood : into;
    terms.lower_neighbours.push_back(point);
    terms.upper_neighbours.push_back(point);
    terms.lower_neighbours[i][i] = move_along(variable, point[i], -down);
    terms.upper_neighbours[i][i] = move_along(variable, point[i], up);
  }
  return terms;
}

std::vector<Request> list_requests(const CertificateTerms& terms, const EvaluationLog& log) {
  std::vector<Request> requests = {{terms.point, 1.0, "certificate"},
                                   {terms.point, 0.5, "certificate"}};
  std::vector<std::vector<double>> suspects = scan_below(terms);
  for (std::size_t i = 0; i < terms.point.size(); ++i) {
    for (const std::vector<double>& x : points_about(terms, i)) {
      suspects.push_back(x);
      if (is_in_range(terms, x)) requests.push_back({x, 1.0, "certificate"});
    }
    if (terms.response || terms.variables[i].weight == 0.0) continue;
    requests.push_back({terms.lower_neighbours[i], 1.0, "certificate"});
    requests.push_back({terms.upper_neighbours[i], 1.0, "certificate"});
  }
  for (const std::vector<double>& x : suspects) {
    const Observation* base = log.find(x, 1.0);
    if (base != nullptr && compute_ratio(base->answer, terms.components) <= 1.0) {
      requests.push_back({x, 0.5, "certificate"});
    }
  }
  return requests;
}

Certificate make_certificate(const CertificateTerms& terms, const EvaluationLog& log) {
  Certificate certificate;
  certificate.terms = terms;
  certificate.claims = {{"C0", "k* matches at the step and at half of it", {}, {}, {}}};
  add_ids(log, terms.point, certificate.claims[0]);
  certificate.claims.push_back(collect_minimality(terms, log));
  certificate.claims.push_back(collect_scan(terms, log));
  if (!terms.response) certificate.claims.push_back(collect_neighbourhood(terms, log));
  if (terms.has_proof) certificate.claims.push_back(collect_proof(terms, log));
  for (Claim& claim : certificate.claims) {
    std::vector<Observation> evidence;
    for (const Observation& observation : log.observations()) {
      const auto& ids = claim.evaluations;
      if (std::find(ids.begin(), ids.end(), observation.answer.id) != ids.end()) {
        evidence.push_back(observation);
      }
    }
    judge_claim(terms, evidence, claim);
  }
  conclude(certificate);
  return certificate;
}

Certificate check_certificate(const Certificate& certificate, const Lookup& lookup) {
  Certificate checked = certificate;
  for (std::size_t i = 0; i < checked.claims.size(); ++i) {
    Claim& claim = checked.claims[i];
    std::vector<Observation> evidence;
    for (const std::uint64_t id : claim.evaluations) {
      if (const std::optional<Observation> observation = lookup(id)) {
        evidence.push_back(*observation);
      }
    }
    judge_claim(checked.terms, evidence, claim);
    const Verdict recorded = certificate.claims[i].verdict;
    if (claim.verdict != recorded) {
      claim.reason = fmt::format("recorded as {}, but {}", name_of(recorded), claim.reason);
      claim.verdict = Verdict::refuted;
    }
  }
  conclude(checked);
  if (checked.verdict != certificate.verdict && checked.verdict != Verdict::refuted) {
    checked.reason = fmt::format("recorded as {}, but the claims make it {}",
                                 name_of(certificate.verdict), name_of(checked.verdict));
    checked.verdict = Verdict::refuted;
  }
  return checked;
}

}  // namespace linkstudy::tuning
