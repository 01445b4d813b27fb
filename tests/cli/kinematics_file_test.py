"""The HDF5 file of `linkstudy kinematics`, opened as its users do: the numbers of the CSV table,
link poses against the geometry of the four-bar, singular positions and loops.

usage: kinematics_file_test.py LINKSTUDY CONFIGS
"""
import csv
import json
import os
import subprocess
import sys
import tempfile

import h5netcdf  # noqa: F401  the engines must be there: a missing one fails this test
import h5py
import netCDF4  # noqa: F401
import numpy as np
import xarray as xr

PROGRAM, CONFIGS = (os.path.abspath(path) for path in sys.argv[1:3])


def run(model, *options):
    call = [PROGRAM, "kinematics", os.path.join(CONFIGS, "mechanisms", model + ".toml"), *options]
    return subprocess.run(call, check=True, capture_output=True, text=True).stdout


def read_csv(path):
    with open(path, encoding="utf-8") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    columns = np.array([[float(x) if x else np.nan for x in row] for row in rows[1:]]).T
    return dict(zip(rows[0], columns))


def free_names(group):
    return {v.attrs.get("path", name): v for name, v in group.variables.items()}


def check_table(path, table, engine):
    with xr.open_dataset(path, group="kinematics", engine=engine) as group:
        assert list(group.coords) == ["time"], group.coords
        columns = free_names(group)
        assert set(columns) == set(table), set(columns) ^ set(table)
        for name, values in table.items():
            np.testing.assert_array_equal(columns[name].values, values, err_msg=name)
        assert columns["joint.A.a"].attrs["units"] == "rad/s^2"
        assert columns["point.K.position.x"].attrs["units"] == "m"


def check_poses(path, table, engine):
    """Planar: link angles are sums of joint angles, frames sit at the joints."""
    crank = table["joint.A.q"]
    coupler = crank + table["joint.B.q"]
    with xr.open_dataset(path, group="poses", engine=engine) as group:
        pose = {name: v.values for name, v in free_names(group).items()}
        for link, angle in (("crank", crank), ("coupler", coupler)):
            w, x, z = (pose[f"link.{link}.e.{part}"] for part in "wxz")
            sign = np.sign(w[0] * np.cos(angle[0] / 2))
            np.testing.assert_allclose(sign * w, np.cos(angle / 2), atol=1e-14)
            np.testing.assert_allclose(sign * z, np.sin(angle / 2), atol=1e-14)
            np.testing.assert_allclose(x, 0, atol=1e-14)
        np.testing.assert_allclose(pose["link.coupler.position.x"], 0.1 * np.cos(crank), atol=1e-14)
        np.testing.assert_allclose(pose["link.rocker.position.x"], 0.4, atol=1e-15)
    point = 0.1 * np.exp(1j * crank) + (0.175 + 0.1j) * np.exp(1j * coupler)
    np.testing.assert_allclose(table["point.K.position.x"], point.real, atol=1e-14)
    np.testing.assert_allclose(table["point.K.position.y"], point.imag, atol=1e-14)


def check_parts(path, summary):
    with h5py.File(path) as file:
        assert file.attrs["mobility"] == 1 and file.attrs["redundant_constraints"] == 3
        assert json.loads(file.attrs["summary"]) == summary
        assert "[[link]]" in file.attrs["input_resolved"]
        loops = file["loops"]
        assert loops["cut"].asstr()[:].tolist() == ["closure.C"]
        assert loops["joints"].asstr()[0] == "joint.A joint.B closure.C joint.D"
        assert len(loops["elements"].asstr()[0].split()) == 3


def check_singular(path):
    limit = np.arccos(0.1)
    with xr.open_dataset(path, group="singular", engine="h5netcdf") as group:
        assert group["kind"].values.tolist() == [0, 0]
        assert group["kind"].attrs["flag_meanings"] == "lock branch stop"
        np.testing.assert_allclose(group["joint_A_q"], [limit, -limit], atol=1e-9)
        assert group["h"].values.tolist() == [1, 1] and group["h_R"].values.tolist() == [2, 2]
        assert group["joints"].values.tolist() == ["joint.B joint.D"] * 2
    with xr.open_dataset(path, group="kinematics", engine="h5netcdf") as group:
        time = group["time"].values
        assert (np.diff(time) > 0).all() and time[0] < 0 < time[-1]


def check_no_singular(path):
    with h5py.File(path) as file:
        assert len(file["singular"]["h"]) == 0


def main():
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        summary = json.loads(run("four_bar", "--json", "--h5", "bar.h5", "--csv", "bar.csv"))
        table = read_csv("bar.csv")
        for engine in ("h5netcdf", "netcdf4"):
            check_table("bar.h5", table, engine)
            check_poses("bar.h5", table, engine)
        check_parts("bar.h5", summary)
        check_no_singular("bar.h5")
        run("four_bar_double_rocker", "--h5", "locked.h5")
        check_singular("locked.h5")
        assert sorted(os.listdir()) == ["bar.csv", "bar.h5", "locked.h5"], os.listdir()


main()
