"""Numbers that are none: caught within the step, exit code 76, the node named, the last good state saved."""

import random

from program import DONE, INTEGRATORS, NUMERICAL, require
from run_files import checkpoints, differences, final_state, read_checkpoint, step_times


def torture(program, counts, seed=7):
    draw = random.Random(seed)
    unbroken = {}
    for name, overrides in INTEGRATORS.items():
        folder = program.fresh(f"unbroken {name}")
        result = program.run(folder, overrides)
        require(result.returncode == DONE, result.stderr)
        unbroken[name] = final_state(folder), len(step_times(folder))
    for i in range(counts["faults"]):
        round_, at = divmod(i, len(INTEGRATORS))
        target = ("position", "force", "velocity")[(round_ + at) % 3]
        name = list(INTEGRATORS)[at]
        reference, n_steps = unbroken[name]
        step = 1 if i == 0 else draw.randint(1, n_steps)
        what = f"{name}, {target} of step {step}"
        folder = program.fresh("faulty")
        result = program.run(folder, INTEGRATORS[name], SKEIN_TEST_NAN=f"{target}:{step}")
        require(result.returncode == NUMERICAL, f"{what}: exit code {result.returncode}: {result.stderr}")
        require("node " in result.stderr and "nan" in result.stderr, f"{what}: no node is named: {result.stderr}")
        saved = read_checkpoint(checkpoints(folder)[-1])
        require(saved["state.step"][0] == step - 1, f"{what}: saved is step {saved['state.step'][0]}")
        result = program.verify(folder)
        require(result.returncode == DONE, f"{what}: verify: {result.stderr}")
        program.finish(folder)  # the fault does not come back
        require(not differences(folder, reference), f"{what}: the end differs: {differences(folder, reference)}")
    return counts["faults"], "position, force, velocity; every integrator; resumed to an equal end"
