// What a study is made of: evaluations. An evaluation is one point of the parameter space with an
// id (its position in the declared design) and, once run, one value per response or a cause. Each
// record states its members once, for its bytes (bytes.h).
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "core/simulation/cause.h"
#include "study/record/bytes.h"
#include "study/record/table.h"

namespace linkstudy {

// A varied key: numbers in SI units, or words ("cut", "sde").
using Value = std::variant<double, std::string>;

template <class Archive, Like<Value> Item>
void visit_members(Archive& archive, Item& value) {
  std::uint8_t is_number = std::holds_alternative<double>(value) ? 1 : 0;
  archive(is_number);
  if constexpr (!std::is_const_v<Item>) value = is_number != 0 ? Value(0.0) : Value(std::string());
  std::visit([&](auto& held) { archive(held); }, value);
}

// The words of causes by number.
std::vector<std::string> cause_words();

struct Parameter {
  std::string path;       // "closure.S.sde.stiffness"
  std::string unit;       // "N/m"; "" for words and pure numbers
  std::string long_name;  // meaning, from the key reference
};

void visit_members(auto& archive, Like<Parameter> auto& parameter) {
  archive(parameter.path, parameter.unit, parameter.long_name);
}

struct Response {
  std::string name;  // "error_max_closure_S_force_x"; of statics a channel, "closure.S.force.x"
  std::string unit;
  std::string long_name;
};

void visit_members(auto& archive, Like<Response> auto& response) {
  archive(response.name, response.unit, response.long_name);
}

struct Point {
  std::uint64_t id = 0;
  std::vector<Value> values;  // one per Parameter
};

void visit_members(auto& archive, Like<Point> auto& point) {
  archive(point.id, point.values);
}

// One time history asked for: columns share the time axis of the run. Or one number of it.
struct Trace {
  std::string name;  // channel, "closure.S.force.x"
  std::string unit;
  std::vector<double> values;
};

void visit_members(auto& archive, Like<Trace> auto& trace) {
  archive(trace.name, trace.unit, trace.values);
}

// Time histories of one load case; the name is empty when there are no load cases.
struct CaseTraces {
  std::string load_case;
  std::vector<Trace> traces;
};

void visit_members(auto& archive, Like<CaseTraces> auto& set) {
  archive(set.load_case, set.traces);
}

// A table of one run in a load case.
struct CaseTable {
  std::string load_case;
  Table table;
};

void visit_members(auto& archive, Like<CaseTable> auto& one) {
  archive(one.load_case, one.table);
}

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
  // Stored apart, as trace sets. Of one value each: what the input says in other terms (damping in
  // N s/m where it gives a ratio), with the load case in front where there are several.
  std::vector<Trace> derived;
  std::vector<double> residuals;  // of a calibration, against what was measured
  std::vector<CaseTraces> traces;
  std::vector<CaseTable> contacts;  // of runs whose histories are kept
  // Of model and start; said by rank 0 and not stored.
  std::vector<std::string> warnings;
};

void visit_members(auto& archive, Like<Evaluation> auto& evaluation) {
  archive(evaluation.point);
  archive.template as<std::uint8_t>(evaluation.status, kWords<Cause>.size());
  archive(evaluation.message, evaluation.responses, evaluation.attempts, evaluation.parent,
          evaluation.wall_s, evaluation.rank, evaluation.host);
}

// An evaluation with all that is stored apart, as ranks send it to each other.
struct WholeEvaluation {
  Evaluation evaluation;
};

void visit_members(auto& archive, Like<WholeEvaluation> auto& whole) {
  archive(whole.evaluation, whole.evaluation.derived, whole.evaluation.residuals,
          whole.evaluation.traces, whole.evaluation.contacts, whole.evaluation.warnings);
}

}  // namespace linkstudy
