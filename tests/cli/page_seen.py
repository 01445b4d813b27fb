"""What tests of reports share: runs of the program, the data of a page, and what a browser
(Chromium) without a network makes of it.
"""

import base64
import html
import json
import re
import shutil
import struct
import subprocess
import tempfile
import unittest
from pathlib import Path

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
// Solids as they are built, and how many points of a picture of nothing else they take, and take
// otherwise when bent a thousandfold.
function shapesOf(stored) {
  const {shapes} = new Mechanism(stored, false);
  const pictures = [[], [1], [1000]].map(([bending]) => pictureOf(stored, bending));
  const differ = ([a, b]) => a.filter((point, i) => point !== b[i]).length;
  return {solids: shapes.map(({link, elements, geometry: {boundingBox, attributes}}) => ({
            link, elements, low: boundingBox.min.toArray(), high: boundingBox.max.toArray(),
            corners: [...attributes.position.array],
            bound: attributes.skinIndex ? [...attributes.skinIndex.array] : null})),
          points: differ(pictures), bentPoints: differ(pictures.slice(1))};
}
function pictureOf(stored, bending) {
  const place = document.createElement("div");
  place.style = "width: 320px; height: 240px";
  document.body.append(place);
  const mechanism = new Mechanism(stored, false);
  if (bending) mechanism.bending = bending;
  const geometries = bending ? mechanism.shapes.map((shape) => shape.geometry) : [];
  mechanism.root.traverse((one) => {
    if (one.geometry) one.visible = geometries.includes(one.geometry);
  });
  const theatre = new Theatre(place, [mechanism]);
  theatre.show(mechanism.times.at(-1));
  const {domElement: canvas} = theatre.renderer;
  const copy = document.createElement("canvas");
  [copy.width, copy.height] = [canvas.width, canvas.height];
  copy.getContext("2d").drawImage(canvas, 0, 0);
  place.remove();
  return [...new Uint32Array(copy.getContext("2d").getImageData(0, 0, copy.width,
                                                                copy.height).data.buffer)];
}
addEventListener("load", () => setTimeout(() => {
  for (const figure of [...waiting.keys()]) drawIfWaiting(figure);  // on a busy machine, some
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
  seen.maps = figures.filter((figure) => figure.wanted.numbers).map(({wanted}) => ({
    numbers: wanted.numbers, title: wanted.title, logs: [wanted.x.log, wanted.y.log],
    series: wanted.series.map(({name, x, y, marker, shade, notes}) =>
      ({name, x, y, marker, shade, notes}))}));
  const scene = document.querySelector(".scene canvas");
  if (scene) seen.scene = {before: spokenBelow(scene)};
  const scrub = scene?.closest("figure").querySelector("input[type=range]");
  if (scrub) {
    const still = scene.toDataURL();
    press(scene, "End");
    Object.assign(seen.scene, {after: spokenBelow(scene), moved: still !== scene.toDataURL()});
    scrub.value = 500;
    scrub.dispatchEvent(new Event("input"));
    seen.scene.middle = spokenBelow(scene);
    press(scene, " ");
    seen.scene.button = scene.closest("figure").querySelector("button").textContent;
    press(scene, " ");
  }
  const bent = [...document.querySelectorAll(".scene ~ .controls select")].find(
    (list) => list.parentElement.textContent.startsWith("bending"));
  if (bent) {
    const straight = scene.toDataURL();
    [bent.value, seen.scene.label] = ["100", scene.getAttribute("aria-label")];
    bent.dispatchEvent(new Event("change"));
    seen.scene.bent = {label: scene.getAttribute("aria-label"), spoken: spokenBelow(scene),
                       moved: straight !== scene.toDataURL()};
    seen.scene.drawn = [1, 10].map((times) => {
      const mechanism = new Mechanism(data.mechanisms[0], false);
      mechanism.bending = times;
      mechanism.show(mechanism.times.at(-1));
      return mechanism.links.map((link) => link.matrix.elements);
    });
  }
  const [stored] = data.mechanisms;
  if (stored?.links.some((link) => link.shape.length)) seen.scene.shapes = shapesOf(stored);
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


class Given:
    """The program and the tree under test, from the command line."""
    program = ""
    tree = Path()

    @classmethod
    def main(cls, arguments):
        cls.program, cls.tree = arguments[1], Path(arguments[2])
        unittest.main(argv=[arguments[0], *arguments[3:]])


def run(*arguments, cwd=None):
    command = [Given.program, *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, stdin=subprocess.DEVNULL,
                          cwd=cwd)


def numbers(text, form):
    data = base64.b64decode(text)
    return struct.unpack(f"<{len(data) // 4}{form}", data)


def island_of(page):
    found = re.search(r'<script type="application/json" id="data">(.*?)</script>', page, re.S)
    return json.loads(found[1])


def browse(path, folder, *flags):
    """The page as it stands in a browser, which ends when it is loaded; without a network."""
    browser = shutil.which("chromium") or shutil.which("chromium-browser")
    if browser is None:
        raise unittest.TestCase.failureException("no chromium: jobs/install.sh --tests installs it")
    flags = ["--headless", "--no-sandbox", "--disable-gpu", "--use-angle=swiftshader",
             "--enable-unsafe-swiftshader", "--disable-dev-shm-usage", "--no-first-run",
             "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1",
             f"--user-data-dir={folder}/browser", "--window-size=1200,900", "--dump-dom", *flags]
    return subprocess.run([browser, *flags, path.as_uri()], capture_output=True, text=True,
                          timeout=240, stdin=subprocess.DEVNULL)


def with_scripts(page, first, last):
    """The page with one script before all others and one behind them."""
    head, tail = page.split("<style", 1), page.rsplit("</body>", 1)
    return ((head[0] + first + "<style" + head[1]).rsplit("</body>", 1)[0] + last + "</body>" +
            tail[1])


def show(page, folder):
    """What a browser makes of the page, and what keys and the mouse do there."""
    probed = Path(folder) / "probed.html"
    probed.write_text(with_scripts(page, WATCH, PROBE))
    shown = browse(probed, folder, "--virtual-time-budget=20000")
    found = re.search(r'<pre id="seen">(.*?)</pre>', shown.stdout, re.S)
    if not found:
        raise AssertionError(f"the page did not come to its end: {shown.stderr[-2000:]}")
    return json.loads(html.unescape(found[1]))


def saved(page, folder):
    """The page as a browser writes it after its scripts ran."""
    path = Path(folder) / "before.html"
    path.write_text(page)
    return browse(path, folder, "--virtual-time-budget=20000").stdout


class PageTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.results = Path(self.folder.name) / "results"

    def make(self, verb, name, *options):
        """Runs a shipped file and returns the page of its results."""
        study = Given.tree / "configs" / "studies" / f"{name}.toml"
        self.ran = run(verb, study, "-o", self.results, "--progress", "none", *options)
        return self.report()

    def analyse(self, verb, model, *options, code=0):
        """Keeps statics or kinematics of a shipped model, or of a file."""
        path = model if isinstance(model, Path) else (
            Given.tree / "configs" / "mechanisms" / f"{model}.toml")
        self.ran = run(verb, path, "-o", self.results, *options)
        self.assertEqual(self.ran.returncode, code, self.ran.stderr)

    def report(self, *options):
        made = run("report", self.results, *options)
        self.assertEqual(made.returncode, 0, made.stderr)
        self.notes = made.stderr
        return (self.results / "report.html").read_text()

    def check_clean(self, page):
        """No complaint, no request, nothing blank; returns what was seen."""
        seen = show(page, self.folder.name)
        self.assertEqual(seen["problems"], [])
        self.assertEqual(seen["requests"], [])
        self.assertFalse(seen["wide"], "the page is wider than the window")
        for canvas in seen["canvases"]:
            self.assertGreater(canvas["colours"], 5, canvas["label"])
            self.assertTrue(canvas["label"])
        return seen

    def check_shown(self, page, charts):
        """Likewise, with charts and motion, all by keys."""
        seen = self.check_clean(page)
        self.assertGreaterEqual(len(seen["charts"]), charts)
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
