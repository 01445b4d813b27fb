"""Opens results files with the programs their users have: h5py and xarray with both engines.

usage: open_results.py WRITE_SAMPLE   (the executable that writes the two files)
Expected values are those of tests/study/store/sample/sample.h, written out here again.
"""
import math
import os
import re
import subprocess
import sys
import tempfile

import h5netcdf  # noqa: F401  the engines must be there: a missing one fails this test
import h5py
import netCDF4  # noqa: F401
import numpy as np
import xarray as xr

ENGINES = ("h5netcdf", "netcdf4")
NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*\Z")
CAUSES = ("ok diverged energy_blowup step_budget statics_failed assembly_failed constraint_drift "
          "contact_budget timeout cancelled exception rank_lost invalid_point "
          "step_too_coarse course_blocked no_full_turn")
PARAMETER = "closure_S_sde_stiffness"
RESPONSE = "error_max_closure_S_force_x"


def check_study(path, engine):
    with xr.open_dataset(path, group="study", engine=engine) as study:
        assert list(study.coords) == ["evaluation"], study.coords
        assert study.evaluation.values.tolist() == [0, 1, 2, 3]
        assert all(v.dims == ("evaluation",) for v in study.variables.values())
        stiffness = study[PARAMETER]
        np.testing.assert_array_equal(stiffness, [1e4 * (i + 0.1) for i in range(4)])
        assert stiffness.attrs["units"] == "N/m"
        assert stiffness.attrs["long_name"] == "stiffness of the spring"
        assert stiffness.attrs["role"] == "parameter"
        assert stiffness.attrs["path"] == "closure.S.sde.stiffness"
        assert study.closure_S_model.values.tolist() == ["sde", "cut", "sde", "cut"]
        error = study[RESPONSE]
        assert error.attrs["role"] == "response" and error.attrs["units"] == "1"
        assert math.isnan(error.sel(evaluation=2)) and error.sel(evaluation=3) == 1 / 3.1
        status = study.status
        assert status.dtype == np.uint8 and status.values.tolist() == [0, 0, 1, 0]
        assert np.asarray(status.attrs["flag_values"]).tolist() == list(range(16))
        assert status.attrs["flag_meanings"] == CAUSES
        assert study.message.values.tolist() == [
            "", "", "state is not finite at t = 0.25 s, \u03c9 h = 3.1", ""]
        assert study.attempts.values.tolist() == [1, 1, 2, 1]
        assert study.parent_evaluation.values.tolist() == [-1, -1, 1, -1]
        assert study.attrs["name"] == "stiffness of S"


def check_histories(path, engine):
    with xr.open_dataset(path, group="reference/reference", engine=engine) as reference:
        force = reference["closure_S_force_x"]
        assert force.dims == ("time",) and "time" in force.coords
        assert reference.time.attrs["units"] == "s" and force.attrs["units"] == "N"
        np.testing.assert_allclose(force, np.sin(reference.time), rtol=1e-15)
        assert force.sizes["time"] == 1501
    with xr.open_dataset(path, group="traces/evaluation_3", engine=engine) as traces:
        assert traces.attrs["evaluation"] == 3 and traces.sizes["time"] == 20


def check_rest(path, engine):
    with xr.open_dataset(path, group="tuning/S", engine=engine) as tuning:
        assert tuning.attrs["C0"] == "feasible at 2.5e4 N/m and at half the step"
        assert tuning.attrs["low"] == 2.5e4 and tuning.attrs["evaluations"] == 17
    with xr.open_dataset(path, group="tuning/S/scan", engine=engine) as scan:
        assert list(scan.coords) == ["row"]
        assert scan["error_closure_S_force"].values.tolist() == [4.0, 0.4, math.inf]
        assert scan.side.attrs["flag_meanings"] == "feasible too_soft step_too_coarse"
    with xr.open_dataset(path, group="runtime", engine=engine) as runtime:
        assert runtime["rank"].values.tolist() == [0, 1, 2, 0]
        assert runtime.wall_s.attrs["units"] == "s"
        assert runtime.evaluation.values.tolist() == [0, 1, 2, 3]
    with xr.open_dataset(path, group="provenance", engine=engine) as provenance:
        assert provenance.event.values.tolist() == ["start", "resume"]
        assert provenance.job.values.tolist() == ["", "12_3"]
        assert provenance.restart.values.tolist() == [0, 1]
        start = np.datetime64("2023-11-14T22:13:20.25")  # xarray's own decoding rounds to 0.2 us
        assert abs(provenance.time.values[0] - start) < np.timedelta64(1, "us")
        assert provenance.attrs["input_text"] == 'format = 1\nname = "\u00e4"\n'


def check_root(path, engine):
    with xr.open_dataset(path, engine=engine) as root:
        attrs = root.attrs
        assert attrs["format"] == "linkstudy results" and attrs["format_version"] == 1
        assert attrs["status"] == "complete" and attrs["seed"] == 2**64 - 1
        assert attrs["input_sha256"] == "a" * 64
        assert re.fullmatch("[0-9a-f]{64}", attrs["results_digest"])
        assert attrs["program_version"] == "0.1.0" and attrs["git_revision"] == "05ba0c3"


def check_empty(path, engine):
    with xr.open_dataset(path, engine=engine) as root:
        assert root.attrs["status"] == "running"
    with xr.open_dataset(path, group="study", engine=engine) as study:
        assert study.sizes["evaluation"] == 0 and PARAMETER in study and RESPONSE in study


def check_rules(path):
    """The layout rules, object by object."""
    seen = []

    def visit(name, thing):
        seen.append(name)
        assert NAME.match(name.split("/")[-1]), name
        if isinstance(thing, h5py.Group):
            return
        assert thing.ndim == 1, name
        text = h5py.check_string_dtype(thing.dtype)
        assert thing.dtype.kind in "fiu" or (text.encoding == "utf-8" and text.length is None), name
        assert h5py.check_enum_dtype(thing.dtype) is None and thing.dtype.names is None, name
        for attr in ("long_name", "role", "path"):
            assert isinstance(thing.attrs[attr], str), (name, attr)
        assert thing.dtype.kind == "O" or "units" in thing.attrs or "flag_values" in thing.attrs
        if not h5py.h5ds.is_scale(thing.id):
            scale = thing.dims[0][0]
            assert scale.parent == thing.parent and scale.shape == thing.shape, name

    with h5py.File(path) as file:
        file.visititems(visit)
        trace = file["reference/reference/closure_S_force_x"]
        assert trace.chunks and trace.shuffle and trace.compression == "gzip"
    assert len(seen) > 30, seen


def main():
    with tempfile.TemporaryDirectory() as folder:
        full, empty = (os.path.join(folder, name) for name in ("full.h5", "empty.h5"))
        subprocess.run([sys.argv[1], full, empty], check=True)
        assert sorted(os.listdir(folder)) == ["empty.h5", "full.h5"]
        for engine in ENGINES:
            for check in (check_root, check_study, check_histories, check_rest):
                check(full, engine)
            check_empty(empty, engine)
        check_rules(full)


main()
