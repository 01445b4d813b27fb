#include "study/tune/judge_claim.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "study/tune/monotone_proof.h"
#include "study/tune/scan_window.h"
#include "study/tune/variable_axis.h"

namespace linkstudy::tuning {
namespace {

using Evidence = std::vector<Observation>;

struct Finding {
  Verdict verdict = Verdict::inconclusive;
  std::string reason;
};

const Observation* find(const Evidence& evidence, const std::vector<double>& x, double factor) {
  for (const Observation& observation : evidence) {
    if (observation.request.x == x && observation.request.step_factor == factor) {
      return &observation;
    }
  }
  return nullptr;
}

std::string format_point(const std::vector<double>& x) {
  return fmt::format("{:.6g}", fmt::join(x, ", "));
}

std::string describe(const Observation* observation, const CertificateTerms& terms) {
  if (observation == nullptr) return "not evaluated";
  if (observation->answer.status != Cause::ok) {
    return std::string(name_of(observation->answer.status));
  }
  return fmt::format("{:.4g} of tolerance", compute_ratio(observation->answer, terms.components));
}

Acceptance accept(const CertificateTerms& terms, const Evidence& evidence,
                  const std::vector<double>& x) {
  return judge_acceptance(find(evidence, x, 1.0), find(evidence, x, 0.5), terms.components);
}

bool is_half_step(const Observation* base, const Observation* half) {
  if (base == nullptr || half == nullptr || !(base->answer.step > 0.0)) return true;
  return std::abs(half->answer.step - 0.5 * base->answer.step) <= 1e-3 * base->answer.step;
}

Finding judge_feasible(const CertificateTerms& terms, const Evidence& evidence) {
  const Observation* base = find(evidence, terms.point, 1.0);
  const Observation* half = find(evidence, terms.point, 0.5);
  const std::string seen =
      fmt::format("{}, at half the step {}", describe(base, terms), describe(half, terms));
  switch (judge_acceptance(base, half, terms.components)) {
    case Acceptance::accepted:
      return is_half_step(base, half)
                 ? Finding{Verdict::certified, seen}
                 : Finding{Verdict::inconclusive, "the second evaluation did not halve the step"};
    case Acceptance::rejected:
      return {Verdict::refuted, seen};
    case Acceptance::open:
      break;
  }
  return {Verdict::inconclusive, seen};
}

// What is accepted refutes only where it is better, which the points of a sum are.
bool is_better(const CertificateTerms& terms, const Evidence& evidence,
               const std::vector<double>& x) {
  if (!terms.response) return true;
  const Observation* base = find(evidence, x, 1.0);
  const bool is_known = base != nullptr && base->answer.status == Cause::ok;
  return !is_known || base->answer.objective < terms.objective;
}

// All points must be rejected; the first accepted refutes, else the first open one leaves it open.
Finding judge_rejected(const CertificateTerms& terms, const Evidence& evidence,
                       const std::vector<std::vector<double>>& points) {
  const std::string all = terms.response
                              ? fmt::format("none of {} is better and matches", points.size())
                              : fmt::format("{} of {} fail", points.size(), points.size());
  Finding finding{Verdict::certified, all};
  for (const std::vector<double>& x : points) {
    if (!is_better(terms, evidence, x)) continue;
    const Acceptance acceptance = accept(terms, evidence, x);
    if (acceptance == Acceptance::accepted) {
      return {Verdict::refuted, format_point(x) + " matches"};
    }
    if (acceptance == Acceptance::open && finding.verdict == Verdict::certified) {
      finding = {Verdict::inconclusive, fmt::format("{}: {}, at half the step {}", format_point(x),
                                                    describe(find(evidence, x, 1.0), terms),
                                                    describe(find(evidence, x, 0.5), terms))};
    }
  }
  return finding;
}

Finding judge_minimal(const CertificateTerms& terms, const Evidence& evidence) {
  const std::vector<std::vector<double>> points = points_about(terms);
  for (const std::vector<double>& x : points) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      const TunedVariable& variable = terms.variables[i];
      if (x[i] >= variable.low && x[i] <= variable.high) continue;
      const bool is_low = x[i] < variable.low;
      return {Verdict::inconclusive,
              fmt::format("the range of '{}' ends at {:.6g}, {}", variable.path,
                          is_low ? variable.low : variable.high,
                          !variable.is_logarithmic ? "where k lies: extend it"
                          : is_low                 ? "above k (1 - delta): lower its low end"
                                                   : "below k / (1 - delta): raise its high end")};
    }
  }
  Finding finding = judge_rejected(terms, evidence, points);
  if (finding.verdict == Verdict::certified && points.size() == 1) {
    const Observation* base = find(evidence, points[0], 1.0);
    finding.reason = fmt::format("{}: {}", format_point(points[0]), describe(base, terms));
  }
  return finding;
}

Finding judge_scan(const CertificateTerms& terms, const Evidence& evidence) {
  const std::vector<std::vector<double>> points = scan_below(terms);
  if (points.empty()) {
    return {Verdict::certified, "no point of the scan lies below"};
  }
  return judge_rejected(terms, evidence, points);
}

