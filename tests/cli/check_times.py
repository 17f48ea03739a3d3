"""What a run does with times: pulses are felt in full, units change nothing, no limit is no end, Euler's warning is true.

Usage: check_times.py SKEIN FOLDER"""

import json
import pathlib
import shutil
import subprocess
import sys

import h5py
import numpy as np

from checks import check

PULSE = """
[flow]
kind = "shear"
rate = 2.5
center = [0.0, -1.0, 0.0]
start = 0.52
stop = 0.525
[fiber]
sections = 10
nodes_per_section = 6
spring_stiffness = 0.0409
blob = 0.0045
direction = [0.0, 0.0, 1.0]
[time]
end = 0.6
[output]
frame_interval = 0.3
"""


def make_turning_scene(unit=1.0, end=1.2):
    """A fiber that tumbles, told in a unit of time of which `unit` make the paper's; `end` in the paper's."""
    return f"""
[flow]
rate = {2.5 / unit!r}
[fiber]
sections = 28
nodes_per_section = 6
spring_stiffness = {0.0409 / unit!r}
blob = 0.0045
start_amplitude = 0.01
direction = [1.0, 0.3, 0.0]
[time]
end = {end * unit!r}
"""


class Program:
    def __init__(self, program, folder):
        self.program, self.folder = program, folder
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)

    def run(self, name, text, *arguments, expected_code=0):
        """Standard error, output and the frames of a run, [n_frames, n_nodes, 3]."""
        scene = self.folder / f"{name}.toml"
        scene.write_text(text)
        run = self.folder / name
        result = subprocess.run([self.program, "run", scene, "-o", run, *arguments], capture_output=True, text=True)
        check(result.returncode == expected_code, f"{name}: exit code {result.returncode}: {result.stderr}")
        if "--dry-run" in arguments or expected_code != 0:
            return result.stderr + result.stdout, None, None
        with h5py.File(run / "trajectory.h5") as file:
            return result.stderr, file["/particles/fibers/position/value"][()], file["/observables/dt/value"][()]


def check_pulses(program):
    for method, extra in (("rkc2", ""), ("trbdf2", ""), ("auto", ""), ("rk4", "max_step=0.01"), ("bs3", ""),
                          ("euler", "step=0.0017"), ("rkc2", "step=0.1"), ("trbdf2", "step=0.1")):
        sets = [f"time.method={method}"] + ([f"time.{extra}"] if extra else [])
        arguments = [word for setting in sets for word in ("--set", setting)]
        name = f"pulse_{method}_{extra.split('=')[0]}"
        _, frames, _ = program.run(name, PULSE, *arguments)
        drift = (frames[-1] - frames[0]).mean(axis=0)
        check(np.allclose(drift, [2.5 * 0.005, 0.0, 0.0], atol=1e-6), f"{name}: a drift of {drift}")


def check_units(program):
    _, frames, steps = program.run("unit", make_turning_scene())
    for unit, tolerance in ((1000.0, 1e-9), (1e-6, 1e-9), (1e6, 1e-9), (2.0**20, 0.0), (2.0**-20, 0.0)):
        _, others, other_steps = program.run(f"unit_{unit:g}", make_turning_scene(unit))
        check(len(steps) == len(other_steps), f"unit {unit}: {len(other_steps)} steps instead of {len(steps)}")
        check(frames.shape == others.shape, f"unit {unit}: {others.shape} instead of {frames.shape}")
        check(np.abs(frames - others).max() <= tolerance * 0.14, f"unit {unit}: {np.abs(frames - others).max()}")


def leaves_of(tree, path=""):
    """The numbers and words of what JSON holds, by their places."""
    if isinstance(tree, (dict, list)):
        items = tree.items() if isinstance(tree, dict) else enumerate(tree)
        return {place: leaf for key, value in items for place, leaf in leaves_of(value, f"{path}/{key}").items()}
    return {path: tree}


def check_analysis(program):
    """Every number of an analysis is one of the same motion: itself times a power of the unit of time."""
    unit = 2.0**20
    found = []
    for name, factor in (("turn", 1.0), ("turn_in_other_units", unit)):
        program.run(name, make_turning_scene(factor, 11.0), "-q")
        result = subprocess.run([program.program, "analyze", program.folder / name, "--json"], capture_output=True, text=True)
        check(result.returncode == 0, result.stderr)
        found.append(leaves_of(json.loads(result.stdout)))
    here, there = found
    check(here.keys() == there.keys(), f"other places: {here.keys() ^ there.keys()}")
    n_times = 0
    for place, value in here.items():
        other = there[place]
        if isinstance(value, float) and value != 0.0 and other is not None:
            power = np.log2(abs(other / value)) / 20.0
            check(abs(power - round(power)) < 1e-9 and abs(power) < 3.5 and value * other > 0, f"{place}: {value}, {other}")
            n_times += round(power) == 1
        else:
            check(value == other, f"{place}: {value} and {other}")
    check(n_times >= 2, "the fiber did not turn")


def check_no_limit(program):
    _, frames, steps = program.run("limited", make_turning_scene())
    for limit in ("1e10", "inf", "1e30"):
        _, others, other_steps = program.run(f"limit_{limit}", make_turning_scene(), "--set", f"time.max_step={limit}")
        check(np.array_equal(frames, others) and len(steps) == len(other_steps), f"max_step = {limit} is not none")


def check_eulers_warning(program):
    """The energy of the springs tells on which side of the limit a step is; the radius is that of the start."""
    text = make_turning_scene()

    def run(step, *arguments, **expected):
        said, _, _ = program.run(f"euler_{step}", text, "--set", "time.method=euler", "--set", f"time.step={step}",
                                 *arguments, **expected)
        energy = None
        if not arguments and not expected:
            with h5py.File(program.folder / f"euler_{step}" / "trajectory.h5") as file:
                energy = file["/observables/energy/value"][()].max()
        return "forward Euler is unstable above 2" in said, energy, said

    is_warned_of, stable_energy, said = run(2.0e-3)
    check(not is_warned_of, f"a false warning: {said}")
    is_warned_of, energy, said = run(2.1e-3)
    check(not is_warned_of and energy < 1.1 * stable_energy, f"2.1e-3: energy {energy}: {said}")
    is_warned_of, energy, said = run(2.2e-3)
    check(is_warned_of and energy > 3.0 * stable_energy, f"2.2e-3: energy {energy}: {said}")
    check(run(2.2e-3, "--dry-run")[0], "no warning in a dry run")
    check(run(3.0e-3, expected_code=76)[0], "no warning of a step that blows up")


def main():
    program = Program(sys.argv[1], pathlib.Path(sys.argv[2]))
    check_pulses(program)
    check_units(program)
    check_analysis(program)
    check_no_limit(program)
    check_eulers_warning(program)


if __name__ == "__main__":
    main()
