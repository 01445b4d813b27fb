// What an evaluation answers, and the bytes in which points and answers travel between ranks.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "study/record/evaluation.h"

namespace linkstudy {

// Time histories of one load case; the name is empty when there are no load cases.
struct CaseTraces {
  std::string load_case;
  std::vector<Trace> traces;
};

struct CaseResult {
  Cause status = Cause::ok;
  std::string message;
  std::vector<double> responses;
  std::vector<CaseTraces> traces;
  std::uint32_t attempts = 1;
  std::string host;
};

std::string encode_points(std::span<const Point> points);
std::vector<Point> decode_points(std::string_view bytes);

std::string encode_results(std::span<const CaseResult> results);
std::vector<CaseResult> decode_results(std::string_view bytes);

}  // namespace linkstudy