double way_of(const CertificateTerms& terms, std::size_t i) {
  return terms.variables[i].weight < 0.0 ? -1.0 : 1.0;
}

struct Sample {
  double value = 0.0;  // decades from k* along the axis
  double log_ratio = 0.0;
};

// Base-step samples along variable i from one neighbour to the other, ascending; of a largest value
// turned, so that the point lies above what fails.
std::vector<Sample> samples_along(const CertificateTerms& terms, const Evidence& evidence,
                                  std::size_t i) {
  std::vector<Sample> samples;
  for (const Observation& observation : evidence) {
    std::vector<double> x = observation.request.x;
    const double value = way_of(terms, i) * distance(terms.variables[i], terms.point[i], x[i]);
    const bool inside =
        is_below(terms.lower_neighbours[i], x) && is_below(x, terms.upper_neighbours[i]);
    x[i] = terms.point[i];
    const bool counts = !is_transient(observation.answer.status);
    if (x == terms.point && inside && counts && observation.request.step_factor == 1.0) {
      samples.push_back(
          {value, compute_log_ratio(compute_ratio(observation.answer, terms.components))});
    }
  }
  std::sort(samples.begin(), samples.end(),
            [](const Sample& a, const Sample& b) { return a.value < b.value; });
  return samples;
}

double find_largest_rise(const std::vector<Sample>& samples) {
  double rise = 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (const Sample& sample : samples) {
    least = std::min(least, sample.log_ratio);
    rise = std::max(rise, sample.log_ratio - least);
  }
  return rise;
}

Finding judge_falling(const CertificateTerms& terms, const Evidence& evidence, std::size_t i) {
  const Observation* base = find(evidence, terms.point, 1.0);
  const Observation* half = find(evidence, terms.point, 0.5);
  const std::vector<Sample> samples = samples_along(terms, evidence, i);
  const double way = way_of(terms, i);
  const auto reach = [&](const std::vector<std::vector<double>>& neighbours) {
    return way * distance(terms.variables[i], terms.point[i], neighbours[i][i]);
  };
  const auto& failing = way > 0.0 ? terms.lower_neighbours : terms.upper_neighbours;
  const auto& matching = way > 0.0 ? terms.upper_neighbours : terms.lower_neighbours;
  // Of several variables the window above may be a point: another one decides there.
  const bool is_alone = terms.point.size() == 1;
  const bool has_lower =
      samples.size() >= 2 && samples.front().value < 0.0 && samples.front().value == reach(failing);
  const bool has_upper =
      samples.size() >= 3 && samples.back().value > 0.0 && samples.back().value == reach(matching);
  const bool ends = has_lower && (has_upper || !is_alone);
  if (base == nullptr || half == nullptr || !ends) {
    return {Verdict::inconclusive, "a neighbour of k* was not evaluated or lies outside the range"};
  }
  const double at_base = compute_log_ratio(compute_ratio(base->answer, terms.components));
  const double at_half = compute_log_ratio(compute_ratio(half->answer, terms.components));
  const double rise = find_largest_rise(samples);
  const double noise = std::max(std::abs(at_base - at_half), rise);
  const double below = samples.front().log_ratio - at_base;
  const double above = at_base - samples.back().log_ratio;
  const double drop = is_alone ? std::min(below, above) : below;
  const std::string seen = fmt::format("drop {:.2g} decades within {:.2g} of k*, noise {:.2g}",
                                       drop, samples.back().value - samples.front().value, noise);
  if (drop > noise) {
    return {Verdict::certified, seen};
  }
  return {rise > 0.0 && rise >= drop ? Verdict::refuted : Verdict::inconclusive, seen};
}

Finding judge_neighbourhood(const CertificateTerms& terms, const Evidence& evidence) {
  Finding worst{Verdict::certified, ""};
  bool is_first = true;
  for (std::size_t i = 0; i < terms.point.size(); ++i) {
    if (terms.variables[i].weight == 0.0) continue;
    Finding finding = judge_falling(terms, evidence, i);
    if (terms.point.size() > 1) finding.reason += " along " + terms.variables[i].path;
    const bool is_worse =
        finding.verdict == Verdict::refuted || worst.verdict == Verdict::certified;
    if (is_first || is_worse) worst = finding;
    is_first = false;
  }
  return worst;
}

std::string describe(const MonotoneAudit& audit) {
  if (audit.contradictions == 0) return fmt::format("none of {} pairs contradicts it", audit.pairs);
  return fmt::format("{} of {} pairs contradict it, the worst by {:.2g} % (evaluations {} and {})",
                     audit.contradictions, audit.pairs, 100.0 * audit.worst, audit.lower_id,
                     audit.upper_id);
}

