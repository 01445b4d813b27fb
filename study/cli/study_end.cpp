#include "study/cli/study_end.h"

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
  fmt::print(stderr, "{}", message);
  if (end.code == exit_resumable) {
    fmt::print(stderr, "linkstudy: interrupted; the same command continues\n");
  }
  const bool is_partial = end.code == exit_resumable;
  end.digest = session.record().write(is_partial ? RunStatus::interrupted : RunStatus::complete);
  session.log().info("{}, results digest {}", end.status, end.digest);
  return end;
}

}  // namespace linkstudy
