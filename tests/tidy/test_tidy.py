#!/usr/bin/env python3
"""The checker finds what is planted, where it is planted, and nothing in a tree in order."""

import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
sys.dont_write_bytecode = True
import tidy  # noqa: E402

HEADER = "// Computes nothing.\n#pragma once\n"


class Tidy(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.tree = Path(folder.name)
        self.write("README.md", "# A tree in order\n" + "long " * 40 + "\n")
        self.write(".gitignore", "build*/\n*.h5\n")
        self.write("core/base/real.h", HEADER)
        self.write("core/laws/law.h", HEADER + '#include "core/base/real.h"\n')
        self.write("study/cli/main.cpp", '#include <mpi.h>\n#include "core/laws/law.h"\n')
        self.write("study/store/store.cpp", '#include <hdf5.h>\nint f() {\n  return 1;\n}\n')

    def write(self, path, text):
        (self.tree / path).parent.mkdir(parents=True, exist_ok=True)
        (self.tree / path).write_text(text)

    def problems(self):
        return [(str(path), line, message) for path, line, message in tidy.check_tree(self.tree)]

    def expect(self, path, line, words):
        found = self.problems()
        self.assertEqual([(path, line)], [problem[:2] for problem in found], found)
        self.assertIn(words, found[0][2])

    def test_a_tree_in_order_has_no_problems(self):
        self.assertEqual([], self.problems())

    def test_an_include_of_a_lower_layer_is_found(self):
        self.write("core/base/up.h", HEADER + '#include "core/laws/law.h"\n')
        self.expect("core/base/up.h", 3, "below it")

    def test_the_engine_does_not_include_the_study(self):
        self.write("study/record/record.h", HEADER)
        self.write("core/simulation/run.cpp", '#include "study/record/record.h"\n')
        self.expect("core/simulation/run.cpp", 1, "below it")

    def test_every_neighbour_in_the_order_is_held(self):
        for upper, lower in zip(tidy.LAYERS, tidy.LAYERS[1:]):
            self.write(f"{lower}/probe.h", HEADER)
            self.write(f"{upper}/probe.cpp", f'#include "{lower}/probe.h"\n')
            self.expect(f"{upper}/probe.cpp", 1, "below it")
            self.write(f"{upper}/probe.cpp", "")
            self.write(f"{lower}/probe.cpp", f'#include "{upper}/probe.h"\n')
            self.write(f"{upper}/probe.h", HEADER)
            self.assertEqual([], self.problems())
            for name in (f"{lower}/probe.h", f"{lower}/probe.cpp", f"{upper}/probe.h"):
                (self.tree / name).unlink()

    def test_a_folder_that_is_no_layer_is_found(self):
        self.write("core/misc/thing.cpp", "")
        self.expect("core/misc/thing.cpp", 1, "no layer")

    def test_an_include_relative_to_the_file_is_found(self):
        self.write("core/laws/law.cpp", '#include "law.h"\n')
        self.expect("core/laws/law.cpp", 1, "from the top of the tree")

    def test_headers_that_include_each_other_are_found(self):
        self.write("core/laws/law.h", HEADER + '#include "core/laws/other.h"\n')
        self.write("core/laws/other.h", HEADER + '#include "core/laws/law.h"\n')
        self.expect("core/laws/law.h", 0, "each other")

    def test_a_build_in_another_layer_order_is_found(self):
        order = "\n".join(["numerics", "base"] + tidy.CORE[2:])
        self.write("core/CMakeLists.txt", f"linkstudy_layers(core Eigen3::Eigen {order})\n")
        self.expect("core/CMakeLists.txt", 0, "layers are not those")

    def test_a_library_outside_its_folder_is_found(self):
        for header in ("toml++/toml.h", "mpi.h", "hdf5.h", "hdf5_hl.h", "nlopt.hpp",
                       "boost/numeric/odeint.hpp", "boost/program_options.hpp", "spdlog/spdlog.h",
                       "openssl/evp.h", "immintrin.h"):
            self.write("study/design/probe.cpp", f"#include <vector>\n#include <{header}>\n")
            self.expect("study/design/probe.cpp", 2, header)

    def test_mpi_belongs_to_the_schedule_and_to_main_only(self):
        self.write("study/schedule/transport.cpp", "#include <mpi.h>\n")
        self.assertEqual([], self.problems())
        self.write("study/cli/study.cpp", "#include <mpi.h>\n")
        self.expect("study/cli/study.cpp", 1, "study/cli/main.cpp")

    def test_files_and_printing_in_the_engine_are_found(self):
        self.write("core/laws/law.cpp", "#include <fstream>\n")
        self.expect("core/laws/law.cpp", 1, "study/")
        self.write("core/laws/law.cpp", '#include <cstdio>\nvoid f() { std::printf("1"); }\n')
        self.expect("core/laws/law.cpp", 2, "prints nothing")
        self.write("core/laws/law.cpp", 'void f() { std::snprintf(b, 1, "1"); }\n')
        self.assertEqual([], self.problems())

    def test_a_header_without_its_opening_is_found(self):
        self.write("core/laws/law.h", "#pragma once\n\n#pragma once\n")
        self.expect("core/laws/law.h", 1, "opens with")
        self.write("core/laws/law.h", "// A law.\n")
        self.expect("core/laws/law.h", 1, "pragma once")

    def test_a_line_of_101_characters_is_found(self):
        self.write("jobs/job.sh", "#" * 100 + "\n" + "#" * 101 + "\n")
        self.expect("jobs/job.sh", 2, "101")

    def test_a_file_of_501_lines_is_found(self):
        self.write("tests/long_test.cpp", "\n" * 500)
        self.assertEqual([], self.problems())
        self.write("tests/long_test.cpp", "\n" * 501)
        self.expect("tests/long_test.cpp", 500, "501")

    def test_a_function_of_71_lines_is_found_where_it_begins(self):
        heads = ["int f(int a)", "Model::Model(int a) : a_(a), b_{a}", "TEST(Suite, Name)",
                 "template <class T>\nauto f(T a) -> T", "int A::f() const noexcept"]
        for head in heads:
            lines = head.count("\n") + 2  # the head, and the closing brace
            before = "namespace a {\nclass B { int g() { return 1; } };\nint x = 1;\n\n"
            body = 'g("}{", \'}\');  // }\n' * (70 - lines)
            self.write("tests/long_test.cpp", f"{before}{head} {{\n{body}}}\n}}\n")
            self.assertEqual([], self.problems(), head)
            self.write("tests/long_test.cpp", f"{before}{head} {{\n{body}\n}}\n}}\n")
            self.expect("tests/long_test.cpp", 5, "71")

    def test_a_member_function_is_measured_and_its_class_is_not(self):
        short = "  int g() {\n    return 1;\n  }\n" * 30
        for head in ("class A : public B<C>", "template <int (*f)(int)>\nstruct A"):
            self.write("tests/long_test.cpp", f"{head} {{\n{short}}};\n")
            self.assertEqual([], self.problems())
        body = "    g();\n" * 69
        self.write("tests/long_test.cpp", f"class A {{\n public:\n  void f() {{\n{body}  }}\n}};\n")
        self.expect("tests/long_test.cpp", 3, "71")

    def test_a_table_of_values_is_no_function(self):
        rows = "    {g(1), 2},\n" * 90
        self.write("tests/table.cpp", f"constexpr int kTable[] = {{\n{rows}}};\nint f() {{ }}\n")
        self.assertEqual([], self.problems())

    def test_a_text_inside_a_function_counts_as_one_line(self):
        text = 'R"(' + "{ line }\n" * 90 + ')"'
        self.write("tests/long_test.cpp", f"int f() {{\n  g({text});\n" + "  g();\n" * 67 + "}\n")
        self.assertEqual([], self.problems())
        self.write("tests/long_test.cpp", f"int f() {{\n  g({text});\n" + "  g();\n" * 68 + "}\n")
        self.expect("tests/long_test.cpp", 1, "71")

    def test_a_python_function_of_71_lines_is_found(self):
        self.write("tests/long.py", "def f():\n" + "    g()\n" * 70)
        self.expect("tests/long.py", 1, "71")

    def test_braces_about_one_short_statement_are_found(self):
        self.write("core/laws/a.cpp", "void f() {\n  if (a) {\n    b();\n  }\n}\n")
        self.expect("core/laws/a.cpp", 2, "no braces")

    def test_braces_that_are_needed_stay(self):
        long = "a" * 91
        self.write("core/laws/a.cpp",
                   "void f() {\n  if (a) {\n    b();\n  } else {\n    c();\n  }\n"
                   f"  if (a) {{\n    {long}();\n  }}\n"
                   "  for (int i = 0;\n       i < 3; ++i) {\n    b();\n  }\n"
                   "  if (a) {\n    b();\n    c();\n  }\n}\n")
        self.assertEqual([], self.problems())

    def test_a_constant_without_its_k_is_found(self):
        self.write("core/laws/a.cpp", "constexpr double most = 3.0;\n")
        self.expect("core/laws/a.cpp", 1, "'most' is not named kName")
        self.write("core/laws/a.cpp", "inline constexpr std::array kMost = {1, 2};\n"
                   "template <class T>\ninline constexpr bool is_small = false;\n"
                   "constexpr double square(double x) {\n  return x * x;\n}\n")
        self.assertEqual([], self.problems())

    def test_tests_in_a_file_of_another_name_are_found(self):
        self.write("tests/laws/test_law.cpp", "TEST(Law, Holds) {}\n")
        self.expect("tests/laws/test_law.cpp", 0, "*_test.cpp")

    def test_a_mark_left_over_is_found(self):
        for mark in ("TO" + "DO", "FIX" + "ME", "XX" + "X", "<" * 7 + " ours", ">" * 7 + " theirs"):
            comment = "# " if mark[0].isalpha() else ""
            self.write("jobs/job.sh", f"true\n{comment}{mark}\n")
            self.expect("jobs/job.sh", 2, "left over")

    def test_a_path_of_a_machine_is_found(self):
        for folder in tidy.FOLDERS:
            harmless = f"cat relative/{folder}/x $A/{folder}/x"
            self.write("jobs/job.sh", f"{harmless}\ncat \"/{folder}/x\"\n")
            self.expect("jobs/job.sh", 2, "absolute path")

    def test_a_stranger_at_the_top_is_found(self):
        self.write("notes.txt", "")
        self.expect("notes.txt", 0, "at the top")

    def test_a_name_that_is_not_snake_case_is_found(self):
        for name in ("tests/CamelCase.cpp", "tests/with-dash.sh", "configs/Old/a.toml"):
            self.write(name, "")
            self.expect(name, 0, "snake_case")
            (self.tree / name).unlink()

    def test_what_git_ignores_is_left_alone(self):
        self.write("build-x/core/base/Bad-name.cpp", '#include "study/cli/run.h"\n')
        self.write("results.h5", "")
        self.assertEqual([], self.problems())


if __name__ == "__main__":
    unittest.main()
