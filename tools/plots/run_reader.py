"""A run folder as the pictures see it: trajectory.h5 (H5MD 1.1), opened for reading only."""

import errno
import os

# A closed file of a run is never written again, and locks fail on some shared file systems.
os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")

import h5py
import numpy as np

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

    def __init__(self, folder):
        self.folder = folder
        self.path = os.path.join(folder, "trajectory.h5")
        if not os.path.isdir(folder):
            raise PlotError(MISSING, f"the run folder {folder} is not there")
        if not os.path.isfile(self.path):
            raise PlotError(MISSING, f"{folder} holds no trajectory.h5: no run, or one that has written no frame yet")
        try:
            self.file = h5py.File(self.path, "r")
        except OSError as error:
            raise PlotError(DAMAGED, f"{self.path} cannot be read: {error}") from None
        self._check_segments()

        self.frame_times = self._times("centreline")
        self.step_times = self._times("end_to_end")
        self.sections = self.parameter("fiber_sections").astype(int)
        self.first_section = self.parameter("first_section").astype(int)
        self.radius = self.parameter("fiber_radius").astype(float)
        if len(self.frame_times) == 0:
            raise PlotError(DAMAGED, f"{self.path} holds no frame")
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
        return self.steps("length")[0] if self.n_steps else np.full(self.n_fibers, np.nan)

    @property
    def n_steps(self):
        return len(self.step_times)

    def attribute(self, name):
        value = self.file["/parameters"].attrs.get(name, "")
        return value.decode(errors="replace") if isinstance(value, bytes) else str(value)

    def dataset(self, name):
        try:
            return self.file[name]
        except KeyError:
            raise PlotError(DAMAGED, f"{self.path} lacks {name}") from None

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
        return times[np.isfinite(times)]

    # HDF5 quietly returns fill values for segments that are lost or damaged.
    def _check_segments(self):
        position = self.dataset("/observables/centreline/value")
        steps = self.dataset("/observables/end_to_end/value")
        names = {source.file_name for d in (position, steps) if d.is_virtual for source in d.virtual_sources()}
        for name in sorted(names - {"."}):
            path = os.path.join(self.folder, name)
            try:
                h5py.File(path, "r").close()
            except OSError:
                raise PlotError(DAMAGED, f"{path}, a part of this trajectory, is missing or damaged") from None


def write_error(path, error):
    full = (errno.ENOSPC, errno.EDQUOT, errno.EIO)
    code = IO_ERROR if error.errno in full else CANNOT_CREATE
    return PlotError(code, f"{path} cannot be written: {error.strerror or error}")
