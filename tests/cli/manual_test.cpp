// What is written from the tables of verbs, options and keys: manual pages and completion.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program.h"

namespace linkstudy::testing::manual_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class Manual : public Program {
 protected:
  // What bash offers for the words of a line, the last of them unfinished.
  std::string complete(const std::string& words, int count) const {
    write("offer.sh", "source completion\nCOMP_WORDS=(linkstudy " + words + ")\nCOMP_CWORD=" +
                          std::to_string(count) + "\n_linkstudy\necho \"${COMPREPLY[*]}\"\n");
    return run_shell("bash offer.sh");
  }

  // Output of a command in the directory of the test.
  std::string run_shell(const std::string& command) const {
    return run("--version >/dev/null; " + command).out;
  }
};

TEST_F(Manual, Page_1_has_every_verb_and_every_option_that_help_lists) {
  const std::string page = run("describe --man 1").out;
  const std::string usage = run("--help").out;
  for (const char* verb : {"init", "check", "describe", "simulate", "statics", "kinematics",
                           "study", "tune", "converge", "verify", "status", "export"}) {
    EXPECT_THAT(usage, HasSubstr(std::string("  ") + verb + " "));
    EXPECT_THAT(page, HasSubstr(std::string(".SS linkstudy ") + verb + " "));
    const std::string help = run(std::string("help ") + verb).out;
    for (std::size_t at = 0; (at = help.find(" --", at)) != std::string::npos; at += 3) {
      const std::size_t end = help.find_first_of(" \n]", at + 1);
      std::string option = help.substr(at + 3, end - at - 3);
      if (option == "help") continue;
      for (std::size_t dash = 0; (dash = option.find('-', dash)) != std::string::npos; dash += 2) {
        option.insert(dash, "\\");
      }
      EXPECT_THAT(page, HasSubstr("\\-\\-" + option)) << verb;
    }
  }
}

TEST_F(Manual, Pages_have_no_line_that_roff_takes_for_an_unknown_request) {
  for (const char* section : {"1", "5"}) {
    const std::string page = run(std::string("describe --man ") + section).out;
    for (std::size_t at = 0; (at = page.find("\n.", at)) != std::string::npos; ++at) {
      const std::string request = page.substr(at + 1, page.find_first_of(" \n", at + 2) - at - 1);
      EXPECT_THAT(request,
                  ::testing::AnyOf(".TH", ".SH", ".SS", ".TP", ".B", ".BR", ".br", ".nf", ".fi"));
    }
  }
}

TEST_F(Manual, Page_5_has_the_keys_that_describe_prints) {
  const std::string page = run("describe --man 5").out;
  for (const char* key : {"link.*.mass", "closure.*.sde.stiffness", "tune.*.range.log"}) {
    EXPECT_THAT(page, HasSubstr(std::string("\n") + key + "\n"));
  }
}

TEST_F(Manual, Bash_completes_verbs_options_words_and_keys) {
  write("completion", run("describe --completion").out);
  EXPECT_EQ(complete("si", 1), "simulate\n");
  EXPECT_EQ(complete("st", 1), "statics study status\n");
  EXPECT_EQ(complete("tune --ba", 2), "--batch\n");
  EXPECT_EQ(complete("study --ba", 2), "\n");
  EXPECT_EQ(complete("export --format la", 3), "latex\n");
  EXPECT_EQ(complete("init ", 1), "init\n");
  EXPECT_EQ(complete("init mo", 2), "model\n");
  EXPECT_EQ(complete("describe closure.\\*.sde.sti", 2),
            run_shell("echo 'closure.*.sde.stiffness closure.*.sde.stiffness.all "
                      "closure.*.sde.stiffness.phi closure.*.sde.stiffness.psi "
                      "closure.*.sde.stiffness.theta closure.*.sde.stiffness.x "
                      "closure.*.sde.stiffness.y closure.*.sde.stiffness.z'"));
}

TEST_F(Manual, Documents_are_printed_whole_or_not_at_all) {
  const Ended ended = run("describe link --man 1");
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("leave PATH out"));
  EXPECT_EQ(run("describe --man 3").code, 2);
}

}  // namespace
}  // namespace linkstudy::testing::manual_test
