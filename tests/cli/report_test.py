#!/usr/bin/env python3
"""Reports of every kind of results, as they are written and as a browser (Chromium) shows them.

usage: report_test.py LINKSTUDY TREE [options of unittest]
"""

import base64
import html
import json
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from xml.etree import ElementTree

LINKSTUDY = ""
TREE = Path()
FLOAT = 2.0 ** -23  # relative spacing of the numbers that curves are stored in

# Before everything else on the page: what it complains about.
WATCH = """<script>
window.problems = [];
window.addEventListener("error", (event) => problems.push(event.message));
for (const name of ["error", "warn"]) {
  console[name] = (...words) => problems.push(words.join(" "));
}
</script>"""

# After everything else: what can be seen, and what keys and the mouse do.
PROBE = """<script>
function colours(canvas) {
  const copy = document.createElement("canvas");
  [copy.width, copy.height] = [canvas.width, canvas.height];
  const context = copy.getContext("2d");
  context.drawImage(canvas, 0, 0);
  const words = new Uint32Array(context.getImageData(0, 0, copy.width, copy.height).data.buffer);
  return new Set(words).size;
}
function press(element, key) {
  element.dispatchEvent(new KeyboardEvent("keydown", {key, bubbles: true, cancelable: true}));
}
function spokenBelow(canvas) {
  return canvas.closest("figure").querySelector("output").textContent;
}
addEventListener("load", () => setTimeout(() => {
  const canvases = [...document.querySelectorAll("canvas")];
  const charts = canvases.filter((canvas) => canvas.closest(".plot"));
  const seen = {canvases: canvases.map((canvas) => ({label: canvas.getAttribute("aria-label"),
                                                     colours: colours(canvas)}))};
  seen.charts = charts.map((canvas) => {
    press(canvas, "ArrowRight");
    const first = spokenBelow(canvas);
    press(canvas, "End");
    return [first, spokenBelow(canvas)];
  });
  const scene = document.querySelector(".scene canvas");
  if (scene) {
    const before = spokenBelow(scene);
    const still = scene.toDataURL();
    press(scene, "End");
    seen.scene = {before, after: spokenBelow(scene), moved: still !== scene.toDataURL()};
    const scrub = scene.closest("figure").querySelector("input[type=range]");
    scrub.value = 500;
    scrub.dispatchEvent(new Event("input"));
    seen.scene.middle = spokenBelow(scene);
    press(scene, " ");
    seen.scene.button = scene.closest("figure").querySelector("button").textContent;
    press(scene, " ");
  }
  for (const choice of document.querySelectorAll("figure select")) {
    choice.selectedIndex = choice.options.length - 1;
    choice.dispatchEvent(new Event("change"));
  }
  for (const fold of document.querySelectorAll("details")) fold.open = true;
  setTimeout(() => {
    seen.text = document.querySelector("main").innerText;
    seen.tables = document.querySelectorAll("table").length;
    seen.wide = document.documentElement.scrollWidth > innerWidth;
    seen.requests = performance.getEntriesByType("resource").map((entry) => entry.name);
    seen.problems = problems;
    const mark = document.createElement("pre");
    mark.id = "seen";
    mark.textContent = JSON.stringify(seen);
    document.body.append(mark);
  }, 300);
}, 300));
</script>"""

def run(*arguments, cwd=None):
    command = [LINKSTUDY, *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, stdin=subprocess.DEVNULL,
                          cwd=cwd)


def numbers(text, form):
    data = base64.b64decode(text)
    return struct.unpack(f"<{len(data) // 4}{form}", data)


def island_of(page):
    found = re.search(r'<script type="application/json" id="data">(.*?)</script>', page, re.S)
    return json.loads(found[1])


