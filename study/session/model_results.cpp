#include "study/session/model_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "study/config/input_error.h"
#include "study/config/toml_reader.h"
#include "study/config/toml_writer.h"
#include "study/kinematics/file.h"
#include "study/kinematics/report.h"
#include "study/kinematics/table.h"
#include "study/record/bytes.h"
#include "study/report/model_report.h"
#include "study/report/modes_report.h"
#include "study/session/identity.h"
#include "study/session/study_record.h"
#include "study/store/store_error.h"

namespace linkstudy {
namespace {

using Clock = std::chrono::steady_clock;

double elapsed_s(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

void add_numbers(const std::vector<FoundNumber>& numbers, ModelResults& results) {
  for (const FoundNumber& number : numbers) {
    results.responses.push_back(number.response);
    results.evaluation.responses.push_back(number.value);
  }
}

// A table of numbers, its first column the time.
std::vector<Trace> traces_of(const Table& table) {
  std::vector<Trace> traces;
  for (const Column& column : table.columns) {
    traces.push_back({column.name, column.unit, std::get<std::vector<double>>(column.values)});
  }
  return traces;
}

std::string without_wall_time(const std::string& json) {
  nlohmann::ordered_json object = nlohmann::ordered_json::parse(json);
  object.erase("wall_s");
  return object.dump();
}

ModelInput stored_model(const StudyResults& results) {
  const AnalysedTexts texts = analysed_texts(results);
  Diagnostics diagnostics;
  const auto document =
      ModelDocument::parse(texts.model, "the model that these results hold", diagnostics);
  throw_if_any(diagnostics);
  std::optional<ModelInput> input = document->with({}, diagnostics);
  throw_if_any(diagnostics);
  return std::move(*input);
}

// The matrix equations of loops are over the coordinates of the joint that closes them.
void refuse_rods(const ModelInput& input) {
  Diagnostics diagnostics;
  for (const Closure& closure : input.linkage.closures) {
    if (closure.type != JointType::rod) continue;
    diagnostics.add(locate(input.resolved, "closure." + closure.name + ".type"),
                    fmt::format("closure '{}': kinematics does not know a rod", closure.name),
                    "give a link between two spherical joints, one of them the closure");
  }
  throw_if_any(diagnostics);
}

}  // namespace

StaticsAnalysis analyse_statics(ModelInput input) {
  const auto begin = Clock::now();
  StaticsAnalysis analysis;
  analysis.made_ideal = take_statics(input);
  analysis.preparation = prepare(input.linkage, input.options);
  if (analysis.preparation.cause == Cause::ok) {
    analysis.values = equilibrium_values(analysis.preparation, input.options);
    analysis.modes = compute_modes(analysis.preparation.model, analysis.preparation.model.start);
  }
  analysis.input = std::move(input);
  analysis.wall_s = elapsed_s(begin);
  return analysis;
}

KinematicsAnalysis analyse_course(ModelInput input, const CourseRequest& request) {
  refuse_rods(input);
  const auto begin = Clock::now();
  KinematicsAnalysis analysis;
  analysis.closed = std::make_unique<const Model>(compile_closed(input.rigid));
  if (input.kinematics.drives.empty()) {
    for (const Motion& motion : input.linkage.motions) {
      DriveCourse& course = input.kinematics.drives.emplace_back();
      course.joint = motion.joint;
      course.coordinate = motion.coordinate;
      course.motion = motion;
    }
  }
  analysis.result = analyse_kinematics(request, input.kinematics, *analysis.closed);
  analysis.input = std::move(input);
  analysis.wall_s = elapsed_s(begin);
  return analysis;
}

ModelResults results_of(const StaticsAnalysis& analysis) {
  const Preparation& preparation = analysis.preparation;
  ModelResults results;
  results.kind = AnswerKind::statics;
  results.evaluation.status = preparation.cause;
  results.evaluation.message = preparation.message;
  results.evaluation.wall_s = analysis.wall_s;
  add_numbers(statics_numbers(preparation, analysis.values), results);
  std::vector<Finding> findings = preparation_findings(preparation, analysis.input.options);
  for (const std::string& warning : preparation.warnings) findings.push_back({"warning", warning});
  for (const std::string& closure : analysis.made_ideal) {
    findings.push_back({"note", fmt::format("closure '{}' is taken as an ideal joint", closure)});
  }
  results.tables.push_back(findings_table(findings));
  if (!analysis.values.empty()) results.tables.push_back(equilibrium_table(analysis.values));
  if (!analysis.modes.empty()) {
    results.tables.push_back(modes_table(preparation.model.mechanism, analysis.modes));
  }
  results.json = without_wall_time(statics_json(preparation, analysis.values, analysis.modes, 0.0));
  return results;
}

ModelResults results_of(const KinematicsAnalysis& analysis) {
  const KinematicsResult& found = analysis.result;
  ModelResults results;
  results.kind = AnswerKind::kinematics;
  results.evaluation.wall_s = analysis.wall_s;
  results.evaluation.message = blocked_text(found);
  if (!is_followed(found)) {
    results.evaluation.status =
        found.assembly.closed ? Cause::course_blocked : Cause::assembly_failed;
  }
  add_numbers(kinematics_numbers(found), results);
  if (found.driven) {
    results.evaluation.traces.push_back({"", traces_of(kinematics_table(*analysis.closed, found))});
  }
  results.tables = kinematics_tables(analysis.input, *analysis.closed, found);
  results.tables.push_back(findings_table(kinematics_findings(found)));
  results.json = kinematics_json(found);
  return results;
}

std::string course_text(const CourseRequest& request) {
  Tree course = Tree::make_table();
  if (!request.drives.empty()) {
    Tree drives = Tree::make_array();
    for (const std::string& drive : request.drives) drives.items.push_back(Tree::make_text(drive));
    course.set("drive", std::move(drives));
  }
  const auto add = [&](const char* key, const std::optional<std::string>& text) {
    if (text) course.set(key, Tree::make_text(*text));
  };
  add("from", request.from);
  add("to", request.to);
  add("speed", request.speed);
  if (request.positions) course.set("positions", Tree::make_integer(*request.positions));
  return course.items.empty() ? "" : write_toml(course);
}

CourseRequest read_course(const std::string& text) {
  CourseRequest request;
  if (text.empty()) return request;
  Diagnostics diagnostics;
  const std::optional<Tree> course =
      parse_toml(text, "the course that these results hold", diagnostics);
  throw_if_any(diagnostics);
  if (const Tree* drives = course->find("drive")) {
    for (const Tree& drive : drives->items) request.drives.push_back(drive.text);
  }
  const auto read = [&](const char* key) {
    const Tree* found = course->find(key);
    return found == nullptr ? std::nullopt : std::optional(found->text);
  };
  request.from = read("from");
  request.to = read("to");
  request.speed = read("speed");
  if (const Tree* positions = course->find("positions")) {
    request.positions = static_cast<int>(positions->integer);
  }
  return request;
}

std::string keep_results(const SessionOptions& options, const ModelDocument& document,
                         const ModelInput& input, const std::string& course, ModelResults results) {
  const std::string kind(name_of(results.kind));
  StudyRecord record(*options.output,
                     make_model_identity(options, kind, document, input, course, results.responses),
                     options.fresh);
  const auto stored = record.evaluations().find(0);
  if (stored != record.evaluations().end()) {
    const Evaluation& found = results.evaluation;
    const bool is_same = stored->second.status == found.status &&
                         to_bytes(stored->second.responses) == to_bytes(found.responses);
    if (!is_same) {
      throw StoreError(fmt::format(
          "{}: holds other results of the same input, of another program or machine; choose "
          "another directory with -o or overwrite them with --fresh",
          record.directory().string()));
    }
  } else {
    results.evaluation.host = record.results().provenance.back().host;
    record.add(std::move(results.evaluation));
  }
  if (record.results().answers.empty()) {
    record.set_answer(results.kind, results.json, std::move(results.tables));
  }
  return record.write(RunStatus::complete);
}

std::optional<AnswerKind> analysed_kind(const StudyResults& results) {
  const std::optional<AnswerKind> kind = find_word<AnswerKind>(results.description.kind);
  const bool is_analysis = kind == AnswerKind::statics || kind == AnswerKind::kinematics;
  return is_analysis ? kind : std::nullopt;
}

StaticsAnalysis statics_again(const StudyResults& results) {
  return analyse_statics(stored_model(results));
}

KinematicsAnalysis course_again(const StudyResults& results) {
  return analyse_course(stored_model(results), read_course(analysed_texts(results).course));
}

}  // namespace linkstudy
