"""Runs that ranks share: their bits are the same for any number of ranks.

Usage: check_ranks.py SKEIN MPIRUN FOLDER [CASE...]

A case is a scene of a hundred steps or so, or of a few where it has many nodes. Frames and the numbers of every step have to be equal on 1, 2, 3 and 4 ranks, and
equal to those of a run without mpirun where sums are made by the fast multipole method."""

import os
import pathlib
import shutil
import subprocess
import sys

os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")

import h5py
import numpy as np

from checks import check, skein

FIBER = """[fiber]
sections = {sections}
nodes_per_section = {nodes}
blob = {blob}
direction = [1.0, 0.3, 0.1]
start_amplitude = 0.02
"""
TIME = """[time]
method = "{method}"
end = 100.0
max_step = {step}
[output]
precision = "double"
frame_interval = {interval}
"""
HYDRODYNAMICS = """[hydrodynamics]
method = "{sums}"
tolerance = 1e-3
check_every = 40
"""
TWO_FIBERS = """[[fiber]]
sections = 15
nodes_per_section = 9
blob = 0.0045
center = [-0.007, 0.0, 0.0]
direction = [0.0, 1.0, 0.0]
[[fiber]]
sections = 15
nodes_per_section = 9
blob = 0.0045
center = [0.007, 0.0, 0.0]
direction = [0.0, 0.0, 1.0]
[repulsion]
strength = 2.5
range = 0.005
"""
MANY_FIBERS = """seed = 7
[fiber]
sections = 7
nodes_per_section = 4
blob = 0.004
[placement]
kind = "random"
count = 64
box = [0.25, 0.25, 0.25]
gap = 0.002
orientation = "random"
[repulsion]
strength = 2.5
range = 0.005
"""
# Enough nodes apart for leaves that are far from each other.
SPREAD_FIBERS = MANY_FIBERS.replace("nodes_per_section = 4", "nodes_per_section = 6").replace("0.25", "0.5")
CASES = {
    "direct_rkc2": (FIBER.format(sections=24, nodes=18, blob=0.00225), "direct", "rkc2"),
    "direct_trbdf2": (FIBER.format(sections=24, nodes=18, blob=0.00225), "direct", "trbdf2"),
    "fmm_rkc2": (FIBER.format(sections=120, nodes=9, blob=0.0045), "fmm", "rkc2"),
    "fmm_trbdf2": (FIBER.format(sections=120, nodes=9, blob=0.0045), "fmm", "trbdf2"),
    "few_nodes": (FIBER.format(sections=10, nodes=6, blob=0.0065), "direct", "rkc2"),
    "few_nodes_bs3": (FIBER.format(sections=10, nodes=6, blob=0.0065), "direct", "bs3"),
    "few_nodes_rk4": (FIBER.format(sections=10, nodes=6, blob=0.0065), "direct", "rk4"),
    "two_fibers": (TWO_FIBERS, "direct", "rkc2"),
    "many_fibers": (MANY_FIBERS, "auto", "rkc2"),
    "fmm_many_fibers": (SPREAD_FIBERS, "fmm", "rkc2"),
    # From 75 000 nodes on two ranks make a part of the tree each, on more of them from fewer on.
    "trees_in_parts": (FIBER.format(sections=8700, nodes=9, blob=0.0045), "fmm", "rkc2"),
}
POSITION = "fibers/position/value"
STEPS = {"trees_in_parts": 5}
STEP = 2e-3


def steps_of(name):
    return STEPS.get(name, 100)


