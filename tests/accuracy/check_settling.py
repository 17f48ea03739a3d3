"""Heavy fibers fall as dense matrices of their nodes, and the theory of slender bodies, say.

Called as check_settling.py PROGRAM [--fine]: a stiff tube along, across and aslant of gravity, a rigid fiber, a soft one that
bends to a U, and two that feel each other. What is compared with slender-body theory differs by that theory's own error: ends
that are blunt drag more than it says, so that the U of short fibers is deeper.
"""

import sys

import numpy as np

from dense_stokes import Claims, make_rigid_motions, mean_velocity, place_tube, run, solve_rigid, write_tube

RADIUS, BLOB, SPACING, NODES = 0.01, 0.008, 0.01, 6
WEIGHT = 1.0


def write_scene(sections, stiffness, direction, end, fibers=((0.0, 0.0, 0.0),), model="tube", frames=4, weight=WEIGHT,
                tolerance=1e-4):
    text = f"""[flow]
kind = "none"
[gravity]
weight = {weight}
direction = {list(direction)}
[time]
end = {end}
tolerance = {tolerance}
[output]
frame_interval = {end / frames}
"""
    for center in fibers:
        text += f"""[[fiber]]
model = "{model}"
{write_tube(sections, NODES, RADIUS, BLOB, SPACING, stiffness)}
center = {list(center)}
"""
    return text


def tube(sections, center=(0.0, 0.0, 0.0)):
    return place_tube(sections, NODES, RADIUS, SPACING, center)


def check_drag(program, claims, sections=40):
    length = sections * SPACING
    resistance = solve_rigid([tube(sections)], BLOB)[1]
    end = 0.05
    for name, direction in (("along", (1.0, 0.0, 0.0)), ("across", (0.0, -1.0, 0.0)), ("aslant", (0.6, -0.8, 0.0))):
        time, position, _, _ = run(program, write_scene(sections, 200.0, direction, end))
        found = mean_velocity(time, position, end / 2, end)
        expected = np.linalg.solve(resistance[:3, :3], WEIGHT * length * np.array(direction))
        claims.compare(f"a stiff tube falls {name}, speed", np.linalg.norm(found), np.linalg.norm(expected),
                       "dense matrices", 1e-3)
        claims.check("... its direction, radians", np.linalg.norm(np.cross(found, expected)) / (found @ expected), 1e-3)
    half = length / 2
    across = 8 * np.pi * half / (np.log(2 * half / RADIUS) + np.log(2) - 0.5)
    claims.compare("... drag across", resistance[1, 1], across, "slender-body theory of a cylinder", 0.12)
    along = 4 * np.pi * half / (np.log(2 * half / RADIUS) + np.log(2) - 1.5)  # both of Batchelor 1970, to 1 / ln
    claims.compare("... drag along", resistance[0, 0], along, "slender-body theory of a cylinder", 0.12)
    for name, direction in (("along", (1.0, 0.0, 0.0)), ("across", (0.0, -1.0, 0.0))):
        time, position, _, _ = run(program, write_scene(sections, 200.0, direction, end, model="rigid"))
        speed = np.linalg.norm(mean_velocity(time, position, end / 2, end))
        drag = resistance[0, 0] if name == "along" else resistance[1, 1]
        claims.compare(f"the rigid line in its stead falls {name}, speed", speed, WEIGHT * length / drag,
                       "the tube by dense matrices", 0.06)


def integrate_twice(values, h):
    """Of values at the middles of pieces; at the joints between them, from 0."""
    once = np.r_[0, np.cumsum(values * h)]
    return np.r_[0, np.cumsum((once[1:] + once[:-1]) / 2 * h)]


def bend_beam(load, rigidity, h):
    """Deflection at the middles of pieces of a free beam whose fourth derivative is load over rigidity; the load has no sum and
    no moment."""
    moment = integrate_twice(load, h)
    deflection = integrate_twice((moment[1:] + moment[:-1]) / 2 / rigidity, h)
    return (deflection[1:] + deflection[:-1]) / 2


