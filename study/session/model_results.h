// Analyses of one model, statics and kinematics, as results like those of a study: one evaluation
// whose responses are the numbers found, the positions of a course as its histories, and an answer
// of tables and the object of --json. They are made again from what the results hold of the model.
#pragma once

#include <memory>
#include <optional>

#include "core/dynamics/modes.h"
#include "core/simulation/prepare.h"
#include "study/config/model_document.h"
#include "study/evaluate/equilibrium.h"
#include "study/kinematics/result.h"
#include "study/record/findings.h"
#include "study/session/options.h"
#include "study/store/results.h"

namespace linkstudy {

struct StaticsAnalysis {
  ModelInput input;                     // as statics takes it
  std::vector<std::string> made_ideal;  // closures with clearance
  Preparation preparation;
  std::vector<StaticValue> values;  // empty where there is no equilibrium
  std::vector<Mode> modes;          // about it
  double wall_s = 0.0;
};
StaticsAnalysis analyse_statics(ModelInput input);

struct KinematicsAnalysis {
  ModelInput input;
  std::unique_ptr<const Model> closed;  // `result` refers to it
  KinematicsResult result;
  double wall_s = 0.0;
};
KinematicsAnalysis analyse_course(ModelInput input, const CourseRequest& request);

struct ModelResults {
  AnswerKind kind = AnswerKind::statics;
  std::vector<Response> responses;
  Evaluation evaluation;
  std::string json;           // without what differs from run to run
  std::vector<Table> tables;  // "findings" and others
};
ModelResults results_of(const StaticsAnalysis& analysis);
ModelResults results_of(const KinematicsAnalysis& analysis);

// What --drive and its companions say as text, and back; empty where they say nothing.
std::string course_text(const CourseRequest& request);
CourseRequest read_course(const std::string& text);

// Writes the results directory of options.output and returns the results digest. What it holds of
// the same input already is kept. Throws StoreError where that is something else.
std::string keep_results(const SessionOptions& options, const ModelDocument& document,
                         const ModelInput& input, const std::string& course, ModelResults results);

// statics or kinematics, where these are results of them.
std::optional<AnswerKind> analysed_kind(const StudyResults& results);

// The analysis again. Throws StoreError and InputError.
StaticsAnalysis statics_again(const StudyResults& results);
KinematicsAnalysis course_again(const StudyResults& results);

}  // namespace linkstudy
