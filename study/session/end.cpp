#include "study/session/end.h"

#include <fmt/format.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "study/report/console.h"
#include "study/session/exit_code.h"

namespace linkstudy {

std::string to_json(const StudyEnd& end, const StudyRecord& record,
                    const std::string& sensitivity) {
  nlohmann::ordered_json failed = nlohmann::ordered_json::object();
  for (const auto& [cause, count] : record.failures()) failed[std::string(name_of(cause))] = count;
  nlohmann::ordered_json json = {{"status", end.status},
                                 {"evaluations", record.evaluations().size()},
                                 {"done", record.evaluations().size() - record.failure_count()},
                                 {"failed", failed},
                                 {"digest", end.digest},
                                 {"results", record.results_path().string()}};
  if (!sensitivity.empty()) json["sensitivity"] = nlohmann::ordered_json::parse(sensitivity);
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

StudyEnd end_study(StudySession& session, const std::function<void()>& work) {
  StudyEnd end{kDone, "complete", ""};
  std::string message;
  try {
    work();
  } catch (const Interrupted&) {
    end.code = kExitResumable;
    end.status = "interrupted";
  } catch (const TooManyFailures& reason) {
    end.code = kTooManyFailed;
    end.status = "failed";
    message = fmt::format("linkstudy: error: {}\n", reason.what());
  }
  session.finish_progress();
  session.say_known();
  print_err(message);
  if (end.code == kExitResumable) {
    fmt::print(stderr, "linkstudy: interrupted; the same command continues\n");
  }
  // Ended by failures with evaluations left is no complete study either.
  const bool is_partial = end.code != kDone && !session.is_exhausted();
  end.digest = session.record().write(is_partial ? RunStatus::interrupted : RunStatus::complete);
  session.log().info("{}, results digest {}", end.status, end.digest);
  return end;
}

}  // namespace linkstudy
