#include "study/cli/study_end.h"
#include "study/cli/output.h"

#include <fmt/format.h>

#include <cstdio>

#include "study/cli/exit_code.h"

namespace linkstudy {

StudyEnd end_study(StudySession& session, const std::function<void()>& work) {
  StudyEnd end{kDone, "complete", ""};
  std::string message;
  try {
    work();
  } catch (const Interrupted&) {
    end.code = exit_resumable;
    end.status = "interrupted";
  } catch (const TooManyFailures& reason) {
    end.code = kTooManyFailed;
    end.status = "failed";
    message = fmt::format("linkstudy: error: {}\n", reason.what());
  }
  session.finish_progress();
  print_err(message);
  if (end.code == exit_resumable) {
    fmt::print(stderr, "linkstudy: interrupted; the same command continues\n");
  }
  // Ended by failures with evaluations left is no complete study either.
  const bool is_partial = end.code != kDone && !session.is_exhausted();
  end.digest = session.record().write(is_partial ? RunStatus::interrupted : RunStatus::complete);
  session.log().info("{}, results digest {}", end.status, end.digest);
  return end;
}

}  // namespace linkstudy
