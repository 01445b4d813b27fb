#include "study/config/override.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config_text.h"
#include "study/config/key_reference.h"

namespace linkstudy::override_test {
namespace {

using test::kRsrrp;
using test::replaced;
using ::testing::HasSubstr;

ModelDocument document() {
  Diagnostics diagnostics;
  return *ModelDocument::parse(kRsrrp, "model.toml", diagnostics);
}

std::optional<ModelInput> with(const std::vector<std::string>& assignments,
                               Diagnostics& diagnostics) {
  std::vector<Override> overrides;
  for (const std::string& text : assignments) {
    if (auto override = parse_set(text, diagnostics)) overrides.push_back(*override);
  }
  return document().with(overrides, diagnostics);
}

ModelInput good(const std::vector<std::string>& assignments) {
  Diagnostics diagnostics;
  std::optional<ModelInput> input = with(assignments, diagnostics);
  EXPECT_TRUE(input) << to_string(diagnostics);
  return input.value_or(ModelInput{});
}

Diagnostic bad(const std::vector<std::string>& assignments) {
  Diagnostics diagnostics;
  EXPECT_FALSE(with(assignments, diagnostics));
  EXPECT_EQ(diagnostics.sorted().size(), 1u) << to_string(diagnostics);
  return diagnostics.empty() ? Diagnostic{} : diagnostics.sorted().front();
}

TEST(Override, A_star_for_the_name_sets_the_value_everywhere) {
  const ModelInput input = good({"link.*.mass=3", "joint.*.initial.hold=true"});
  for (const Link& link : input.linkage.links) EXPECT_EQ(link.mass, 3.0) << link.name;
  for (const Joint& joint : input.linkage.joints) EXPECT_TRUE(joint.hold) << joint.name;
  // What comes later and names one of them holds for that one.
  const ModelInput later = good({"link.*.mass=3", "link.crank.mass=4"});
  EXPECT_EQ(later.linkage.links[0].mass, 4.0);
  EXPECT_EQ(later.linkage.links[1].mass, 3.0);
}

TEST(Override, A_star_is_every_element_that_there_is) {
  const ModelDocument model = document();
  const auto paths = expand_path(model.tree(), model_schema(), "link.*.mass");
  EXPECT_THAT(paths, ::testing::Contains("link.crank.mass"));
  EXPECT_EQ(paths.size(), good({}).linkage.links.size());
  EXPECT_THAT(expand_path(model.tree(), model_schema(), "link.crank.mass"),
              ::testing::ElementsAre("link.crank.mass"));
}

TEST(Override, A_star_where_no_name_stands_is_an_error) {
  for (const char* set : {"*=1", "*.crank.mass=1", "link.*=1", "link.*.mas=1", "point.*.link=crank",
                          "link.crank.*=1", "gravity.*=1"}) {
    EXPECT_THAT(bad({set}).message, HasSubstr("names no value")) << set;
  }
}

TEST(Override, A_star_takes_the_unit_that_its_values_share) {
  const ModelDocument model = document();
  ASSERT_TRUE(parameter_for(model, "link.*.mass"));
  EXPECT_EQ(parameter_for(model, "link.*.mass")->unit, "kg");
  EXPECT_EQ(parameter_for(model, "closure.*.sde.stiffness")->unit, "N/m");
  // A is a revolute joint and P slides: rad and m.
  EXPECT_FALSE(parameter_for(model, "joint.*.initial.position"));
}

TEST(Override, Values_of_every_kind_are_set_by_their_path) {
  const ModelInput input = good({"link.crank.mass=2 kg", "simulation.step=1e-3", "name=a title",
                                 "joint.A.initial.hold=true", "gravity.1=-1.62",
                                 "link.crank.center_of_mass=[0, \"6 cm\", 0]", "link.1.mass=7",
                                 "joint.A.initial.position.0=30 deg", "simulation.start=given",
                                 "joint.Q.initial.position=0.25", "joint.R.initial.velocity.0=3"});
  EXPECT_EQ(input.linkage.links[0].mass, 2.0);
  EXPECT_EQ(input.linkage.links[1].mass, 7.0);
  EXPECT_EQ(input.options.step, 1e-3);
  EXPECT_EQ(input.options.start, Start::given);
  EXPECT_EQ(input.name, "a title");
  EXPECT_TRUE(input.linkage.joints[0].hold);
  EXPECT_EQ(input.linkage.gravity.y(), -1.62);
  EXPECT_EQ(input.linkage.links[0].center_of_mass.y(), 0.06);
  EXPECT_DOUBLE_EQ(input.linkage.joints[0].position[0], 0.52359877559829882);
  EXPECT_EQ(input.linkage.joints[2].position[0], 0.25);
  EXPECT_EQ(input.linkage.joints[3].velocity[0], 3.0);
}

TEST(Override, An_element_of_an_array_that_is_not_written_starts_from_its_default) {
  EXPECT_EQ(good({"link.yoke.center_of_mass.2=0.3"}).linkage.links[2].center_of_mass,
            Eigen::Vector3d(0, 0, 0.3));
  const ModelInput quaternion = good({"joint.Q.type=spherical", "joint.Q.coordinates=quaternion",
                                      "joint.Q.initial.position.0=1.0001"});
  EXPECT_THAT(quaternion.linkage.joints[2].position, ::testing::ElementsAre(1.0, 0, 0, 0));
}

TEST(Override, Later_values_win) {
  EXPECT_EQ(good({"link.crank.mass=2", "link.crank.mass=3"}).linkage.links[0].mass, 3.0);
}

TEST(Override, One_of_a_group_replaces_the_others) {
  const ModelInput input = good({"joint.R.frame.quaternion=[1, 0, 0, 0]"});
  EXPECT_EQ(input.linkage.joints[3].frame.rotation, Eigen::Matrix3d::Identity());
}

TEST(Override, The_document_itself_stays_as_it_was) {
  const ModelDocument original = document();
  Diagnostics diagnostics;
  const Override heavy = make_override("link.crank.mass", 9.0);
  EXPECT_EQ(original.with({&heavy, 1}, diagnostics)->linkage.links[0].mass, 9.0);
  EXPECT_EQ(original.with({}, diagnostics)->linkage.links[0].mass, 1.0);
  EXPECT_EQ(original.edited({&heavy, 1}, diagnostics)->with({}, diagnostics)->linkage.links[0].mass,
            9.0);
}

TEST(Override, A_wrong_value_is_an_error_of_the_option_that_set_it) {
  EXPECT_EQ(to_string(bad({"link.crank.mass=-2"})),
            "--set link.crank.mass=-2: error: link 'crank': mass must be positive, got -2 kg\n    "
            "mass: a number > 0 kg");
  EXPECT_THAT(bad({"closure.S.model=cur"}).remedy, HasSubstr("did you mean 'cut'?"));
  EXPECT_THAT(bad({"link.crank.mass=2 m"}).message, HasSubstr("must be a number in kg, got '2 m'"));
  EXPECT_THAT(bad({"link.crank.mass=nan"}).message, HasSubstr("got 'nan'"));
  EXPECT_THAT(bad({"gravity=[1, 2]"}).message, HasSubstr("must have 3 entries"));
  EXPECT_THAT(bad({"closure.S.sde.stiffness.psi=1 N/m"}).message, HasSubstr("N m/rad"));
  EXPECT_THAT(bad({"joint.A.parent=crnk"}).file, HasSubstr("--set joint.A.parent=crnk"));
}

TEST(Override, A_path_that_names_nothing_gives_the_nearest_paths) {
  const Diagnostic d = bad({"link.crnk.mass=2"});
  EXPECT_EQ(d.file, "--set link.crnk.mass=2");
  EXPECT_EQ(d.message, "the path 'link.crnk.mass' names no value of model.toml");
  EXPECT_THAT(d.remedy, HasSubstr("link.crank.mass"));
  EXPECT_THAT(bad({"simulation.stp=1"}).remedy, HasSubstr("simulation.step"));
  EXPECT_THAT(bad({"closure.S.sde.stifness.x=1"}).remedy, HasSubstr("closure.S.sde.stiffness"));
  for (const char* path :
       {"", "link", "link.crank", "link.crank.mass.0", "gravity.3", "gravity.x", "gravity.1.0",
        "simulation", "joint.A.frame", "link.9.mass", "link.*.mas", ".", "a..b",
        "link.crank.flexible", "joint.A.initial.position.1", "joint.A.frame.matrix.0"}) {
    Diagnostics diagnostics;
    const Override nowhere = make_override(path, 1.0);
    EXPECT_FALSE(document().with({&nowhere, 1}, diagnostics)) << path;
    EXPECT_EQ(diagnostics.sorted().size(), 1u) << path << to_string(diagnostics);
  }
}

TEST(Override, Kind_and_format_cannot_be_set) {
  EXPECT_THAT(bad({"kind=study"}).message, HasSubstr("cannot be set"));
  EXPECT_THAT(bad({"format=2"}).message, HasSubstr("cannot be set"));
}

TEST(Override, Text_that_is_no_assignment_is_an_error) {
  for (const char* text : {"link.crank.mass", "=3", "a=", "gravity=[1, 2", "gravity=[1]]"}) {
    Diagnostics diagnostics;
    EXPECT_FALSE(parse_set(text, diagnostics)) << text;
    EXPECT_EQ(diagnostics.size(), 1u) << text;
  }
}

TEST(Override, Parameters_know_their_unit_from_the_neighbours) {
  const ModelDocument model = document();
  const std::pair<const char*, const char*> units[] = {{"link.crank.mass", "kg"},
                                                       {"closure.S.sde.stiffness", "N/m"},
                                                       {"closure.S.sde.stiffness.psi", "N m/rad"},
                                                       {"joint.A.initial.position", "rad"},
                                                       {"joint.P.initial.position.0", "m"},
                                                       {"joint.P.initial.velocity.0", "m/s"},
                                                       {"load.drive.course.value", "N m"},
                                                       {"load.resistance.law.at_speed", "rad/s"},
                                                       {"closure.S.model", ""},
                                                       {"gravity.2", "m/s^2"},
                                                       {"simulation.step", "s"}};
  for (const auto& [path, unit] : units) {
    const std::optional<Parameter> parameter = parameter_for(model, path);
    ASSERT_TRUE(parameter) << path;
    EXPECT_EQ(parameter->path, path);
    EXPECT_EQ(parameter->unit, unit) << path;
    EXPECT_FALSE(parameter->long_name.empty()) << path;
  }
  for (const char* path :
       {"link.crank", "joint.A.frame", "closure.T.model", "link.crank.inertia.5"}) {
    EXPECT_FALSE(parameter_for(model, path)) << path;
  }
}

TEST(Reference, Every_key_of_the_reference_linkage_is_described) {
  for (const char* path :
       {"", "link", "link.crank.mass", "joint.A.initial.position.0", "model.gravity", "study.vary",
        "tune.search", "match", "closure.S.sde.stiffness.x"}) {
    ASSERT_TRUE(describe(path)) << path;
  }
  EXPECT_THAT(*describe("link.crank.mass"),
              HasSubstr("link.*.mass\n    mass\n    type: number; unit: kg; "
                        "range: > 0; required\n"));
  EXPECT_THAT(*describe("simulation.step"), HasSubstr("default: 1.0e-4"));
  EXPECT_FALSE(describe("link.crank.color"));
  EXPECT_THAT(nearest_keys("link.mas").front(), "link.*.mass");
  EXPECT_THAT(nearest_keys("mass"), ::testing::ElementsAre("link.*.mass"));
}

TEST(Reference, The_markdown_has_a_row_for_every_key_and_six_columns) {
  const std::string text = key_reference_markdown();
  for (const Word<FileKind>& kind : kWords<FileKind>) {
    for (const KeyRow& row : key_rows(kind.value)) {
      const bool is_planned = row.type == KeyType::planned;
      EXPECT_EQ(text.find("| `" + row.path + "` |") == std::string::npos, is_planned) << row.path;
    }
  }
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("|")) continue;
    std::size_t bars = 0;
    for (std::size_t i = 0; i < line.size(); ++i)
      bars += line[i] == '|' && (i == 0 || line[i - 1] != '\\');
    EXPECT_EQ(bars, 7u) << line;
  }
}

TEST(Reference, Every_row_has_a_meaning_and_no_required_key_a_default) {
  for (const Word<FileKind>& kind : kWords<FileKind>) {
    for (const KeyRow& row : key_rows(kind.value)) {
      EXPECT_FALSE(row.meaning.empty()) << row.path;
      EXPECT_FALSE(row.required && !row.standard.empty()) << row.path;
    }
  }
}

}  // namespace
}  // namespace linkstudy::override_test
