#!/usr/bin/python3
"""How far the nodes of two runs of one scene drift apart: the largest distance over the fiber's length at equal frames.
Of fibers resolved by other numbers of nodes, points at equal shares of their centrelines.

Usage: compare_runs.py RUN OTHER_RUN [--at-most 1e-2]
Exit code: 0; 1 where the distance is above --at-most; 2 where the runs cannot be compared.
"""

import argparse
import os
import sys

os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")

import h5py
import numpy as np


N_PLACES = 201  # along a centreline, where other numbers of sections stand for it


class Positions:
    """[n_frames, n_nodes, 3], of which one frame at a time is read."""

    def __init__(self, folder):
        try:
            self.file = h5py.File(os.path.join(folder, "trajectory.h5"), "r")
            self.value = self.file["/particles/fibers/position/value"]
            self.time = self.file["/particles/fibers/position/time"][()]
            self.centreline = self.file["/observables/centreline/value"]
            self.n_sections = self.file["/parameters/fiber_sections"][()]
            self.length = float(np.max(self.file["/parameters/fiber_length"][()]))
        except (OSError, KeyError) as error:
            raise SystemExit(f"{folder} is no run that can be read: {error}") from None


    def places(self, frame, margin):
        """[n_fibers N_PLACES, 3] along the centrelines; the first section stands half a section's share from the end."""
        found = []
        for line in np.split(self.centreline[frame], np.cumsum(self.n_sections)[:-1]):
            shares = (np.arange(len(line)) + 0.5) / len(line)
            wanted = np.linspace(margin, 1.0 - margin, N_PLACES)
            found.append(np.stack([np.interp(wanted, shares, x) for x in line.T], axis=1))
        return np.concatenate(found)


def compare(run, other):
    """(time, largest distance over length, its node or place) of every frame that both have."""
    if len(run.n_sections) != len(other.n_sections):
        raise SystemExit(f"the runs have {len(run.n_sections)} and {len(other.n_sections)} fibers")
    is_alike = run.value.shape[1:] == other.value.shape[1:]
    margin = 0.5 / min(run.n_sections.min(), other.n_sections.min())
    common, ours, theirs = np.intersect1d(run.time, other.time, return_indices=True)
    rows = []
    for time, i, j in zip(common, ours, theirs):
        ours_now, theirs_now = ((run.value[i], other.value[j]) if is_alike else
                                (run.places(i, margin), other.places(j, margin)))
        distance = np.linalg.norm(ours_now - theirs_now, axis=1) / run.length
        if not np.all(np.isfinite(distance)):
            raise SystemExit(f"t = {time:g}: a position is not a number")
        rows.append((time, distance.max(), int(distance.argmax())))
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run")
    parser.add_argument("other_run")
    parser.add_argument("--at-most", type=float, default=float("inf"), help="distance over length that is allowed")
    arguments = parser.parse_args()
    rows = compare(Positions(arguments.run), Positions(arguments.other_run))
    if len(rows) < 2:
        raise SystemExit("the runs have no two frames at equal times")
    print("time,largest_distance_over_length,node")
    for row in rows:
        print("{:g},{:.3e},{}".format(*row))
    time, largest, node = max(rows, key=lambda row: row[1])
    print(f"# largest: {largest:.3e} of the length, node {node}, t = {time:g}; {len(rows)} frames up to t = {rows[-1][0]:g}")
    return 0 if largest <= arguments.at_most else 1


if __name__ == "__main__":
    try:
        sys.exit(main())
    except SystemExit as end:
        if isinstance(end.code, str):
            print(f"compare_runs: {end.code}", file=sys.stderr)
            sys.exit(2)
        raise
