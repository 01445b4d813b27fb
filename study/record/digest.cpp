#include "study/record/digest.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "study/record/bytes.h"
#include "study/record/sha256.h"

namespace linkstudy {
namespace {

// A tag opens every part of the stream, so that no two different contents share their bytes.
constexpr std::uint8_t kParameter = 'p', kResponse = 'r', kEvaluation = 'e', kNumber = 'n',
                       kWord = 'w';

constexpr std::uint64_t kCanonicalNan = 0x7ff8000000000000u;

void put_number(ByteWriter& out, double value) {
  out(std::isnan(value) ? kCanonicalNan : std::bit_cast<std::uint64_t>(value));
}

void put_value(ByteWriter& out, const Value& value) {
  if (const double* number = std::get_if<double>(&value)) {
    out(kNumber);
    put_number(out, *number);
  } else {
    out(kWord, std::get<std::string>(value));
  }
}

void put_responses(ByteWriter& out, const Evaluation& evaluation, std::size_t count) {
  if (evaluation.responses.size() > count) {
    throw std::invalid_argument(fmt::format("evaluation {} has {} responses, {} are declared",
                                            evaluation.point.id, evaluation.responses.size(),
                                            count));
  }
  for (double value : evaluation.responses) put_number(out, value);
  for (std::size_t i = evaluation.responses.size(); i < count; ++i) {
    put_number(out, std::numeric_limits<double>::quiet_NaN());
  }
}

void put_evaluation(ByteWriter& out, const Evaluation& evaluation, std::size_t response_count) {
  out(kEvaluation, evaluation.point.id, std::uint64_t{evaluation.point.values.size()});
  for (const Value& value : evaluation.point.values) put_value(out, value);
  out.as<std::uint8_t>(evaluation.status);
  put_responses(out, evaluation, response_count);
  out(evaluation.parent, evaluation.message);
}

}  // namespace

std::vector<Evaluation> latest_by_id(std::vector<Evaluation> evaluations) {
  const auto id = [](const Evaluation& evaluation) { return evaluation.point.id; };
  std::ranges::stable_sort(evaluations, {}, id);
  std::ranges::reverse(evaluations);
  const auto repeated = std::ranges::unique(evaluations, {}, id);
  evaluations.erase(repeated.begin(), repeated.end());
  std::ranges::reverse(evaluations);
  return evaluations;
}

std::string results_digest(const std::vector<Parameter>& parameters,
                           const std::vector<Response>& responses,
                           const std::vector<Evaluation>& evaluations) {
  ByteWriter out;
  out(std::string_view("linkstudy results 1"), std::uint64_t{parameters.size()},
      std::uint64_t{responses.size()});
  for (const Parameter& parameter : parameters) out(kParameter, parameter.path, parameter.unit);
  for (const Response& response : responses) out(kResponse, response.name, response.unit);
  Sha256 hash;
  hash.update(out.bytes());
  for (const Evaluation& evaluation : latest_by_id(evaluations)) {
    out.clear();
    put_evaluation(out, evaluation, responses.size());
    hash.update(out.bytes());
  }
  return hash.finish();
}

std::string input_sha256(const std::vector<std::string>& texts) {
  ByteWriter out;
  out(std::string_view("linkstudy input 1"), texts);
  return sha256(out.bytes());
}

}  // namespace linkstudy
