"""A tube with a travelling wave of preferred curvature swims as surface nodes do that are given this motion.

Called as check_swimming.py PROGRAM [SCENE]: of a small and stiff swimmer, or of another scene with one wave on one fiber. The
reference shares nothing with the program: it moves plane sections along a centreline of the preferred curvature and solves
for forces without sum and torque, by dense matrices of regularized Stokeslets.
"""

import pathlib
import subprocess
import sys
import tempfile
import tomllib

import h5py
import numpy as np

TOLERANCE = 0.04  # springs of finite stiffness give way

SMALL = """title = "a small swimmer"
[flow]
kind = "none"
[fiber]
sections = 33
nodes_per_section = 4
radius = 0.005
blob = 0.0035
spring_stiffness = 6.0
spacing = 0.006
[[undulation]]
curvature = 12.0
wavelength = 0.1
angular_frequency = 6.283185307179586
ramp = 0.5
[time]
end = 2.5
[output]
frame_interval = 0.5
"""


def place_nodes(fiber, wave, time):
    """[n_nodes, 3]: plane sections across a centreline that has the preferred curvature."""
    h, n_sections, n = fiber["spacing"], fiber["sections"], fiber["nodes_per_section"]
    halfway = h * (np.arange(n_sections - 1) + 0.5)
    curvature = wave["curvature"] * np.cos(2 * np.pi * halfway / wave["wavelength"] - wave["angular_frequency"] * time)
    section = np.r_[0, np.cumsum(curvature * h)]
    link = (section[1:] + section[:-1]) / 2
    x, y = np.r_[0, np.cumsum(np.cos(link) * h)], np.r_[0, np.cumsum(np.sin(link) * h)]
    angle = 2 * np.pi * np.arange(n) / n
    across = fiber["radius"] * np.cos(angle)
    nodes = np.stack([x[:, None] - np.sin(section)[:, None] * across, y[:, None] + np.cos(section)[:, None] * across,
                      np.broadcast_to(fiber["radius"] * np.sin(angle), (n_sections, n))], axis=-1).reshape(-1, 3)
    return nodes - nodes.mean(axis=0) * [1, 1, 0]


def make_mobility(nodes, blob):
    d = nodes[:, None] - nodes[None]
    core = (d**2).sum(axis=-1) + blob**2
    factor = 1 / (8 * np.pi * core**1.5)
    blocks = [[factor * ((core + blob**2) * (a == b) + d[..., a] * d[..., b]) for b in range(3)] for a in range(3)]
    return np.block(blocks)


def swim(fiber, wave, n_times=16, step=1e-5):
    """Velocity along x, the mean of a period, in a fluid of viscosity 1."""
    period = 2 * np.pi / wave["angular_frequency"]
    angle, moved = 0.0, np.zeros(2)
    for time in np.arange(n_times) * period / n_times:
        nodes = place_nodes(fiber, wave, time)
        velocity = (place_nodes(fiber, wave, time + step) - place_nodes(fiber, wave, time - step)) / (2 * step)
        zero, one = np.zeros(len(nodes)), np.ones(len(nodes))
        rigid = np.stack([np.r_[one, zero, zero], np.r_[zero, one, zero], np.r_[-nodes[:, 1], nodes[:, 0], zero]], axis=1)
        solved = np.linalg.solve(make_mobility(nodes, fiber["blob"]), np.c_[velocity.T.reshape(-1), rigid])
        u, v, turn = -np.linalg.solve(rigid.T @ solved[:, 1:], rigid.T @ solved[:, 0])
        moved += np.array([np.cos(angle) * u - np.sin(angle) * v, np.sin(angle) * u + np.cos(angle) * v]) / n_times
        angle += turn * period / n_times
    # Only the line along which it swims is the same: the reference starts with its first link along x.
    return np.hypot(*moved)


def main(program, scene=None):
    text = SMALL if scene is None else pathlib.Path(scene).read_text(encoding="utf-8")
    config = tomllib.loads(text)
    fiber, wave = config["fiber"], config["undulation"][0]
    with tempfile.TemporaryDirectory() as folder:
        file, run = pathlib.Path(folder, "scene.toml"), pathlib.Path(folder, "run")
        file.write_text(text, encoding="utf-8")
        subprocess.run([program, "run", file, "-o", run, "-q"], check=True, timeout=600)
        with h5py.File(run / "trajectory.h5") as index:
            position = index["particles/fibers/position/value"][()]
            time = index["particles/fibers/position/time"][()]
    middle = position.mean(axis=1)
    before = np.argmin(abs(time - (time[-1] - 2 * np.pi / wave["angular_frequency"])))
    velocity = (middle[-1] - middle[before]) / (time[-1] - time[before])
    expected = swim(fiber, wave)
    print(f"velocity {velocity}, by dense matrices {expected:.4e} against the wave: {-velocity[0] / expected - 1:+.2%}")
    assert abs(-velocity[0] / expected - 1) < TOLERANCE, "the speed is another one"
    assert abs(velocity[1]) < 0.02 * expected and abs(velocity[2]) < 1e-9 * expected, "it does not swim along itself"


if __name__ == "__main__":
    main(*sys.argv[1:])
