"""table.csv of a sweep, as the pictures see it."""

import csv
import os

import numpy as np
from matplotlib.colors import LogNorm, Normalize

from diagnostics import REGIMES
from skein_package import DamagedData, MissingInput

WORDS = {"regime": REGIMES, "wave": ["standing", "travelling", "unclear"]}  # what codes stand for
WIDE = 20.0  # a ratio of values that a logarithmic axis shows better


class Column:
    """One column: numbers, codes of words, or places in a list of texts."""

    def __init__(self, heading, cells):
        name, _, unit = heading.partition(" [")
        self.name = name
        unit = unit.rstrip("]")
        self.label = name.replace("_", " ") + (f" ({unit})" if unit not in ("", name) else "")
        try:
            self.values = np.array([float(cell) for cell in cells])
            self.words = WORDS.get(name)
        except ValueError:
            self.words = sorted(set(cells))
            self.values = np.array([self.words.index(cell) for cell in cells], dtype=float)

    def is_wide(self):
        known = self.values[np.isfinite(self.values)]
        return self.words is None and known.size > 1 and known.min() > 0.0 and known.max() > WIDE * known.min()

    def scale(self):
        """Of colours: that of an axis."""
        known = self.values[np.isfinite(self.values)]
        return (LogNorm if self.is_wide() else Normalize)(known.min(), known.max())

    def shown(self, value):
        """A value in words of a legend."""
        return self.words[int(value)] if self.words else f"{value:.4g}"


class SweepTable:
    def __init__(self, folder):
        path = os.path.join(folder, "table.csv")
        try:
            with open(path, newline="", encoding="utf-8") as file:
                rows = list(csv.reader(file))
        except OSError as error:
            raise MissingInput(f"{path} cannot be read: {error.strerror}") from None
        except (csv.Error, UnicodeDecodeError) as error:
            raise DamagedData(f"{path} is no table: {error}") from None
        if not rows or any(len(row) != len(rows[0]) for row in rows):
            raise DamagedData(f"{path} is no table: its lines have different numbers of cells")
        self.path = path
        self.cells = {heading.partition(" [")[0]: (heading, [row[i] for row in rows[1:]])
                      for i, heading in enumerate(rows[0])}
        state = np.array(self.cells["state"][1]) if "state" in self.cells else np.array([])
        self.is_done = state == "done"
        self.is_failed = state == "failed"

    def column(self, name):
        if name not in self.cells:
            raise MissingInput(f"{self.path} has no column {name}")
        return Column(*self.cells[name])
