"""Half a turn of the paper's shortest fiber, L = 0.139, in shear. Takes minutes.

dx/dt = (rate y, 0, 0) + M(x) F(x): springs and regularized Stokeslets of 80 sections of 18 nodes, straight along x at
t = 0. The run goes by RKL2, the stabilized Runge-Kutta-Legendre method of second order by Meyer, Balsara and Aslam
(J. Comput. Phys. 257, 594, 2014), with fixed steps of 0.05. Another step size, as in `python3 orbit.py 0.1`, says how
far this one is off. A straight fiber stays as it is under reflection of z and under half a turn about z, so that
velocities are computed at a quarter of the nodes.

Numbers for tests/accuracy/test_orbit.cpp: the angle of the line through the first and last section's centres, clockwise
from +x.
"""

import sys

import numpy as np

import straight_tube as tube

SECTIONS = 80
SPECTRAL_RADIUS = 1.3e4  # decay_rates.py gives 1.106e4 for the straight fiber, and bends have a little more
LAST_OF_HALF = tube.NODES_PER_SECTION // 2  # nodes 0 to 9 stand for the others, their mirror images in z


def add_symmetric(quarter):
    """All nodes' vectors from those of the first half of the sections and the first half of each section."""
    half_turned = quarter[::-1, ::-1] * [-1.0, -1.0, 1.0]
    half = np.concatenate([quarter, half_turned])
    return np.concatenate([half, half[:, -2:0:-1] * [1.0, 1.0, -1.0]], axis=1)


def velocity_of(quarter):
    """The velocity of a quarter of the nodes."""
    nodes = add_symmetric(quarter)
    source, force = nodes.reshape(-1, 3), tube.spring_forces(nodes).reshape(-1, 3)
    source_force = np.sum(source * force, 1)
    target = quarter.reshape(-1, 3)
    velocity = np.empty_like(target)
    for first in range(0, len(target), 50):  # few enough for the cache
        x = target[first:first + 50]
        core = np.sum(x**2, 1)[:, None] + (np.sum(source**2, 1) + tube.BLOB**2) - 2.0 * x @ source.T
        weight = 1.0 / (core * np.sqrt(core))
        along = weight * (x @ force.T - source_force)  # weight times f . (x - y)
        sums = (weight * (core + tube.BLOB**2)) @ force + along.sum(1)[:, None] * x - along @ source
        velocity[first:first + 50] = sums
    velocity /= 8.0 * np.pi
    velocity[:, 0] += tube.SHEAR_RATE * target[:, 1]
    return velocity.reshape(quarter.shape)


def advance(y, step, stages):
    """One step of RKL2."""
    b = lambda j: 1.0 / 3.0 if j < 3 else (j * j + j - 2.0) / (2.0 * j * (j + 1.0))
    w = 4.0 / (stages * stages + stages - 2.0)
    slope = velocity_of(y)
    before, last = y, y + b(1) * w * step * slope
    for j in range(2, stages + 1):
        mu = (2.0 * j - 1.0) / j * b(j) / b(j - 1)
        nu = -(j - 1.0) / j * b(j) / b(j - 2)
        inner = mu * last + nu * before + (1.0 - mu - nu) * y
        before, last = last, inner + mu * w * step * (velocity_of(last) - (1.0 - b(j - 1)) * slope)
    return last


def angle_of(quarter):
    """Degrees clockwise from +x, from -90 to 270."""
    nodes = add_symmetric(quarter)
    line = nodes[-1].mean(0) - nodes[0].mean(0)
    angle = -np.degrees(np.arctan2(line[1], line[0]))
    return angle + 360.0 if angle < -90.0 else angle


def main():
    step = float(sys.argv[1]) if len(sys.argv) > 1 else 0.05
    # Stable while step * radius / 2 is below (s^2 + s - 2) / 4.
    stages = int(np.ceil(0.5 * (np.sqrt(9.0 + 8.0 * step * SPECTRAL_RADIUS) - 1.0))) | 1
    shape = tube.straight_nodes(SECTIONS)[:SECTIONS // 2, :LAST_OF_HALF + 1]
    times, orbit = [0.0], [0.0]
    while orbit[-1] < 180.0:
        shape = advance(shape, step, stages)
        times.append(times[-1] + step)
        orbit.append(angle_of(shape))
    at = lambda angle: np.interp(angle, orbit, times)
    print(f"step {step:g} of {stages} stages: angle at t = 4.95: {np.interp(4.95, times, orbit):.3f} degrees; "
          f"vertical at {at(90.0):.4f}; half turn {at(180.0):.4f}")


if __name__ == "__main__":
    main()