Finding judge_proof(const CertificateTerms& terms, const Evidence& evidence) {
  const MonotoneProof proof =
      prove(terms.variables, terms.components, terms.point, terms.mu, evidence);
  const std::string seen = fmt::format(
      "proven gap {:.4g} decades if errors are monotone to {:.3g} % (which costs {:.2g} decades a "
      "value); {}",
      proof.gap(), 100.0 * proof.mu, std::log10(1.0 + proof.mu), describe(proof.audit));
  const bool is_closed =
      proof.gap() <= terms.gap + terms.slack && proof.audit.worst <= kMostContradiction;
  if (!is_closed) return {Verdict::inconclusive, seen};
  if (proof.doubts == 0) return {Verdict::certified, seen};
  return {Verdict::inconclusive,
          fmt::format("{}; {} points that may contradict it were not tried at half the step", seen,
                      proof.doubts)};
}

// A linear range may end where values do, as at zero: then its end stands for what lies beyond.
double moved_in_range(const TunedVariable& variable, double value, double distance) {
  const double moved = move_along(variable, value, distance);
  return moved == value ? shifted(variable, value, distance) : moved;
}

}  // namespace

std::vector<std::vector<double>> points_about(const CertificateTerms& terms, std::size_t i) {
  std::vector<double> reduced = terms.point;
  std::vector<double> raised = terms.point;
  if (terms.variables[i].is_logarithmic) {
    reduced[i] *= 1.0 - terms.delta;
    raised[i] /= 1.0 - terms.delta;
  } else {
    reduced[i] = moved_in_range(terms.variables[i], terms.point[i], -terms.delta);
    raised[i] = moved_in_range(terms.variables[i], terms.point[i], terms.delta);
  }
  if (terms.response) {
    std::vector<std::vector<double>> points = {reduced, raised};
    std::erase_if(points, [&](const auto& x) { return !is_in_range(terms, x); });
    return points;
  }
  const double weight = terms.variables[i].weight;
  if (weight == 0.0) return {};
  std::vector<std::vector<double>> points = {weight > 0.0 ? reduced : raised};
  for (std::size_t j = 0; j < terms.point.size(); ++j) {
    if (terms.variables[j].weight != 0.0) continue;
    for (const double decades : {-terms.neighbourhood, terms.neighbourhood}) {
      std::vector<double> x = points.front();
      x[j] = move_along(terms.variables[j], x[j], decades);
      if (x != points.front()) points.push_back(std::move(x));
    }
  }
  return points;
}

std::vector<std::vector<double>> points_about(const CertificateTerms& terms) {
  std::vector<std::vector<double>> points;
  for (std::size_t i = 0; i < terms.point.size(); ++i) {
    std::ranges::copy(points_about(terms, i), std::back_inserter(points));
  }
  return points;
}

bool is_in_range(const CertificateTerms& terms, const std::vector<double>& x) {
  for (std::size_t j = 0; j < x.size(); ++j) {
    if (x[j] < terms.variables[j].low || x[j] > terms.variables[j].high) return false;
  }
  return true;
}

std::string minimality_statement(const CertificateTerms& terms) {
  if (terms.response) {
    return fmt::format("no single value changed by {:g} is better and matches", terms.delta);
  }
  const auto has_weight = [&](double weight) {
    return std::ranges::count(terms.variables, weight, &TunedVariable::weight) > 0;
  };
  std::string text = fmt::format("every k_i (1 - {:g}) alone fails", terms.delta);
  if (has_weight(0.0)) text = fmt::format("k (1 - {:g}) fails", terms.delta);
  if (has_weight(-1.0)) text = fmt::format("k / (1 - {:g}) fails", terms.delta);
  const bool is_linear = std::ranges::any_of(terms.variables, [](const TunedVariable& variable) {
    return variable.weight != 0.0 && !variable.is_logarithmic;
  });
  if (is_linear) {
    text = fmt::format("k {} {:g} of its range, or its end, fails", has_weight(-1.0) ? '+' : '-',
                       terms.delta);
  }
  if (has_weight(0.0)) {
    text +=
        fmt::format(", also with a free value {:g} decades{} to either side", terms.neighbourhood,
                    std::ranges::count(terms.variables, false, &TunedVariable::is_logarithmic) > 0
                        ? ", or parts of a linear range,"
                        : "");
  }
  return text;
}

std::vector<std::vector<double>> scan_below(const CertificateTerms& terms) {
  std::vector<std::vector<double>> points;
  const TuningProblem problem{terms.variables, {}, {}};
  for (const std::vector<double>& x : terms.scan) {
    if (terms.response || compute_objective(problem, x, {}) < terms.objective) points.push_back(x);
  }
  return points;
}

void judge_claim(const CertificateTerms& terms, const std::vector<Observation>& evidence,
                 Claim& claim) {
  Finding finding{Verdict::inconclusive, "no such claim"};
  if (claim.name == "C0") {
    finding = judge_feasible(terms, evidence);
  } else if (claim.name == "C1") {
    finding = judge_minimal(terms, evidence);
  } else if (claim.name == "C2") {
    finding = judge_scan(terms, evidence);
  } else if (claim.name == "C3") {
    finding = judge_neighbourhood(terms, evidence);
  } else if (claim.name == "C4") {
    finding = judge_proof(terms, evidence);
  }
  claim.verdict = finding.verdict;
  claim.reason = finding.reason;
}

}  // namespace linkstudy::tuning
