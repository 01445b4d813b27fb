#include "synthetic_error.h"

namespace linkstudy::tuning::certificate_test {
namespace {

using testing::SyntheticError;

class ATunedModel : public ::testing::Test {
 protected:
  ATunedModel() : result_(tune(model_.problem(), {}, model_.evaluator())) {}

  const Certificate& certificate() const { return *result_.certificate; }

  // The recorded evaluations, changed by `tamper` on the way.
  Certificate check(const std::function<void(Observation&)>& tamper) const {
    return check_certificate(certificate(), [&](std::uint64_t id) -> std::optional<Observation> {
      for (Observation seen : result_.observations) {
        if (seen.answer.id == id) {
          tamper(seen);
          return seen;
        }
      }
      return std::nullopt;
    });
  }

  bool at(const Observation& seen, double value, double factor) const {
    return seen.request.x[0] == value && seen.request.step_factor == factor;
  }

  SyntheticError model_;
  TuningResult result_;
};

TEST_F(ATunedModel, Is_certified_again_from_its_recorded_evaluations) {
  const Certificate checked = check([](Observation&) {});
  EXPECT_EQ(checked.verdict, Verdict::certified) << checked.reason;
  for (std::size_t i = 0; i < checked.claims.size(); ++i) {
    EXPECT_EQ(checked.claims[i].reason, certificate().claims[i].reason);
    EXPECT_FALSE(checked.claims[i].evaluations.empty());
  }
}

TEST_F(ATunedModel, Is_refuted_when_half_the_step_does_not_match) {
  const Certificate checked = check([&](Observation& seen) {
    if (at(seen, result_.point[0], 0.5)) seen.answer.errors[0] = 0.0201;
  });
  EXPECT_EQ(checked.verdict, Verdict::refuted);
  EXPECT_EQ(checked.claims[0].verdict, Verdict::refuted);
}

TEST_F(ATunedModel, Is_refuted_when_the_second_step_was_not_halved) {
  const Certificate checked = check([&](Observation& seen) { seen.answer.step = 1e-4; });
  EXPECT_EQ(checked.claims[0].verdict, Verdict::refuted);
}

TEST_F(ATunedModel, Is_refuted_when_a_lower_point_matches) {
  const double reduced = result_.point[0] * (1.0 - TuningOptions{}.delta);
  int changed = 0;
  const Certificate checked = check([&](Observation& seen) {
    if (at(seen, reduced, 1.0)) {
      seen.answer.errors[0] = 0.0199;
      ++changed;
    }
  });
  EXPECT_GT(changed, 0);
  EXPECT_EQ(checked.claims[1].verdict, Verdict::refuted) << checked.claims[1].reason;
  EXPECT_EQ(checked.verdict, Verdict::refuted);
}

TEST_F(ATunedModel, Is_refuted_when_a_scan_point_below_matches_or_is_missing) {
  const Certificate matching = check([&](Observation& seen) {
    if (at(seen, 1e3, 1.0)) seen.answer.errors[0] = 0.001;
  });
  EXPECT_EQ(matching.claims[2].verdict, Verdict::refuted);
  Certificate shortened = certificate();
  shortened.claims[2].evaluations.pop_back();
  const Certificate missing = check_certificate(
      shortened,
      [&](std::uint64_t id) -> std::optional<Observation> { return result_.observations.at(id); });
  EXPECT_EQ(missing.claims[2].verdict, Verdict::refuted);
  EXPECT_NE(missing.claims[2].reason.find("not evaluated"), std::string::npos);
}

TEST_F(ATunedModel, Is_refuted_when_the_error_rises_near_the_point) {
  const Certificate checked = check([&](Observation& seen) {
    if (seen.request.x[0] > result_.point[0] * 1.1) seen.answer.errors[0] = 0.03;
  });
  EXPECT_EQ(checked.claims[3].verdict, Verdict::refuted) << checked.claims[3].reason;
}

TEST_F(ATunedModel, Is_refuted_when_its_evaluations_are_gone) {
  const Certificate checked =
      check_certificate(certificate(), [](std::uint64_t) { return std::nullopt; });
  for (const Claim& claim : checked.claims) EXPECT_EQ(claim.verdict, Verdict::refuted);
}

TEST_F(ATunedModel, Is_refuted_when_its_point_was_changed) {
  Certificate forged = certificate();
  forged.terms.point[0] *= 0.99;
  const Certificate checked = check_certificate(
      forged,
      [&](std::uint64_t id) -> std::optional<Observation> { return result_.observations.at(id); });
  EXPECT_EQ(checked.verdict, Verdict::refuted);
}

TEST_F(ATunedModel, Is_refuted_when_only_its_verdict_was_changed) {
  SyntheticError open;
  open.terms = {{1.0, 0.0}};  // matches at the low end of the range: inconclusive
  const TuningResult inconclusive = tune(open.problem(), {}, open.evaluator());
  Certificate forged = *inconclusive.certificate;
  ASSERT_EQ(forged.verdict, Verdict::inconclusive);
  forged.verdict = Verdict::certified;
  const Certificate checked =
      check_certificate(forged, [&](std::uint64_t id) -> std::optional<Observation> {
        return inconclusive.observations.at(id);
      });
  EXPECT_EQ(checked.verdict, Verdict::refuted);
}

TEST_F(ATunedModel, Rests_on_evaluations_at_the_points_it_names) {
  const auto& first = result_.observations.at(certificate().claims[0].evaluations.at(0));
  const auto& second = result_.observations.at(certificate().claims[0].evaluations.at(1));
  EXPECT_TRUE(at(first, result_.point[0], 1.0));
  EXPECT_TRUE(at(second, result_.point[0], 0.5));
}

}  // namespace
}  // namespace linkstudy::tuning::certificate_test
