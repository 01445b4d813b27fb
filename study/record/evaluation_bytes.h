// The parts of evaluations in the byte encoding of study/record/bytes.h: the journal keeps them,
// ranks send them to each other. (The digest has an encoding of its own, with one NaN.)
// Reading throws std::out_of_range where the bytes are none of these.
#pragma once

#include "study/record/bytes.h"
#include "study/record/evaluation.h"

namespace linkstudy {

void put_numbers(ByteWriter& out, const std::vector<double>& numbers);
std::vector<double> get_numbers(ByteReader& in);

void put_point(ByteWriter& out, const Point& point);
Point get_point(ByteReader& in);

void put_cause(ByteWriter& out, Cause cause);
Cause get_cause(ByteReader& in);

void put_traces(ByteWriter& out, const std::vector<Trace>& traces);
std::vector<Trace> get_traces(ByteReader& in);

}  // namespace linkstudy
