"""A run folder as the pictures see it: trajectory.h5 (H5MD 1.1), opened for reading only."""

import errno
import os

# A closed file of a run is never written again, and locks fail on some shared file systems.
os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")

import h5py
import numpy as np

from plain_hdf5 import NotPlain, check_sources, find_dataset

DAMAGED, MISSING, CANNOT_CREATE, IO_ERROR = 65, 66, 73, 74


class PlotError(Exception):
    """An error the user can meet, with the exit code that tells its kind."""

    def __init__(self, code, message):
        super().__init__(message)
        self.code = code


class Nothing(Exception):
    """The run holds too little for a picture: not an error."""


class Run:
    """Datasets are read in slices, on demand: a run may be far larger than the memory."""

    def __init__(self, folder, tables=None):
        """@param tables  folder of what `skein analyze` wrote; DIR/analysis without"""
        self.folder = folder
        self.tables = tables or os.path.join(folder, "analysis")
        self.path = os.path.join(folder, "trajectory.h5")
        if not os.path.isdir(folder):
            raise PlotError(MISSING, f"the run folder {folder} is not there")
        if not os.path.isfile(self.path):
            raise PlotError(MISSING, f"{folder} holds no trajectory.h5: no run, or one that has written no frame yet")
        try:
            self.file = h5py.File(self.path, "r")
        except OSError as error:
            raise PlotError(DAMAGED, f"{self.path} cannot be read: {error}") from None
        self.checked = {}  # arrays that were found as they should be

        self.frame_times = self._times("centreline")
        self.step_times = self._times("end_to_end")
        self.sections = self._whole_numbers("fiber_sections")
        self.first_section = self._whole_numbers("first_section")
        self.radius = self.parameter("fiber_radius").astype(float)
        if len(self.frame_times) == 0:
            raise PlotError(DAMAGED, f"{self.path} holds no frame")
        self._check_fibers()
        if self.dataset("/observables/centreline/value").shape[1:] != (self.n_sections, 3):
            raise PlotError(DAMAGED, f"{self.path}: /observables/centreline does not fit /parameters/fiber_sections")

    @property
    def n_fibers(self):
        return len(self.sections)

    @property
    def n_sections(self):
        return int(self.sections.sum())

    @property
    def lengths(self):
        """[n_fibers], at rest; as measured in the first step where the run does not say."""
        if "fiber_length" in self.file["/parameters"]:
            return np.atleast_1d(self.parameter("fiber_length")).astype(float)
        return self.steps("centreline_length")[0] if self.n_steps else np.full(self.n_fibers, np.nan)

    @property
    def n_steps(self):
        return len(self.step_times)

    def attribute(self, name):
        value = self.file["/parameters"].attrs.get(name, "")
        if not isinstance(value, (str, bytes)):
            raise PlotError(DAMAGED, f"{self.path}: {name} of /parameters is no single text")
        return value.decode(errors="replace") if isinstance(value, bytes) else value

    def dataset(self, name):
        if name not in self.checked:
            try:
                found = find_dataset(self.file, name)
                if found.is_virtual:
                    check_sources(found, name, self.folder)
            except NotPlain as error:
                raise PlotError(DAMAGED, f"{self.path}: {error}") from None
            except (OSError, RuntimeError) as error:
                raise PlotError(DAMAGED, f"{self.path}: a part of {name} is missing or damaged: {error}") from None
            self.checked[name] = found
        return self.checked[name]

    def parameter(self, name):
        return self.dataset(f"/parameters/{name}")[()]

    def centreline(self, frame):
        """[n_sections, 3] at one frame."""
        return self.dataset("/observables/centreline/value")[frame]

    def steps(self, name, n_fibers=None):
        """[n_steps, ...] of an observable of every step; of the first n_fibers only, if given."""
        values = self.dataset(f"/observables/{name}/value")
        if n_fibers is None:
            return values[: self.n_steps].astype(float)
        return values[: self.n_steps, :n_fibers].astype(float)

    def fiber_sections(self, fiber):
        first = self.first_section[fiber]
        return slice(first, first + self.sections[fiber])

    def _times(self, name):
        times = self.dataset(f"/observables/{name}/time")[()]
        if times.ndim != 1 or not np.isfinite(times).all() or not (np.diff(times) > 0).all():
            raise PlotError(DAMAGED, f"{self.path}: the times in /observables/{name} do not grow")
        return times

    def _whole_numbers(self, name):
        return np.atleast_1d(self.parameter(name)).astype(int)

    def _check_fibers(self):
        sound = self.sections.ndim == 1 and (self.sections > 0).all() and self.radius.shape == self.sections.shape
        starts = np.concatenate(([0], np.cumsum(self.sections)[:-1]))
        if not sound or not np.array_equal(starts, self.first_section) or not (self.radius > 0).all():
            raise PlotError(DAMAGED, f"{self.path}: the fibers in /parameters do not fit each other")


def write_error(path, error):
    full = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO)
    code = IO_ERROR if error.errno in full else CANNOT_CREATE
    return PlotError(code, f"{path} cannot be written: {error.strerror or error}")
