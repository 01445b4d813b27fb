// Fingerprints of a study. Two runs of one input agree in results_digest exactly when they computed
// the same bits: the digest covers ids, inputs, status, outputs, parent and message of every
// evaluation, and leaves out what may differ between such runs: wall time, rank, host, attempts and
// the order of arrival. All NaN count as one.
#pragma once

#include <string>
#include <vector>

#include "study/record/evaluation.h"

namespace linkstudy {

// One evaluation per id in ascending order; of several with one id (a transient failure that was
// tried again) the last counts.
std::vector<Evaluation> latest_by_id(std::vector<Evaluation> evaluations);

// SHA-256, 64 hexadecimal digits. Responses that an evaluation lacks at its end count as NaN.
std::string results_digest(const std::vector<Parameter>& parameters,
                           const std::vector<Response>& responses,
                           const std::vector<Evaluation>& evaluations);

// SHA-256 over texts and where one ends and the next begins: the identity of a study's input.
std::string input_sha256(const std::vector<std::string>& texts);

}  // namespace linkstudy
