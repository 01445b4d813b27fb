#include "study/evaluate/prepared_case.h"

#include <gmock/gmock.h>

#include "study/config/model_document.h"
#include "tests/support/rsrrp_text.h"

namespace linkstudy::prepared_case_test {
namespace {

using ::testing::ElementsAre;
using Cases = std::vector<std::unique_ptr<PreparedCase>>;
using Set = std::vector<std::pair<std::string, Value>>;

class Grouping : public ::testing::Test {
 protected:
  Grouping() {
    const auto base = test::replaced(test::rsrrp_text(), "end_time = 15.0", "end_time = 0.05");
    const std::string point = "[[point]]\nname = \"tip\"\nlink = \"coupler\"\n";
    document_ = ModelDocument::parse(base + point, "model.toml", diagnostics_);
  }

  // Ready to run, with the speed of the crank reduced.
  void add(const Set& set) {
    std::vector<Override> overrides;
    for (const auto& [path, value] : set) overrides.push_back(make_override(path, value));
    const std::optional<ModelInput> model = document_->with(overrides, diagnostics_);
    ASSERT_TRUE(model) << to_string(diagnostics_);
    Preparation preparation = prepare(model->linkage, model->options);
    ASSERT_EQ(preparation.cause, Cause::ok) << preparation.message;
    StudyInput input;
    input.response.emplace_back();
    StudySignals signals;
    signals.response = {find_channels(list_channels(preparation.model.mechanism), "joint.A.v")};
    RunMetrics metrics(input, signals, model->options, nullptr);
    cases_.push_back(std::unique_ptr<PreparedCase>(
        new PreparedCase{0, cases_.size(), model->options, std::move(preparation),
                         std::move(metrics), SimulationOutcome()}));
  }

  std::vector<std::vector<std::size_t>> groups() const {
    std::vector<std::vector<std::size_t>> all;
    for (const CaseGroup& group : group_cases(cases_)) {
      all.emplace_back();
      for (const PreparedCase* item : group) all.back().push_back(item->point);
    }
    return all;
  }

  Diagnostics diagnostics_;
  std::optional<ModelDocument> document_;
  Cases cases_;
};

TEST_F(Grouping, Puts_numbers_of_one_structure_together) {
  for (const double mass : {1.0, 2.0, 3.0}) add({{"link.crank.mass", mass}});
  EXPECT_THAT(groups(), ElementsAre(ElementsAre(0, 1, 2)));
}

TEST_F(Grouping, Keeps_apart_points_of_other_links_and_not_other_points_of_a_link) {
  add({});
  add({{"point.tip.position.0", 0.1}});
  add({{"point.tip.link", std::string("yoke")}});
  add({{"point.tip.link", std::string("ground")}});
  EXPECT_THAT(groups(), ElementsAre(ElementsAre(0, 1), ElementsAre(2), ElementsAre(3)));
}

TEST_F(Grouping, Keeps_apart_what_differs_in_steps_samples_limits_or_structure) {
  add({});
  add({{"simulation.step", 5e-5}});
  add({{"simulation.end_time", 0.04}});
  add({{"simulation.output_interval", 5e-3}});
  add({{"simulation.drift_limit", 1e-2}});
  add({{"closure.S.model", std::string("sde")}});
  add({{"load.drive.course.value", 11.0}});
  EXPECT_THAT(groups(), ElementsAre(ElementsAre(0, 6), ElementsAre(1), ElementsAre(2),
                                    ElementsAre(3), ElementsAre(4), ElementsAre(5)));
}

TEST_F(Grouping, Runs_each_case_as_if_it_were_alone) {
  for (const double mass : {1.0, 2.0, 3.0}) add({{"link.crank.mass", mass}});
  const CaseGroup group = group_cases(cases_).at(0);
  run_cases(group, {});
  for (PreparedCase* item : group) {
    const SimulationOutcome together = item->outcome;
    const double speed = item->metrics.observers().reductions[0].max;
    run_cases({item}, {});
    EXPECT_EQ(together.final_state.q, item->outcome.final_state.q);
    EXPECT_EQ(speed, item->metrics.observers().reductions[0].max);
    EXPECT_EQ(together.steps, 500);
  }
}

}  // namespace
}  // namespace linkstudy::prepared_case_test
