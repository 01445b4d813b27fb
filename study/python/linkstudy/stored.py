"""A results.h5 as it is stored: groups of columns, read by h5py or netCDF4, whichever is there."""

import difflib
import importlib
from pathlib import Path

# What HDF5 keeps of its scales beside the attributes of results.
INTERNAL = {"CLASS", "NAME", "DIMENSION_LIST", "REFERENCE_LIST", "_Netcdf4Dimid",
            "_Netcdf4Coordinates", "_NCProperties"}
FORMAT = "linkstudy results"
FORMAT_VERSION = 1
BROKEN = (OSError, RuntimeError, KeyError, ValueError, IndexError)  # what the libraries raise


class ResultsError(Exception):
    """Results that cannot be read as asked. The message names the path and what to do."""


class H5pyFile:
    """Reads with h5py."""

    def __init__(self, path):
        import h5py
        self.file = h5py.File(path, "r")
        self.is_text = lambda dtype: h5py.check_string_dtype(dtype) is not None

    def close(self):
        self.file.close()

    def names(self, path):
        return list(self.file[path])

    def attributes(self, path):
        attributes = self.file[path].attrs
        return {name: attributes[name] for name in attributes if name not in INTERNAL}

    def kind(self, path):
        column = self.file[path]
        return ("O" if self.is_text(column.dtype) else column.dtype), column.shape[0]

    def read(self, path):
        column = self.file[path]
        return (column.asstr() if self.is_text(column.dtype) else column)[:]


class NetcdfFile:
    """Reads with netCDF4."""

    def __init__(self, path):
        import netCDF4
        self.file = netCDF4.Dataset(path)
        self.file.set_auto_maskandscale(False)

    def close(self):
        self.file.close()

    def names(self, path):
        return [*self.at(path).groups, *self.at(path).variables]

    def attributes(self, path):
        thing = self.at(path)
        return {name: thing.getncattr(name) for name in thing.ncattrs()}

    def kind(self, path):
        column = self.at(path)
        return ("O" if column.dtype is str else column.dtype), column.shape[0]

    def read(self, path):
        return self.at(path)[:]

    def at(self, path):
        return self.file if path == "/" else self.file[path]


ENGINES = {"h5py": ("h5py", H5pyFile), "netcdf4": ("netCDF4", NetcdfFile)}


def choose_engine(engine):
    """The class that reads with `engine`, or where it is None with the first that is there."""
    if engine is not None and engine not in ENGINES:
        raise ValueError(f"there is no engine '{engine}'; there are {' and '.join(ENGINES)}")
    for module, reader in ([ENGINES[engine]] if engine else ENGINES.values()):
        try:
            importlib.import_module(module)
            return reader
        except ImportError:
            continue
    wanted = ENGINES[engine][0] if engine else "neither h5py nor netCDF4"
    raise ResultsError(f"results.h5 cannot be read: {wanted} cannot be imported; install one, on "
                       "Debian: apt-get install python3-h5py")


def find_file(path):
    """The results.h5 of a directory, or the file itself."""
    path = Path(path)
    if not path.exists():
        raise ResultsError(f"{path}: there is no such directory or file; name a directory that "
                           "-o made, or its results.h5")
    if not path.is_dir():
        return path
    if (path / "results.h5").exists():
        return path / "results.h5"
    if (path / "journal.bin").exists():
        raise ResultsError(f"{path}: has no results.h5 yet; a run writes it now and then, and at "
                           f"its end. 'linkstudy status {path}' tells how far it is; if it runs no "
                           "more, the same command again goes on and writes it")
    raise ResultsError(f"{path}: holds no results; name a directory that -o made, or its "
                       "results.h5")


class Stored:
    """An open results file. Paths are those of its groups and columns."""

    def __init__(self, path, engine=None):
        reader = choose_engine(engine)
        self.path = find_file(path)
        self.is_open = True
        try:
            self.file = reader(self.path)
            root = self.file.attributes("/")
        except BROKEN as problem:
            raise self.damage(problem) from None
        if root.get("format") != FORMAT:
            self.close()
            raise ResultsError(f"{self.path}: is an HDF5 file, but none of linkstudy; name a "
                               "results.h5 of study, tune, converge, calibrate, simulate, "
                               "statics or kinematics")
        if root.get("format_version", 0) > FORMAT_VERSION:
            self.close()
            raise ResultsError(f"{self.path}: has version {root['format_version']} of the format, "
                               f"and this module reads {FORMAT_VERSION}; take the module that is "
                               "installed with the program that wrote it")

    def damage(self, problem):
        beside = (self.path.parent / "journal.bin").exists()
        cure = ("the same linkstudy command again writes it anew from the journal.bin beside it"
                if beside else "take another copy of it, or run the study again")
        return ResultsError(f"{self.path}: is damaged or no HDF5 file ({problem}); {cure}")

    def close(self):
        if self.is_open and hasattr(self, "file"):
            self.file.close()
        self.is_open = False

    def ask(self, what, *arguments):
        if not self.is_open:
            raise ResultsError(f"{self.path}: was closed before its values were read; open it "
                               "again, or call load() before close()")
        try:
            return getattr(self.file, what)(*arguments)
        except BROKEN as problem:
            raise self.damage(problem) from None

    def names(self, path="/"):
        """Of the groups in a group, or of its columns: it has either."""
        return self.ask("names", path)

    def attributes(self, path="/"):
        return self.ask("attributes", path)

    def kind(self, path):
        """(dtype, number of values) of a column."""
        return self.ask("kind", path)

    def read(self, path):
        """All values of a column."""
        return self.ask("read", path)

    def require_complete(self, partial):
        status = self.attributes().get("status")
        if partial or status == "complete":
            return
        state = "was interrupted" if status == "interrupted" else "is running, or was killed"
        raise ResultsError(f"{self.path}: the run {state}, and rows are missing; the same "
                           "linkstudy command again goes on with it, partial=True opens the rows "
                           "there are")

    def missing_table(self, name, names):
        near = difflib.get_close_matches(str(name), names, 1, 0.5)
        hint = f"did you mean '{near[0]}'? " if near else ""
        return ResultsError(f"{self.path}: has no table '{name}'; {hint}there are "
                            f"{', '.join(names)}")
