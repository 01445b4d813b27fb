// Which entry of a queue is begun when time is short. The times are those of a forecast here, and
// of work that only sleeps.
#include "study/queue/drain.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <chrono>
#include <set>
#include <thread>

#include "study/config/study_input.h"
#include "study/queue/enough_time.h"
#include "study/schedule/stop_signals.h"
#include "tests/study/store/scratch.h"
#include "tests/support/rsrrp_text.h"

namespace linkstudy::queue {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

void sleep_s(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

class Drain : public Scratch {
 protected:
  Drain() {
    put(dir_ / "model.toml", test::rsrrp_text());
    // Some seconds on any machine: to forecast it takes a half.
    constexpr double end_time = 350.0, least_s = 3.0;
    forecast_long(end_time);
    if (forecast_s_ < least_s) forecast_long(end_time * least_s / forecast_s_);
  }

  void forecast_long(double end_time) {
    long_ = read(write("long", end_time));
    const Entry entry{"none", dir_ / "none", dir_ / "none", dir_ / "none"};
    forecast_s_ = time_needed(entry, *long_, 1, 1e3).value();
  }

  std::filesystem::path write(const std::string& name, double end_time) const {
    const std::filesystem::path file = dir_ / (name + ".toml");
    put(file, fmt::format(R"(format = 1
kind = "study"
model = "model.toml"
base = {{ set = {{ "simulation.end_time" = {}, "simulation.output_interval" = 1.0 }} }}
[[vary]]
parameter = "link.0.mass"
values = [1.0, 1.1, 1.2, 1.3]
[[response]]
name = "speed"
signal = "joint.A.v"
reduce = "last"
)",
                          end_time));
    return file;
  }

  static StudyInput read(const std::filesystem::path& file) {
    Diagnostics diagnostics;
    std::optional<StudyInput> input = read_study(file.string(), {}, diagnostics);
    EXPECT_TRUE(input) << file;
    return std::move(*input);
  }

  // Names in the order of their begins, of a start with so much time.
  std::vector<std::string> drained(double allocation_s) {
    std::vector<std::string> begun;
    LocalTransport ranks;
    const auto until = std::chrono::steady_clock::now() +
                       std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                           std::chrono::duration<double>(allocation_s));
    const DrainWork work = {[&](const Entry& entry) {
                              if (slow_to_read_.contains(entry.name))
                                sleep_s(slow_to_read_.at(entry.name));
                              return read(entry.file);
                            },
                            [](const StudyInput& input, Transport&) { return input.file; },
                            [&](const Entry& entry, Transport&, const OnEnd& end) {
                              begun.push_back(entry.name);
                              if (takes_.contains(entry.name)) sleep_s(takes_.at(entry.name));
                              end({0, "over"});
                              return 0;
                            }};
    code_ = drain(ranks, {dir_, {until, until}, 0.0, false, ""}, work);
    return begun;
  }

  std::optional<StudyInput> long_;
  double forecast_s_ = 0.0;  // of the file "long"
  std::map<std::string, double> takes_, slow_to_read_;
  int code_ = -1;
};

// Half of what it takes is left, and another allocation has twice as much.
TEST_F(Drain, What_another_allocation_would_end_is_not_begun_in_the_rest_of_this_one) {
  write("a", 1e-2);
  write("z", 1e-2);
  takes_["a"] = 1.5 * forecast_s_;
  EXPECT_THAT(drained(2.0 * forecast_s_), ElementsAre("a", "z"));
  EXPECT_EQ(code_, kExitResumable);
  EXPECT_THAT(drained(2.0 * forecast_s_), ElementsAre("long"));
  EXPECT_EQ(code_, 0);
}

TEST_F(Drain, What_no_allocation_would_end_comes_last) {
  write("z", 1e-2);
  EXPECT_THAT(drained(0.4 * forecast_s_ + 0.5), ElementsAre("z", "long"));
  EXPECT_EQ(code_, 0);
  EXPECT_THAT(drained(1e3), IsEmpty()) << "what has ended is known by its own input";
}

// Otherwise it would wait for a better allocation, and never find one.
TEST_F(Drain, What_has_no_time_though_nothing_else_has_begun_is_begun) {
  write("a", 1e-2);
  ASSERT_THAT(drained(1e3), ElementsAre("a", "long"));
  std::filesystem::remove(dir_ / "results/long.queue");
  slow_to_read_["a"] = 1.5 * forecast_s_;
  EXPECT_THAT(drained(2.0 * forecast_s_), ElementsAre("long"));
}

}  // namespace
}  // namespace linkstudy::queue
