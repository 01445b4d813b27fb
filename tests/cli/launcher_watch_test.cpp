#include "tests/cli/launcher_watch.h"

#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "tests/cli/program.h"

namespace linkstudy::testing::launcher_watch_test {
namespace {

using std::chrono::milliseconds;

class Watch : public Program {
 protected:
  // A process named mpirun that never ends, nor sees to its ranks: one that has ended, and perhaps
  // one that goes on.
  pid_t launch(bool goes_on) const {
    const pid_t launcher = fork();
    if (launcher != 0) return launcher;
    prctl(PR_SET_NAME, "mpirun");
    if (chdir(path("").c_str()) != 0) _exit(99);
    if (goes_on && fork() == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      for (;;) pause();
    }
    if (fork() == 0) _exit(0);
    for (;;) pause();
  }
};

TEST_F(Watch, Ends_a_launcher_that_outlives_its_ranks) {
  const pid_t launcher = launch(false);
  const LauncherWatch watch(path(""), milliseconds(300));
  int status = 0;
  ASSERT_EQ(waitpid(launcher, &status, 0), launcher);
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), SIGKILL);
}

TEST_F(Watch, Lets_one_be_that_has_a_rank) {
  const pid_t busy = launch(true);
  const LauncherWatch watch(path(""), milliseconds(0));
  std::this_thread::sleep_for(milliseconds(1000));
  EXPECT_EQ(waitpid(busy, nullptr, WNOHANG), 0);
  kill(busy, SIGKILL);
  waitpid(busy, nullptr, 0);
}

TEST_F(Watch, Lets_one_be_that_works_elsewhere) {
  const pid_t other = launch(false);
  std::filesystem::create_directory(path("elsewhere"));
  const LauncherWatch watch(path("elsewhere"), milliseconds(0));
  std::this_thread::sleep_for(milliseconds(1000));
  EXPECT_EQ(waitpid(other, nullptr, WNOHANG), 0);
  kill(other, SIGKILL);
  waitpid(other, nullptr, 0);
}

}  // namespace
}  // namespace linkstudy::testing::launcher_watch_test
