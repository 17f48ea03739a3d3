"""Fibers in a viscous fluid by dense matrices of regularized Stokeslets: references that share nothing with the program."""

import json
import pathlib
import subprocess
import tempfile

import h5py
import numpy as np


def make_mobility(nodes, blob, viscosity=1.0):
    """[3 n, 3 n], all x first: velocities of nodes by forces on them."""
    d = nodes[:, None] - nodes[None]
    core = (d**2).sum(axis=-1) + blob**2
    factor = 1 / (8 * np.pi * viscosity * core**1.5)
    return np.block([[factor * ((core + blob**2) * (a == b) + d[..., a] * d[..., b]) for b in range(3)] for a in range(3)])


def make_rigid_motions(nodes, about=(0.0, 0.0, 0.0)):
    """[3 n, 6]: velocities of nodes by a unit translation along, and a unit turn about, x, y and z."""
    x, y, z = (nodes - about).T
    zero, one = np.zeros(len(nodes)), np.ones(len(nodes))
    moves = [(one, zero, zero), (zero, one, zero), (zero, zero, one), (zero, -z, y), (z, zero, -x), (-y, x, zero)]
    return np.stack([np.concatenate(move) for move in moves], axis=1)


def place_tube(n_sections, nodes_per_section, radius, spacing, center=(0.0, 0.0, 0.0)):
    """[n, 3]: a straight tube along x, section by section, node 0 of each towards y."""
    x = (np.arange(n_sections) - 0.5 * (n_sections - 1)) * spacing
    angle = 2 * np.pi * np.arange(nodes_per_section) / nodes_per_section
    shape = (n_sections, nodes_per_section)
    nodes = np.stack([np.broadcast_to(x[:, None], shape), np.broadcast_to(radius * np.cos(angle), shape),
                      np.broadcast_to(radius * np.sin(angle), shape)], axis=-1)
    return nodes.reshape(-1, 3) + center


def solve_rigid(bodies, blob):
    """Of rigid bodies that feel each other, [n, 3] each: forces on all nodes [3 n, 6 b] by unit motions of each body, all x
    first, and the resistance [6 b, 6 b]."""
    nodes = np.concatenate(bodies)
    motions = np.zeros((3 * len(nodes), 6 * len(bodies)))
    first = 0
    for b, body in enumerate(bodies):
        own = make_rigid_motions(body, body.mean(axis=0)).reshape(3, len(body), 6)
        motions.reshape(3, len(nodes), -1)[:, first:first + len(body), 6 * b:6 * b + 6] = own
        first += len(body)
    forces = np.linalg.solve(make_mobility(nodes, blob), motions)
    return forces, motions.T @ forces


def write_tube(sections, nodes_per_section, radius, blob, spacing, stiffness):
    """The keys of a tube in a scene's [fiber], lines."""
    return f"""sections = {sections}
nodes_per_section = {nodes_per_section}
radius = {radius}
blob = {blob}
spacing = {spacing}
spring_stiffness = {stiffness}
"""


def run(program, scene, sets=(), timeout=900):
    """Runs a scene, given as text. @returns times [m], positions [m, n, 3], the analysis' columns by fibers, its summary"""
    with tempfile.TemporaryDirectory() as folder:
        file, result = pathlib.Path(folder, "scene.toml"), pathlib.Path(folder, "run")
        file.write_text(scene, encoding="utf-8")
        options = [word for key in sets for word in ("--set", key)]
        subprocess.run([program, "run", file, "-o", result, "-q", *options], check=True, timeout=timeout)
        summary = subprocess.run([program, "analyze", result, "--json"], check=True, timeout=timeout, capture_output=True)
        with h5py.File(result / "trajectory.h5") as index:
            position = index["particles/fibers/position/value"][()]
            time = index["particles/fibers/position/time"][()]
        with h5py.File(result / "analysis" / "diagnostics.h5") as table:
            columns = [{name: array[()] for name, array in table[fiber].items()} for fiber in sorted(table) if fiber != "time"]
    return time, position, columns, json.loads(summary.stdout)


def mean_velocity(time, position, begin, end):
    """[3]: of the mean of nodes between two moments that frames stand at."""
    a, b = np.argmin(abs(time - begin)), np.argmin(abs(time - end))
    return (position[b].mean(axis=0) - position[a].mean(axis=0)) / (time[b] - time[a])


class Claims:
    """Numbers held against their references, printed as rows of a table."""

    def __init__(self):
        self.failed = 0

    def compare(self, what, found, reference, source, tolerance):
        difference = found / reference - 1
        fails = not abs(difference) <= tolerance
        self.failed += fails
        print(f"{what}: {found:.5g}, {source} {reference:.5g}: {difference:+.2%}, allowed {tolerance:.2%}"
              + (" FAILS" if fails else ""), flush=True)

    def state(self, what, found, reference, source):
        """Of a theory that is known to be off: no claim."""
        print(f"{what}: {found:.5g}, {source} {reference:.5g}: {found / reference - 1:+.0%}", flush=True)

    def check(self, what, found, largest):
        fails = not abs(found) <= largest
        self.failed += fails
        print(f"{what}: {found:.2e}, at most {largest:.0e}" + (" FAILS" if fails else ""), flush=True)

    def finish(self):
        return 1 if self.failed else 0
