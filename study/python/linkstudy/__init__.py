"""Results of linkstudy in Python: studies as xarray Datasets.

    import linkstudy
    data = linkstudy.open("results")             # a directory made by -o, or its results.h5
    good = linkstudy.ok(data)                    # the evaluations that ended ok
    data.closure_S_force_x.sel(evaluation=3)     # a time history, over time

    linkstudy.tables("results")                  # {"evaluations": 11, "tuning": 1, ...}: rows
    linkstudy.table("results", "certificate")    # one of them, over its rows

Names are those of results.h5: of channels, parameters and responses with every character but
letters, digits and underscores replaced by an underscore; the attribute `path` has the name of
input files and of `linkstudy export`. All numbers are in the unit of the attribute `units`, as
they are stored, to the last bit. Datasets are read when their values are needed: `close()` or
`with` ends that, `load()` reads all.

What cannot be read raises ResultsError, which says what to do.
"""

from .reading import causes, ok, open, table, tables
from .stored import ResultsError

__all__ = ["ResultsError", "causes", "ok", "open", "table", "tables"]
