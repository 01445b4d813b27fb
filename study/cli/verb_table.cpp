#include "study/cli/verb_table.h"

#include <fmt/format.h>

#include <string_view>

#include "core/topology/nearest_name.h"

namespace linkstudy {
namespace {

constexpr std::size_t kMany = 1000000;

using Names = std::vector<std::string>;

Names joined(Names first, const Names& more) {
  first.insert(first.end(), more.begin(), more.end());
  return first;
}

Names run_options(const Names& own = {}) {
  return joined(joined({"output,o", "set,s", "seed"}, own),
                {"on-failure", "max-failures", "timeout", "walltime", "fresh", "retry-failed",
                 "extend", "cache", "progress", "log-level", "json"});
}

Names verb_names() {
  Names names;
  for (const VerbRow& verb : verb_rows()) names.emplace_back(verb.name);
  return names;
}

// Of a file, and of one model.
std::vector<VerbRow> model_verbs() {
  return {
      {"init",
       "KIND",
       1,
       1,
       "writes a commented input to start from: model, study, tune or converge",
       {"output,o", "slurm", "fresh"},
       run_init},
      {"check",
       "FILE...",
       1,
       kMany,
       "validates files; lists all problems in one pass",
       {"json"},
       run_check},
      {"describe",
       "[PATH | channels [MODEL] | units]",
       0,
       2,
       "prints the reference of the keys, of the channels of a model, or of units",
       {"markdown", "man", "completion"},
       run_describe},
      {"simulate",
       "MODEL",
       1,
       1,
       "runs a model once: statics if asked, then time histories",
       {"output,o", "fresh", "set,s", "timeout", "csv", "signals", "write-start", "progress",
        "json"},
       run_simulate},
      {"statics",
       "MODEL",
       1,
       1,
       "finds the static equilibrium and the closure forces there",
       {"output,o", "fresh", "set,s", "modes", "write-start", "json"},
       run_statics},
      {"kinematics",
       "MODEL",
       1,
       1,
       "finds mobility, redundant joints, and the motion over a driven cycle",
       {"output,o", "fresh", "set,s", "drive", "from", "to", "positions", "speed", "csv", "h5",
        "json"},
       run_kinematics},
  };
}

// Of what takes many runs, and of its results.
std::vector<VerbRow> study_verbs() {
  return {
      {"plan",
       "FILE",
       1,
       1,
       "tells what a file will evaluate, and what that takes; runs nothing to its end",
       {"csv", "ranks", "probe", "set,s", "seed", "batch", "json"},
       run_plan},
      {"study", "FILE", 1, 1, "runs a parameter study; starts or continues", run_options(),
       run_study, true},
      {"tune", "FILE", 1, 1, "finds the lowest value that matches the reference",
       run_options({"batch"}), run_tune, true},
      {"calibrate", "FILE", 1, 1, "finds the values with which the model fits measured data best",
       run_options(), run_calibrate, true},
      {"converge", "FILE", 1, 1, "refines, and tells orders of convergence and errors",
       run_options(), run_converge, true},
      {"queue",
       "FOLDER",
       1,
       1,
       "runs the study, tune, calibrate and converge files of a folder, and further ones that come",
       {"group", "wait", "on-failure", "max-failures", "timeout", "walltime", "retry-failed",
        "extend", "cache", "progress", "log-level", "json"},
       run_queue,
       true},
      {"verify",
       "DIR|FILE.h5",
       1,
       1,
       "runs evaluations of results again, compares bits, and judges their answer anew",
       {"all", "count", "json"},
       run_verify},
      {"status",
       "DIR|FOLDER",
       1,
       1,
       "tells how far a study or a queue is, running or dead",
       {"watch", "json"},
       run_status},
      {"export",
       "DIR|FILE.h5",
       1,
       1,
       "prints tables of the results of a directory, or of its results.h5",
       {"list", "table", "columns", "rows", "traces", "figure", "format", "output,o"},
       run_export},
      {"report",
       "DIR|FILE.h5",
       1,
       1,
       "writes one offline HTML page: verdict, charts, tables and the moving mechanism",
       {"output,o", "evaluation", "timeout"},
       run_report},
  };
}

}  // namespace

const std::vector<VerbRow>& verb_rows() {
  static const std::vector<VerbRow> rows = [] {
    std::vector<VerbRow> all = model_verbs();
    const std::vector<VerbRow> more = study_verbs();
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }();
  return rows;
}

const VerbRow& find_verb(const std::string& name) {
  for (const VerbRow& verb : verb_rows())
    if (name == verb.name) return verb;
  throw UsageError(
      fmt::format("there is no verb '{}'; {}", name, suggest_name(name, verb_names())));
}

}  // namespace linkstudy
