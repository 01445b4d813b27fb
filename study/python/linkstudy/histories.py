"""Time histories of all runs side by side."""

from dataclasses import dataclass

import numpy as np

from .stack import variable

SAME = 1e-9  # relative; so `export --traces` compares times with those of the reference


@dataclass
class Run:
    path: str         # of its group
    cell: tuple       # where it stands among all runs: row, and load case where they have names
    time: np.ndarray  # s
    channels: list


def find_runs(stored, group, prefixes, cases):
    """The runs in /traces or /reference that belong to a row; `prefixes`: (row, name) of each."""
    places = {}
    for row, prefix in prefixes:
        names = [f"{prefix}_{case}" for case in cases] or [prefix]
        for i, name in enumerate(names):
            places[name] = row + ((i,) if cases else ())
    runs = []
    for name in stored.names(group) if group in stored.names() else []:
        path = f"{group}/{name}"
        cell = places.get(stored.attributes(path).get("path", name))
        columns = stored.names(path)
        if cell is not None and "time" in columns:
            channels = [column for column in columns if column != "time"]
            runs.append(Run(path, cell, stored.read(f"{path}/time"), channels))
    return runs


def common_grid(grids):
    """The longest grid where all others are its begin; None where they differ or there is none."""
    if not grids:
        return None
    longest = max(grids, key=len)
    for grid in grids:
        begin = longest[:len(grid)]
        if not np.all(np.abs(grid - begin) <= SAME * np.maximum(1.0, np.abs(begin))):
            return None
    return longest


def cells_of(runs, column, shape):
    """Paths of a column in all runs that have it."""
    cells = np.full(shape, None, dtype=object)
    for run in runs:
        if column == "time" or column in run.channels:
            cells[run.cell] = f"{run.path}/{column}"
    return cells


def lay_out(stored, runs, dims, shape, grid, prefix, axis):
    """(variables, coordinates) of runs; `grid` is what all share, or None."""
    own = grid is None
    length = max(len(run.time) for run in runs) if own else len(grid)
    dims = (*dims, f"{axis}sample" if own else f"{axis}time")
    time = (variable(stored, dims, cells_of(runs, "time", shape), length) if own else
            (dims[-1], grid, stored.attributes(f"{runs[0].path}/time")))
    channels = sorted({channel for run in runs for channel in run.channels})
    return ({prefix + name: variable(stored, dims, cells_of(runs, name, shape), length)
             for name in channels}, {f"{axis}time": time})


def find_histories(stored, evaluations, cases):
    """(variables, coordinates) of all histories, those of references with "reference_" before."""
    prefixes = [((row,), f"evaluation_{number}") for row, number in enumerate(evaluations)]
    runs = find_runs(stored, "traces", prefixes, cases)
    references = find_runs(stored, "reference", [((), "reference")], cases)
    grid = common_grid([run.time for run in runs])
    reference_grid = common_grid([run.time for run in references])
    both = None if grid is None or reference_grid is None else common_grid([grid, reference_grid])
    beside = "" if both is not None or not runs else "reference_"
    cases_dims, cases_shape = (("load_case",), (len(cases),)) if cases else ((), ())
    found, coordinates = {}, {}
    for members, dims, shape, times, prefix, axis in (
            (runs, ("evaluation",), (len(evaluations),), grid, "", ""),
            (references, (), (), reference_grid, "reference_", beside)):
        if members:
            times = times if both is None else both
            own, its_time = lay_out(stored, members, dims + cases_dims, shape + cases_shape, times,
                                    prefix, axis)
            found.update(own)
            coordinates.update(its_time)
    return found, coordinates
