#!/usr/bin/env python3
"""Sampled designs and sensitivities as a user meets them, on a body that falls along a guide:
x(T) = x0 + v0 T + g T^2 / 2, which RK4 integrates to rounding, so that shares of the variance and
elementary effects are known in closed form.

usage: designs_test.py LINKSTUDY TREE [options of unittest]
"""

import csv
import io
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import h5py

LINKSTUDY = ""

MODEL = """format = 1
kind = "model"
name = "body on a guide"
gravity = [0.0, 0.0, -2.0]

[[link]]
name = "body"
mass = 1.0
center_of_mass = [0.0, 0.0, 0.0]
inertia = [1.0, 1.0, 1.0]

[[joint]]
name = "P"
type = "prismatic"
parent = "ground"
child = "body"
initial = { position = [0.5], velocity = [1.0] }

[simulation]
end_time = 1.0
step = 0.01
integrator = "rk4"
start = "given"
"""

SPRING = """
[[spring]]
name = "C"
first = { link = "ground", position = [0.0, 0.0, -1.0] }
second = { link = "body", position = [0.0, 0.0, 0.0] }
stiffness = 100.0
damping = 0.0
free_length = 1.0
"""

STUDY = """format = 1
kind = "study"
name = "sensitivities of a fall"
model = "model.toml"
design = { DESIGN }

[[vary]]
parameter = "joint.P.initial.position"
lin = [0.0, 1.0]

[[vary]]
parameter = "joint.P.initial.velocity"
lin = [0.0, 2.0]

[[vary]]
parameter = "gravity.2"
lin = [-4.0, 0.0]

[[vary]]
parameter = "link.body.mass"
log = [0.1, 10.0]

[[response]]
name = "height"
signal = "joint.P.q"
reduce = "last"
"""

STIFF = """format = 1
kind = "study"
name = "stiffness"
model = "model.toml"
design = { type = "saltelli", samples = 32 }

[[vary]]
parameter = "spring.C.stiffness"
log = [1.0e2, 1.0e6]

[[vary]]
parameter = "joint.P.initial.velocity"
lin = [0.0, 2.0]

[[response]]
name = "height"
signal = "joint.P.q"
reduce = "max"
"""

PATHS = ["joint.P.initial.position", "joint.P.initial.velocity", "gravity.2", "link.body.mass"]
SALTELLI = 'type = "saltelli", samples = 512'
MORRIS = 'type = "morris", trajectories = 6'


