"""Tables of a run, each as a mapping from names to arrays."""

import os
from collections.abc import Mapping

import h5py
import numpy as np

from .errors import DamagedData, MissingInput
from .plain_hdf5 import NotPlain, check_file, has_hard_link

FIRST_OF_STEPS = "end_to_end"  # which holds the times of all


class Series(Mapping):
    """What a run writes down at every accepted step: "energy" [n_steps, n_fibers], "dt" [n_steps], ...; "time" and
    "step" say when. Units are in the file, unit() gives them."""

    def __init__(self, run):
        self._run = run

    def _place(self, name):
        if name in ("time", "step"):
            return f"/observables/{FIRST_OF_STEPS}/{name}"
        if name not in self:
            raise KeyError(f"{name!r} is no series of {self._run.folder}: there are {', '.join(self)}")
        return f"/observables/{name}/value"

    def __getitem__(self, name):
        return self._run.dataset(self._place(name))[: self._run.n_steps]

    def unit(self, name):
        """"length", "1/time", ...; empty for pure numbers"""
        unit = self._run.dataset(self._place(name)).attrs.get("unit", "")
        return unit.decode() if isinstance(unit, bytes) else str(unit)

    def _is_of_steps(self, name):
        observables = self._run.file["/observables"]
        if name in ("centreline", "curvature") or not has_hard_link(observables, name):
            return False
        return isinstance(observables[name], h5py.Group) and has_hard_link(observables[name], "value")

    def __iter__(self):
        yield "time"
        yield "step"
        yield from (name for name in self._run.file["/observables"] if self._is_of_steps(name))

    def __contains__(self, name):
        return name in ("time", "step") or self._is_of_steps(name)

    def __len__(self):
        return sum(1 for _ in self)


class Diagnostics(Mapping):
    """diagnostics.h5, which `skein analyze` wrote of the very frames that the run has."""

    def __init__(self, run):
        path = os.path.join(run.tables, "diagnostics.h5")
        if not os.path.isfile(path):
            raise MissingInput(f"there is no {path}: run 'skein analyze' first")
        try:
            self.file = h5py.File(path, "r")
            check_file(self.file)
        except (OSError, RuntimeError, NotPlain):
            raise DamagedData(f"{path} cannot be read: run 'skein analyze' again") from None
        if not np.array_equal(self.file["time"][()], run.frame_times):
            raise DamagedData(f"{path} is not of these frames: run 'skein analyze' again")

    def __getitem__(self, name):
        found = self.file.get(name)
        if not isinstance(found, h5py.Dataset):
            raise KeyError(f"{name!r} is not among what was measured; 'fiber_0/angle' is, of each fiber")
        return found[()]

    def __iter__(self):
        names = []
        self.file.visititems(lambda name, item: names.append(name) if isinstance(item, h5py.Dataset) else None)
        return iter(names)

    def __len__(self):
        return len(list(iter(self)))
