// The rules by which a claim of a certificate is judged, from its evaluations alone.
#pragma once

#include "study/tune/certificate.h"

namespace linkstudy::tuning {

// The points about k* that C1 takes along variable i, and all of them; those of a value that the
// objective wants smaller or larger may lie outside its range.
std::vector<std::vector<double>> points_about(const CertificateTerms& terms, std::size_t i);
std::vector<std::vector<double>> points_about(const CertificateTerms& terms);
bool is_in_range(const CertificateTerms& terms, const std::vector<double>& x);
std::string minimality_statement(const CertificateTerms& terms);

// Points of the declared scan with a smaller objective than k*; all where that is a response.
std::vector<std::vector<double>> scan_below(const CertificateTerms& terms);

// Sets verdict and reason of the claim by its name.
void judge_claim(const CertificateTerms& terms, const std::vector<Observation>& evidence,
                 Claim& claim);

}  // namespace linkstudy::tuning
