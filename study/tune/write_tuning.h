// Tuning results as text for people and as one JSON object.
#pragma once

#include <string>

#include "study/tune/tuning_result.h"

namespace linkstudy::tuning {

// Aligned lines: point, window, binding component, step, NLopt, claims, cost, and one line for
// every value of the scan and its refinement with the side it failed on.
std::string write_text(const TuningResult& result);
// Of several targets: a line for each, and what is left to say of those without a certificate.
std::string write_text(const std::vector<TuningResult>& results);

// One line; keys as fixed for `tune --json`, NaN and infinity as null.
std::string write_json(const TuningResult& result, const std::string& digest);
// Of several targets {"status": the worst, "answers": [...], "evaluations", "rounds", "digest"}.
std::string write_json(const std::vector<TuningResult>& results, const std::string& digest);

// In a few words: "certified: 812945 N/m".
std::string write_verdict(const std::vector<TuningResult>& results);

}  // namespace linkstudy::tuning
