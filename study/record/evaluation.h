// What a study is made of: evaluations. An evaluation is one point of the parameter space with an
// id (its position in the declared design) and, once run, one value per response or a cause.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "core/simulation/cause.h"

namespace linkstudy {

// A varied key: numbers in SI units, or words ("cut", "sde").
using Value = std::variant<double, std::string>;

struct Parameter {
  std::string path;       // "closure.S.sde.stiffness"
  std::string unit;       // "N/m"; "" for words and pure numbers
  std::string long_name;  // meaning, from the key reference
};

struct Response {
  std::string name;  // "error_max_closure_S_force_x", [A-Za-z][A-Za-z0-9_]*
  std::string unit;
  std::string long_name;
};

struct Point {
  std::uint64_t id = 0;
  std::vector<Value> values;  // one per Parameter
};

// One time history asked for: columns share the time axis of the run.
struct Trace {
  std::string name;  // channel, "closure.S.force.x"
  std::string unit;
  std::vector<double> values;
};

struct Evaluation {
  Point point;
  Cause status = Cause::ok;
  std::string message;            // one line, empty when ok
  std::vector<double> responses;  // one per Response; NaN where there is none
  std::uint32_t attempts = 1;
  std::int64_t parent = -1;  // id of the evaluation this one refines, or -1
  // Outside the digest:
  double wall_s = 0.0;
  std::int32_t rank = 0;
  std::string host;
};

}  // namespace linkstudy
