// Values without effect: what is refused, what is remarked, and that the key tables tell the truth
// about it.
#include "study/config/effect.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config_text.h"
#include "core/simulation/prepare.h"
#include "core/simulation/simulate.h"
#include "tests/support/source_file.h"

namespace linkstudy::effect_test {
namespace {

using test::kRsrrp;
using test::replaced;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::string> remarks_of(const std::string& text, const std::string& verb,
                                    const std::vector<std::string>& sets = {}) {
  Diagnostics diagnostics;
  std::vector<Override> overrides;
  for (const std::string& assignment : sets) overrides.push_back(test::set(assignment));
  const auto document = ModelDocument::parse(text, "model.toml", diagnostics);
  EXPECT_TRUE(read_model_file(*document, overrides, verb, diagnostics)) << to_string(diagnostics);
  std::vector<std::string> messages;
  for (const Diagnostic& d : diagnostics.sorted_remarks()) messages.push_back(d.message);
  return messages;
}

const char* const kFriction = "friction = { mu_s = 0.3, mu_k = 0.2, sigma0 = 1e4 }\n";

TEST(Effect, Friction_of_a_closure_that_can_never_slide_is_an_error_that_names_both_lines) {
  const std::string text =
      replaced(kRsrrp, "model  = \"cut\"", std::string("model = \"cut\"\n") + kFriction);
  Diagnostics diagnostics;
  EXPECT_FALSE(test::read_text(text, diagnostics));
  const std::vector<Diagnostic> found = diagnostics.sorted();
  ASSERT_EQ(found.size(), 1u) << to_string(diagnostics);
  EXPECT_THAT(found[0].message,
              HasSubstr("closure.S.friction has no effect: closure.S.model = 'cut' (model.toml:"));
  EXPECT_THAT(found[0].remedy, HasSubstr("which needs closure.S.clearance"));
  const auto line_of = [&](const char* part) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(text.find(part));
    return 1 + std::count(text.begin(), end, '\n');
  };
  EXPECT_EQ(found[0].line, line_of("friction = {"));
  EXPECT_THAT(found[0].message,
              HasSubstr("model.toml:" + std::to_string(line_of("model = \"cut\"")) + ":"));
}

TEST(Effect, Tables_that_a_switch_would_use_are_remarked_or_stand_by) {
  const std::string clearance = test::real_joints_text();
  EXPECT_THAT(remarks_of(clearance, "simulate"), IsEmpty());
  // The tables of the three models stand by; contact and friction are what one may miss.
  EXPECT_THAT(remarks_of(clearance, "simulate", {"closure.S.model=cut"}),
              ElementsAre(HasSubstr("closure.S.contact has no effect"),
                          HasSubstr("closure.S.friction has no effect")));
  EXPECT_THAT(remarks_of(clearance, "kinematics", {"closure.S.model=cut"}), IsEmpty());
  EXPECT_THAT(remarks_of(kRsrrp, "simulate"), IsEmpty());
  EXPECT_THAT(remarks_of(clearance, "simulate", {"closure.S.friction.enabled=false"}), IsEmpty());
}

TEST(Effect, What_a_set_option_sets_must_act) {
  EXPECT_THAT(remarks_of(kRsrrp, "simulate", {"closure.S.sde.stiffness=1e7"}),
              ElementsAre(HasSubstr("closure.S.sde.stiffness has no effect: closure.S.model = "
                                    "'cut' (model.toml:")));
  EXPECT_THAT(
      remarks_of(kRsrrp, "simulate", {"closure.S.sde.stiffness=1e7", "closure.0.model=sde"}),
      IsEmpty());
  EXPECT_THAT(remarks_of(kRsrrp, "simulate", {"simulation.tolerance.relative=1e-6"}),
              ::testing::Contains(HasSubstr("simulation.integrator = 'rk4'")));
  EXPECT_THAT(remarks_of(kRsrrp, "simulate",
                         {"simulation.tolerance.relative=1e-6", "simulation.integrator=stiff"}),
              IsEmpty());
  EXPECT_THAT(remarks_of(kRsrrp, "simulate", {"closure.S.cut.alpha=5"}),
              ::testing::Contains(HasSubstr("closure.S.cut.stabilization = 'none'")));
}

TEST(Effect, Drives_of_kinematics_are_remarked_where_a_run_moves_by_its_loads) {
  const std::string text = kRsrrp + "\n[[kinematics.drive]]\njoint = \"A\"\n";
  EXPECT_THAT(remarks_of(text, "simulate"), ElementsAre(HasSubstr("kinematics has no effect")));
  EXPECT_THAT(remarks_of(text, "kinematics"), IsEmpty());
  EXPECT_THAT(remarks_of(text, ""), IsEmpty());  // check
}

// A value that is switched off or on, and another value for it.
struct Switched {
  const char* off;
  const char* on;
  const char* value;  // "path=value"
};

std::vector<double> end_of(const ModelInput& input) {
  const Preparation p = prepare(input.linkage, input.options);
  EXPECT_EQ(p.cause, Cause::ok) << p.message;
  Observers none;
  const SimulationOutcome outcome =
      simulate(p.model.mechanism, p.model.parameters, p.model.start, input.options, none);
  EXPECT_EQ(outcome.cause, Cause::ok) << outcome.message;
  std::vector<double> end = outcome.final_state.q;
  end.insert(end.end(), outcome.final_state.v.begin(), outcome.final_state.v.end());
  return end;
}

// Second route: what the key tables call ineffective changes no bit of a run, and the rest does.
TEST(Effect, Is_none_where_a_run_keeps_every_bit) {
  const Switched all[] = {
      {"closure.R.model=cut", "closure.R.model=sde", "closure.R.sde.stiffness=2e6"},
      {"closure.R.model=sde", "closure.R.model=clearance", "closure.R.clearance.radial=2e-4"},
      {"closure.R.model=cut", "closure.R.model=clearance", "closure.R.contact.stiffness=1e9"},
      {"closure.R.friction.enabled=false", "closure.R.friction.enabled=true",
       "closure.R.friction.mu_s=0.9"},
      {"link.coupler.flexible.enabled=false", "link.coupler.flexible.enabled=true",
       "link.coupler.flexible.young=1e10"},
      {"simulation.integrator=rk4", "simulation.integrator=adaptive",
       "simulation.tolerance.relative=1e-3"},
      {"closure.R.clearance.kind=planar", "closure.R.clearance.kind=spatial",
       "closure.R.clearance.length=0.09"},
  };
  Diagnostics diagnostics;
  const auto document = ModelDocument::load(
      testing::source_file("configs/mechanisms/rsup_clearance_flexible.toml"), diagnostics);
  ASSERT_TRUE(document) << to_string(diagnostics);
  const std::vector<Override> brief = {test::set("simulation.end_time=0.03"),
                                       test::set("simulation.step=1e-5"),
                                       test::set("link.coupler.flexible.segments=1")};
  for (const Switched& one : all) {
    for (const char* word : {one.off, one.on}) {
      std::vector<Override> set = brief;
      set.push_back(test::set(word));
      const auto plain = document->with(set, diagnostics);
      const Override value = test::set(one.value);
      set.push_back(value);
      const auto changed = document->with(set, diagnostics);
      ASSERT_TRUE(plain && changed) << to_string(diagnostics);
      const bool acts =
          !find_ineffective(changed->resolved, model_schema(), value.path, "simulate");
      EXPECT_EQ(acts, word == one.on) << word << " " << one.value;
      EXPECT_EQ(end_of(*plain) == end_of(*changed), !acts) << word << " " << one.value;
    }
  }
}

}  // namespace
}  // namespace linkstudy::effect_test
