#!/usr/bin/env python3
"""Results read by the Python module: every number is that of `linkstudy export`, to the last bit.

usage: reading_test.py LINKSTUDY TREE [options of unittest]
"""

import csv
import importlib
import io
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np
import xarray as xr

LINKSTUDY = ""
TREE = Path()
ENGINES = ("h5py", "netcdf4")
linkstudy = None  # the module under test

TRACE = """
[[trace]]
signals = ["closure.C.force", "motion.crank.effort"]
"""

# Intervals of 10 and 15 ms, springs that hold and springs that the step cannot resolve; responses
# with the names that channels and an axis have.
GRIDS = """format = 1
kind = "study"
name = "grids that differ"
model = "MODEL"
base = { set = { "closure.S.model" = "sde", "closure.S.sde.damping_ratio" = 0.7 } }
reference = { set = { "closure.S.model" = "cut" } }
vary = [
  { parameter = "simulation.output_interval", values = [INTERVALS] },
  { parameter = "closure.S.sde.stiffness", values = [1.0e5, 1.0e9] },
]
trace = [{ signals = ["closure.S.force"] }]
response = [
  { name = "closure_S_force_x", signal = "closure.S.force.x", reduce = "last" },
  { name = "time", signal = "joint.A.q", reduce = "last" },
]
"""

MEASURED = """format = 1
kind = "study"
name = "measured reference"
model = "CONFIGS/mechanisms/rsrrp.toml"
base.set."closure.S.model" = "sde"
base.set."load.drive.course.duration" = 0.05
base.set."simulation.end_time" = 1.5
vary = [{ parameter = "closure.S.sde.stiffness", values = [4.0e4, 5.0e4] }]
match = [{ signal = "closure.S.force", norm = "rms", tolerance = 0.02 }]
trace = [{ signals = ["closure.S.force"] }]

[reference]
file = "CONFIGS/data/rsrrp_force.csv"

[reference.columns]
time = "t [ms]"
"closure.S.force.x" = "Fx [N]"
"closure.S.force.y" = "Fy [N]"
"closure.S.force.z" = "Fz [N]"
"""


def run(*arguments):
    done = subprocess.run([LINKSTUDY, *map(str, arguments)], capture_output=True, text=True,
                          stdin=subprocess.DEVNULL)
    if done.returncode not in (0, 3, 4):
        raise AssertionError(f"{arguments}: exit {done.returncode}\n{done.stderr}")
    return done


def exported(results, table):
    """(columns, rows) of a table as export prints it with every digit."""
    read = json.loads(run("export", results, "--table", table, "--format", "json").stdout)
    return [column["name"] for column in read["columns"]], read["rows"]


def is_same(told, value):
    """Whether a cell of JSON is this value; a missing number is null there."""
    if told is None:
        return isinstance(value, float) and not math.isfinite(value) or value == ""
    return told == value


def cells(column):
    """The values of a column as JSON has them."""
    if "flag_meanings" in column.attrs:
        words = column.attrs["flag_meanings"].split()
        return [words[value] for value in column.values]
    return column.values.tolist()


def make_all(folder):
    """One of each kind of results, as short as may be."""
    studies, mechanisms = TREE / "configs" / "studies", TREE / "configs" / "mechanisms"

    def make(name, verb, file, *options):
        quiet = [] if verb in ("simulate", "statics", "kinematics") else ["--progress", "none"]
        run(verb, file, "-o", folder / name, *quiet, *options)

    def short(end, *windows):
        sets = [f"simulation.end_time={end}", *(f"{one}=[{end / 3}, {end}]" for one in windows)]
        return [word for value in sets for word in ("-s", value)]

    text = (studies / "quick_return_speeds.toml").read_text() + TRACE
    speeds = folder / "speeds.toml"
    speeds.write_text(text.replace("../mechanisms", str(mechanisms)))
    make("results_speeds", "study", speeds, *short(0.15, "match.0.window", "match.1.window"))
    for name, intervals in (("ragged", "0.01, 0.015"), ("shared", "0.01")):
        file = folder / f"{name}.toml"
        file.write_text(GRIDS.replace("MODEL", str(mechanisms / "rsrrp.toml"))
                        .replace("INTERVALS", intervals))
        make(name, "study", file, *short(0.3))
    file = folder / "measured.toml"
    file.write_text(MEASURED.replace("CONFIGS", str(TREE / "configs")))
    make("measured", "study", file)
    make("contacts", "simulate", mechanisms / "rsup_clearance_planar.toml", *short(0.05))
    make("tune", "tune", studies / "rsrrp_tune_loads.toml", *short(1, "match.0.window"))
    make("converge", "converge", studies / "rsrrp_converge_step.toml",
         *short(0.5, "response.1.window"), "-s", "refine.0.ladder.levels=5")
    make("calibrate", "calibrate", studies / "rsrrp_calibrate.toml", "-s", "fit.starts=2",
         "-s", "fit.max_evaluations=40")
    make("simulate", "simulate", mechanisms / "slider_crank.toml", *short(0.2))
    make("statics", "statics", mechanisms / "slider_crank.toml")
    make("kinematics", "kinematics", mechanisms / "four_bar.toml", "--positions", "20")


