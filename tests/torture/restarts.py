"""Stopped at any step and resumed, a run equals one that was never interrupted, in every bit and with any threads."""

import itertools
import random
import signal

from program import DONE, INTEGRATORS, require
from run_files import differences, final_state, step_times


def torture(program, counts, seed=2):
    draw = random.Random(seed)
    unbroken = {}
    scenes = {name: (program.scene, overrides) for name, overrides in INTEGRATORS.items()}
    scenes["rkc2, fmm, three fibers"] = program.three_fibers, INTEGRATORS["rkc2, fmm"]
    for name, (scene, overrides) in scenes.items():
        # A checkpoint at every step, so that every step is one to go on from.
        end = "time.end=0.008" if name in ("euler", "bs3") else "time.end=0.4"
        overrides = [*overrides, end, "checkpoint.simulated_interval=1e-7"]
        folder = program.fresh(f"unbroken {name}")
        result = program.run(folder, overrides, scene=scene)
        require(result.returncode == DONE, result.stderr)
        unbroken[name] = scene, overrides, final_state(folder), len(step_times(folder))
    cases = itertools.cycle(itertools.product(((1, 2), (2, 1), (2, 2), (1, 1)), unbroken))
    for (threads, resumed_with), name in itertools.islice(cases, counts["restarts"]):
        scene, overrides, reference, n_steps = unbroken[name]
        step = draw.randint(1, n_steps - 1)
        folder = program.fresh("restarted")
        result = program.run(folder, overrides, scene=scene, threads=threads, SKEIN_TEST_KILL=f"step:{step}")
        require(result.returncode == -signal.SIGKILL, f"{name}: not killed at step {step}: {result.stderr}")
        result = program.resume(folder, threads=resumed_with)
        require(result.returncode == DONE, f"{name}: resume at step {step}: {result.stderr}")
        different = differences(folder, reference)
        require(not different, f"{name}: restarted at step {step}, {threads} then {resumed_with} threads: {different}")
    return counts["restarts"], f"{len(unbroken)} integrators and methods, 1 and 3 fibers; threads 1 and 2, also changed between the halves"
