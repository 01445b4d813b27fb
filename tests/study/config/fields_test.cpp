// One statement for each key and each word: defaults are those of the records, words read and write
// back, and a resolved input holds every default and says the same again.
#include "study/config/fields.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "config_text.h"
#include "core/simulation/cause.h"
#include "core/topology/nearest_name.h"
#include "study/config/beam_section.h"
#include "study/config/fill.h"
#include "study/config/model_keys.h"
#include "study/config/study_input.h"
#include "study/config/toml_reader.h"
#include "study/config/toml_writer.h"
#include "study/config/validate.h"
#include "tests/support/source_file.h"

namespace linkstudy::fields_test {
namespace {

namespace fs = std::filesystem;

// A record of the keys of a table that says nothing but `text`.
template <class Record>
Record read_table(const Fields<Record>& fields, const std::string& text) {
  const KeyNode schema = make_schema(fields.rows());
  Diagnostics diagnostics;
  Tree table = *parse_toml(text, "table.toml", diagnostics);
  validate(table, schema, diagnostics);
  Record record;
  fill_record(&record, table, schema, diagnostics);
  EXPECT_TRUE(diagnostics.empty()) << to_string(diagnostics);
  return record;
}

TEST(Fields, A_table_that_says_nothing_fills_a_record_as_it_is_made) {
  EXPECT_EQ(read_table(simulation_fields(), ""), SimulationOptions{});
  EXPECT_EQ(read_table(kinematics_fields(), ""), KinematicsOptions{});
  EXPECT_EQ(read_table(contact_fields(), ""), Clearance{});
  EXPECT_EQ(read_table(frame_fields(), ""), Frame{});
  const Friction law = read_table(friction_fields(), "mu_s = 0.2\nmu_k = 0.1\nsigma0 = 1e5");
  EXPECT_EQ(law, (Friction{.mu_s = 0.2, .mu_k = 0.1, .sigma0 = 1e5}));
}

struct Settings {
  double small = 1.7e-5;
  double large = 2.07e11;
  double third = 1.0 / 3.0;
  double none = 0.0;
  long count = 100'000'000;
  bool flag = true;
  ClosureModel model = ClosureModel::sde;
  std::string title = "as it is";
  Eigen::Vector3d place = {0.1, -2.0e-7, 3.0};
  Eigen::Matrix3d matrix = 7.0 * Eigen::Matrix3d::Identity();
  std::optional<double> open;

