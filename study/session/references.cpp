#include "study/session/references.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "core/base/isa.h"
#include "study/evaluate/form_packs.h"
#include "study/evaluate/reference_bytes.h"
#include "study/record/bytes.h"
#include "study/session/interrupted.h"
#include "study/session/warnings.h"

namespace linkstudy {
namespace {

// A reference that is longer is run again by the next start.
constexpr std::size_t kMostStoredBytes = std::size_t{1} << 30;

std::string title_of(const Evaluator& evaluator, std::size_t i) {
  const std::string& name = evaluator.load_case_name(i);
  return name.empty() ? "reference run" : fmt::format("reference run of load case '{}'", name);
}

bool take_bytes(Evaluator& evaluator, std::size_t i, const std::string& bytes,
                spdlog::logger& log) {
  try {
    evaluator.set_reference(i, decode_reference(bytes));
    return true;
  } catch (const std::out_of_range& error) {
    log.warn("{} as it is kept is not used: {}", title_of(evaluator, i), error.what());
    return false;
  }
}

void warn(const std::string& title, const std::vector<std::string>& warnings, spdlog::logger& log) {
  for (const std::string& text : warnings) say_warning(fmt::format("{}: {}", title, text), log);
}

void keep(const Evaluator& evaluator, std::size_t i, std::string bytes, StudyRecord& record,
          spdlog::logger& log) {
  if (bytes.size() > kMostStoredBytes) {
    log.warn("{} is not kept for later starts: {} MB are too long for the journal",
             title_of(evaluator, i), bytes.size() / 1000000);
    return;
  }
  record.add_reference({evaluator.load_case_name(i), std::move(bytes)});
}

// What a rank found: records, or why there are none.
struct ReferenceAnswer {
  Cause cause = Cause::ok;
  std::string message;
  std::vector<KnownReference> records;
};

void visit_members(auto& archive, Like<ReferenceAnswer> auto& answer) {
  archive.template as<std::uint8_t>(answer.cause, kWords<Cause>.size());
  archive(answer.message, answer.records);
}

// What could not be sent (over 2 GiB), or a rank had no memory for, is made here.
ReferenceAnswer answer_of(const TaskResult& result, const std::string& task, Evaluator& evaluator) {
  return from_bytes<ReferenceAnswer>(result.failed ? run_reference_task(evaluator, task)
                                                   : result.bytes);
}

}  // namespace

std::vector<std::size_t> take_references(Evaluator& evaluator, StudyRecord& record,
                                         KnownRows& known, spdlog::logger& log) {
  std::vector<std::size_t> others;
  for (std::size_t i = 0; i < evaluator.load_case_count(); ++i) {
    if (!evaluator.has_reference(i)) continue;
    const StoredReference* stored = record.reference(evaluator.load_case_name(i));
    if (stored != nullptr && take_bytes(evaluator, i, stored->bytes, log)) continue;
    std::optional<KnownReference> one = known.find_reference(i);
    if (!one || !take_bytes(evaluator, i, one->bytes, log)) {
      others.push_back(i);
      continue;
    }
    log.info("{} is taken from an earlier one", title_of(evaluator, i));
    warn(title_of(evaluator, i), one->warnings, log);
    keep(evaluator, i, std::move(one->bytes), record, log);
  }
  return others;
}

std::string run_reference_task(Evaluator& evaluator, const std::string& task) {
  ReferenceAnswer answer;
  const auto load_cases = from_bytes<std::vector<std::uint64_t>>(task);
  const std::vector<std::size_t> indices(load_cases.begin(), load_cases.end());
  try {
    evaluator.run_references(indices);
    for (const std::size_t i : indices) {
      const ReferenceRecord& run = evaluator.run_reference(i);
      answer.records.push_back({encode_reference(run), run.warnings});
    }
  } catch (const ReferenceFailure& failure) {
    answer = {failure.cause(), failure.what(), {}};
  }
  return to_bytes(answer);
}

void run_references(const std::vector<std::size_t>& load_cases, Evaluator& evaluator,
                    StudyRecord& record, KnownRows& known, Pool& pool, spdlog::logger& log) {
  const auto packs =
      split(load_cases, pack_size(load_cases.size(), simd_level().lanes, pool.ranks()));
  std::vector<std::string> tasks;
  for (const std::vector<std::size_t>& pack : packs) {
    tasks.push_back(to_bytes(std::vector<std::uint64_t>(pack.begin(), pack.end())));
  }
  std::optional<ReferenceFailure> failure;
  bool is_cancelled = false;
  const auto take = [&](const TaskResult& result) {
    const std::vector<std::size_t>& pack = packs[result.index];
    ReferenceAnswer answer = answer_of(
        result, to_bytes(std::vector<std::uint64_t>(pack.begin(), pack.end())), evaluator);
    is_cancelled |= answer.cause == Cause::cancelled;
    if (answer.cause != Cause::ok) {
      if (!failure) failure.emplace(answer.cause, answer.message);
      return pool.cancel();
    }
    for (std::size_t k = 0; k < pack.size(); ++k) {
      KnownReference& made = answer.records.at(k);
      warn(title_of(evaluator, pack[k]), made.warnings, log);
      known.keep_reference(pack[k], made);
      if (evaluator.known_reference(pack[k]) == nullptr)
        take_bytes(evaluator, pack[k], made.bytes, log);
      keep(evaluator, pack[k], std::move(made.bytes), record, log);
      log.info("{} took {:.3g} s on rank {}", title_of(evaluator, pack[k]),
               result.seconds / static_cast<double>(pack.size()), result.rank);
    }
  };
  const RunOutcome outcome = pool.run(std::move(tasks), take);
  if (outcome.interrupted() || is_cancelled) throw Interrupted();
  if (failure) throw *failure;
}

void share_references(Evaluator& evaluator, Transport& transport) {
  if (transport.size() == 1) return;
  for (std::size_t i = 0; i < evaluator.load_case_count(); ++i) {
    if (!evaluator.has_reference(i)) continue;
    const bool is_first = transport.rank() == 0;
    std::string bytes = is_first ? encode_reference(evaluator.run_reference(i)) : "";
    transport.broadcast(bytes);
    if (!is_first) evaluator.set_reference(i, decode_reference(bytes));
  }
}

}  // namespace linkstudy
