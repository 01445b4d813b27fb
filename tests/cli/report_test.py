#!/usr/bin/env python3
"""Reports of studies of every kind, as they are written and as a browser (Chromium) shows them.

usage: report_test.py LINKSTUDY TREE [options of unittest]
"""

import json
import re
import shutil
import sys
import unittest
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from page_seen import FLOAT, Given, PageTest, island_of, numbers, run, show


def vector_of(matrix):
    """Of a small turn: axis times sine of the angle."""
    return np.array([matrix[2, 1] - matrix[1, 2], matrix[0, 2] - matrix[2, 0],
                     matrix[1, 0] - matrix[0, 1]]) / 2


class Report(PageTest):
    def test_a_tune_shows_its_verdict_its_curve_and_its_mechanism(self):
        page = self.make("tune", "rsrrp_tune", "-s", "simulation.end_time=2", "-s",
                         "match.0.window=[0.5, 2]")
        data = self.check_tables(page)
        seen = self.check_shown(page, charts=4)
        self.assertIn(f"tune: {data['answer']['status']}", seen["text"])
        value = data["answer"]["parameters"]["closure.S.sde.stiffness"]
        self.assertIn(f"closure.S.sde.stiffness = {value:.6g}", seen["text"])
        self.assertIn(data["answer"]["digest"], seen["text"])
        self.assertLess(len(page), 5e6)

    def test_curves_of_a_run_made_again_are_the_stored_ones(self):
        page = self.make("study", "rsrrp_stiffness", "-s", "simulation.end_time=2", "-s",
                         "match.0.window=[0.5, 2]", "-s", "vary.0.values=[1e5, 1e6, 1e7]")
        data = self.check_tables(page)
        exported = run("export", self.results, "--traces", "--format", "json")
        rows = json.loads(exported.stdout)["rows"]
        compared = 0
        for history in data["histories"]:
            stored = [row for row in rows if row["run"] == history["name"]]
            times = numbers(history["time"], "f")
            by_time = {round(t, 4): i for i, t in enumerate(times)}
            for channel in history["channels"]:
                if not stored or channel["name"] not in stored[0] or channel["rows"]:
                    continue
                values = numbers(channel["values"], "f")
                for row in stored:
                    expected = row[channel["name"]]
                    got = values[by_time[round(row["time"], 4)]]
                    self.assertLessEqual(abs(got - expected), FLOAT * abs(expected) + 1e-38)
                    compared += 1
        self.assertGreater(compared, 500)
        seen = self.check_shown(page, charts=3)
        self.assertIn("3 of 3 evaluations ended well", seen["text"])

    def test_a_calibration_shows_data_residuals_and_profiles(self):
        page = self.make("calibrate", "rsrrp_calibrate")
        data = self.check_tables(page)
        seen = self.check_shown(page, charts=10)
        for name, one in data["answer"]["parameters"].items():
            self.assertIn(f"{name} = {one['value']:.6g}", seen["text"])
        self.assertIn("of a normal distribution", seen["text"])

    def test_a_refinement_shows_its_orders(self):
        page = self.make("converge", "rsrrp_converge_step")
        self.check_tables(page)
        seen = self.check_shown(page, charts=7)
        self.assertRegex(seen["text"], r"fitted order (3\.9|4\.0)")
        self.assertIn("evaluation 6", seen["text"])  # the finest level moves

    def test_several_values_and_failures_show_their_region(self):
        page = self.make("study", "rsrrp_step_and_stiffness", "-s", "simulation.end_time=1", "-s",
                         "match.0.window=[0.2, 1]")
        data = self.check_tables(page)
        self.assertTrue(data["counts"]["failed"], "this study is here because some of it fails")
        seen = self.check_shown(page, charts=4)
        self.assertIn("failures lie between", seen["text"])
        self.assertIn("side by side", seen["text"])
        [shown] = self.check_map(seen, 0.02)
        self.assertEqual(shown["logs"], [True, True])  # both are spaced by ratios
        feasible = [(row["simulation.step"], -row["closure.S.sde.stiffness"])
                    for row in self.evaluations() if self.largest_error(row) <= 0.02]
        step, stiffness = max(feasible)
        [best] = [one for one in shown["series"] if one["name"].startswith("largest step")]
        self.assertEqual((best["x"], best["y"]), ([step], [-stiffness]))

        path = Path(self.folder.name) / "map.svg"
        drawn = run("export", self.results, "--figure", "map", "-o", path)
        self.assertEqual(drawn.returncode, 0, drawn.stderr)
        errors = [self.largest_error(row) for row in self.evaluations()]
        failed = sum(error == float("inf") for error in errors)
        for mark, count in ((6, len(feasible)), (1, failed),  # circle, cross, triangle of gnuplot
                            (8, len(errors) - len(feasible) - failed)):
            points = re.findall(rf"<use xlink:href='#gpPt{mark}' transform", path.read_text())
            self.assertEqual(len(points), count + 1, mark)  # and one in the key

    def test_the_map_is_the_picture_that_the_readme_describes(self):
        page = self.make("study", "rsrrp_step_and_stiffness")
        [shown] = self.check_map(self.check_clean(page), 0.02)
        band = {}
        for one in shown["series"]:
            for step, stiffness in zip(one["x"], one["y"], strict=True):
                if one["marker"] == "circle":
                    band.setdefault(step, []).append(stiffness)
        ends = {step: (min(all_), max(all_)) for step, all_ in band.items()}
        for step, low, high in ((5e-5, 1e6, 1e8), (1e-4, 1e6, 10 ** 7.5), (2e-4, 1e6, 1e7),
                                (4e-4, 1e6, 10 ** 6.5)):
            np.testing.assert_allclose(ends[step], (low, high), rtol=1e-12)
        crosses = [(step, stiffness) for one in shown["series"] if one["marker"] == "crossRot"
                   for step, stiffness in zip(one["x"], one["y"], strict=True)]
        self.assertTrue(crosses)
        for step, stiffness in crosses:
            self.assertGreater(stiffness, ends[step][1])

    def evaluations(self):
        return json.loads(run("export", self.results, "--table", "evaluations", "--format",
                              "json").stdout)["rows"]

    def largest_error(self, row):
        """Of a row; infinite where it failed."""
        if row["status"] != "ok":
            return float("inf")
        return max(value for name, value in row.items() if name.startswith("error_max_"))

    def check_map(self, seen, tolerance):
        """The map holds every evaluation that it says once, in the shape and class of its error."""
        for shown in seen["maps"]:
            numbers = {column["name"]: column["values"] for column in shown["numbers"]}
            exported = {row["evaluation"]: row for row in self.evaluations()}
            rows = [exported[one] for one in numbers["evaluation"]]
            self.assertGreater(len(rows), 8)
            for row, ratio in zip(rows, numbers["largest error / tolerance"], strict=True):
                error = self.largest_error(row)
                # One division of doubles.
                expected = None if error == float("inf") else error / tolerance
                self.assertEqual(ratio, expected, row)
            drawn, shades = {}, {}
            for one in shown["series"]:
                for x, y, note in zip(one["x"], one["y"], one.get("notes") or [], strict=False):
                    found = re.search(r"evaluation (\d+)$", note)
                    if found:
                        drawn.setdefault(int(found[1]), []).append((one, x, y))
            self.assertEqual(sorted(drawn), sorted(numbers["evaluation"]))
            across, up = shown["numbers"][1]["name"], shown["numbers"][2]["name"]
            for row in rows:
                [(one, x, y)] = drawn[row["evaluation"]]
                self.assertEqual((x, y), (row[across], row[up]))
                error = self.largest_error(row)
                marker = ("crossRot" if error == float("inf") else
                          "circle" if error <= tolerance else "triangle")
                self.assertEqual(one["marker"], marker, row)
                if marker == "crossRot":
                    self.assertEqual(one["name"], row["status"])
                    continue
                low, high = map(float, re.match(r"(\S+) to ([^ ,]+)", one["name"]).groups())
                self.assertTrue(0.998 * low <= error / tolerance <= 1.002 * high,  # three digits
                                (one["name"], error / tolerance))
                shades[low] = one["shade"]
            ordered = [shades[low] for low in sorted(shades)]
            self.assertEqual(ordered, sorted(ordered))
            self.assertEqual(len(set(ordered)), len(ordered))
        return seen["maps"]

    def test_a_tune_over_steps_shows_a_map_of_value_and_step(self):
        page = self.make("tune", "rsrrp_tune", "-s", "simulation.end_time=1", "-s",
                         "match.0.window=[0.2, 1]", "-s", "search.steps=[2e-4,4e-4,8e-4]")
        data = self.check_tables(page)
        seen = self.check_shown(page, charts=5)
        [shown] = self.check_map(seen, 0.02)
        # What the tuner itself wrote of its scan.
        ids = {column["name"]: column["values"] for column in shown["numbers"]}
        ratios = dict(zip(ids["evaluation"], ids["largest error / tolerance"], strict=True))
        [scan] = [table for table in data["tables"] if table["name"] == "scan"]
        scanned = {column["name"]: column["values"] for column in scan["columns"]}
        for number, ratio in zip(scanned["evaluation"], scanned["ratio"], strict=True):
            self.assertEqual(ratios[number], ratio)
        series = {one["name"]: one for one in shown["series"]}
        answers = data["answer"]["answers"]
        self.assertEqual(series["answer"]["x"], [one["parameters"]["closure.S.sde.stiffness"]
                                                 for one in answers])
        self.assertEqual(series["answer"]["y"], [2e-4, 4e-4, 8e-4])
        best = series["largest step that matches, and its least value"]
        self.assertEqual((best["x"], best["y"]), (series["answer"]["x"][2:], [8e-4]))

    def test_feasible_is_what_keeps_limits_and_the_tightest_tolerance(self):
        text = (Given.tree / "configs" / "studies" / "rsrrp_tune.toml").read_text()
        model = (Given.tree / "configs" / "mechanisms" / "rsrrp.toml").resolve()
        text = re.sub(r"^model = .*$", lambda _: f"model = '{model}'", text, flags=re.M)
        study = Path(self.folder.name) / "limited.toml"
        bound = 1e-3  # m: binds near the answer, the error far below it
        study.write_text(f'{text}\n[[limit]]\nresponse = "gap_max"\nat_most = {bound}\n')
        self.ran = run("tune", study, "-o", self.results, "--progress", "none", "-s",
                       "simulation.end_time=1", "-s", "match.0.window=[0.2, 1]", "-s",
                       "match.0.tolerance=[0.05, 0.02]")
        page = self.report()
        binding = {"gap": 0, "error": 0, "nothing": 0}
        for row, ratio in zip(self.evaluations(), island_of(page)["ratios"], strict=True):
            if row["status"] != "ok":
                self.assertIsNone(ratio)
                continue
            parts = {"gap": 1 + (row["gap_max"] - bound) / bound,
                     "error": self.largest_error(row) / 0.02}
            self.assertAlmostEqual(ratio, max(parts.values()), delta=1e-14 * ratio)
            binding["nothing" if ratio <= 1 else max(parts, key=parts.get)] += 1
        self.assertTrue(all(binding.values()), binding)
        answers = island_of(page)["answer"]["answers"]
        seen = self.check_clean(page)
        [shown] = seen["maps"]
        [stars] = [one for one in shown["series"] if one["name"] == "answer"]
        self.assertEqual(stars["x"], [one["parameters"]["closure.S.sde.stiffness"]
                                      for one in answers])
        self.assertEqual(stars["notes"], ["tolerance 0.05", "tolerance 0.02"])

    def test_a_tune_of_two_values_shows_its_staircase_on_the_map(self):
        text = (Given.tree / "configs" / "studies" / "rsrrp_tune_axes.toml").read_text()
        model = (Given.tree / "configs" / "mechanisms" / "rsrrp.toml").resolve()
        text = re.sub(r"^model = .*$", lambda _: f"model = '{model}'", text, flags=re.M)
        text, count = re.subn(r'\[\[tune\]\]\nparameter = "[^"]*\.z"\nrange = .*\n', "", text)
        self.assertEqual(count, 1)
        study = Path(self.folder.name) / "two.toml"
        study.write_text(text.replace("1.0e4, 1.0e7", "1.0e3, 1.0e7"))
        self.ran = run("tune", study, "-o", self.results, "--progress", "none", "-s",
                       "simulation.end_time=1", "-s", "match.0.window=[0.2, 1]")
        page = self.report()
        data = self.check_tables(page)
        seen = self.check_shown(page, charts=5)
        [shown] = self.check_map(seen, 0.02)
        stairs = json.loads(run("export", self.results, "--table", "staircase", "--format",
                                "json").stdout)["rows"]
        corners = sorted((row["closure.S.sde.stiffness.x"], row["closure.S.sde.stiffness.y"])
                         for row in stairs)
        series = {one["name"]: one for one in shown["series"]}
        steps = series["minimal matches"]
        self.assertEqual(list(zip(steps["x"], steps["y"], strict=True)), corners)
        self.assertGreater(len(corners), 2)
        # It falls: of two minimal points none lies below the other.
        self.assertEqual(steps["y"], sorted(steps["y"], reverse=True))
        value = data["answer"]["parameters"]
        self.assertEqual((series["answer"]["x"], series["answer"]["y"]),
                         ([value["closure.S.sde.stiffness.x"]],
                          [value["closure.S.sde.stiffness.y"]]))

    def test_a_results_file_alone_makes_the_same_page(self):
        page = self.make("study", "rsrrp_stiffness", "-s", "simulation.end_time=1", "-s",
                         "match.0.window=[0.2, 1]", "-s", "vary.0.values=[1e5, 1e6]")
        lone = Path(self.folder.name) / "lone.h5"
        shutil.copy(self.results / "results.h5", lone)
        made = run("report", lone)
        self.assertEqual(made.stdout.strip(), str(lone.with_suffix(".html")))
        again = island_of(lone.with_suffix(".html").read_text())
        first = island_of(page)
        for part in ("digest", "counts", "histories", "mechanisms", "matches"):
            self.assertEqual(again[part], first[part], part)

    def test_one_run_of_a_model_is_results_like_any_other(self):
        model = Given.tree / "configs" / "mechanisms" / "rsup_clearance_planar.toml"
        options = ["-s", "simulation.end_time=0.2"]
        ran = run("simulate", model, "-o", self.results, *options)
        self.assertEqual(ran.returncode, 0, ran.stderr)
        self.assertIn("results digest", ran.stdout)
        self.assertNotIn("no effect", ran.stderr)
        lone = run("simulate", model, "--csv", "-", *options)
        names, *rows = [line.split(",") for line in lone.stdout.splitlines()[1:]]
        stored = json.loads(run("export", self.results, "--traces", "--format", "json").stdout)
        self.assertEqual(len(stored["rows"]), len(rows))
        for row, one in zip(stored["rows"], rows, strict=True):
            for name, value in zip(names, one, strict=True):
                self.assertEqual(row[name], float(value), name)
        self.assertEqual(run("verify", self.results).returncode, 0)
        page = self.report()
        data = self.check_tables(page)
        self.assertEqual(data["status"], "complete")
        # Contact force, displacement, velocity and acceleration of the slider stand open.
        opened = [(panel["group"], panel["over"]) for panel in data["panels"]]
        for group in ("closure.R.normal_force", "joint.P.q", "joint.P.v", "joint.P.a"):
            self.assertIn((group, "time"), opened)
        seen = self.check_shown(page, charts=7)
        self.assertIn("Journal of R, evaluation 0", seen["text"])
        few = run("simulate", model, "-o", self.results, "--fresh", "--signals", "joint.P,energy",
                  *options)
        self.assertEqual(few.returncode, 0, few.stderr)
        kept = json.loads(run("export", self.results, "--traces", "--format", "json").stdout)
        self.assertEqual({name.rsplit(".", 1)[0] for name in kept["rows"][0]} - {"run", "time"},
                         {"joint.P", "joint.P.force", "joint.P.torque", "joint.P.force_local",
                          "joint.P.torque_local", "energy"})
        refused = run("simulate", model, "-o", self.results, "--csv", "x.csv")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("--csv with -o", refused.stderr)

    def test_bending_is_drawn_larger_about_the_same_axes(self):
        model = Given.tree / "configs" / "mechanisms" / "rsup_flexible.toml"
        ran = run("simulate", model, "-o", self.results, "-s", "simulation.end_time=0.02")
        self.assertEqual(ran.returncode, 0, ran.stderr)
        page = self.report()
        [mechanism] = island_of(page)["mechanisms"]
        seen = self.check_shown(page, charts=2)["scene"]
        self.assertNotIn("bending", seen["label"])
        self.assertIn("100 times their bending", seen["bent"]["label"])
        self.assertIn("100 times their bending", seen["bent"]["spoken"])
        self.assertTrue(seen["bent"]["moved"])
        true, larger = ([np.reshape(one, (4, 4)).T for one in drawn] for drawn in seen["drawn"])
        poses = np.reshape(numbers(mechanism["poses"], "f"), (-1, len(true), 7))[-1]
        for pose, one in zip(poses, true, strict=True):
            np.testing.assert_allclose(one[:3, 3], pose[:3], atol=1e-7)
        hinges = [joint for joint in mechanism["joints"] if joint["bends"]]
        self.assertEqual(len(hinges), 4)  # of four segments
        for joint in hinges:
            ends = joint["parent"], joint["child"]
            once, tenfold = (np.linalg.inv(all_[ends[0]]) @ all_[ends[1]]
                             for all_ in (true, larger))
            # Poses have 24 bits; a turn near zero has twice their spacing, ten times as large.
            turn = vector_of(once)
            self.assertGreater(np.linalg.norm(turn), 1e-5)
            np.testing.assert_allclose(vector_of(tenfold), 10 * turn, atol=1e-5)
            at = np.array([*joint["parent_frame"][:3], 1.0])  # unbent, all share one frame
            np.testing.assert_allclose(tenfold @ at, at, atol=1e-6)
        # From end to end less than a hundredth of a degree, as the README says.
        ends = np.linalg.inv(true[hinges[0]["parent"]]) @ true[hinges[-1]["child"]]
        self.assertLess(np.linalg.norm(vector_of(ends)), np.radians(0.01))
        moved = {joint["child"] for joint in hinges}
        for i, (one, other) in enumerate(zip(true, larger, strict=True)):
            if i not in moved:
                np.testing.assert_array_equal(one, other)

    def test_links_are_drawn_as_they_were_shaped(self):
        model = Given.tree / "configs" / "mechanisms" / "rsup_flexible.toml"
        brief = ("-s", "simulation.end_time=0.02", "--csv", Path(self.folder.name) / "run.csv")
        shaped = run("simulate", model, *brief)
        self.assertEqual((shaped.returncode, shaped.stderr.count("shape")), (0, 0), shaped.stderr)
        histories = (Path(self.folder.name) / "run.csv").read_bytes()
        digest, page = self.keep(model)
        mechanism = island_of(page)["mechanisms"][0]
        names = [link["name"] for link in mechanism["links"]]
        solids = {link["name"]: link["shape"] for link in mechanism["links"] if link["shape"]}
        self.assertEqual({name: [one["kind"] for one in shape] for name, shape in solids.items()},
                         {"crank": ["box", "cylinder", "sphere"], "coupler_rfe4": ["cylinder"],
                          "slider": ["box", "cylinder"], "yoke": ["cylinder"]})
        self.assertEqual(solids["crank"][0]["sides"], [0.028, 0.1, 0.012])
        self.assertEqual(solids["crank"][2]["diameter"], 0.034)
        self.assertEqual(solids["coupler_rfe4"][0], {"kind": "cylinder", "begin": [0, 0, 0],
                                                     "end": [0, 0.5, 0], "diameter": 0.022})
        seen = self.check_shown(page, charts=2)["scene"]["shapes"]
        self.assertGreater(seen["points"], 500)  # of 320 x 240 at the least
        self.assertGreater(seen["bentPoints"], 50)
        boxes = {(names[one["link"]], i): (one["low"], one["high"])
                 for i, one in enumerate(seen["solids"])}
        for key, low, high in ((("crank", 0), (-0.014, 0, -0.006), (0.014, 0.1, 0.006)),
                               (("crank", 2), (-0.017, 0.083, -0.017), (0.017, 0.117, 0.017)),
                               (("slider", 4), (-0.015, -0.03, -0.04), (0.015, 0.03, 0.04))):
            np.testing.assert_allclose(boxes[key], (low, high), atol=1e-7)  # of 24 bits
        # Five elements of the coupler, joined in the middles of its four segments.
        [coupler] = [one for one in seen["solids"] if one["bound"]]
        self.assertEqual([names[i] for i in coupler["elements"]],
                         [f"coupler_rfe{k}" for k in range(5)])
        along = np.reshape(coupler["corners"], (-1, 3))[:, 1]
        self.assertEqual((along.min(), along.max()), (0, 0.5))
        np.testing.assert_array_equal(np.reshape(coupler["bound"], (-1, 4))[:, 0],
                                      np.floor(along / 0.125 + 0.5))
        # Without shapes it is the same run.
        text = re.sub(r"^\[\[link\.shape\]\].*\n(.+\n)*", "", model.read_text(), flags=re.M)
        text = re.sub(r"^shape = \[($(\n.+)*\n\]|.*\])$", "", text, flags=re.M)
        self.assertNotIn("shape =", re.sub("section = .*|course = .*|law = .*", "", text))
        plain = Path(self.folder.name) / "plain.toml"
        plain.write_text(text)
        self.assertEqual(run("simulate", plain, *brief).returncode, 0)
        self.assertEqual((Path(self.folder.name) / "run.csv").read_bytes(), histories)
        again, page = self.keep(plain, "--fresh")
        self.assertEqual(again, digest)
        self.assertEqual([link["shape"] for link in island_of(page)["mechanisms"][0]["links"]],
                         [[]] * len(names))

    def keep(self, model, *options):
        """The digest of a short run that is kept, and its page."""
        ran = run("simulate", model, "-o", self.results, "-s", "simulation.end_time=0.02", *options)
        self.assertEqual(ran.returncode, 0, ran.stderr)
        page = self.report()
        return island_of(page)["digest"], page

    def test_an_evaluation_of_choice_moves(self):
        self.make("study", "rsrrp_stiffness", "-s", "simulation.end_time=1", "-s",
                  "match.0.window=[0.2, 1]", "-s", "vary.0.values=[1e5, 1e6]")
        data = island_of(self.report("--evaluation", "0"))
        titles = [one["title"] for one in data["mechanisms"]]
        self.assertEqual(titles, ["evaluation 0", "reference"])
        missing = run("report", self.results, "--evaluation", "7")
        self.assertEqual(missing.returncode, 2)
        self.assertIn("hold no such evaluation", missing.stderr)

    def test_where_every_evaluation_fails_the_page_says_so(self):
        page = self.make("study", "rsrrp_stiffness", "-s", "simulation.end_time=1", "-s",
                         "match.0.window=[0.2, 1]", "-s", "vary.0.values=[1e13, 1e14]")
        self.assertEqual(island_of(page)["counts"]["ok"], 0)
        seen = show(page, self.folder.name)
        self.assertEqual(seen["problems"], [])
        self.assertIn("0 of 2 evaluations ended well, 2 failed", seen["text"])
        self.assertIn("there is no motion to show", seen["text"])

    def test_a_hostile_name_is_only_a_name(self):
        name = "</script><img src=x onerror=problems.push('ran')>&amp;<!--\u2028\u202e'\\\\\""
        text = (Given.tree / "configs" / "studies" / "rsrrp_stiffness.toml").read_text()
        model = (Given.tree / "configs" / "mechanisms" / "rsrrp.toml").resolve()
        text = re.sub(r"^model = .*$", lambda _: f"model = '{model}'", text, flags=re.M)
        text = re.sub(r"^name = .*$", lambda _: f"name = {json.dumps(name)}", text, flags=re.M)
        study = Path(self.folder.name) / "hostile.toml"
        study.write_text(text)
        ran = run("study", study, "-o", self.results, "--progress", "none", "-s",
                  "simulation.end_time=1", "-s", "match.0.window=[0.2, 1]", "-s",
                  "vary.0.values=[1e5, 1e6]")
        self.assertEqual(ran.returncode, 0, ran.stderr)
        page = self.report()
        self.assertEqual(island_of(page)["name"], json.loads(json.dumps(name)))
        seen = self.check_shown(page, charts=2)
        self.assertIn("<img src=x", seen["text"])

    def test_a_watched_study_tells_the_best_so_far(self):
        self.make("study", "rsrrp_stiffness", "-s", "simulation.end_time=1", "-s",
                  "match.0.window=[0.2, 1]", "-s", "vary.0.values=[1e5, 1e6, 1e13]")
        watched = run("status", self.results, "--watch")
        self.assertEqual(watched.returncode, 0, watched.stderr)
        self.assertIn("complete", watched.stdout)
        self.assertRegex(watched.stdout, r"failed +1 ")
        self.assertRegex(watched.stdout, r"best so far +evaluation 1, closure.S.sde.stiffness = "
                                         r"1e\+06 N/m, largest error [\d.]+ %")

    def test_figures_for_papers_are_drawn_from_the_same_numbers(self):
        self.make("study", "rsrrp_stiffness", "-s", "simulation.end_time=1", "-s",
                  "match.0.window=[0.2, 1]", "-s", "vary.0.values=[1e5, 3e5, 1e6, 1e13]")
        for form, begin in (("svg", b"<?xml"), ("pdf", b"%PDF"), ("png", b"\x89PNG")):
            path = Path(self.folder.name) / f"errors.{form}"
            drawn = run("export", self.results, "--figure", "errors", "--format", form, "-o", path)
            self.assertEqual((drawn.returncode, drawn.stdout), (0, f"{path}\n"), drawn.stderr)
            self.assertTrue(path.read_bytes().startswith(begin))
        texts = [text for element in ElementTree.parse(Path(self.folder.name) / "errors.svg").iter()
                 for text in [element.text or ""] if text.strip()]
        for name in ("closure.S.force.x", "closure.S.sde.stiffness [N/m]"):
            self.assertTrue(any(name in text for text in texts), name)
        drawn = run("export", self.results, "--figure", "histories", "-o",
                    Path(self.folder.name) / "histories.svg")
        self.assertEqual(drawn.returncode, 0, drawn.stderr)
        for options, message in ((["--figure", "residuals"], "have nothing of it"),
                                 (["--figure", "forces"], "there is no figure 'forces'"),
                                 (["--figure", "errors", "--format", "csv"], "svg, pdf or png"),
                                 (["--figure", "errors", "--table", "summary"], "goes with"),
                                 (["--format", "svg"], "name one with --figure")):
            refused = run("export", self.results, *options, cwd=self.folder.name)
            self.assertEqual(refused.returncode, 2, options)
            self.assertIn(message, refused.stderr)
        self.assertEqual(list(Path(self.folder.name).glob("*.tmp")), [])

    def test_what_is_no_results_is_refused(self):
        for path in (self.folder.name, Path(self.folder.name) / "nothing"):
            refused = run("report", path)
            self.assertEqual(refused.returncode, 2, refused.stderr)
            self.assertIn("error:", refused.stderr)
            self.assertFalse(list(Path(self.folder.name).glob("*.html")))


if __name__ == "__main__":
    Given.main(sys.argv)