  bool operator==(const Settings&) const = default;
};

Fields<Settings> settings_fields() {
  Fields<Settings> fields;
  fields.add("small", &Settings::small, {});
  fields.add("large", &Settings::large, {});
  fields.add("third", &Settings::third, {});
  fields.add("none", &Settings::none, {});
  fields.add("count", &Settings::count, {});
  fields.add("flag", &Settings::flag, {});
  fields.add("model", &Settings::model, {});
  fields.add("title", &Settings::title, {});
  fields.add("place", &Settings::place, {});
  fields.add("matrix", &Settings::matrix, {});
  fields.add("open", &Settings::open, {});
  return fields;
}

// The default that is shown, read as if the user had written it, changes no bit.
TEST(Fields, The_default_that_is_shown_is_the_one_of_the_member_to_the_last_bit) {
  const Fields<Settings> fields = settings_fields();
  std::string written;
  for (const KeyRow& row : fields.rows()) {
    if (!row.standard.empty()) written += row.path + " = " + row.standard + "\n";
  }
  EXPECT_THAT(written, ::testing::HasSubstr("small = 1.7e-5\nlarge = 2.07e11\nthird = 0.333"));
  EXPECT_THAT(written, ::testing::HasSubstr("count = 100000000\nflag = true\nmodel = \"sde\"\n"));
  EXPECT_THAT(written, ::testing::Not(::testing::HasSubstr("open")));
  EXPECT_EQ(read_table(fields, ""), Settings{});
  EXPECT_EQ(read_table(fields, written), Settings{});
  EXPECT_EQ(read_table(fields, "open = 2.0\nmodel = \"cut\"").open, 2.0);
}

TEST(Fields, A_default_beside_that_of_the_member_is_refused) {
  Fields<Settings> fields;
  EXPECT_THROW(fields.add("small", &Settings::small, {.standard = "1.0"}), std::logic_error);
}

TEST(Fields, Keys_of_a_part_fill_the_part_of_the_whole) {
  const Fields<Joint> joint = joint_fields();
  const Joint read = read_table(
      joint,
      "name = \"A\"\ntype = \"revolute\"\nparent = \"ground\"\nchild = \"c\"\nfriction = { mu_s = "
      "0.3, mu_k = 0.2, sigma0 = 1e5, radius = 0.01 }\nchild_frame.position = [1, 2, 3]");
  ASSERT_TRUE(read.friction);
  EXPECT_EQ(read.friction->law.mu_s, 0.3);
  EXPECT_EQ(read.friction->radius, 0.01);
  EXPECT_EQ(read.frame, Frame{});
  EXPECT_EQ(read.child_frame.position, Eigen::Vector3d(1, 2, 3));
}

template <class E>
class WordsOf : public ::testing::Test {};

using Enumerations =
    ::testing::Types<ContactLaw, ApproachSpeed, JointType, RotationCoordinates, ClosureModel,
                     Stabilization, SdeForm, SdeAxes, TiltMeasure, SdeStart, ClearanceKind,
                     FreeBristle, ContactPoints, CourseShape, ResistanceShape, Integrator,
                     RedundantReactions, Start, MotionLaw, Cause, SectionShape, LoadKind, FileKind,
                     Design, ErrorNorm, ErrorScale, Reduction, FailurePolicy>;
TYPED_TEST_SUITE(WordsOf, Enumerations);

TYPED_TEST(WordsOf, Every_enumerator_is_written_as_a_default_and_read_back) {
  for (std::size_t i = 0; i < kWords<TypeParam>.size(); ++i) {
    const auto value = static_cast<TypeParam>(i);
    ASSERT_TRUE(is_legal_name(name_of(value))) << name_of(value);
    EXPECT_EQ(standard_of(value), "\"" + std::string(name_of(value)) + "\"");
    TypeParam read{};
    set_member(read, Tree::make_text(std::string(name_of(value))));
    EXPECT_EQ(read, value) << name_of(value);
  }
}

// Every switch that a row names, and every word that it may hold, exists.
TEST(Fields, Conditions_and_effects_name_words_of_their_switches) {
  for (const Word<FileKind>& kind : kWords<FileKind>) {
    const auto* rows = &key_rows(kind.value);
    const auto find_row = [&](const std::string& path) -> const KeyRow* {
      const auto found = std::ranges::find(*rows, path, &KeyRow::path);
      return found == rows->end() ? nullptr : &*found;
    };
    const auto expect_words = [&](const KeyRow& row, const std::string& key,
                                  const std::vector<std::string>& words) {
      const KeyRow* of = find_row(key);
      ASSERT_NE(of, nullptr) << row.path << " depends on " << key;
      if (of->type != KeyType::word) return;
      EXPECT_THAT(of->words, ::testing::IsSupersetOf(words)) << key;
    };
    for (const KeyRow& row : *rows) {
      const std::string table = row.path.substr(0, row.path.rfind('.') + 1);
      if (!row.only.key.empty()) expect_words(row, table + row.only.key, row.only.words);
      for (const Effect& effect : row.effects) {
        if (effect.key != "verb") expect_words(row, effect.key, effect.words);
      }
    }
  }
}

// Of every table that is there, each key with a default is there, unless another one of its group
// is or its condition does not hold.
void expect_defaults(const Tree& table, const KeyNode& node, const std::string& path) {
  for (const KeyNode& child : node.children) {
    const Tree* value = table.find(child.name);
    const auto is_other = [&](const KeyNode& other) {
      return !child.row.group.empty() && other.row.group == child.row.group &&
             table.find(other.name) != nullptr;
    };
    const Tree* state = table.find(child.row.only.key);
    const bool applies =
        child.row.only.key.empty() ||
        (state != nullptr && std::ranges::count(child.row.only.words, state->text));
    const bool is_due = child.standard && applies && std::ranges::none_of(node.children, is_other);
    EXPECT_TRUE(!is_due || value != nullptr) << path << child.name;
    if (value == nullptr) continue;
    if (child.row.type == KeyType::tables) {
      for (const Tree& item : value->items) {
        expect_defaults(item, *child.element(), path + child.name + ".");
      }
    } else if (value->is(Tree::Kind::table)) {
      expect_defaults(*value, child, path + child.name + ".");
    }
  }
}

std::vector<fs::path> files_in(const std::string& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(linkstudy::testing::source_file(folder))) {
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  }
  EXPECT_FALSE(files.empty()) << folder;
  return files;
}

ModelInput read_model_text(const std::string& text) {
  Diagnostics diagnostics;
  const std::optional<ModelInput> input = test::read_text(text, diagnostics);
  EXPECT_TRUE(input) << to_string(diagnostics);
  return input.value_or(ModelInput{});
}

TEST(Resolved, Every_model_of_ours_holds_all_defaults_and_reads_back_to_the_same_records) {
  for (const fs::path& file : files_in("configs/mechanisms")) {
    Diagnostics diagnostics;
    const auto document = ModelDocument::load(file, diagnostics);
    ASSERT_TRUE(document) << to_string(diagnostics);
    const std::optional<ModelInput> input = document->with({}, diagnostics);
    ASSERT_TRUE(input) << to_string(diagnostics);
    expect_defaults(input->resolved, model_schema(), file.stem().string() + ": ");
    const ModelInput again = read_model_text(write_toml(input->resolved));
    EXPECT_TRUE(again.linkage == input->linkage) << file;
    EXPECT_TRUE(again.rigid == input->rigid) << file;
    EXPECT_TRUE(again.options == input->options) << file;
    EXPECT_TRUE(again.kinematics == input->kinematics) << file;
    EXPECT_TRUE(equal_content(again.resolved, input->resolved)) << file;
  }
}

TEST(Resolved, Every_study_of_ours_holds_all_defaults_and_reads_back_to_itself) {
  const fs::path copy = fs::path(::testing::TempDir()) / "linkstudy_resolved";
  fs::create_directories(copy / "studies");
  for (const char* folder : {"mechanisms", "data"}) {
    fs::copy(linkstudy::testing::source_file(fmt::format("configs/{}", folder)), copy / folder,
             fs::copy_options::recursive | fs::copy_options::overwrite_existing);
  }
  for (const fs::path& file : files_in("configs/studies")) {
    Diagnostics diagnostics;
    const std::optional<StudyInput> input = read_study(file, {}, diagnostics);
    ASSERT_TRUE(input) << to_string(diagnostics);
    expect_defaults(input->resolved, key_schema(input->kind), file.stem().string() + ": ");
    const std::string text = write_toml(input->resolved);
    const fs::path written = copy / "studies" / file.filename();
    std::ofstream(written) << text;
    const std::optional<StudyInput> again = read_study(written, {}, diagnostics);
    ASSERT_TRUE(again) << to_string(diagnostics);
    EXPECT_EQ(write_toml(again->resolved), text) << file;
    EXPECT_EQ(again->match.size(), input->match.size());
    EXPECT_EQ(again->vary.size(), input->vary.size());
  }
}

}  // namespace
}  // namespace linkstudy::fields_test
