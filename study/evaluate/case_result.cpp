#include "study/evaluate/case_result.h"

#include "study/record/evaluation_bytes.h"

namespace linkstudy {
namespace {

void put_result(ByteWriter& out, const CaseResult& result) {
  put_cause(out, result.status);
  out.put_text(result.message);
  put_numbers(out, result.responses);
  out.put_u64(result.traces.size());
  for (const CaseTraces& set : result.traces) {
    out.put_text(set.load_case);
    put_traces(out, set.traces);
  }
  out.put_u32(result.attempts);
  out.put_text(result.host);
}

CaseResult get_result(ByteReader& in) {
  CaseResult result;
  result.status = get_cause(in);
  result.message = in.get_text();
  result.responses = get_numbers(in);
  result.traces.resize(in.get_count(1));
  for (CaseTraces& set : result.traces) {
    set.load_case = in.get_text();
    set.traces = get_traces(in);
  }
  result.attempts = in.get_u32();
  result.host = in.get_text();
  return result;
}

}  // namespace

std::string encode_points(std::span<const Point> points) {
  ByteWriter out;
  out.put_u64(points.size());
  for (const Point& point : points) put_point(out, point);
  return out.bytes();
}

std::vector<Point> decode_points(std::string_view bytes) {
  ByteReader in(bytes);
  std::vector<Point> points(in.get_count(1));
  for (Point& point : points) point = get_point(in);
  return points;
}

std::string encode_results(std::span<const CaseResult> results) {
  ByteWriter out;
  out.put_u64(results.size());
  for (const CaseResult& result : results) put_result(out, result);
  return out.bytes();
}

std::vector<CaseResult> decode_results(std::string_view bytes) {
  ByteReader in(bytes);
  std::vector<CaseResult> results(in.get_count(1));
  for (CaseResult& result : results) result = get_result(in);
  return results;
}

}  // namespace linkstudy