def show(page, folder):
    """What a browser without a network makes of the page."""
    browser = shutil.which("chromium") or shutil.which("chromium-browser")
    if browser is None:
        raise unittest.TestCase.failureException("no chromium: jobs/install.sh --tests installs it")
    probed = Path(folder) / "probed.html"
    head, tail = page.split("<style>", 1), page.rsplit("</body>", 1)
    probed.write_text((head[0] + WATCH + "<style>" + head[1]).rsplit("</body>", 1)[0] + PROBE +
                      "</body>" + tail[1])
    flags = ["--headless", "--no-sandbox", "--disable-gpu", "--use-angle=swiftshader",
             "--enable-unsafe-swiftshader", "--disable-dev-shm-usage", "--no-first-run",
             "--host-resolver-rules=MAP * ~NOTFOUND", f"--user-data-dir={folder}/browser",
             "--window-size=1200,900", "--virtual-time-budget=20000", "--dump-dom"]
    shown = subprocess.run([browser, *flags, probed.as_uri()], capture_output=True, text=True,
                           timeout=240, stdin=subprocess.DEVNULL)
    found = re.search(r'<pre id="seen">(.*?)</pre>', shown.stdout, re.S)
    if not found:
        raise AssertionError(f"the page did not come to its end: {shown.stderr[-2000:]}")
    return json.loads(html.unescape(found[1]))


class Report(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.results = Path(self.folder.name) / "results"

    def make(self, verb, name, *options):
        """Runs a shipped file and returns the page of its results."""
        self.ran = run(verb, TREE / "configs" / "studies" / f"{name}.toml", "-o", self.results,
                       "--progress", "none", *options)
        return self.report()

    def report(self, *options):
        made = run("report", self.results, *options)
        self.assertEqual(made.returncode, 0, made.stderr)
        self.notes = made.stderr
        return (self.results / "report.html").read_text()

    def check_shown(self, page, charts):
        """No complaint, no request, nothing blank, all by keys; returns what was seen."""
        seen = show(page, self.folder.name)
        self.assertEqual(seen["problems"], [])
        self.assertEqual(seen["requests"], [])
        self.assertFalse(seen["wide"], "the page is wider than the window")
        self.assertGreaterEqual(len(seen["charts"]), charts)
        for canvas in seen["canvases"]:
            self.assertGreater(canvas["colours"], 5, canvas["label"])
            self.assertTrue(canvas["label"])
        for first, last in seen["charts"]:
            self.assertRegex(first, r": .* -?[\d.]")
        self.assertTrue(any(first != last for first, last in seen["charts"]))
        self.assertTrue(seen["scene"]["moved"])
        self.assertEqual(seen["scene"]["button"], "Pause")
        texts = {seen["scene"][when] for when in ("before", "middle", "after")}
        self.assertEqual(len(texts), 3, texts)
        return seen

    def check_tables(self, page):
        """Every table of the page is that of `export`, to the last bit."""
        data = island_of(page)
        self.assertTrue(data["tables"])
        for table in data["tables"]:
            names = ",".join(column["name"] for column in table["columns"])
            exported = run("export", self.results, "--table", table["name"], "--format", "json",
                           "--columns", names)
            self.assertEqual(exported.returncode, 0, exported.stderr)
            rows = json.loads(exported.stdout)["rows"]
            for column in table["columns"]:
                self.assertEqual([row[column["name"]] for row in rows], column["values"],
                                 f"{table['name']}.{column['name']}")
        return data

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
        model = TREE / "configs" / "mechanisms" / "rsup_clearance_planar.toml"
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
        seen = self.check_shown(page, charts=3)
        self.assertIn("Journal of R, evaluation 0", seen["text"])
        refused = run("simulate", model, "-o", self.results, "--csv", "x.csv")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("--csv with -o", refused.stderr)

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
        text = (TREE / "configs" / "studies" / "rsrrp_stiffness.toml").read_text()
        model = (TREE / "configs" / "mechanisms" / "rsrrp.toml").resolve()
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
    LINKSTUDY, TREE = sys.argv[1], Path(sys.argv[2])
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
