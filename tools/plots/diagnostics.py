"""What `skein analyze` measured, as the pictures see it."""

import numpy as np

from script import Nothing
from skein_package import Error

REGIMES = ["tumble", "C", "S", "snake", "coil", "three-dimensional"]


def open_diagnostics(run):
    """diagnostics.h5 of a run, as h5py has it."""
    try:
        return run.diagnostics.file
    except Error as error:
        raise Nothing(error) from None


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
