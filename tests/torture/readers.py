"""Whoever reads a run while it writes finds whole frames only."""

import h5py
import numpy as np

from program import DONE, require

OVERRIDES = ["time.end=12.0", "time.max_step=0.01", "output.frame_interval=0.02", "checkpoint.simulated_interval=0.06"]


def read_once(index):
    with h5py.File(index, "r") as file:
        position = file["particles/fibers/position"]
        values, times, steps = position["value"][...], position["time"][...], position["step"][...]
        energies = file["observables/energy/value"][...]
    require(len(values) == len(times) == len(steps), "arrays of different lengths")
    require(np.isfinite(values).all() and np.isfinite(times).all() and np.isfinite(energies).all(), "a partial frame")
    require((steps >= 0).all() and (np.diff(times) > 0).all(), "frames out of order")
    return len(times)


def torture(program, counts, seed=8):
    n_opened, seen, n_runs = 0, set(), 0
    while n_opened < counts["readings"]:
        folder = program.fresh("read")
        process = program.start(program.run_command(folder, OVERRIDES))
        last = 0
        while process.poll() is None and n_opened < counts["readings"]:
            if not (folder / "trajectory.h5").exists():
                continue
            n_frames = read_once(folder / "trajectory.h5")
            require(n_frames >= last, "frames vanished")
            last = n_frames
            seen.add((n_runs, n_frames))
            n_opened += 1
        if process.poll() is None:
            process.terminate()
        _, messages = process.communicate(timeout=60)
        require(process.returncode in (DONE, 75), f"the run ended with {process.returncode}: {messages}")
        n_runs += 1
    require(len(seen) >= min(20, n_opened // 4), f"the run was hardly caught writing: {len(seen)} different states")
    return n_opened, f"{len(seen)} different states in {n_runs} runs"
