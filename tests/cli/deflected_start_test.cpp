// A run that begins with its springs deflected and moving, and what is said where it may not.
#include <gmock/gmock.h>

#include <cmath>
#include <cstdio>

#include "tests/cli/program.h"

namespace linkstudy::testing::deflected_start_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kMassOnBushing = R"(format = 1
kind = "model"
name = "mass on bushing"
gravity = [0.0, 0.0, 0.0]

[[link]]
name = "b"
mass = 1.0
center_of_mass = [0.0, 0.0, 0.0]
inertia = [0.01, 0.01, 0.01]

[[joint]]
name = "P"
type = "prismatic"
parent = "ground"
child = "b"
initial = { position = [0.01], velocity = [1.0] }

[[closure]]
name = "B"
type = "fixed"
first = { link = "b", position = [0.0, 0.0, 0.0] }
second = { link = "ground", position = [0.0, 0.0, 0.0] }
model = "sde"
sde = { stiffness = 1000.0 }

[simulation]
end_time = 0.5
step = 1.0e-4
output_interval = 0.1
)";

class DeflectedStart : public Program {
 protected:
  DeflectedStart() { write("mass.toml", kMassOnBushing); }
};

TEST_F(DeflectedStart, A_spring_that_begins_shut_says_that_it_takes_the_given_velocity_away) {
  const Ended ended = run("simulate mass.toml");
  EXPECT_EQ(ended.code, 0);
  EXPECT_THAT(ended.err, HasSubstr("joint.P: its initial velocity is 0 instead of the given 1"));
  EXPECT_THAT(ended.err, HasSubstr("closure.*.sde.start"));
}

TEST_F(DeflectedStart, A_spring_asked_to_begin_as_given_moves_as_the_closed_form_says) {
  const Ended ended = run("simulate mass.toml --set closure.B.sde.start=given --csv out.csv");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.err, Not(HasSubstr("initial velocity")));
  const std::string csv = read_text(path("out.csv"));
  const std::string last = csv.substr(csv.rfind('\n', csv.size() - 2) + 1);
  double t = 0.0, q = 0.0;
  ASSERT_EQ(std::sscanf(last.c_str(), "%lf,%lf", &t, &q), 2) << last;
  const double w = std::sqrt(1000.0);
  EXPECT_NEAR(t, 0.5, 1e-12);
  EXPECT_NEAR(q, 0.01 * std::cos(w * t) + std::sin(w * t) / w, 1e-9);
}

}  // namespace
}  // namespace linkstudy::testing::deflected_start_test