RANKS = {"OMP_NUM_THREADS": "1", "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


def command(mpirun, n_ranks, *words):
    launcher = [mpirun, "--oversubscribe", "-n", n_ranks] if n_ranks else []
    return [*launcher, *words]


def arrays(folder):
    """Everything that a run has computed, by name."""
    found = {}
    with h5py.File(folder / "trajectory.h5") as file:
        for group in ("particles", "observables"):
            file[group].visititems(
                lambda name, item: found.__setitem__(name, item[()]) if isinstance(item, h5py.Dataset) else None)
    check(len(found) > 10, f"hardly anything to compare in {folder}")
    return found


def differences(one, other):
    return sorted(name for name in {*one, *other}
                  if name not in one or name not in other or one[name].tobytes() != other[name].tobytes())


def run(program, mpirun, n_ranks, scene, folder, *options):
    shutil.rmtree(folder, ignore_errors=True)
    return skein(*command(mpirun, n_ranks, program, "run", scene, "-o", folder, *options), **RANKS)


def check_case(program, mpirun, folder, name):
    text, sums, method = CASES[name]
    scene = folder / f"{name}.toml"
    end, interval = f"time.end={steps_of(name) * STEP}", steps_of(name) // 5 * STEP
    scene.write_text(text + HYDRODYNAMICS.format(sums=sums) + TIME.format(method=method, step=STEP, interval=interval))
    runs = {}
    for n_ranks in (0, 1, 2, 3, 4):
        runs[n_ranks] = folder / f"{name}_{n_ranks}"
        said = run(program, mpirun, n_ranks, scene, runs[n_ranks], "--set", end).stderr
        if n_ranks:
            check(f"ranks: {n_ranks}," in said, f"{name}: no ranks in the first lines: {said}")
            check("leaves along the tree" in said or sums != "fmm", f"{name}: no tree is shared: {said}")
            are_parts = n_ranks > 1 and name == "trees_in_parts"
            check(("of which each rank has a part" in said) == are_parts, f"{name}: whose is the tree? {said}")
            check("times the mean work" in said or n_ranks == 1, f"{name}: nothing of balance: {said}")
            are_owned = "each advances the nodes of its sections" in said
            check(are_owned == (n_ranks > 1), f"{name}: whose are the nodes? {said}")
    reference = arrays(runs[1])
    first, n_steps = reference[POSITION], reference["evaluations/value"].shape[0]
    check(n_steps >= steps_of(name), f"{name}: only {n_steps} steps")
    if sums == "fmm":
        check(reference["fmm_order/value"].min() > 0, f"{name}: sums were direct")
        # More than the rounding of pairs: some boxes meet by expansions.
        check(np.nanmax(reference["velocity_error/value"]) > 1e-6, f"{name}: nothing is far")
    moved = np.abs(first[-1] - first[0]).max()
    check(moved > 1e-6 * steps_of(name), f"{name}: nothing moves")
    for n_ranks in (2, 3, 4):
        unequal = differences(arrays(runs[n_ranks]), reference)
        check(not unequal, f"{name}: on {n_ranks} ranks these differ: {unequal}")
    alone = arrays(runs[0])[POSITION]
    if sums == "fmm":
        check(not differences(arrays(runs[0]), reference), f"{name}: ranks differ from a run without them")
    check(np.abs(alone - first).max() <= 1e-9 * moved, f"{name}: ranks are {np.abs(alone - first).max()} from a run without")
    print(f"{name}: {n_steps} steps, moved by {moved:.3g}, equal on 1 to 4 ranks; {np.abs(alone - first).max():.2g} from a run alone")
    return scene, reference


def check_restart(program, mpirun, folder, name):
    """Stopped on 2 ranks, resumed on 3: as if it had run through on one."""
    scene, reference = check_case(program, mpirun, folder, name)
    broken = folder / f"{name}_broken"
    shutil.rmtree(broken, ignore_errors=True)
    end = f"time.end={steps_of(name) * STEP}"
    # Killed as a whole behind its second checkpoint, of which there is one at each fifth of the steps.
    interval = steps_of(name) // 5 * STEP
    run_words = [program, "run", scene, "-o", broken, "--set", end, "--set", f"checkpoint.simulated_interval={interval}"]
    result = subprocess.run([str(word) for word in command(mpirun, 2, *run_words)], capture_output=True, text=True,
                            env={**os.environ, **RANKS, "SKEIN_TEST_KILL": "checkpoint.after_rename:3"})
    check(result.returncode != 0, f"{name}: was not killed")
    said = skein(*command(mpirun, 3, program, "resume", broken), **RANKS).stderr
    check("ranks: 3," in said and "resume: from" in said, f"{name}: not resumed on 3 ranks: {said}")
    unequal = differences(arrays(broken), reference)
    check(not unequal, f"{name}: from 2 to 3 ranks these differ: {unequal}")
    print(f"{name}: stopped on 2 ranks, resumed on 3, equal")


def main():
    program, mpirun, folder, *names = sys.argv[1:]
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    for name in names or CASES:
        if name.startswith("restart_"):
            check_restart(program, mpirun, folder, name.removeprefix("restart_"))
        else:
            check_case(program, mpirun, folder, name)


if __name__ == "__main__":
    main()
