"""What users call: studies and tables of results as xarray Datasets."""

import contextlib
import re
import tomllib

import numpy as np
import xarray as xr

from .histories import find_histories
from .stack import variable
from .stored import Stored

# Groups of what a verb concludes, each with one group for the study and its tables below.
ANSWERS = ["tuning", "calibration", "convergence", "sensitivity", "statics", "kinematics"]
# Tables that `linkstudy export` calls otherwise than results.h5.
EXPORTED = {"result": "tuning", "estimates": "calibration", "findings": "summary",
            "evaluations": "tuning_evaluations"}
AXES = {"time", "sample", "reference_time", "reference_sample", "load_case"}
LISTS = ["contacts", "reference", "traces"]  # groups with a table for every run


def open(path, *, partial=False, histories=True, engine=None):
    """The evaluations of a study as a Dataset; `path` is a results directory or a results.h5.

    Over `evaluation` (their numbers, the coordinate) stand
      - parameters, responses and errors of matches, each with `units`, `long_name`, `path` and
        `role` ("parameter", "response", "derived"); relative errors are fractions, not percent;
      - `status`, a number with `flag_values` and `flag_meanings` (0 is ok; see ok() and causes()),
        `message`, `attempts` and `parent_evaluation`. Failed evaluations stay, with NaN.
    Where load cases (of a calibration: experiments) have names, `load_case` is a second axis, with
    these names, of all that each of them has: data.torque.sel(load_case="fast"). What only some
    of them have keeps the name of the load case before its own.

    Time histories have the names of channels, over (`evaluation`, `time`) or (`evaluation`,
    `load_case`, `time`); those of the reference are reference_NAME over `time` or (`load_case`,
    `time`). Nothing is ever interpolated:
      - Runs that share their instants (to 1e-9) from the begin on, however far they come, share
        the axis `time`; after the end of a run, and where a run was not kept, there is NaN.
      - Otherwise the axis is `sample`, and `time` is a coordinate of the shape of the histories:
        data.joint_A_q.sel(evaluation=3).plot(x="time").
      - A reference whose instants are not those of the runs has `reference_time` in the same way
        (over `reference_sample` where its load cases differ among themselves).
    A history with the name of a response is history_NAME, a response with that of an axis
    response_NAME.

    Attributes are those of the file (`results_digest`, `seed`, `status`, ...), `name` and `kind`.
    `partial=True` also opens results in which rows are missing yet, `histories=False` leaves those
    out, `engine` is "h5py" or "netcdf4" (slow where there are many histories). Values are read when
    they are needed, histories too.
    """
    with opened(path, engine, partial) as stored:
        columns = read_columns(stored, "study")
        cases = load_cases(stored)
        rows = by_load_case(stored, columns, cases)
        rows = {f"{of.attrs['role']}_{name}" if name in AXES else name: of
                for name, of in rows.items()}
        coordinates = {"evaluation": rows.pop("evaluation")}
        if histories:
            found, times = find_histories(stored, columns["evaluation"].values, cases)
            rows.update({f"history_{name}" if name in rows else name: of
                         for name, of in found.items()})
            coordinates.update(times)
        if cases:
            coordinates["load_case"] = ("load_case", cases, {"long_name": "load case"})
        attributes = {**stored.attributes(), **group_attributes(stored, "study")}
        return closing(xr.Dataset(rows, coordinates, attributes), stored)


def ok(data):
    """The evaluations of open() or table(path, "evaluations") that ended ok."""
    words = data.status.attrs["flag_meanings"].split()
    return data.isel(evaluation=data.status.values == words.index("ok"))


def causes(data):
    """Why each evaluation ended, in words ("ok", "diverged", ...), over `evaluation`."""
    words = np.array(data.status.attrs["flag_meanings"].split(), dtype=object)
    return xr.DataArray(words[data.status.values], data.status.coords, ["evaluation"], "cause")


def tables(path, *, engine=None):
    """The tables there are, as a dict from their names to their numbers of rows.

    Names are those of `linkstudy export --list` (but `summary` of studies and `traces` and
    `contacts` of all runs together, which export makes), and of each run its own
    "traces/evaluation_3", "reference/reference", "contacts/evaluation_3".
    """
    with opened(path, engine, True) as stored:
        counts = {name: row_count(stored, group) for name, group in table_groups(stored).items()}
        stored.close()
        return {name: rows for name, rows in counts.items() if rows > 0}