class Reading(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.scratch.name)
        make_all(cls.folder)
        cls.names = sorted(path.parent.name for path in cls.folder.glob("*/results.h5"))

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def open(self, name, **options):
        data = linkstudy.open(self.folder / name, **options)
        self.addCleanup(data.close)
        return data

    def table(self, name, table, **options):
        data = linkstudy.table(self.folder / name, table, **options)
        self.addCleanup(data.close)
        return data

    def check_column(self, told, column, where):
        values = cells(column)
        self.assertEqual(len(told), len(values), where)
        for one, other in zip(told, values):
            self.assertTrue(is_same(one, other), f"{where}: {one!r} is not {other!r}")

    def refuse(self, words, ask, *arguments, **options):
        with self.assertRaises(linkstudy.ResultsError) as caught:
            ask(*arguments, **options)
        for word in words:
            self.assertIn(str(word), str(caught.exception))

    def test_tables_are_those_of_export_to_the_last_bit(self):
        for name in self.names:
            listed = {row["table"]: row["rows"] for row in json.loads(
                run("export", self.folder / name, "--list", "--format", "json").stdout)["rows"]}
            of_runs = {"traces", "contacts"} & set(listed)
            if name not in ("statics", "kinematics"):
                of_runs.add("summary")
            for engine in ENGINES:
                there = linkstudy.tables(self.folder / name, engine=engine)
                for table in set(listed) - of_runs:
                    self.assertEqual(there[table], listed[table], (name, table))
                    self.check_table(name, table, engine)

    def check_table(self, name, table, engine):
        columns, rows = exported(self.folder / name, table)
        data = self.table(name, table, engine=engine)
        by_path = {of.attrs["path"]: of for of in data.variables.values()}
        for column in columns:
            if (table, column) == ("provenance", "time"):
                continue  # of the calendar here
            told = [row[column] for row in rows]
            self.check_column(told, by_path[column], (name, table, column, engine))

    def test_evaluations_are_those_of_export_by_load_case(self):
        for name in self.names:
            columns, rows = exported(self.folder / name, "evaluations")
            for engine in ENGINES:
                data = self.open(name, engine=engine)
                self.assertEqual(data.evaluation.values.tolist(),
                                 [row["evaluation"] for row in rows])
                flat = {}
                for of in data.variables.values():
                    if "load_case" in of.dims and "evaluation" in of.dims and of.ndim == 2:
                        for i, case in enumerate(data.load_case.values):
                            flat[f"{case}_{of.attrs['path']}"] = of[:, i]
                    elif of.dims == ("evaluation",):
                        flat[of.attrs["path"]] = of
                for column in columns:
                    self.check_column([row[column] for row in rows], flat[column],
                                      (name, column, engine))

    def test_histories_are_those_of_export_and_nan_elsewhere(self):
        seen = 0
        for name in self.names:
            groups = set(linkstudy.tables(self.folder / name))
            if not any(group.startswith(("traces/", "reference/")) for group in groups):
                continue
            lines = run("export", self.folder / name, "--traces", "--format", "csv").stdout
            rows = list(csv.DictReader(io.StringIO(re.sub("^#.*\n", "", lines))))
            for engine in ENGINES:
                seen += self.check_histories(self.open(name, engine=engine), rows, name)
        self.assertGreater(seen, 5000)

    def check_histories(self, data, rows, name):
        seen = 0
        channels = {of.attrs["path"]: key for key, of in data.data_vars.items()
                    if of.attrs.get("role") == "channel" and not key.startswith("reference_")}
        of_reference = {of.attrs["path"]: key for key, of in data.data_vars.items()
                        if key.startswith("reference_")}
        told = {key for key in rows[0] if not key.endswith(".difference")} - {"run", "time"}
        self.assertEqual({*channels, *of_reference}, told)
        for run_name in dict.fromkeys(row["run"] for row in rows):
            mine = [row for row in rows if row["run"] == run_name]
            kind, _, rest = run_name.partition("_")
            number, _, case = rest.partition("_") if kind == "evaluation" else ("", "", rest)
            at = {"evaluation": int(number)} if number else {}
            at.update({"load_case": case} if case else {})
            for path, key in (channels if number else of_reference).items():
                history = data[key].sel(at)
                time = next(of for of in history.coords if of in ("time", "reference_time"))
                told = [(float(row["time"]), float(row[path] or "nan")) for row in mine]
                self.check_history(history, history[time].values, told, (name, run_name, path))
                seen += len(told)
        return seen

    def check_history(self, history, time, told, where):
        np.testing.assert_array_equal(history[:len(told)], [value for _, value in told], str(where))
        self.assertTrue(np.isnan(history.values[len(told):]).all(), where)
        np.testing.assert_allclose(time[:len(told)], [at for at, _ in told], rtol=1e-9, atol=1e-9)

    def test_load_cases_are_an_axis_in_the_order_of_the_input(self):
        data = self.open("results_speeds")
        self.assertEqual(data.load_case.values.tolist(), ["slow", "usual", "fast"])
        self.assertEqual(data.torque.dims, ("evaluation", "load_case"))
        self.assertEqual(data.closure_C_force_x.dims, ("evaluation", "load_case", "time"))
        self.assertEqual(data.reference_closure_C_force_x.dims, ("load_case", "time"))
        self.assertEqual(data.closure___sde_stiffness.values.tolist(), [1e5, 1e6, 1e7])
        error = data.error_rms_motion_crank_effort
        self.assertEqual((error.attrs["units"], error.attrs["role"]), ("1", "response"))
        self.assertIn("motion.crank.effort", error.attrs["long_name"])
        self.assertEqual(data.torque.attrs["units"], "N m")
        # A faster crank takes more.
        self.assertTrue((data.torque.sel(load_case="fast") > data.torque.sel(load_case="slow"))
                        .all())

    def test_failed_evaluations_stay_and_are_told_apart(self):
        data = self.open("shared")
        self.assertEqual(data.status.values.tolist(), [0, 1])
        self.assertEqual(linkstudy.causes(data).values.tolist(), ["ok", "diverged"])
        self.assertEqual(linkstudy.ok(data).evaluation.values.tolist(), [0])
        self.assertEqual(linkstudy.ok(self.table("shared", "evaluations")).sizes["evaluation"], 1)
        self.assertTrue(np.isnan(data.gap_max[1]))
        self.assertTrue(data.message.values[1])
        # The diverged run ended at once: its history is what there is of it.
        self.assertEqual(data.sizes["time"], data.reference_closure_S_force_y.sizes["time"])
        self.assertEqual(np.isfinite(data.closure_S_force_y[1]).values.sum(), 1)

    def test_grids_that_differ_stay_as_they_are(self):
        data = self.open("ragged")
        self.assertEqual(data.closure_S_force_y.dims, ("evaluation", "sample"))
        self.assertEqual(data.time.dims, ("evaluation", "sample"))
        np.testing.assert_allclose(data.time[2, :3], [0, 0.015, 0.03], rtol=1e-12)
        self.assertEqual(np.isfinite(data.time).values.sum(axis=1).tolist(), [31, 1, 21, 1])
        self.assertEqual(data.reference_closure_S_force_y.dims, ("reference_time",))
        own = self.table("ragged", "traces/evaluation_2")
        self.assertEqual(own.closure_S_force_x.dims, ("time",))
        self.assertEqual(own.closure_S_force_x.values.tolist(),
                         data.history_closure_S_force_x.values[2, :21].tolist())

    def test_measured_samples_stand_at_their_own_instants(self):
        data = self.open("measured")
        self.assertEqual(data.closure_S_force_x.dims, ("evaluation", "time"))
        self.assertEqual(data.reference_closure_S_force_x.dims, ("reference_time",))
        with (TREE / "configs" / "data" / "rsrrp_force.csv").open() as file:
            lines = csv.DictReader(line for line in file if not line.startswith("#"))
            force = {float(row["t [ms]"]): row["Fx [N]"] for row in lines}
        at = 1000 * data.reference_time.values  # ms
        told = [float(force[min(force, key=lambda one: abs(one - time))]) for time in at]
        self.assertEqual(data.reference_closure_S_force_x.values.tolist(), told)

    def test_contacts_of_a_run_are_a_table(self):
        _, rows = exported(self.folder / "contacts", "contacts")
        data = self.table("contacts", "contacts/evaluation_0")
        self.assertEqual(data.peak_force.attrs["units"], "N")
        for name in data.data_vars:
            self.check_column([row[name] for row in rows], data[name], name)

    def test_names_that_are_taken_are_told_apart(self):
        data = self.open("shared")
        self.assertEqual(data.closure_S_force_x.attrs["role"], "response")
        self.assertEqual(data.history_closure_S_force_x.attrs["role"], "channel")
        self.assertEqual(data.response_time.attrs["path"], "time")
        self.assertEqual(data.time.dims, ("time",))
        self.assertEqual(data.closure_S_force_x.values[0],
                         data.history_closure_S_force_x.values[0, 30])

    def test_parts_are_those_of_the_whole(self):
        data = self.open("results_speeds").closure_C_force_x
        whole = self.open("results_speeds").closure_C_force_x.values
        picked = xr.DataArray([0, 2], dims="picked")
        np.testing.assert_array_equal(data[[0, 2], 1, 3:9:2], whole[[0, 2], 1, 3:9:2])
        np.testing.assert_array_equal(data[::-1, :, -1], whole[::-1, :, -1])
        np.testing.assert_array_equal(data[1, [2, 0], ::-2], whole[1, [2, 0], ::-2])
        np.testing.assert_array_equal(data[2, 2, 4], whole[2, 2, 4])
        np.testing.assert_array_equal(data.isel(evaluation=picked, time=picked),
                                      whole[[0, 2], :, [0, 2]])

    def test_attributes_are_those_of_the_file(self):
        data = self.open("results_speeds")
        with h5py.File(self.folder / "results_speeds" / "results.h5") as file:
            for name in ("results_digest", "input_sha256", "seed", "status", "git_revision"):
                self.assertEqual(data.attrs[name], file.attrs[name])
        self.assertEqual(data.attrs["kind"], "study")
        self.assertEqual(data.attrs["name"], "quick-return linkage at three crank speeds")
        answer = json.loads(self.table("tune", "tuning").attrs["answer"])
        self.assertIn("status", answer)
        start = self.table("tune", "provenance")
        self.assertEqual(start.time.dtype.kind, "M")
        self.assertIn("kind = \"tune\"", start.attrs["resolved_study"])

    def test_a_dataset_is_saved_by_xarray(self):
        data = self.open("results_speeds").load()
        for engine, name in (("netcdf4", "one.nc"), ("h5netcdf", "two.nc")):
            data.to_netcdf(self.folder / name, engine=engine)
            with xr.open_dataset(self.folder / name, engine=engine) as back:
                xr.testing.assert_identical(back.load().drop_vars("message"),
                                            data.drop_vars("message"))

    def test_a_file_alone_is_enough(self):
        alone = self.folder / "alone.h5"
        shutil.copy(self.folder / "shared" / "results.h5", alone)
        with linkstudy.open(alone) as data, linkstudy.open(str(self.folder / "shared")) as same:
            xr.testing.assert_identical(data.load(), same.load())
        with linkstudy.open(alone, histories=False) as data:
            self.assertNotIn("closure_S_force_y", data)

    def test_what_is_no_results_says_what_to_do(self):
        self.refuse(["nowhere", "-o"], linkstudy.open, self.folder / "nowhere")
        empty = self.folder / "empty"
        empty.mkdir()
        self.refuse([empty, "holds no results"], linkstudy.tables, empty)
        shutil.copy(self.folder / "tune" / "journal.bin", empty)
        self.refuse([empty, "linkstudy status", "the same command"], linkstudy.open, empty)
        other = self.folder / "other.h5"
        xr.Dataset({"x": 1.0}).to_netcdf(other, engine="h5netcdf")
        self.refuse([other, "none of linkstudy"], linkstudy.open, other)
        with h5py.File(other, "w") as file:
            file.attrs.update({"format": "linkstudy results", "format_version": 2})
        self.refuse([other, "version 2"], linkstudy.open, other)
        self.refuse(["no table 'tunin'", "did you mean 'tuning'?", "certificate"],
                    linkstudy.table, self.folder / "tune", "tunin")

    def test_damage_is_told_and_the_cure_works(self):
        for engine in ENGINES:
            self.damage(engine, lambda data: data[:4000])
            self.damage(engine, lambda data: b"")
            self.damage(engine, lambda data: b"plain text")

    def damage(self, engine, change):
        results = self.folder / "damaged"
        shutil.rmtree(results, ignore_errors=True)
        shutil.copytree(self.folder / "shared", results)
        file = results / "results.h5"
        whole = file.read_bytes()
        file.write_bytes(change(whole))
        for ask in (linkstudy.open, linkstudy.tables):
            self.refuse([file, "damaged", "the same linkstudy command again"], ask, results,
                        engine=engine)
        run("study", self.folder / "shared.toml", "-o", results, "--progress", "none",
            "-s", "simulation.end_time=0.3")
        with linkstudy.open(results, engine=engine) as data:
            self.assertEqual(data.status.values.tolist(), [0, 1])

    def test_damage_inside_is_told_when_it_is_read(self):
        results = self.folder / "spoiled"
        shutil.copytree(self.folder / "simulate", results)
        file = results / "results.h5"
        with h5py.File(file) as stored:
            chunk = stored["traces/evaluation_0/joint_A_q"].id.get_chunk_info(0)
        data = bytearray(file.read_bytes())
        data[chunk.byte_offset:chunk.byte_offset + chunk.size] = b"\xff" * chunk.size
        file.write_bytes(data)
        for engine in ENGINES:
            with linkstudy.open(results, engine=engine) as opened:
                self.assertTrue(np.isfinite(opened.joint_A_v).all())
                self.refuse([file, "damaged"], lambda: opened.joint_A_q.values)

    def test_rows_that_are_missing_are_not_overlooked(self):
        for status, words in (("running", "is running, or was killed"),
                              ("interrupted", "was interrupted")):
            part = self.folder / f"{status}.h5"
            shutil.copy(self.folder / "shared" / "results.h5", part)
            with h5py.File(part, "r+") as file:
                file.attrs["status"] = status
            self.refuse([part, words, "partial=True"], linkstudy.open, part)
            self.refuse([part, words, "partial=True"], linkstudy.table, part, "evaluations")
            with linkstudy.open(part, partial=True) as data:
                self.assertEqual(data.attrs["status"], status)
                self.assertEqual(data.sizes["evaluation"], 2)

    def test_closed_results_say_so(self):
        data = linkstudy.open(self.folder / "shared")
        data.close()
        self.refuse(["closed", "load()"], lambda: data.gap_max.values)

    def test_an_engine_is_loaded_when_it_is_needed(self):
        code = ("import sys, linkstudy\n"
                "assert not {'h5py', 'netCDF4', 'h5netcdf'} & set(sys.modules)\n"
                "sys.modules['h5py'] = sys.modules[sys.argv[2]] = None\n"
                "data = linkstudy.open(sys.argv[1])\n"
                "print(data.gap_max.values[0])\n")
        self.assertIn("e-", self.alone(code, "shared", "nothing").stdout)
        none = self.alone(code, "shared", "netCDF4")
        self.assertIn("ResultsError", none.stderr)
        self.assertIn("apt-get install python3-h5py", none.stderr)

    def alone(self, code, *arguments):
        path = {**os.environ, "PYTHONPATH": str(TREE / "study" / "python")}
        return subprocess.run([sys.executable, "-B", "-c", code, *arguments], env=path, text=True,
                              cwd=self.folder, capture_output=True, stdin=subprocess.DEVNULL)

    def test_the_example_of_the_readme_runs(self):
        text = (TREE / "study" / "README.md").read_text()
        example = text.split("## Reading results\n")[1].split("```python\n")[1].split("```")[0]
        done = self.alone(example)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("certificate" if "certificate" in example else "torque", done.stdout)


if __name__ == "__main__":
    LINKSTUDY, TREE = os.path.abspath(sys.argv[1]), Path(sys.argv[2]).resolve()
    sys.path.insert(0, str(TREE / "study" / "python"))
    sys.dont_write_bytecode = True
    linkstudy = importlib.import_module("linkstudy")
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
