"""What `skein analyze` measured, as the pictures see it."""

import os

import h5py
import numpy as np

from plain_hdf5 import NotPlain, check_file
from run_reader import Nothing

REGIMES = ["tumble", "C", "S", "snake", "coil", "three-dimensional"]


def open_diagnostics(run):
    """diagnostics.h5 of a run; it must be of the very frames that the run has."""
    path = os.path.join(run.tables, "diagnostics.h5")
    if not os.path.isfile(path):
        raise Nothing(f"there is no {path}: run 'skein analyze' first")
    try:
        file = h5py.File(path, "r")
        check_file(file)
    except (OSError, RuntimeError, NotPlain):
        raise Nothing(f"{path} cannot be read: run 'skein analyze' again") from None
    if not np.array_equal(file["time"][()], run.frame_times):
        raise Nothing(f"{path} is not of these frames: run 'skein analyze' again")
    return file


def read_words(file, attribute):
    """{code: words} of an attribute such as "0 standing, 1 travelling"."""
    text = file.attrs[attribute]
    text = text.decode() if isinstance(text, bytes) else str(text)
    return {int(code): word for code, word in (entry.split(" ", 1) for entry in text.split(", "))}


def split_tracks(fiber):
    """[(times, arclengths, fit row)] of the tracked extrema of curvature."""
    points, fits = fiber["track_points"][()], fiber["tracks"][()]
    return [(points[points[:, 0] == i, 1], points[points[:, 0] == i, 2], fits[i]) for i in range(len(fits))]


def regime_spans(times, codes):
    """[(first time, end time, code)]"""
    codes = codes.astype(int)
    starts = np.concatenate(([0], np.flatnonzero(np.diff(codes)) + 1))
    ends = np.concatenate((times[starts[1:]], [times[-1]]))
    return [(times[s], e, codes[s]) for s, e in zip(starts, ends)]
