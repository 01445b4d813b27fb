#!/usr/bin/env python3
"""statics and kinematics kept as results with -o: what is stored is what was printed, the directory
is protected, verify and export work on it, and the report shows it.

usage: model_results_test.py LINKSTUDY TREE [options of unittest]
"""

import csv
import json
import math
import os
import shutil
import subprocess
import sys
from pathlib import Path

import h5py

from page_seen import Given, PageTest, island_of, run

# Gravity leans by 20 deg towards the rail x: 9.81 sin 20 and 9.81 cos 20, m/s^2.
ALONG, ACROSS = 3.3552176060248105, 9.218384609909762
MASS = 2.0
INCLINE = f"""format = 1
kind = "model"
name = "block on incline"
gravity = [{ALONG}, 0.0, -{ACROSS}]

[[link]]
name = "block"
mass = {MASS}
center_of_mass = [0.0, 0.0, 0.0]
inertia = [0.01, 0.01, 0.01]

[[joint]]
name = "P"
type = "prismatic"
parent = "ground"
child = "block"
frame = {{ rotation = {{ axis = [0, 1, 0], angle = "90 deg" }} }}
child_frame = {{ rotation = {{ axis = [0, 1, 0], angle = "90 deg" }} }}
initial = {{ hold = HOLD }}

[simulation]
end_time = 0.1
step = 1.0e-4
"""


def table(results, name="summary"):
    return json.loads(run("export", results, "--table", name, "--format", "json").stdout)["rows"]


def digest_of(text):
    return text.split("results digest: ")[1].split()[0]


