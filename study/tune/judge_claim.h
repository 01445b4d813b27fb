// The rules by which a claim of a certificate is judged, from its evaluations alone.
#pragma once

#include "study/tune/certificate.h"

namespace linkstudy::tuning {

// k* with variable i reduced to k_i (1 - delta).
std::vector<double> reduced_point(const CertificateTerms& terms, std::size_t i);

// Points of the declared scan with a smaller objective than k*.
std::vector<std::vector<double>> scan_below(const CertificateTerms& terms);

// Sets verdict and reason of the claim by its name.
void judge_claim(const CertificateTerms& terms, const std::vector<Observation>& evidence,
                 Claim& claim);

}  // namespace linkstudy::tuning
