#!/usr/bin/env python3
"""Reports of what is partial, damaged, large or saved by a browser.

usage: damaged_results_test.py LINKSTUDY TREE [options of unittest]
"""

import http.server
import sys
import threading
import urllib.parse
from pathlib import Path

from page_seen import Given, PageTest, browse, island_of, numbers, run, saved, show, with_scripts

SHORT = ["-s", "simulation.end_time=1", "-s", "match.0.window=[0.2, 1]"]

# After the first frame that is drawn; `held` keeps the browser until then.
DRAWN = """<script>
new Image().src = "http://127.0.0.1:PORT/held";
requestAnimationFrame(() => setTimeout(() => {
  new Image().src = `http://127.0.0.1:PORT/drawn?ms=${performance.now()}`;
}));
</script>"""


def drawing_time(page, folder):
    """Seconds from the start of the page to its first frame, as the page measures it."""
    told = []
    is_drawn = threading.Event()

    class Listener(http.server.BaseHTTPRequestHandler):
        def do_GET(self):
            asked = urllib.parse.urlparse(self.path)
            if asked.path == "/drawn":
                told.append(float(urllib.parse.parse_qs(asked.query)["ms"][0]))
                is_drawn.set()
            is_drawn.wait(60)
            self.send_error(404)

        def log_message(self, *_):
            pass

    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), Listener) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        path = Path(folder) / "timed.html"
        path.write_text(with_scripts(page, "", DRAWN.replace("PORT", str(server.server_port))))
        browse(path, folder)
        server.shutdown()
    return told[0] / 1000