def table(path, name, *, partial=False, engine=None):
    """A table of tables() as a Dataset over its rows (`evaluation`, `time` or `row`).

    Columns have the attributes `units` (numbers), `long_name` and `path`. Attributes are those of
    the table; with the tables of a tune, a calibration and so on `answer`, all of it as JSON; of
    `provenance` the texts of the input. A history has here its own instants alone.
    """
    with opened(path, engine, partial) as stored:
        groups = table_groups(stored)
        if name not in groups:
            raise stored.missing_table(name, list(groups))
        columns = read_columns(stored, groups[name])
        data = xr.Dataset(columns, attrs=group_attributes(stored, groups[name]))
        # What is "seconds since ..." becomes a time of the calendar, nothing else changes.
        return closing(xr.decode_cf(data, mask_and_scale=False, decode_timedelta=False), stored)


@contextlib.contextmanager
def opened(path, engine, partial):
    """The stored file, closed again where what is done with it fails."""
    stored = Stored(path, engine)
    try:
        stored.require_complete(partial)
        yield stored
    except BaseException:
        stored.close()
        raise


def closing(data, stored):
    """The Dataset, whose close() closes the file."""
    data.set_close(stored.close)
    return data


def read_columns(stored, group):
    """The columns of a group over its axis, which is a column itself."""
    names = stored.names(group)
    if not names:
        return {}
    attributes = {name: stored.attributes(f"{group}/{name}") for name in names}
    axis = next(name for name in names if attributes[name].get("role") in ("axis", "row"))
    length = stored.kind(f"{group}/{axis}")[1]
    return {name: variable(stored, (axis,), f"{group}/{name}", length) for name in names}


def group_attributes(stored, group):
    """Of a group and of the one that it is part of."""
    above = stored.attributes(group.rpartition("/")[0] or "/") if group.count("/") == 2 else {}
    own = {**above, **stored.attributes(group)}
    own.pop("path", None)
    return own


def load_cases(stored):
    """Names of the load cases, or of experiments, in the order of the input; often none."""
    text = stored.attributes("provenance").get("resolved_study", "")
    if "load_case" not in text and "experiment" not in text:
        return []
    try:
        study = tomllib.loads(text)
    except tomllib.TOMLDecodeError as problem:
        raise stored.damage(problem) from None
    return [case["name"] for case in study.get("load_case", []) + study.get("experiment", [])]


def by_load_case(stored, columns, cases):
    """The columns, those of load cases side by side over (`evaluation`, `load_case`)."""
    paths = {of.attrs["path"]: name for name, of in columns.items()
             if of.attrs["role"] in ("response", "derived")}
    rows, split = dict(columns), {}
    start = f"{cases[0]}_" if cases else ""
    for path in paths if cases else ():
        rest = path[len(start):]
        own = [paths.get(f"{case}_{rest}") for case in cases]
        name = re.sub("[^A-Za-z0-9_]", "_", rest)
        if path.startswith(start) and None not in own and name not in {**columns, **split}:
            split[name] = stack_cases(stored, own, columns[own[0]], rest)
            for one in own:
                rows.pop(one, None)
    return {**rows, **split}


def stack_cases(stored, names, first, path):
    stacked = variable(stored, ("load_case", "evaluation"), [f"study/{name}" for name in names],
                       first.sizes["evaluation"], {"path": path})
    return stacked.transpose("evaluation", "load_case")


def table_groups(stored):
    """From the name of every table to its group."""
    top = stored.names()
    found = {"evaluations": "study"}
    for kind in (kind for kind in ANSWERS if kind in top):
        for study in stored.names(kind):
            for part in stored.names(f"{kind}/{study}"):
                name = EXPORTED.get(part, part)
                found[f"{kind}_{name}" if name in found else name] = f"{kind}/{study}/{part}"
    found.update({name: name for name in ("runtime", "provenance") if name in top})
    for group in (group for group in LISTS if group in top):
        found.update({f"{group}/{run}": f"{group}/{run}" for run in stored.names(group)})
    return found


def row_count(stored, group):
    names = stored.names(group)
    return stored.kind(f"{group}/{names[0]}")[1] if names else 0
