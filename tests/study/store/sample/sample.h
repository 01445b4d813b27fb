// A small study with everything in it that a results file must carry.
#pragma once

#include <cmath>
#include <limits>
#include <string>

#include "study/store/results.h"

namespace linkstudy::sample {

inline const std::string kInputSha256(64, 'a');

inline StudyDescription description() {
  return {"stiffness of S",
          "study",
          18446744073709551615u,
          {{"closure.S.sde.stiffness", "N/m", "stiffness of the spring"},
           {"closure.S.model", "", "how the loop is closed"},
           {"load.drive.course.value", "N m", "size of the drive"}},
          {{"error_max_closure_S_force_x", "", "largest relative error"},
           {"gap_max_closure_S", "m", "largest gap"}}};
}

inline Evaluation evaluation(std::uint64_t id) {
  const double x = static_cast<double>(id) + 0.1;
  Evaluation evaluation;
  evaluation.point = {id, {1e4 * x, std::string(id % 2 == 0 ? "sde" : "cut"), -x}};
  evaluation.responses = {1.0 / x, std::sqrt(x)};
  evaluation.wall_s = 0.01 * x;
  evaluation.rank = static_cast<std::int32_t>(id % 3);
  evaluation.host = "n1";
  if (id % 2 == 0) evaluation.derived = {{"closure.S.sde.damping", "N s/m", {10.0 * x}}};
  return evaluation;
}

// An evaluation that ended badly: NaN and its cause.
inline Evaluation failed_evaluation(std::uint64_t id) {
  Evaluation failed = evaluation(id);
  failed.status = Cause::diverged;
  failed.message = "state is not finite at t = 0.25 s, \u03c9 h = 3.1";
  failed.responses.assign(2, std::numeric_limits<double>::quiet_NaN());
  failed.attempts = 2;
  failed.parent = 1;
  return failed;
}

inline TraceSet traces(const std::string& name, std::int64_t evaluation, std::size_t samples) {
  TraceSet set{name, evaluation, {{"time", "s", {}}, {"closure.S.force.x", "N", {}}}};
  for (std::size_t i = 0; i < samples; ++i) {
    const double t = 0.01 * static_cast<double>(i);
    set.traces[0].values.push_back(t);
    set.traces[1].values.push_back(std::sin(t));
  }
  return set;
}

inline Table tuning() {
  Table scan{"scan",
             {{"closure.S.sde.stiffness",
               "N/m",
               "stiffness",
               "parameter",
               std::vector<double>{1e4, 1e5, 1e6},
               {}},
              {"error.closure.S.force",
               "",
               "error over tolerance",
               "error",
               std::vector<double>{4.0, 0.4, std::numeric_limits<double>::infinity()},
               {}},
              {"side",
               "",
               "side of failure",
               "side",
               std::vector<std::uint8_t>{1, 0, 2},
               {"feasible", "too_soft", "step_too_coarse"}}},
             {},
             {}};
  return {"S",
          {},
          {{"C0", std::string("feasible at 2.5e4 N/m and at half the step")},
           {"low", 2.5e4},
           {"evaluations", std::int64_t{17}}},
          {scan}};
}

inline StudyResults results() {
  StudyResults results;
  results.description = description();
  results.status = RunStatus::complete;
  results.program_version = "0.1.0";
  results.git_revision = "05ba0c3";
  results.input_sha256 = kInputSha256;
  results.evaluations = {evaluation(0), evaluation(1), failed_evaluation(2), evaluation(3)};
  results.references = {traces("reference", -1, 1501)};
  results.traces = {traces("evaluation_3", 3, 20)};
  results.answers = {{AnswerKind::tuning, tuning()}};
  results.provenance = {
      {"start", 1.7e9 + 0.25, 4, 3, "n1", "0.1.0", "05ba0c3", "linkstudy study", "avx2", 4},
      {"resume", 1.7e9 + 60, 4, 2, "n2", "0.1.0", "05ba0c3", "linkstudy study", "avx512", 8, "12_3",
       1}};
  results.texts = {{"input_text", "format = 1\nname = \"\u00e4\"\n"}, {"machine", "x86_64"}};
  return results;
}

}  // namespace linkstudy::sample
