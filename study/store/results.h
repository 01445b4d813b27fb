// All that a study leaves behind, as plain records: what results.h5 holds, what tables are made of.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/words.h"
#include "study/record/evaluation.h"
#include "study/record/table.h"

namespace linkstudy {

enum class RunStatus { running, complete, interrupted };

template <>
inline constexpr auto kWords<RunStatus> = make_words<RunStatus>({{RunStatus::running, "running"},
                                                                 {RunStatus::complete, "complete"},
                                                                 {RunStatus::interrupted,
                                                                  "interrupted"}});

// Groups of results.h5 for what a verb concludes from its evaluations.
enum class AnswerKind { tuning, calibration, convergence, statics, kinematics, sensitivity };

template <>
inline constexpr auto kWords<AnswerKind> =
    make_words<AnswerKind>({{AnswerKind::tuning, "tuning"},
                            {AnswerKind::calibration, "calibration"},
                            {AnswerKind::convergence, "convergence"},
                            {AnswerKind::statics, "statics"},
                            {AnswerKind::kinematics, "kinematics"},
                            {AnswerKind::sensitivity, "sensitivity"}});

// What was asked for; constant over all runs into one directory.
struct StudyDescription {
  std::string name;  // of the study, free text
  std::string kind;  // the verb: "study", "tune", "statics"
  std::uint64_t seed = 0;
  std::vector<Parameter> parameters;
  std::vector<Response> responses;
};

void visit_members(auto& archive, Like<StudyDescription> auto& study) {
  archive(study.name, study.kind, study.seed, study.parameters, study.responses);
}

// Time histories of one run. The trace named "time" is their axis, when there is one.
struct TraceSet {
  std::string name;              // "reference", "evaluation_12"
  std::int64_t evaluation = -1;  // id, or -1 where the run is none of the design
  std::vector<Trace> traces;
};

void visit_members(auto& archive, Like<TraceSet> auto& set) {
  archive(set.name, set.evaluation, set.traces);
}

struct NamedText {
  std::string name;
  std::string text;
};

void visit_members(auto& archive, Like<NamedText> auto& text) {
  archive(text.name, text.text);
}

// A reference run that has ended, in bytes of study/evaluate: no later start repeats it.
struct StoredReference {
  std::string name;  // of the load case, or empty
  std::string bytes;
};

void visit_members(auto& archive, Like<StoredReference> auto& reference) {
  archive(reference.name, reference.bytes);
}

// One start or resume of the program on a directory.
struct ProvenanceRow {
  std::string event;         // "start", "resume"
  double time_unix_s = 0.0;  // s since 1970-01-01 UTC
  std::uint64_t total = 0;   // evaluations in the design; of a tune the most it may take
  std::uint32_t ranks = 1;
  std::string host;
  std::string program_version;
  std::string git_revision;
  std::string command;
  std::string simd{};         // instruction set of the step loops on rank 0
  std::uint32_t lanes = 1;    // cases that run side by side there
  std::string job{};          // of the queue that started it (Slurm's job id), or empty
  std::uint32_t restart = 0;  // how often that job was requeued before
};

// As version 2 of the journal has it.
void visit_without_job(auto& archive, Like<ProvenanceRow> auto& row) {
  archive(row.event, row.time_unix_s, row.total, row.ranks, row.host, row.program_version,
          row.git_revision, row.command, row.simd, row.lanes);
}

void visit_members(auto& archive, Like<ProvenanceRow> auto& row) {
  visit_without_job(archive, row);
  archive(row.job, row.restart);
}

// What a verb concludes from its evaluations. `tables` has the study's name, the tables as parts
// and the object of --json as attribute "answer".
struct VerbAnswer {
  AnswerKind kind = AnswerKind::tuning;
  Table tables;

  bool operator==(const VerbAnswer&) const = default;
};

struct StudyResults {
  StudyDescription description;
  RunStatus status = RunStatus::running;
  std::string program_version;
  std::string git_revision;
  std::string input_sha256;
  std::string results_digest;  // set by the writer and by the reader of the file
  std::vector<Evaluation> evaluations;
  std::vector<TraceSet> references;
  std::vector<TraceSet> traces;
  std::vector<Table> contacts;  // of a run each, named as its traces; attribute "evaluation"
  std::vector<VerbAnswer> answers;
  std::vector<ProvenanceRow> provenance;
  std::vector<NamedText> texts;  // input text, resolved input, build, machine
  std::string dropped;           // what the journal has lost, in a sentence; empty: nothing
};

}  // namespace linkstudy
