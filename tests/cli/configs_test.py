#!/usr/bin/env python3
"""Every file in configs/ is right, runs (shortened), and is described.

usage: configs_test.py LINKSTUDY TREE [options of unittest]
"""

import json
import re
import subprocess
import sys
import tempfile
import tomllib
import unittest
from pathlib import Path

END = 0.05  # s
LINKSTUDY = ""
TREE = Path()


def run(*arguments):
    command = [LINKSTUDY, *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, stdin=subprocess.DEVNULL)


def files_in(folder):
    return sorted((TREE / "configs" / folder).glob("*.toml"))


def shortened(path):
    """Options that run a study over END instead of its own time."""
    options = ["-s", f"simulation.end_time={END}"]
    study = tomllib.loads(path.read_text())
    if any("cycle" in entry for entry in study.get("match", []) + study.get("response", [])):
        return []  # it has to turn once; such a study is short
    for table in ("match", "response", "series", "experiment"):
        for position, entry in enumerate(study.get(table, [])):
            if table in ("match", "experiment") or "window" in entry:
                options += ["-s", f"{table}.{position}.window=[{END / 5}, {END}]"]
    return options


class Configs(unittest.TestCase):
    def test_there_are_mechanisms_and_studies(self):
        self.assertGreaterEqual(len(files_in("mechanisms")), 19)
        self.assertGreaterEqual(len(files_in("studies")), 12)

    def test_every_file_is_right(self):
        done = run("check", *files_in("mechanisms"), *files_in("studies"))
        self.assertEqual((0, ""), (done.returncode, done.stderr))

    def test_every_file_opens_with_what_to_look_at_and_how_to_run_it(self):
        for path in files_in("mechanisms") + files_in("studies"):
            head = path.read_text().split("\n\n")[0]
            for words in ("Source:", "Look at:", "linkstudy ", f"{path.parent.name}/{path.name}"):
                self.assertIn(words, head, path.name)

    def test_every_mechanism_runs_with_every_closure_model(self):
        for path in files_in("mechanisms"):
            closures = tomllib.loads(path.read_text()).get("closure", [])
            real = closures and all("clearance" in closure for closure in closures)
            for model in ("cut", "sde", *(("clearance",) if real else ())) if closures else ("",):
                options = [text for closure in closures
                           for text in ("-s", f"closure.{closure['name']}.model={model}")]
                with self.subTest(file=path.name, model=model):
                    done = run("simulate", path, "-s", f"simulation.end_time={END}", *options)
                    self.assertEqual(0, done.returncode, done.stderr)

    def test_every_part_of_a_real_joint_or_link_is_switched_by_one_word(self):
        for path in files_in("mechanisms"):
            model = tomllib.loads(path.read_text())
            words = [f"link.{link['name']}.flexible.enabled={word}"
                     for link in model["link"] if "flexible" in link for word in ("true", "false")]
            for closure in model.get("closure", []):
                name = closure["name"]
                if "friction" in closure:
                    words.append(f"closure.{name}.friction.enabled=false")
                if "length" in closure.get("clearance", {}):
                    words += [f"closure.{name}.clearance.kind={kind}"
                              for kind in ("planar", "spatial")]
            for word in words:
                with self.subTest(file=path.name, word=word):
                    done = run("simulate", path, "-s", f"simulation.end_time={END}", "-s", word)
                    self.assertEqual(0, done.returncode, done.stderr)

    def test_the_same_linkage_cut_elsewhere_moves_the_same(self):
        def crank_angles(name, *options):
            done = run("simulate", TREE / "configs" / "mechanisms" / name, "-s",
                       "simulation.end_time=2", "-s", "simulation.output_interval=0.01", "--csv",
                       "-", "--signals", "joint.A.q,joint.P.q", *options)
            self.assertEqual(0, done.returncode, done.stderr)
            lines = done.stdout.split("\n")[2:-1]
            return [[float(text) for text in line.split(",")] for line in lines]

        rsrrp = crank_angles("rsrrp.toml", "-s", "load.drive.course.duration=2", "-s",
                             "closure.S.cut={ stabilization = \"projection\" }")
        rsup = crank_angles("rsup.toml", "-s", "closure.R.cut={ stabilization = \"projection\" }")
        self.assertEqual(201, len(rsup))
        self.assertGreater(rsup[-1][1], 6.0)  # the crank has turned
        for one, other in zip(rsrrp, rsup, strict=True):
            for a, b in zip(one, other, strict=True):
                self.assertLess(abs(a - b), 1e-8)

    def test_every_study_runs(self):
        for path in files_in("studies"):
            kind = tomllib.loads(path.read_text())["kind"]
            search = {"tune": ["-s", "search.scan=4", "-s", "search.max_evaluations=12"],
                      "calibrate": ["-s", "fit.starts=1", "-s", "fit.max_evaluations=20"]}
            with self.subTest(file=path.name), tempfile.TemporaryDirectory() as folder:
                done = run(kind, path, "-o", f"{folder}/results", *shortened(path),
                           *search.get(kind, []))
                # So short a run need not hold what is tuned for (4), nor converge (5).
                codes = {"tune": (0, 4), "converge": (0, 5)}
                self.assertIn(done.returncode, codes.get(kind, (0,)), done.stderr)
                self.assertTrue(Path(folder, "results", "results.h5").exists())
                made = run("report", f"{folder}/results")
                self.assertEqual((0, ""), (made.returncode, made.stderr))
                page = Path(folder, "results", "report.html").read_text()
                data = json.loads(re.search(r'id="data">(.*?)</script>', page, re.S)[1])
                self.assertGreater(data["counts"]["ok"], 0)
                self.assertTrue(all(one["poses"] for one in data["mechanisms"]))
                histories = [one["name"] for one in data["histories"]]
                self.assertTrue(data["mechanisms"])
                self.assertTrue(all(one["history"] in histories for one in data["mechanisms"]))

    def test_every_mechanism_has_results_of_kinematics_and_statics_with_a_report(self):
        for path in files_in("mechanisms"):
            for verb in ("kinematics", "statics"):
                with self.subTest(file=path.name, verb=verb), \
                        tempfile.TemporaryDirectory() as folder:
                    done = run(verb, path, "-o", f"{folder}/results", "--json")
                    if verb == "kinematics" and 'type = "rod"' in path.read_text():
                        self.assertEqual(2, done.returncode)
                        self.assertIn("kinematics does not know a rod", done.stderr)
                        continue
                    # Most of them have no equilibrium, as nothing holds them.
                    self.assertIn(done.returncode, {"statics": (0, 3)}.get(verb, (0,)), done.stderr)
                    made = run("report", f"{folder}/results")
                    self.assertEqual(0, made.returncode, made.stderr)
                    page = Path(folder, "results", "report.html").read_text()
                    data = json.loads(re.search(r'id="data">(.*?)</script>', page, re.S)[1])
                    found = json.loads(done.stdout)
                    self.assertEqual(found["digest"], data["digest"])
                    moving = [one for one in data["mechanisms"] if one["poses"]]
                    self.assertEqual(done.returncode == 0, len(moving) == 1)
                    self.assertEqual(data["status"], "failed" if done.returncode else "done")
                    if found.get("positions"):
                        self.assertTrue(data["panels"])
                    self.assertEqual(run("verify", f"{folder}/results").returncode, 0)

    def test_the_readme_is_the_key_reference(self):
        done = run("describe", "--markdown")
        self.assertEqual(0, done.returncode, done.stderr)
        readme = (TREE / "configs" / "README.md").read_text()
        self.assertTrue(done.stdout == readme,
                        "not up to date: linkstudy describe --markdown > configs/README.md")


if __name__ == "__main__":
    LINKSTUDY, TREE = sys.argv[1], Path(sys.argv[2])
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
