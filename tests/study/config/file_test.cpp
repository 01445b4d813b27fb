// Files that are no inputs, several errors at once, what is not reported twice.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>

#include "config_text.h"
#include "study/config/check_file.h"
#include "study/config/toml_reader.h"

namespace linkstudy::file_test {
namespace {

using test::kRsrrp;
using test::read_text;
using test::replaced;
using test::write_file;
using ::testing::HasSubstr;

Diagnostic the_only_error(const std::string& path) {
  const std::vector<Diagnostic> found = check_file(path);
  EXPECT_EQ(found.size(), 1u) << path;
  return found.empty() ? Diagnostic{} : found.front();
}

TEST(File, A_right_model_has_no_errors) {
  EXPECT_TRUE(check_file(write_file("good.toml", kRsrrp)).empty());
  EXPECT_TRUE(check_file(write_file("bom.toml", "\xEF\xBB\xBF" + kRsrrp)).empty());
}

TEST(File, A_missing_file_is_named) {
  const Diagnostic d = the_only_error("no/such/model.toml");
  EXPECT_EQ(to_string(d),
            "no/such/model.toml: error: the file cannot be opened: No such file or directory\n"
            "    check its name and its permissions");
}

TEST(File, A_directory_is_no_input) {
  const std::string folder = std::filesystem::path(write_file("x", "")).parent_path();
  EXPECT_THAT(the_only_error(folder).message, HasSubstr("got a directory"));
  EXPECT_THAT(the_only_error("/").message, HasSubstr("got a directory"));
}

TEST(File, Unreadable_paths_are_errors) {
  const std::string path = write_file("plain.toml", kRsrrp);
  EXPECT_THAT(the_only_error(path + "/inner.toml").message, HasSubstr("Not a directory"));
  EXPECT_THAT(the_only_error(std::string(5000, 'x')).message, HasSubstr("name too long"));
  const std::string loop = path + ".loop";
  std::filesystem::remove(loop);
  std::filesystem::create_symlink(loop, loop);
  EXPECT_THAT(the_only_error(loop).message, HasSubstr("symbolic links"));
  if (geteuid() == 0) return;  // permissions do not bind the superuser
  chmod(path.c_str(), 0);
  EXPECT_THAT(the_only_error(path).message, HasSubstr("Permission denied"));
}

TEST(File, Empty_files_are_errors) {
  for (const char* text : {"", " \n\t\r\n"}) {
    const Diagnostic d = the_only_error(write_file("empty.toml", text));
    EXPECT_EQ(d.message, "the file is empty");
    EXPECT_EQ(d.line, 1);
  }
  EXPECT_EQ(the_only_error(write_file("comment.toml", "# nothing\n")).message, "kind is missing");
}

TEST(File, Huge_files_are_refused_before_they_are_read_as_text) {
  const std::string path = write_file("huge.toml", kRsrrp);
  std::filesystem::resize_file(path, kLargestInput + 1);
  EXPECT_EQ(the_only_error(path).message, "the file is larger than 16 MiB");
  EXPECT_EQ(the_only_error("/dev/zero").message, "the file is larger than 16 MiB");
}

TEST(File, Binary_junk_is_an_error_with_a_place) {
  const Diagnostic elf = the_only_error(write_file("junk.toml",
                                                   "ok = 1\n\x7F"
                                                   "ELF\x02\xFF\xFE"));
  EXPECT_EQ(elf.line, 2);
  EXPECT_EQ(elf.column, 6);
  EXPECT_THAT(elf.message, HasSubstr("got byte 0xFF"));
  const std::string zeros(1000, '\0');
  EXPECT_THAT(the_only_error(write_file("zeros.toml", zeros)).message, HasSubstr("not TOML"));
}

// Whatever walks a tree goes down by recursion.
TEST(File, Deep_nesting_is_an_error_with_a_place_and_no_crash) {
  std::string names = "a";
  for (int i = 0; i < 1000000; ++i) names += ".a";
  const std::pair<std::string, int> texts[] = {{"\na = " + std::string(1000000, '['), 69},
                                               {"\n" + names + " = 1\n", 128},
                                               {"\n[" + names + "]\n", 129},
                                               {"\na = {" + names + " = 1}\n", 133},
                                               {"\n\"a\" . 'b' . " + names + " = 1\n", 136}};
  for (const auto& [text, column] : texts) {
    const Diagnostic error = the_only_error(write_file("deep.toml", text));
    EXPECT_THAT(error.message, HasSubstr("more than 64"));
    EXPECT_EQ(error.line, 2) << text.substr(0, 20);
    EXPECT_EQ(error.column, column) << text.substr(0, 20);
  }
}

// Dots and brackets in strings and comments are no depth, wherever a string ends.
TEST(File, Strings_and_comments_may_hold_anything) {
  const char* const texts[] = {"# @",
                               "a = \"@\"",
                               "a = '@'",
                               R"(a = "\"@")",
                               "a = \"\"\"\n\"@\"\"\"",
                               R"(a = """""" # @)",
                               "a = '''\n''@'''''",
                               R"(a = ["", '@'] # ')",
                               R"("@" = "")",
                               "a = \"\"\"\\\n   @\"\"\"\"\" # \"@"};
  const std::string many = "\u00e9" + std::string(100, '.') + std::string(100, '[') + "\u00e9";
  for (const char* pattern : texts) {
    std::string text = std::string(pattern) + "\nb = [1.5, 2.5]\n";
    for (std::size_t at; (at = text.find('@')) != std::string::npos;) text.replace(at, 1, many);
    Diagnostics diagnostics;
    EXPECT_TRUE(parse_toml(text, "text.toml", diagnostics)) << text << to_string(diagnostics);
  }
}

TEST(File, Columns_count_characters_not_bytes) {
  const std::string path =
      write_file("umlaut.toml", "format = 1\nkind = \"model\"\nname = \"\u00E9\u00E9\"; x\n");
  EXPECT_EQ(the_only_error(path).line, 3);
  EXPECT_EQ(the_only_error(path).column, 12);
}

TEST(File, The_printed_form_is_a_compilers) {
  Diagnostics diagnostics;
  read_text(replaced(kRsrrp, "name = \"crank\"\nmass = 1.0", "name = \"crank\"\nmass = -1"),
            diagnostics);
  EXPECT_EQ(to_string(diagnostics),
            "model.toml:8:8: error: link 'crank': mass must be positive, got -1 kg\n    mass: a "
            "number > 0 kg\n");
}

TEST(File, All_errors_come_in_one_pass_in_the_order_of_the_file) {
  std::string text = replaced(kRsrrp, "gravity = [0.0, -9.81, 0.0]", "gravity = 9.81");
  text = replaced(text, "mass = 2.0", "mass = \"2 m\"");
  text = replaced(text, "parent = \"slider\"", "parent = \"slidr\"");
  text = replaced(text, "integrator = \"rk4\"", "integrater = \"rk4\"");
  text = replaced(text, "duration = 5.0", "duration = -5.0");
  Diagnostics diagnostics;
  EXPECT_FALSE(read_text(text, diagnostics));
  const std::vector<Diagnostic> found = diagnostics.sorted();
  std::vector<std::pair<int, int>> places;
  for (const Diagnostic& d : found) places.emplace_back(d.line, d.column);
  EXPECT_THAT(places, ::testing::ElementsAre(std::pair(4, 11), std::pair(14, 8), std::pair(47, 10),
                                             std::pair(72, 53), std::pair(83, 1)))
      << to_string(diagnostics);
}

// A value that was reported is not reported again by what depends on it.
TEST(File, One_mistake_gives_one_error) {
  const std::pair<const char*, const char*> mistakes[] = {
      {"name = \"yoke\"", "name = 7"},        // joints Q and R name it
      {"name = \"yoke\"", "nam = \"yoke\""},  // two: unknown and missing
      {"mass = 1.5", "mass = []"},            // link coupler stays known
      {"name = \"Q\"\ntype = \"revolute\"", "name = \"Q\"\ntype = \"hinge\""},
      {"name = \"A\"\ntype = \"revolute\"", "name = \"A\"\ntype = \"fix\""},  // loads on A
      {"parent = \"yoke\"", "parent = 1"},
      {"child = \"crank\"", "child = \"\""},
      {"type = \"torque\"", "type = \"tork\""},
      {"type = \"spherical\"", "type = 1"},
      {"inertia = [0.03125, 1.0e-4, 0.03125]", "inertia = \"x\""},
      {"law = {", "law = 1 #{"},
      {"frame.position = [0.05, 0.0, 0.0]", "frame = 1"},
      {"initial.position = [\"25 cm\"]", "initial = 1"},
      {"end_time = 15.0", "end_time = -15.0"},
      {"first  = {", "first = 1 # {"},
  };
  for (const auto& [from, to] : mistakes) {
    Diagnostics diagnostics;
    EXPECT_FALSE(read_text(replaced(kRsrrp, from, to), diagnostics)) << to;
    const std::size_t expected = std::string(to).starts_with("nam =") ? 2 : 1;
    EXPECT_EQ(diagnostics.sorted().size(), expected) << to << "\n" << to_string(diagnostics);
  }
}

}  // namespace
}  // namespace linkstudy::file_test
