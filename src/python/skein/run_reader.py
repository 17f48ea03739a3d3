"""A run's folder as arrays: frames, the numbers of its steps, what was measured in it, and its scene."""

import os
import tomllib
from typing import NamedTuple

# A closed file of a run is never written again, and locks fail on some shared file systems.
os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")

import h5py
import numpy as np

from .errors import DamagedData, MissingInput
from .plain_hdf5 import NotPlain, check_sources, find_dataset, has_hard_link
from .tables import Diagnostics, Series


class Frame(NamedTuple):
    """All nodes at one moment."""

    step: int  #: accepted steps before it
    time: float  #: at which it was saved
    position: np.ndarray  #: [n_nodes, 3], length
    centreline: np.ndarray  #: [n_sections, 3], the sections' centroids, length
    curvature: np.ndarray  #: [n_sections], unsigned, 1 / length


class Run:
    """A run's folder, opened for reading: of a run that is done, goes on, was stopped or was killed.

    Arrays are read when they are asked for, in slices, as a run may be far larger than the memory. What a run adds while
    it goes on is seen after refresh(). Nodes and sections of all fibers follow each other; fiber_nodes(f) and
    fiber_sections(f) are the slices of one.

        run = skein.Run("runs/tumbling")
        run.centrelines[-1]                 # [n_sections, 3] of the last frame
        run.series["energy"]                # [n_steps, n_fibers]
        run.diagnostics["fiber_0/angle"]    # [n_frames], of `skein analyze`
        run.scene["fiber"]["sections"]
    """

    def __init__(self, folder, tables=None):
        """@param tables  folder of what `skein analyze` wrote; DIR/analysis without"""
        self.folder = os.fspath(folder)
        self.tables = os.fspath(tables) if tables else os.path.join(self.folder, "analysis")
        self.path = os.path.join(self.folder, "trajectory.h5")
        self._open()

    def _open(self):
        if not os.path.isdir(self.folder):
            raise MissingInput(f"the run folder {self.folder} is not there")
        if not os.path.isfile(self.path):
            raise MissingInput(f"{self.folder} holds no trajectory.h5: no run, or one that has written no frame yet")
        try:
            self.file = h5py.File(self.path, "r")
        except OSError as error:
            raise DamagedData(f"{self.path} cannot be read: {error}") from None
        self.checked = {}  # arrays that were found as they should be

        self.frame_times = self._times("centreline")
        self.step_times = self._times("end_to_end")
        self.sections = self._whole_numbers("fiber_sections")
        self.first_section = self._whole_numbers("first_section")
        self.radius = self.parameter("fiber_radius").astype(float)
        if len(self.frame_times) == 0:
            raise MissingInput(f"{self.path} holds no frame yet")
        self._check_fibers()
        if self.centrelines.shape[1:] != (self.n_sections, 3):
            raise DamagedData(f"{self.path}: /observables/centreline does not fit /parameters/fiber_sections")

    def refresh(self):
        """Looks at the folder again. @returns whether there are more frames or steps than before"""
        before = len(self), self.n_steps
        self.file.close()
        self._open()
        return (len(self), self.n_steps) != before

    def __repr__(self):
        return f"<skein.Run {self.folder!r}: {self.status}, {len(self)} frames, {self.n_fibers} fibers>"

    def __len__(self):
        return len(self.frame_times)

    def __getitem__(self, frame):
        """The Frame of that number, from the end if it is negative."""
        if not -len(self) <= frame < len(self):
            raise IndexError(f"{self.folder} has no frame {frame}: there are {len(self)}")
        frame = int(frame) % len(self)
        step = int(self.dataset("/observables/centreline/step")[frame])
        return Frame(step, float(self.frame_times[frame]), self.positions[frame], self.centreline(frame),
                     self.dataset("/observables/curvature/value")[frame])

    def __iter__(self):
        return (self[frame] for frame in range(len(self)))

    @property
    def status(self):
        """"done", "stopped", "failed" or "running", which is what a killed run says of itself, too."""
        return self.attribute("status")

    @property
    def positions(self):
        """[n_frames, n_nodes, 3] of all nodes, length: an array of HDF5, of which slices are read."""
        return self.dataset("/particles/fibers/position/value")

    @property
    def centrelines(self):
        """[n_frames, n_sections, 3] of the sections' centroids, length; as positions."""
        return self.dataset("/observables/centreline/value")

    @property
    def series(self):
        """The numbers of every step by their names, with "time" and "step"."""
        return Series(self)

    @property
    def diagnostics(self):
        """What `skein analyze` measured at every frame: "time", and "fiber_0/angle" and so on for each fiber."""
        return Diagnostics(self)

    @property
    def scene_text(self):
        """The scene with every key, as TOML."""
        path = os.path.join(self.folder, "scene.toml")
        try:
            with open(path, encoding="utf-8") as file:
                return file.read()
        except FileNotFoundError:
            raise MissingInput(f"{path} is not there") from None
        except (OSError, UnicodeDecodeError) as error:
            raise DamagedData(f"{path} cannot be read: {error}") from None

    @property
    def scene(self):
        """The same as nested dictionaries: run.scene["fiber"] is a list where there are several fibers."""
        try:
            return tomllib.loads(self.scene_text)
        except tomllib.TOMLDecodeError as error:
            raise DamagedData(f"{self.folder}/scene.toml cannot be read: {error}") from None

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
        """Accepted steps of which there is a record."""
        return len(self.step_times)

    @property
    def parameters(self):
        """The names that parameter() knows."""
        group = self.file["/parameters"]
        return [name for name in group if has_hard_link(group, name) and isinstance(group[name], h5py.Dataset)]

    def attribute(self, name):
        """A text about the run: "title", "version", "commit", "integrator", ...; empty where there is none."""
        value = self.file["/parameters"].attrs.get(name, "")
        if not isinstance(value, (str, bytes)):
            raise DamagedData(f"{self.path}: {name} of /parameters is no single text")
        return value.decode(errors="replace") if isinstance(value, bytes) else value

    def dataset(self, name):
        """An array of the file by its whole name, looked over before anything of it is read."""
        if name not in self.checked:
            try:
                found = find_dataset(self.file, name)
                if found.is_virtual:
                    check_sources(found, name, self.folder)
            except NotPlain as error:
                raise DamagedData(f"{self.path}: {error}") from None
            except (OSError, RuntimeError) as error:
                raise DamagedData(f"{self.path}: a part of {name} is missing or damaged: {error}") from None
            self.checked[name] = found
        return self.checked[name]

    def parameter(self, name):
        """A number of the whole run, or one for each fiber or node: "viscosity", "bending_rigidity", "blob", ..."""
        return self.dataset(f"/parameters/{name}")[()]

    def centreline(self, frame):
        """[n_sections, 3] at one frame, length."""
        return self.centrelines[frame]

    def steps(self, name, n_fibers=None):
        """[n_steps, ...] of an observable of every step; of the first n_fibers only, if given."""
        values = self.dataset(f"/observables/{name}/value")
        if n_fibers is None:
            return values[: self.n_steps].astype(float)
        return values[: self.n_steps, :n_fibers].astype(float)

    def fiber_sections(self, fiber):
        """Where a fiber's sections are among all."""
        first = self.first_section[fiber]
        return slice(first, first + self.sections[fiber])

    def fiber_nodes(self, fiber):
        """Where a fiber's nodes are among all."""
        first = self._whole_numbers("first_node")[fiber]
        return slice(first, first + self.sections[fiber] * self._whole_numbers("fiber_nodes_per_section")[fiber])

    def _times(self, name):
        times = self.dataset(f"/observables/{name}/time")[()]
        if times.ndim != 1 or not np.isfinite(times).all() or not (np.diff(times) > 0).all():
            raise DamagedData(f"{self.path}: the times in /observables/{name} do not grow")
        return times

    def _whole_numbers(self, name):
        return np.atleast_1d(self.parameter(name)).astype(int)

    def _check_fibers(self):
        sound = self.sections.ndim == 1 and (self.sections > 0).all() and self.radius.shape == self.sections.shape
        starts = np.concatenate(([0], np.cumsum(self.sections)[:-1]))
        if not sound or not np.array_equal(starts, self.first_section) or not (self.radius > 0).all():
            raise DamagedData(f"{self.path}: the fibers in /parameters do not fit each other")