class Designs(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.write("model.toml", MODEL)

    def path(self, name):
        return Path(self.folder.name, name)

    def write(self, name, text):
        self.path(name).write_text(text)

    def run_program(self, *arguments, ranks=0):
        launch = ["mpirun", "-n", str(ranks), "--oversubscribe", "--bind-to", "none"]
        allowed = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
                   "OMPI_MCA_pml": "ob1"}
        return subprocess.run([*(launch if ranks else []), LINKSTUDY, *map(str, arguments)],
                              capture_output=True, text=True, stdin=subprocess.DEVNULL,
                              cwd=self.folder.name, env=os.environ | allowed)

    def right(self, *arguments, ranks=0):
        done = self.run_program(*arguments, ranks=ranks)
        self.assertEqual(0, done.returncode, done.stderr + done.stdout)
        return done.stdout

    def study(self, design, *options, ranks=0):
        self.write("study.toml", STUDY.replace("DESIGN", design))
        return self.right("study", "study.toml", "-o", "out", "--fresh", *options, ranks=ranks)

    def table(self, name, directory="out"):
        text = self.right("export", directory, "--table", name, "--format", "csv")
        lines = [line for line in text.split("\n") if not line.startswith("#")]
        return list(csv.DictReader(io.StringIO("\n".join(lines))))

    def test_digests_are_the_same_for_any_number_of_ranks(self):
        for design in ('type = "sobol", samples = 40', 'type = "latin_hypercube", samples = 40',
                       'type = "saltelli", samples = 12', MORRIS):
            texts = {self.study(design, ranks=ranks) for ranks in (1, 2, 3)}
            with self.subTest(design=design):
                self.assertEqual(1, len(texts))
                self.assertIn("results digest: ", texts.pop())

    def test_a_plan_lists_the_points_that_are_run(self):
        self.study('type = "latin_hypercube", samples = 12')
        self.right("plan", "study.toml", "--probe", "0", "--csv", "plan.csv")
        ran = self.right("export", "out", "--table", "evaluations", "--format", "csv", "--columns",
                         ",".join(["evaluation", *PATHS]))
        self.assertEqual(self.path("plan.csv").read_text(), ran)
        # And the same points as a list from that file have the same numbers.
        heights = [row["height"] for row in self.table("evaluations")]
        lists = STUDY.split("[[vary]]")[0] + "[[response]]" + STUDY.split("[[response]]")[1]
        self.write("list.toml", lists.replace("DESIGN", 'type = "list", file = "plan.csv"'))
        self.right("study", "list.toml", "-o", "listed")
        self.assertEqual(heights, [row["height"] for row in self.table("evaluations", "listed")])
        self.path("plan.csv").unlink()
        self.right("verify", "listed")  # needs no file

    def test_shares_of_the_variance_are_those_of_the_closed_form(self):
        text = self.study(SALTELLI)
        self.assertIn("height [m]: 512 blocks, mean 0.5", text)
        self.assertIn("link.body.mass: no effect in any block", text)
        rows = {row["parameter"]: row for row in self.table("sensitivity")}
        self.assertEqual(PATHS, list(rows))
        for path, share in zip(PATHS, (1 / 9, 4 / 9, 4 / 9, 0.0)):
            for kind in ("first", "total"):
                # Errors of 512 quasi-random blocks; a random design has 0.05.
                self.assertAlmostEqual(share, float(rows[path][kind]), delta=0.02)
                self.assertLessEqual(float(rows[path][kind + "_low"]), share + 0.01)
                self.assertGreaterEqual(float(rows[path][kind + "_high"]), share - 0.01)
        # Var = (1 + 4 + 4) / 12
        self.assertAlmostEqual(0.75 ** 0.5, float(rows[PATHS[0]]["deviation"]), delta=0.01)
        self.assertEqual("no effect in any block", rows["link.body.mass"]["total_finding"])

    def test_elementary_effects_are_the_slopes(self):
        text = self.study(MORRIS)
        self.assertIn("height [m]: 6 trajectories", text)
        rows = {row["parameter"]: row for row in self.table("sensitivity")}
        for path, slope in zip(PATHS, (1.0, 2.0, 2.0, 0.0)):
            for column in ("mu", "mu_star", "mu_low", "mu_star_high"):
                self.assertAlmostEqual(slope, float(rows[path][column]), delta=1e-9)
            self.assertAlmostEqual(0.0, float(rows[path]["sigma"]), delta=1e-9)

    def test_what_is_told_is_in_json_in_the_file_and_holds_when_judged_anew(self):
        said = json.loads(self.study(MORRIS, "--json"))
        self.assertEqual(30, said["evaluations"])
        height = said["sensitivity"]["quantities"][0]
        self.assertEqual("height", height["name"])
        self.assertEqual(6, height["blocks"])
        self.assertAlmostEqual(2.0, height["parameters"][1]["mu"]["value"], delta=1e-9)
        with h5py.File(self.path("out/results.h5")) as file:
            group = file["sensitivity/sensitivities-of-a-fall".replace("-", "_")]
            stored = group["sensitivity/mu"][:]
        for value, slope in zip(stored, (1.0, 2.0, 2.0, 0.0)):
            self.assertAlmostEqual(slope, value, delta=1e-9)
        self.right("verify", "out")
        # Started again, nothing is run and the answer is the same.
        again = json.loads(self.right("study", "study.toml", "-o", "out", "--json"))
        self.assertEqual(said, again)

    def test_blocks_with_failures_are_left_out_and_the_region_is_told(self):
        self.write("model.toml", MODEL + SPRING)
        self.write("study.toml", STIFF)
        text = self.right("study", "study.toml", "-o", "out")
        self.assertIn("left out for evaluations that failed", text)
        row = self.table("sensitivity")[0]
        self.assertEqual(32, int(row["blocks"]) + int(row["left_out"]))
        self.assertGreater(int(row["left_out"]), 4)
        stiffness = self.table("failures")[0]
        self.assertEqual("spring.C.stiffness", stiffness["parameter"])
        # RK4 holds up to omega h = 2.828: (282.8 / s)^2 kg = 8e4 N/m.
        self.assertGreater(float(stiffness["failed_low"]), 7.0e4)
        self.assertLess(float(stiffness["ok_high"]), 9.0e4)
        self.assertEqual(1.0, float(stiffness["separation"]))
        self.assertLess(float(self.table("failures")[1]["separation"]), 0.5)

    def test_a_small_effect_is_not_told_from_zero_and_the_blocks_that_would_are(self):
        text = self.study('type = "saltelli", samples = 8', "--seed", "3")
        self.assertIn("not distinguishable from 0; about ", text)
        rows = {row["parameter"]: row for row in self.table("sensitivity")}
        found = [row for row in rows.values() if row["first_needed"]]
        self.assertTrue(found)
        for row in found:
            self.assertGreater(float(row["first_needed"]), 8)
            self.assertEqual("not distinguishable from 0", row["first_finding"])

    def test_a_longer_sequence_keeps_the_earlier_rows(self):
        rows = []
        for samples in (8, 13):
            self.study(f'type = "sobol", samples = {samples}')
            rows.append(self.table("evaluations"))
        self.assertEqual(rows[0], rows[1][:8])

    def test_one_parameter_at_a_time_around_the_model(self):
        self.write("study.toml", """format = 1
kind = "study"
model = "model.toml"
design = { type = "centered" }
vary = [
  { parameter = "joint.P.initial.velocity", around = { step = 0.5, steps = 2 } },
  { parameter = "gravity.2", around = { ratio = 2.0, steps = 1 } },
]
response = [{ name = "height", signal = "joint.P.q", reduce = "last" }]
""")
        self.right("study", "study.toml", "-o", "out")
        heights = [float(row["height"]) for row in self.table("evaluations")]
        expected = [0.5, -0.5, 0.0, 1.0, 1.5, 1.0, -0.5]
        self.assertEqual(len(expected), len(heights))
        for one, other in zip(expected, heights):
            self.assertAlmostEqual(one, other, delta=1e-12)


if __name__ == "__main__":
    LINKSTUDY = sys.argv[1]
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
