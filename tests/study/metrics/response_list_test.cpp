// The list of responses, and that it can be read back; what makes two channels the same.
#include "study/metrics/response_list.h"

#include <gmock/gmock.h>

#include <functional>

namespace linkstudy::response_list_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<Channel> vector_channels(const std::string& signal) {
  std::vector<Channel> channels;
  for (const char* axis : {".x", ".y", ".z"}) {
    channels.push_back({signal + axis, "N", Quantity::closure_force});
  }
  return channels;
}

struct Listed {
  StudyInput input;
  StudySignals signals;

  void match(std::vector<Channel> channels) {
    input.match.emplace_back();
    signals.match.push_back(std::move(channels));
  }
  void response(const std::string& name, std::vector<Channel> channels) {
    input.response.emplace_back();
    input.response.back().name = name;
    input.response.back().signal = channels.front().name;
    signals.response.push_back(std::move(channels));
  }
  void load_case(const std::string& name) {
    input.load_case.emplace_back();
    input.load_case.back().name = name;
  }
};

// Names that might be taken for others: a load case that ends like another, a response that ends
// like a run number, two matches of one signal.
Listed awkward() {
  Listed listed;
  listed.match(vector_channels("closure.S.force"));
  listed.match({{"joint.A.q", "rad", Quantity::q}});
  listed.match(vector_channels("closure.S.force"));
  listed.response("own_gap_max", {{"closure.S.gap.x", "m", Quantity::closure_gap}});
  listed.response("peak", {{"joint.A.v", "rad/s", Quantity::v}});
  return listed;
}

void expect_read_back(const Listed& listed, const std::vector<std::string>& load_cases) {
  const std::vector<Response> responses = list_responses(listed.input, listed.signals);
  const std::vector<StoredCase> cases = split_responses(responses);
  const ResponseLayout layout = layout_of(listed.input, listed.signals);
  ASSERT_EQ(cases.size(), load_cases.size());
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const std::size_t first = i * layout.width;
    EXPECT_EQ(cases[i].load_case, load_cases[i]);
    EXPECT_EQ(cases[i].always, first + layout.always);
    ASSERT_EQ(cases[i].matches.size(), layout.match.size());
    for (std::size_t k = 0; k < layout.match.size(); ++k) {
      const StoredErrors& errors = cases[i].matches[k];
      const std::vector<Channel>& channels = listed.signals.match[k];
      EXPECT_EQ(errors.max, first + layout.match[k]);
      EXPECT_EQ(errors.rms, errors.max + channels.size());
      ASSERT_EQ(errors.channels.size(), channels.size());
      for (std::size_t c = 0; c < channels.size(); ++c) {
        EXPECT_EQ(errors.channels[c], channels[c].name);
      }
    }
    std::vector<std::string> names;
    for (const std::size_t k : cases[i].responses) names.push_back(responses[k].name);
    const std::string prefix = load_cases[i].empty() ? "" : load_cases[i] + "_";
    std::vector<std::string> expected;
    for (const ResponseInput& response : listed.input.response) {
      expected.push_back(prefix + response.name);
    }
    EXPECT_EQ(names, expected);
  }
}

TEST(ResponseList, Is_read_back_as_it_was_written) {
  Listed listed = awkward();
  expect_read_back(listed, {""});
  const auto stored = split_responses(list_responses(listed.input, listed.signals));
  EXPECT_EQ(stored[0].matches[0].name, "closure_S_force");
  EXPECT_EQ(stored[0].matches[1].name, "joint_A_q");
  EXPECT_EQ(stored[0].matches[2].name, "closure_S_force_2");
  for (const char* name : {"fast", "very_fast", "gap_max"}) listed.load_case(name);
  expect_read_back(listed, {"fast", "very_fast", "gap_max"});
  expect_read_back(Listed(), {""});
  EXPECT_THAT(split_responses({}), IsEmpty());
}

TEST(SameChannel, Differs_with_every_member) {
  const Channel channel{"point.tip.position.x", "m", Quantity::point_position, 1, 2, BodyIndex(3)};
  const std::vector<std::function<void(Channel&)>> changes = {
      [](Channel& c) { c.name = "point.end.position.x"; },
      [](Channel& c) { c.unit = "m/s"; },
      [](Channel& c) { c.quantity = Quantity::point_velocity; },
      [](Channel& c) { c.index = 0; },
      [](Channel& c) { c.component = 0; },
      [](Channel& c) { c.body = kGroundBody; }};
  EXPECT_TRUE(same_channel(channel, channel));
  for (std::size_t i = 0; i < changes.size(); ++i) {
    Channel other = channel;
    changes[i](other);
    EXPECT_FALSE(same_channel(channel, other)) << "member " << i;
    EXPECT_FALSE(same_channels({channel}, {other})) << "member " << i;
  }
  EXPECT_FALSE(same_channels({channel}, {channel, channel}));
}

}  // namespace
}  // namespace linkstudy::response_list_test