class Damaged(PageTest):
    def study(self, *options):
        return self.make("study", "rsrrp_stiffness", *SHORT, "-s", "vary.0.values=[1e5, 1e6, 1e7]",
                         *options)

    def refuse(self, *arguments):
        refused = run(*arguments)
        self.assertEqual(refused.returncode, 2, refused.stderr)
        self.assertTrue(refused.stderr.startswith("linkstudy: error: "), refused.stderr)
        return refused.stderr

    def test_a_directory_without_its_journal_names_the_file_that_is_left(self):
        self.study()
        (self.results / "journal.bin").unlink()
        for verb in ("report", "export", "verify"):
            told = self.refuse(verb, self.results)
            self.assertIn(f"{self.results}: holds no study (journal.bin is missing)", told)
            self.assertIn(f"name {self.results / 'results.h5'}", told)
        self.assertEqual(run("report", self.results / "results.h5").returncode, 0)

    def test_an_empty_directory_and_one_of_other_files_hold_no_study(self):
        for name in ("empty", "others"):
            folder = Path(self.folder.name) / name
            folder.mkdir()
            if name == "others":
                (folder / "notes.txt").write_text("mine")
            before = sorted(folder.iterdir())
            self.assertIn("journal.bin is missing", self.refuse("report", folder))
            self.assertEqual(sorted(folder.iterdir()), before)

    def test_a_results_file_that_is_cut_off_anywhere_is_an_error_with_its_name(self):
        self.study()
        whole = (self.results / "results.h5").read_bytes()
        cut = Path(self.folder.name) / "cut.h5"
        for size in (0, 1, 100, len(whole) // 4, len(whole) // 2, len(whole) - 1):
            cut.write_bytes(whole[:size])
            self.assertIn(f"{cut}: ", self.refuse("report", cut))
            self.assertFalse(cut.with_suffix(".html").exists())
        # The journal is the truth: the directory needs no results.h5.
        (self.results / "results.h5").write_bytes(whole[:100])
        self.assertEqual(run("report", self.results).returncode, 0)

    def reports_of_cut_journals(self):
        """The journal cut off at eleven places: what `report` says, and the data of its page,
        where it does not refuse."""
        whole = (self.results / "journal.bin").read_bytes()
        for part in range(1, 12):
            (self.results / "journal.bin").write_bytes(whole[:len(whole) * part // 12])
            made = run("report", self.results)
            if made.returncode == 2:
                self.assertIn("error:", made.stderr)
                continue
            self.assertEqual(made.returncode, 0, made.stderr)
            yield made, island_of((self.results / "report.html").read_text())

    def test_a_journal_that_is_cut_off_anywhere_gives_a_report_of_what_is_left(self):
        page = self.study()
        counted = set()
        for made, data in self.reports_of_cut_journals():
            left = data["counts"]["evaluations"]
            counted.add(left)
            self.assertIn("torn or damaged", made.stderr)
            self.assertIn("torn or damaged", data["dropped"])
            if left < 3:
                self.assertEqual(data["status"], f"{left} of 3 evaluations")
        self.assertIn(0, counted)
        self.assertLess(max(counted), island_of(page)["counts"]["evaluations"] + 1)
        shown = self.check_clean((self.results / "report.html").read_text())
        self.assertIn("torn or damaged", shown["text"])

    def test_an_analysis_that_is_cut_off_is_shown_as_far_as_it_is_there(self):
        self.analyse("kinematics", "four_bar_double_rocker")
        digest = island_of(self.report())["digest"]
        told = set()
        for _, data in self.reports_of_cut_journals():
            told.add(data["status"])
            if data["status"] == "done":
                self.assertEqual(data["digest"], digest)
            else:
                self.assertEqual(data["marks"], [])  # what is not there is not made up
        self.assertIn("no answer yet", told)
        shown = self.check_clean((self.results / "report.html").read_text())
        self.assertIn("torn or damaged", shown["text"])
        # The same command completes it.
        self.analyse("kinematics", "four_bar_double_rocker")
        data = island_of(self.report())
        self.assertEqual((data["status"], data["digest"], data["dropped"]), ("done", digest, ""))

    def test_a_journal_without_any_record_holds_nothing_to_show(self):
        self.study()
        journal = self.results / "journal.bin"
        journal.write_bytes(journal.read_bytes()[:80])  # its header
        self.assertIn("ended before anything was begun", self.refuse("report", self.results))

    def test_a_page_that_a_browser_saved_still_works(self):
        page = self.study()
        again = saved(page, self.folder.name)
        self.assertIn("<canvas", again)  # it holds what was drawn
        self.assertEqual(island_of(again), island_of(page))
        first = self.check_shown(page, charts=3)
        second = self.check_shown(again, charts=3)
        self.assertEqual(second["text"], first["text"])
        self.assertEqual(second["tables"], first["tables"])


class Large(PageTest):
    # Two slow processors without a graphics card may do other things as well: the best of five.
    def check(self, page):
        self.assertLess(len(page), 10e6)
        times = []
        while len(times) < 5 and min(times, default=9.0) >= 2.0:
            times.append(drawing_time(page, self.folder.name))
        print(f"{self.id().split('.')[-1]}: {len(page) / 1e6:.2f} MB, {min(times):.2f} s")
        self.assertLess(min(times), 2.0)
        seen = show(page, self.folder.name)
        self.assertEqual(seen["problems"], [])

    def test_a_thousand_evaluations(self):
        values = [1e4 * 10 ** (4 * i / 999) for i in range(1000)]
        page = self.make("study", "rsrrp_stiffness", "-s", "simulation.end_time=0.05", "-s",
                         "match.0.window=[0.01, 0.05]", "-s", f"vary.0.values={values}")
        self.assertEqual(island_of(page)["counts"]["evaluations"], 1000)
        self.check(page)

    def test_fifteen_seconds_of_milliseconds(self):
        model = Given.tree / "configs" / "mechanisms" / "rsrrp.toml"
        ran = run("simulate", model, "-o", self.results, "--progress", "none", "-s",
                  "simulation.end_time=15", "-s", "simulation.output_interval=1e-3")
        self.assertEqual(ran.returncode, 0, ran.stderr)
        page = self.report()
        (history,) = island_of(page)["histories"]
        self.assertEqual(len(numbers(history["time"], "f")), 15001)
        self.check(page)


if __name__ == "__main__":
    Given.main(sys.argv)
