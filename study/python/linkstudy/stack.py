"""Columns of a file side by side, as one array that is read when it is needed."""

import numpy as np
import xarray as xr
from xarray.core import indexing


class Stack(xr.backends.BackendArray):
    """Columns as an array whose last axis is along them.

    `cells` is an array of the paths of the columns, of any shape, or one path. Where a path is
    None, and beyond the end of a column that is shorter than `length`, the numbers are NaN.
    """

    def __init__(self, stored, cells, length):
        self.stored = stored
        self.cells = np.array(cells, dtype=object)
        first = next(path for path in self.cells.flat if path is not None)
        self.dtype = np.dtype(stored.kind(first)[0])
        self.length = length
        self.shape = self.cells.shape + (length,)

    def __getitem__(self, key):
        outer = indexing.IndexingSupport.OUTER
        return indexing.explicit_indexing_adapter(key, self.shape, outer, self.take)

    def take(self, key):
        """The values at a tuple of whole numbers, slices and arrays, each for one axis."""
        cells, along = self.cells, key[-1]
        for axis in reversed(range(cells.ndim)):  # whole numbers take axes away from behind
            cells = cells[(slice(None),) * axis + (key[axis],)]
        cells = np.array(cells, dtype=object)
        taken = np.empty(cells.shape + np.arange(self.length)[along].shape, self.dtype)
        for place, path in np.ndenumerate(cells):
            taken[place] = self.column(path)[along]
        return taken

    def column(self, path):
        values = self.stored.read(path) if path is not None else []
        if len(values) == self.length:
            return values
        padded = np.full(self.length, np.nan, self.dtype)
        padded[:len(values)] = values
        return padded


def variable(stored, dims, cells, length, attributes=None):
    """An xarray variable of a Stack, with the attributes of its first column."""
    stack = Stack(stored, cells, length)
    first = next(path for path in stack.cells.flat if path is not None)
    attributes = {**stored.attributes(first), **(attributes or {})}
    return xr.Variable(dims, indexing.LazilyIndexedArray(stack), attributes)