def depth_of_u(deflection):
    """How far the middle, of an even number of pieces, lies above the end ones."""
    middle = len(deflection) // 2
    return (deflection[middle - 1] + deflection[middle] - deflection[0] - deflection[-1]) / 2


def make_stiffness(nodes, spring_stiffness):
    """[3 n, 3 n], all x first: forces that displace nodes of a straight tube, with springs between all nodes of a section and of
    neighbouring ones, each of the stiffness over its length."""
    n = len(nodes)
    section = np.arange(n) // NODES
    matrix = np.zeros((3, n, 3, n))
    for i in range(n):
        j = np.flatnonzero((abs(section - section[i]) <= 1) & (np.arange(n) != i))
        d = nodes[j] - nodes[i]
        length = np.linalg.norm(d, axis=1)
        blocks = spring_stiffness * d[:, :, None] * d[:, None, :] / length[:, None, None]**3
        matrix[:, i, :, i] += blocks.sum(axis=0)
        for other, block in zip(j, blocks):
            matrix[:, i, :, other] -= block
    return matrix.reshape(3 * n, 3 * n)


def displace(stiffness, nodes, forces):
    """Displacements without rigid motion by forces without sum and torque."""
    rigid = np.linalg.qr(make_rigid_motions(nodes, nodes.mean(axis=0)))[0]
    load = forces - rigid @ (rigid.T @ forces)
    return np.linalg.solve(stiffness + np.abs(stiffness).max() * rigid @ rigid.T, load)


