#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "study/cli/answer.h"
#include "study/cli/verb_table.h"
#include "study/queue/drain.h"
#include "study/queue/queue_status.h"
#include "study/report/console.h"
#include "study/report/write_table.h"
#include "study/session/exit_code.h"
#include "study/session/identity.h"
#include "study/session/study_points.h"

namespace linkstudy {
namespace {

// The command line of an entry by itself.
CommandLine line_of(const CommandLine& line, const queue::Entry& entry, int groups) {
  CommandLine own = line;
  own.inputs = {entry.file.string()};
  own.output = entry.results.string();
  own.is_part = true;
  if (groups > 1) own.progress = "none";
  return own;
}

std::string identify(const CommandLine& line, const StudyInput& input, Transport& ranks) {
  Diagnostics diagnostics;
  const auto evaluator = make_evaluator(input, diagnostics);
  throw_if_any(diagnostics);
  return make_identity(line, *evaluator, 0, ranks).input_sha256;
}

int run_entry(const CommandLine& line, const RunDeadline& deadline, Transport& ranks,
              const queue::OnEnd& end) {
  const auto work = [&](StudySession& session) {
    const FileKind kind = session.evaluator().input().kind;
    const VerbEnd answer = answer_work(kind)(session, false);
    end({answer.code, answer.verdict});
    return answer.code;
  };
  return run_session(
      ranks, deadline, line, [&] { return read_study_input(line); }, work);
}

// Drains the folder with the ranks of one group.
int drain(const CommandLine& line, const RunDeadline& deadline, Transport& all) {
  const int size = std::min(line.group.value_or(all.size()), all.size());
  const int groups = (all.size() + size - 1) / size;
  const int group = all.rank() / size;
  const auto ranks = all.split(group);
  if (all.rank() == 0) {
    print_err(fmt::format("{}{}\n", ranks_text(all),
                          groups > 1 ? fmt::format(", {} groups of {}", groups, size) : ""));
  }
  const std::string name = groups > 1 ? fmt::format("group {}", group) : "";
  return queue::drain(
      *ranks, {line.inputs.front(), deadline, line.wait_s, line.retry_failed, name},
      {[&](const queue::Entry& entry) { return read_study_input(line_of(line, entry, groups)); },
       [&](const StudyInput& input, Transport& own) { return identify(line, input, own); },
       [&](const queue::Entry& entry, Transport& own, const queue::OnEnd& end) {
         return run_entry(line_of(line, entry, groups), deadline, own, end);
       }});
}

void print_end(const CommandLine& line) {
  queue::Folder folder(line.inputs.front());
  const auto entries = queue::read_status(folder);
  print_out(line.json ? queue::status_json(entries) : queue::status_text(entries, output_width()));
}

}  // namespace

int run_queue(const CommandLine& line) {
  const auto start = std::chrono::steady_clock::now();
  return run_on_ranks([&](Transport& all) {
    const auto find_folder = [&] {
      queue::Folder folder(line.inputs.front());
      return kDone;
    };
    int code = pass_gate(all, find_folder);
    if (code != kDone) return code;
    const RunDeadline deadline =
        find_deadline(line.walltime_s, find_batch_job(read_environment), start);
    code = all.agree_exit_code(drain(line, deadline, all));
    if (all.rank() == 0) print_end(line);
    return code;
  });
}

}  // namespace linkstudy
