"""Scenes and what is done with them: runs, their analysis, plans. All as the program does it, with its checks, messages and
bits; messages go to the logger "skein"."""

import json
import os
import shutil
import signal
import tempfile
import tomllib
import weakref
from collections.abc import Mapping
from typing import NamedTuple, Optional

from .errors import UsageError
from .native import _native
from .run_reader import Frame, Run
from .toml_text import write_toml, write_value


class Scene:
    """A scene that was checked: all keys are there, and fibers are where [placement] puts them.

        skein.Scene("configs/tumbling.toml")
        skein.Scene("configs/tumbling.toml", {"fiber.sections": 113, "time.end": 16.0})
        skein.Scene({"fiber": [{"center": [0.0, 0.01 * i, 0.0]} for i in range(3)], "time": {"end": 5.0}})

    text is the whole scene as TOML, warnings what is suspicious in it.
    """

    def __init__(self, source, changes=None):
        """@param source   a file's name, or nested dictionaries
        @param changes  values for keys, as `--set` of the program takes them: {"fiber[1].roll": 30.0}
        @throws SceneError with all that is wrong, MissingInput"""
        overrides = _write_changes(changes)
        if isinstance(source, Mapping):
            self._native, self._file = _native.read_scene_text(write_toml(source), "scene", overrides), None
        elif isinstance(source, (str, os.PathLike)):
            self._native, self._file = _native.read_scene_file(source, overrides), os.fspath(source)
        else:
            raise UsageError(f"a scene is a file's name or a dictionary, and no {type(source).__name__}")

    @classmethod
    def going_on_from(cls, run, scene=None, changes=None):
        """The scene of a run that begins with the state of an earlier one, as `skein run --from` has it.

        @param run    a Run, or its folder, or "folder@time" for the frame at that time
        @param scene  a file whose fibers have the same sections and nodes; without one the earlier run's own"""
        made = cls.__new__(cls)
        parent = run.folder if isinstance(run, Run) else os.fspath(run)
        made._native = _native.continue_run(parent, scene or "", _write_changes(changes))
        made._file = None
        return made

    @property
    def text(self):
        return self._native.text

    @property
    def warnings(self):
        return self._native.warnings

    def __repr__(self):
        return f"<skein.Scene of {self._file}>" if self._file else "<skein.Scene>"


def run(scene, folder=None, on_frame=None, *, overwrite=False, max_walltime=float("inf")):
    """Runs a scene to its end, as `skein run` does, and returns the Run.

    @param scene         a Scene, or what Scene takes
    @param folder        to be made for the run; without one the run is kept in memory as long as the Run is used: in a
                         folder of the system's memory (/dev/shm), or of its temporary files where that is too small
    @param on_frame      called with a Frame whenever one is saved, in double precision. By returning False it stops the
                         run, which then can go on; an exception stops it, too, and is thrown by this call
    @param overwrite     whether to replace an earlier run in the folder
    @param max_walltime  s, after which the run is stopped

    Other threads go on meanwhile. Signals that stop the program's runs stop this one, with a checkpoint, and then do what
    they would have done: after Ctrl-C this call ends by KeyboardInterrupt, and resume(folder) goes on.
    @throws SceneError, CannotCreate, OutputError, NumericalFailure (the last good state is in the folder) and others
    """
    if not isinstance(scene, Scene):
        scene = Scene(scene)
    if folder is not None:
        return _finish(_native.run(scene._native, scene._file or "", folder, overwrite, max_walltime, _on_frame(on_frame)),
                       folder)
    outer = tempfile.mkdtemp(prefix="skein-", dir=_memory_folder(scene))
    inner = os.path.join(outer, "run")
    try:
        made = _finish(_native.run(scene._native, "", inner, False, max_walltime, _on_frame(on_frame)), inner)
    except BaseException:
        shutil.rmtree(outer, ignore_errors=True)
        raise
    weakref.finalize(made, shutil.rmtree, outer, ignore_errors=True)
    return made


def resume(run, changes=None, on_frame=None, *, from_start=False, max_walltime=float("inf")):
    """Goes on with a run that was stopped, killed or failed, as `skein resume` does, and returns the Run.

    @param run         a Run or its folder
    @param changes     {"time.end": LATER} to go on to a later end; no other key can change
    @param from_start  drop the frames of a run that has no good checkpoint
    The others are those of run()."""
    folder = run.folder if isinstance(run, Run) else os.fspath(run)
    return _finish(_native.resume(folder, _write_changes(changes), from_start, max_walltime, _on_frame(on_frame)), folder)


def analyze(run, tables=None, *, forces=True):
    """Measures what the fibers of a run did, as `skein analyze` does: the tables are Run.diagnostics from then on.

    @param run     a Run or its folder
    @param tables  folder for the tables; DIR/analysis without
    @param forces  also energies, powers and particle stress, which take an evaluation of the fluid for each frame
    @returns the summary: regimes and their times, periods, hooks, as `skein analyze --json` has it"""
    folder = run.folder if isinstance(run, Run) else os.fspath(run)
    return json.loads(_native.analyze(folder, tables or "", forces))


class Plan(NamedTuple):
    """The cheapest model that answers well enough."""

    scene: Optional[Scene]  #: to be run; None if no model is good enough
    reason: str
    table: str  #: of all models that were looked at


def plan(scene, tolerance=0.03, max_seconds=600.0):
    """Finds, by pilot runs, the coarsest model of a scene whose answers stay within a tolerance, as `skein plan` does.

    @param tolerance    relative error of each answer, 1e-4 to 0.5
    @param max_seconds  of all pilot runs"""
    if not 1e-4 <= tolerance <= 0.5:
        raise UsageError(f"tolerance = {tolerance}: a number from 1e-4 to 0.5 is needed")
    if not isinstance(scene, Scene):
        scene = Scene(scene)
    found = _native.plan(scene._native, tolerance, max_seconds)
    planned = None
    if found.scene is not None:
        planned = Scene.__new__(Scene)
        planned._native, planned._file = found.scene, None
    return Plan(planned, found.reason, found.table)


def _write_changes(changes):
    if changes is None:
        return []
    if isinstance(changes, Mapping):
        return [f"{key}={write_value(key, value)}" for key, value in changes.items()]
    return [str(change) for change in changes]


def _on_frame(function):
    if function is None:
        return None
    if not callable(function):
        raise UsageError(f"on_frame is called with each Frame, and {function!r} cannot be called")
    return lambda *parts: function(Frame(*parts))


def _finish(end, folder):
    """What became of a run. A signal that stopped it does now what it would have done without the run."""
    if end.signal:
        signal.raise_signal(end.signal)
    return Run(folder)


def _memory_folder(scene):
    """Where a run is kept that has no folder; None: among temporary files."""
    memory = "/dev/shm"
    if not os.access(memory, os.W_OK) or shutil.disk_usage(memory).free < 2 * _largest_size(scene):
        return None
    return memory


def _largest_size(scene):
    """Bytes of a run's frames, and as much again and some for all else in its folder."""
    tables = tomllib.loads(scene.text)
    time, fibers = tables["time"], tables["fiber"]
    n_frames = 2 + (time["end"] - time["start"]) / tables["output"]["frame_interval"]
    n_points = sum(fiber["sections"] * (fiber["nodes_per_section"] + 2) for fiber in
                   ([fibers] if isinstance(fibers, dict) else fibers))
    return 2 * n_frames * 24 * n_points + (64 << 20)
