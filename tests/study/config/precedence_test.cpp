// Where a value comes from, as a table: every source above those before it, and pairs that are
// refused.
#include "study/config/precedence.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config_text.h"
#include "study/config/toml_writer.h"
#include "study/config/value_path.h"

namespace linkstudy::precedence_test {
namespace {

using test::kRsrrp;
using test::write_file;
using ::testing::HasSubstr;

// A study of the crank's mass (1 kg in the model file) as far as its sources state it.
struct Sources {
  std::string base = {}, reference = {}, load = {}, vary = {};  // TOML texts
  std::vector<std::string> sets = {};
};

std::string study_of(const Sources& s) {
  std::string text = "format = 1\nkind = \"study\"\nmodel = \"rsrrp.toml\"\n";
  text += fmt::format("reference = {{ set = {{ {} }} }}\n", s.reference);
  text += fmt::format("base = {{ set = {{ {} }} }}\n", s.base);
  text +=
      s.vary.empty() ? "[[vary]]\nparameter = \"link.coupler.mass\"\nvalues = [1, 2]\n" : s.vary;
  if (!s.load.empty()) text += fmt::format("[[load_case]]\nname = \"a\"\nset = {{ {} }}\n", s.load);
  return text;
}

std::optional<StudyInput> read(const Sources& sources, Diagnostics& diagnostics) {
  write_file("rsrrp.toml", kRsrrp);
  std::vector<Override> overrides;
  for (const std::string& text : sources.sets) overrides.push_back(test::set(text));
  return read_study(write_file("study.toml", study_of(sources)), overrides, diagnostics);
}

// The mass in the first case and in its reference.
std::pair<double, double> masses(const Sources& sources) {
  Diagnostics diagnostics;
  const std::optional<StudyInput> input = read(sources, diagnostics);
  if (!input) {
    ADD_FAILURE() << to_string(diagnostics);
    return {};
  }
  const LoadCaseInput load = input->load_case.empty() ? LoadCaseInput{} : input->load_case[0];
  const Override point = make_override(input->vary[0].parameter.path, input->vary[0].values[0]);
  const auto own = input->model->with(case_overrides(*input, load, {point}), diagnostics);
  const auto other = input->reference->model->with(reference_overrides(*input, load), diagnostics);
  return {own->linkage.links[0].mass, other->linkage.links[0].mass};
}

constexpr const char* kVaryMass = "[[vary]]\nparameter = \"link.crank.mass\"\nvalues = [6, 7]\n";

TEST(Precedence, Each_source_stands_above_those_before_it) {
  struct Row {
    Sources sources;
    double own, reference;
  };
  const Row rows[] = {
      {{}, 1, 1},
      {{.base = "\"link.crank.mass\" = 2"}, 2, 1},
      {{.base = "\"link.0.mass\" = 2", .reference = "\"link.crank.mass\" = 3"}, 2, 3},
      {{.base = "\"link.crank.mass\" = 2", .load = "\"link.crank.mass\" = 4"}, 4, 4},
      {{.reference = "\"link.crank.mass\" = 3", .load = "\"link.0.mass\" = 4"}, 4, 4},
      {{.base = "\"link.0.mass\" = 2", .vary = kVaryMass}, 6, 1},
      {{.sets = {"link.crank.mass=5"}}, 5, 5},
      {{.base = "\"link.crank.mass\" = 2", .sets = {"link.crank.mass=5"}}, 5, 5},
      {{.base = "\"link.crank.mass\" = 2",
        .reference = "\"link.crank.mass\" = 3",
        .sets = {"link.0.mass=5"}},
       5,
       5},
      {{.base = "\"link.0.mass\" = 2", .sets = {"link.crank.mass=4", "link.0.mass=5"}}, 5, 5},
  };
  for (const Row& row : rows) {
    const auto [own, reference] = masses(row.sources);
    EXPECT_EQ(own, row.own) << study_of(row.sources);
    EXPECT_EQ(reference, row.reference) << study_of(row.sources);
  }
}

TEST(Precedence, One_value_of_two_equal_sources_is_refused_under_any_spelling) {
  struct Row {
    Sources sources;
    const char* says;
  };
  const Row rows[] = {
      {{.load = "\"link.crank.mass\" = 4", .vary = kVaryMass},
       "load case 'a' names 'link.crank.mass', which [[vary]] names too"},
      {{.load = "\"link.0.mass\" = 4", .vary = kVaryMass},
       "which [[vary]] names as 'link.crank.mass' too"},
      {{.vary = kVaryMass, .sets = {"link.crank.mass=5"}}, "which [[vary]] names too"},
      {{.load = "\"link.crank.mass\" = 4", .sets = {"link.0.mass=5"}},
       "which load case 'a' names as 'link.crank.mass' too"},
      {{.vary = std::string(kVaryMass) + "[[vary]]\nparameter = \"link.0.mass\"\nvalues = [3]\n"},
       "[[vary]] names 'link.0.mass', which [[vary]] names as 'link.crank.mass' too"},
      {{.base = "\"link.crank.mass\" = 2, \"link.0.mass\" = 3"}, "base.set names"},
      {{.base = "\"closure.S.sde.damping\" = 2, \"closure.S.sde.damping_ratio\" = 3"},
       "base.set names"},
      {{.load = "\"closure.S.sde.stiffness\" = 1e5",
        .vary = "[[vary]]\nparameter = \"closure.S.sde.stiffness.x\"\nvalues = [1e6]\n"},
       "load case 'a' names 'closure.S.sde.stiffness'"},
      {{.vary = "[[vary]]\nparameter = \"joint.A.initial.position.0\"\nvalues = [0.1]\n",
        .sets = {"joint.A.initial.position=0.2"}},
       "--set names 'joint.A.initial.position'"},
  };
  for (const Row& row : rows) {
    Diagnostics diagnostics;
    EXPECT_FALSE(read(row.sources, diagnostics)) << study_of(row.sources);
    EXPECT_THAT(to_string(diagnostics), HasSubstr(row.says)) << study_of(row.sources);
  }
}

TEST(Precedence, A_conflict_names_both_lines) {
  Diagnostics diagnostics;
  EXPECT_FALSE(read({.load = "\"link.crank.mass\" = 4", .vary = kVaryMass}, diagnostics));
  const std::vector<Diagnostic> found = diagnostics.sorted();
  ASSERT_EQ(found.size(), 1u) << to_string(diagnostics);
  EXPECT_EQ(found[0].line, 11);
  EXPECT_THAT(found[0].message, HasSubstr("study.toml:7:13"));
}

TEST(Precedence, A_part_may_follow_its_whole_within_one_set) {
  Diagnostics diagnostics;
  const auto input =
      read({.base = "\"closure.S.model\" = \"sde\", \"closure.S.sde.stiffness\" = 1e5, "
                    "\"closure.S.sde.stiffness.x\" = 2e5"},
           diagnostics);
  ASSERT_TRUE(input) << to_string(diagnostics);
  const auto model = input->model->with(input->base_set, diagnostics);
  EXPECT_EQ(model->linkage.closures[0].sde.stiffness[0], 2e5);
  EXPECT_EQ(model->linkage.closures[0].sde.stiffness[1], 1e5);
}

TEST(Precedence, A_set_option_replaces_what_excludes_it) {
  Diagnostics diagnostics;
  const auto input =
      read({.base = "\"closure.S.model\" = \"sde\", \"closure.S.sde.damping_ratio\" = 0.7",
            .sets = {"closure.S.sde.damping=12"}},
           diagnostics);
  ASSERT_TRUE(input) << to_string(diagnostics);
  const auto model = input->model->with(input->base_set, diagnostics);
  EXPECT_FALSE(model->linkage.closures[0].sde.damping_ratio);
  EXPECT_EQ(model->linkage.closures[0].sde.damping[0], 12.0);
}

TEST(Precedence, The_resolved_study_states_what_was_run) {
  Diagnostics diagnostics;
  const auto input =
      read({.base = "\"link.crank.mass\" = 2", .sets = {"link.crank.mass=5", "link.yoke.mass=9"}},
           diagnostics);
  ASSERT_TRUE(input) << to_string(diagnostics);
  const std::string resolved = write_toml(input->resolved);
  EXPECT_THAT(resolved, HasSubstr("set = { \"link.crank.mass\" = 5"));
  EXPECT_THAT(resolved, ::testing::Not(HasSubstr("yoke")));
}

TEST(Precedence, A_set_option_that_makes_cases_and_reference_alike_is_remarked) {
  const Sources apart = {.base = "\"closure.S.model\" = \"sde\"",
                         .reference = "\"closure.S.model\" = \"cut\"",
                         .sets = {"closure.0.model=sde"}};
  Diagnostics diagnostics;
  const auto input = read(apart, diagnostics);
  ASSERT_TRUE(input) << to_string(diagnostics);
  ASSERT_EQ(input->remarks.size(), 1u);
  EXPECT_THAT(input->remarks[0].message,
              HasSubstr("replaces 'sde' of base.set and 'cut' of reference.set"));
  const Sources alike = {.base = "\"link.crank.mass\" = 2",
                         .reference = "\"link.crank.mass\" = 2",
                         .sets = {"link.crank.mass=3"}};
  EXPECT_TRUE(read(alike, diagnostics)->remarks.empty());
}

TEST(Precedence, A_set_option_needs_its_value_in_one_of_the_models_only) {
  const std::string other = test::replaced(kRsrrp, "name = \"S\"", "name = \"T\"");
  write_file("rsrrp.toml", kRsrrp);
  write_file("other.toml", other);
  const std::string text =
      "format = 1\nkind = \"study\"\nmodel = \"rsrrp.toml\"\nreference = { model = \"other.toml\" "
      "}\n"
      "[[vary]]\nparameter = \"link.crank.mass\"\nvalues = [1, 2]\n";
  const std::string path = write_file("study.toml", text);
  for (const char* known : {"closure.S.cut.alpha=3", "closure.T.cut.alpha=3"}) {
    Diagnostics diagnostics;
    EXPECT_TRUE(read_study(path, std::vector{test::set(known)}, diagnostics))
        << to_string(diagnostics);
  }
  Diagnostics diagnostics;
  EXPECT_FALSE(read_study(path, std::vector{test::set("closure.U.cut.alpha=3")}, diagnostics));
  EXPECT_EQ(diagnostics.size(), 1u) << to_string(diagnostics);
}

TEST(ValuePath, Relations_follow_the_value_and_not_its_spelling) {
  Diagnostics diagnostics;
  const ModelDocument document = *ModelDocument::parse(kRsrrp, "model.toml", diagnostics);
  struct Row {
    const char *first, *second;
    PathRelation relation;
  };
  const Row rows[] = {
      {"link.crank.mass", "link.0.mass", PathRelation::same},
      {"link.crank.mass", "link.1.mass", PathRelation::apart},
      {"gravity.1", "gravity.01", PathRelation::same},
      {"gravity", "gravity.1", PathRelation::contains},
      {"gravity.1", "gravity.2", PathRelation::apart},
      {"closure.S.sde.stiffness", "closure.0.sde.stiffness.x", PathRelation::contains},
      {"closure.S.sde.stiffness.x", "closure.S.sde.stiffness", PathRelation::contained},
      {"closure.S.sde.stiffness.x", "closure.S.sde.stiffness.y", PathRelation::apart},
      {"closure.S.sde.damping.x", "closure.S.sde.damping_ratio", PathRelation::excludes},
      {"closure.*.sde.stiffness", "closure.S.sde.stiffness", PathRelation::same},
      {"joint.R.frame.matrix", "joint.3.frame.rotation", PathRelation::excludes},
      {"joint.R.frame.matrix", "joint.Q.frame.rotation", PathRelation::apart},
      {"link.nobody.mass", "link.crank.mass", PathRelation::apart},
  };
  for (const Row& row : rows) {
    EXPECT_EQ(relation_of(document.tree(), model_schema(), row.first, row.second), row.relation)
        << row.first << " " << row.second;
  }
}

}  // namespace
}  // namespace linkstudy::precedence_test