def measure_rigidity(nodes, stiffness):
    """Of a tube between two couples at its ends: the couple over the curvature of its middle."""
    x, y, _ = nodes.T
    pull = np.zeros((3, len(nodes)))
    pull[0, :NODES], pull[0, -NODES:] = y[:NODES], -y[-NODES:]
    couple = (y[:NODES]**2).sum()
    centre = displace(stiffness, nodes, pull.reshape(-1)).reshape(3, -1, NODES).mean(axis=2)[1]
    inner = slice(len(centre) // 4, -(len(centre) // 4))
    return couple / (2 * abs(np.polyfit(x[::NODES][inner], centre[inner], 2)[0]))


def find_slender_load(aspect_ratio):
    """Weight less drag over the weight per length, at the middles of pieces of two radii of a cylinder that falls across itself: 8
    pi mu u = f (ln((1 - x^2) L^2 / R^2) + 1) + the integral of (f(x') - f(x)) / |x' - x|, x from -1 to 1, with u alike everywhere
    (slender-body theory of Keller and Rubinow, J. Fluid Mech. 75, 705, 1976)."""
    n = int(aspect_ratio / 2)
    x = (2 * np.arange(n) + 1) / n - 1
    apart = abs(x[:, None] - x)
    np.fill_diagonal(apart, 1)
    matrix = 2 / n / apart
    np.fill_diagonal(matrix, 0)
    own = np.log((1 - x**2) * aspect_ratio**2) + 1
    force = np.linalg.solve(matrix + np.diag(own - matrix.sum(axis=1)), np.ones(n))
    return 1 - force / force.mean()


def check_u(program, claims, sections, depth, by_beam_within, by_theory_within):
    """Of a fiber whose U is so deep, as a share of its length."""
    spring_stiffness, length = 1.0, sections * SPACING
    nodes = tube(sections)
    forces, resistance = solve_rigid([nodes], BLOB)
    drag = forces[:, 1] / resistance[1, 1] * WEIGHT * length  # on the fluid, of the rigid tube; it falls towards y here
    weight_of_node = np.zeros((3, len(nodes)))
    weight_of_node[1] = WEIGHT * SPACING / NODES
    load = weight_of_node.reshape(-1) - drag
    stiffness = make_stiffness(nodes, spring_stiffness)
    bent = displace(stiffness, nodes, load).reshape(3, -1, NODES).mean(axis=2)[1]
    weight = depth * length / depth_of_u(bent)  # deflections are in proportion to it
    rigidity = measure_rigidity(nodes, stiffness)
    by_beam = bend_beam(load.reshape(3, -1, NODES).sum(axis=2)[1] / SPACING, rigidity, SPACING)
    end = 12 * resistance[1, 1] / length * (length / 4.73)**4 / rigidity  # relaxation times of the softest bend
    _, position, _, _ = run(program, write_scene(sections, spring_stiffness, (0.0, -1.0, 0.0), end, weight=weight, tolerance=1e-7))
    centre = position[-1].reshape(sections, NODES, 3).mean(axis=1)
    found = -depth_of_u(centre[:, 1]) / length
    number = weight * length**3 / rigidity  # of elasto-gravitation
    print(f"a soft fiber of {length / RADIUS:.0f} radii, weight L^3 / EI = {number:.4g}")
    claims.compare("the depth of its U over L", found, depth, "springs and drag in dense matrices", 0.01)
    claims.compare("...", found, weight * depth_of_u(by_beam) / length, "a beam of the measured EI under that drag",
                   by_beam_within)
    by_theory = number * depth_of_u(bend_beam(find_slender_load(length / RADIUS), 1.0, 2 * RADIUS / length))
    claims.compare("...", found, by_theory, "a beam under the drag of slender-body theory", by_theory_within)
    claims.check("... the ends' difference in height over L", (centre[0, 1] - centre[-1, 1]) / length, 1e-6)


def check_pairs(program, claims, sections=24):
    length, end = sections * SPACING, 0.02
    alone = WEIGHT * length / solve_rigid([tube(sections)], BLOB)[1][1, 1]
    scenes = (("side by side, a tenth of L apart", (0.0, 0.0, 0.1 * length)),
              ("one above the other, half of L apart", (0.0, 0.5 * length, 0.0)),
              ("shifted along and above each other", (0.4 * length, 0.3 * length, 0.0)))
    n = sections * NODES
    for name, apart in scenes:
        centers = [(0.0, 0.0, 0.0), apart]
        load = np.zeros(12)
        load[[1, 7]] = -WEIGHT * length
        expected = np.linalg.solve(solve_rigid([tube(sections, center) for center in centers], BLOB)[1], load)
        # It is so short that they keep their places.
        time, position, _, _ = run(program, write_scene(sections, 1000.0, (0.0, -1.0, 0.0), end, fibers=centers, frames=20))
        for fiber in (0, 1):
            velocity = expected[6 * fiber:6 * fiber + 3]
            found = mean_velocity(time, position[:, fiber * n:(fiber + 1) * n], end / 4, end / 2)
            claims.compare(f"two fibers {name}: fiber {fiber}'s speed over that of one", -found[1] / alone, -velocity[1] / alone,
                           "dense matrices of both", 2e-3)
            claims.check("... its velocity differs, over the speed, by", np.linalg.norm(found - velocity) / alone, 3e-3)
    far = 20 * length
    time, position, _, _ = run(program, write_scene(sections, 1000.0, (0.0, -1.0, 0.0), end, fibers=[(0.0, 0.0, 0.0), (0.0, far, 0.0)]))
    found = -mean_velocity(time, position, end / 2, end)[1] - alone
    claims.compare("20 L above each other, what each adds to the other's speed", found, WEIGHT * length / (4 * np.pi * far),
                   "a point force's", 0.02)


def main(program, fine=False):
    claims = Claims()
    check_drag(program, claims)
    if fine:
        check_u(program, claims, 200, 0.005, by_beam_within=0.01, by_theory_within=0.15)
    check_u(program, claims, 40, 0.01, by_beam_within=0.05, by_theory_within=0.4)
    check_pairs(program, claims)
    return claims.finish()


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], "--fine" in sys.argv))