class ModelResults(PageTest):
    def incline(self, hold="true"):
        path = Path(self.folder.name) / "incline.toml"
        path.write_text(INCLINE.replace("HOLD", hold))
        return path

    def test_a_course_is_kept_and_shown_as_it_was_printed(self):
        printed = Path(self.folder.name) / "positions.csv"
        self.analyse("kinematics", "four_bar_double_rocker", "--csv", printed)
        stored = run("export", self.results, "--traces", "--format", "csv").stdout
        rows = list(csv.reader(line for line in stored.splitlines() if not line.startswith("#")))
        lone = list(csv.reader(line for line in printed.read_text().splitlines()
                               if not line.startswith("#")))
        self.assertEqual([row[1:] for row in rows], lone)  # before them stands the run
        text = self.ran.stdout.replace("\n" + 13 * " ", " ")  # what goes on in the next line
        said = dict(line.split(None, 1) for line in text.splitlines())
        found = table(self.results)
        self.assertEqual([row["text"] for row in found if row["finding"] == "verdict"],
                         [said["verdict"]])
        page = self.report()
        data = self.check_tables(page)
        seen = self.check_shown(page, charts=5)
        self.assertIn(f"kinematics: done: {said['verdict']}", seen["text"])
        self.assertIn("joint.A.q = ", seen["scene"]["middle"])
        self.assertEqual(data["digest"], digest_of(self.ran.stdout))
        self.assertTrue(any("over joint.A.q" in canvas["label"] for canvas in seen["canvases"]))
        self.assertEqual(run("verify", self.results).returncode, 0)

    def test_locks_are_marked_where_the_triangle_of_the_four_bar_closes_last(self):
        self.analyse("kinematics", "four_bar_double_rocker")
        least, greatest = sorted(mark["at"]["joint.A.q"] for mark in
                                 island_of(self.report())["marks"])
        # Crank 0.25 m, ground 0.4 m, coupler and rocker in one line of 0.2 + 0.25 m.
        angle = math.acos((0.25 ** 2 + 0.4 ** 2 - 0.45 ** 2) / (2 * 0.25 * 0.4))
        # At a lock the angle is of second order in what is left open, 1e-9: off by its root.
        self.assertAlmostEqual(greatest, angle, delta=1e-4)
        self.assertAlmostEqual(least, -angle, delta=1e-4)

    def test_mobility_and_conditioning_stand_at_every_position(self):
        self.analyse("kinematics", "planar_two_loop")
        rows = table(self.results, "traces")
        self.assertGreater(len(rows), 50)
        self.assertEqual({row["mobility"] for row in rows}, {1.0})
        numbers = table(self.results, "evaluations")[0]
        self.assertEqual((numbers["mobility"], numbers["kutzbach"], numbers["loops"]), (1, -5, 2))
        for loop in table(self.results, "loops"):
            along = [row[f"{loop['cut']}.conditioning"] for row in rows]
            self.assertEqual(min([*along, loop["conditioning"]]), loop["least_conditioning"])
        # Along the course the transmission is never better than it says at its worst.
        self.assertLessEqual(numbers["least_quality"], min(row["quality"] for row in rows))

    def test_an_equilibrium_is_kept_and_shown_with_its_reactions(self):
        self.analyse("statics", self.incline())
        values = {row["quantity"]: (row["value"], row["unit"])
                  for row in table(self.results, "equilibrium")}
        # Forces are solved for to 1e-9 of their size.
        self.assertAlmostEqual(values["joint.P.force.z"][0], MASS * ACROSS, delta=1e-8)
        self.assertAlmostEqual(values["joint.P.hold"][0], -MASS * ALONG, delta=1e-8)
        self.assertEqual(values["joint.P.force.z"][1], "N")
        page = self.report()
        data = self.check_tables(page)
        seen = self.check_clean(page)
        self.assertEqual(seen["scene"]["before"], "equilibrium")
        self.assertIn("statics: done: ", seen["text"])
        self.assertIn("joint.P.force.z", seen["text"])
        self.assertEqual(len(data["mechanisms"]), 1)
        self.assertEqual(data["panels"], [])
        self.assertEqual(run("verify", self.results).returncode, 0)

    def test_no_equilibrium_is_a_result_with_its_cause(self):
        self.analyse("statics", self.incline("false"), code=3)
        self.assertIn("statics_failed", self.ran.stderr)
        page = self.report()
        self.check_tables(page)
        seen = self.check_clean(page)
        self.assertIn("statics: failed: ", seen["text"])
        self.assertIn("1 statics_failed", seen["text"])
        status = json.loads(run("status", self.results, "--json").stdout)
        self.assertEqual((status["state"], status["failed"]), ("complete", {"statics_failed": 1}))
        self.assertEqual(run("verify", self.results).returncode, 0)

    def test_drives_that_contradict_each_other_are_a_result_with_its_cause(self):
        self.analyse("kinematics", "four_bar", "--drive", "joint.A=0:1", "--drive", "joint.B=0:1",
                     code=3)
        self.assertEqual(table(self.results, "evaluations")[0]["status"], "course_blocked")
        seen = self.check_clean(self.report())
        self.assertIn("kinematics: failed: ", seen["text"])
        self.assertEqual(run("verify", self.results).returncode, 0)

    def test_a_directory_is_kept_unless_told_otherwise(self):
        self.analyse("kinematics", "four_bar", "--positions", "20")
        first = digest_of(self.ran.stdout)
        self.analyse("kinematics", "four_bar", "--positions", "20")
        self.assertEqual(digest_of(self.ran.stdout), first)
        self.assertEqual([row["event"] for row in table(self.results, "provenance")],
                         ["start", "resume"])
        before = (self.results / "results.h5").read_bytes()
        for options in (["kinematics", "four_bar", "--positions", "21"],
                        ["kinematics", "four_bar", "--positions", "20", "-s", "gravity=[0,0,0]"],
                        ["statics", "four_bar"]):
            self.analyse(*options, code=2)
            self.assertIn("holds a study of another input (of linkstudy kinematics",
                          self.ran.stderr)
            self.assertIn("--fresh", self.ran.stderr)
            self.assertEqual((self.results / "results.h5").read_bytes(), before)
        study = Given.tree / "configs" / "studies" / "rsrrp_stiffness.toml"
        refused = run("study", study, "-o", self.results, "--progress", "none")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("of linkstudy kinematics", refused.stderr)
        self.analyse("kinematics", "four_bar", "--positions", "21", "--fresh")
        self.assertEqual(len(table(self.results, "traces")), 21)
        alone = run("statics", self.incline(), "--fresh")
        self.assertEqual(alone.returncode, 2)
        self.assertIn("--fresh goes with -o DIR", alone.stderr)

    def test_what_these_results_do_not_have_is_said(self):
        self.analyse("statics", self.incline())
        for options, message in ((["--figure", "errors"], "have nothing of it"),
                                 (["--table", "loops"], "hold no closed loop"),
                                 (["--traces"], "hold no time histories"),
                                 (["--table", "tuning"], "only a tune")):
            refused = run("export", self.results, *options, cwd=self.folder.name)
            self.assertEqual(refused.returncode, 2, options)
            self.assertIn(message, refused.stderr)
        refused = run("report", self.results, "--evaluation", "3")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("hold no such evaluation", refused.stderr)

    def test_a_number_that_was_changed_is_found(self):
        self.analyse("kinematics", "four_bar", "--positions", "20")
        for group, name in (("study", "least_quality"), ("traces/evaluation_0", "joint.B.q"),
                            ("kinematics/*/loops", "least_conditioning")):
            changed = Path(self.folder.name) / "changed.h5"
            shutil.copy(self.results / "results.h5", changed)
            self.assertEqual(run("verify", changed).returncode, 0)
            with h5py.File(changed, "r+") as file:
                place = file
                for part in group.split("/"):
                    place = next(iter(place.values())) if part == "*" else place[part]
                column = next(one for key, one in place.items()
                              if name in (key, one.attrs.get("path")))
                column[1 if len(column) > 1 else 0] += 1e-12
            found = run("verify", changed)
            self.assertEqual(found.returncode, 4, f"{group} {name}: {found.stdout}")
            self.assertIn("table loops" if "*" in group else name, found.stdout)

    def test_another_instruction_set_agrees_to_rounding(self):
        for verb, agrees in (("statics", "to rounding"), ("kinematics", "to the last bit")):
            self.analyse(verb, "four_bar", "--fresh")
            environment = {**os.environ, "LINKSTUDY_SIMD": "baseline"}
            again = subprocess.run([Given.program, "verify", self.results], capture_output=True,
                                   text=True, env=environment, stdin=subprocess.DEVNULL)
            self.assertEqual(again.returncode, 0, again.stdout + again.stderr)
            if "avx" in run("--version").stdout:
                self.assertIn(f"all agree {agrees}", again.stdout)


if __name__ == "__main__":
    Given.main(sys.argv)
