"""Reads a run folder over and over while a run writes it: check_reading_while_writing.py FOLDER COMMAND...

What a reader finds must always be whole: no NaN where a segment is missing, shapes that agree, frames only added.
"""
import pathlib
import subprocess
import sys

import h5py
import numpy as np


def count_whole_frames(path):
    with h5py.File(path, "r") as index:
        position = index["particles/fibers/position"]
        values, times = position["value"][...], position["time"][...]
    if len(values) != len(times) or np.isnan(values).any() or np.isnan(times).any():
        sys.exit(f"check_reading_while_writing: a partial frame among {len(times)}")
    return len(times)


def main():
    index = pathlib.Path(sys.argv[1]) / "trajectory.h5"
    index.unlink(missing_ok=True)
    run = subprocess.Popen(sys.argv[2:])
    seen = [0]
    while run.poll() is None:
        if index.exists():
            n_frames = count_whole_frames(index)
            if n_frames < seen[-1]:
                sys.exit("check_reading_while_writing: frames vanished")
            seen.append(n_frames)
    if run.returncode != 0:
        sys.exit(f"check_reading_while_writing: the run ended with {run.returncode}")
    if len(set(seen)) < 4:
        sys.exit(f"check_reading_while_writing: the run was too fast to be read while it wrote: {sorted(set(seen))}")
    print(f"{len(seen) - 1} reads, {len(set(seen)) - 1} different states, no partial frame")


main()
