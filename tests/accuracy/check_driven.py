"""Fibers that are held and driven: in a trap, and by one end that swings.

Called as check_driven.py PROGRAM. A stiff tube follows a trap at its stiffness over the drag. An end that swings to and fro
bends a soft fiber over (EI / (xi omega))^(1/4) (Wiggins and Goldstein, Phys. Rev. Lett. 80, 3879, 1998): the length that fits its
motion best in the equation of a beam with a drag xi per length is compared with that of the tube's own EI and of the drag of
slender-body theory at that length; the motion itself with the linear response of dense matrices of springs and fluid.
"""

import sys

import numpy as np

from check_settling import BLOB, NODES, RADIUS, SPACING, make_stiffness, measure_rigidity, tube
from check_swimming import find_thickness
from dense_stokes import Claims, make_mobility, run, solve_rigid, write_tube

FIBER = """[flow]
kind = "none"
[fiber]
"""


def write_fiber(sections, stiffness):
    return FIBER + write_tube(sections, NODES, RADIUS, BLOB, SPACING, stiffness)


def check_trap(program, claims, sections=31):
    """By its middle section, from t = 0 on drawn away at a steady speed, by a trap so soft that the fiber does not bend: it lags
    behind by speed / rate (1 - exp(-rate t))."""
    resistance = solve_rigid([tube(sections)], BLOB)[1]
    stiffness = 0.2
    for name, axis, drag in (("along", 0, resistance[0, 0]), ("across", 1, resistance[1, 1])):
        rate = stiffness / drag
        velocity = [0.0, 0.0, 0.0]
        speed = velocity[axis] = 0.1 * sections * SPACING * rate
        end = 2 / rate
        scene = write_fiber(sections, 20.0) + f"""[tether]
section = {sections // 2}
stiffness = {stiffness}
velocity = {velocity}
[time]
method = "trbdf2"
end = {end}
tolerance = {2e-5 * rate}
[output]
frame_interval = {end / 8}
"""
        time, position, _, _ = run(program, scene)
        lag = speed * time - position[:, :, axis].mean(axis=1)
        # Twice the time makes it 1 + exp(-rate t) times as long.
        found = -np.log(lag[8] / lag[4] - 1) / time[4]
        claims.compare(f"a fiber in a trap, {name}: rate of relaxation", found, rate, "stiffness over drag, dense matrices", 0.01)


def beam_shape(x, length, penetration, is_clamped):
    """Complex amplitude over that of the end at x = 0: i y + penetration^4 y'''' = 0, the other end free."""
    roots = np.exp(1j * (np.array([0, 1, 2, 3]) * np.pi / 2 - np.pi / 8)) / penetration
    at_end = np.exp(roots * length)
    rows = np.stack([np.ones(4), roots if is_clamped else roots**2, roots**2 * at_end, roots**3 * at_end])
    scale = abs(rows).max(axis=1, keepdims=True)
    c = np.linalg.solve(rows / scale, np.array([1, 0, 0, 0]) / scale[:, 0])
    return np.exp(np.outer(x, roots)) @ c


def fit_penetration(x, length, amplitude, guess, is_clamped):
    """The length with which the beam's shape is nearest to an amplitude, by a search that narrows."""
    low, high = 0.7 * guess, 1.4 * guess
    for _ in range(8):
        tries = np.linspace(low, high, 21)
        misses = [np.linalg.norm(beam_shape(x, length, p, is_clamped) - amplitude) for p in tries]
        best = int(np.argmin(misses))
        low, high = tries[max(best - 1, 0)], tries[min(best + 1, 20)]
    return tries[best], misses[best] / np.linalg.norm(amplitude)


def check_wave(program, claims, is_clamped, sections=60, periods=12):
    spring_stiffness, length = 1.0, (sections - 1) * SPACING
    nodes = tube(sections)
    stiffness = make_stiffness(nodes, spring_stiffness)
    rigidity = measure_rigidity(nodes, stiffness)
    penetration = length / 4
    thickness = find_thickness({"radius": RADIUS, "nodes_per_section": NODES, "blob": BLOB, "spacing": SPACING})
    drag = 4 * np.pi / (np.log(2 * penetration / thickness) - np.euler_gamma + 0.5)
    frequency = rigidity / (drag * penetration**4)
    swing, held, hold = 0.05 * penetration, [0, 1] if is_clamped else [0], 100.0
    first = nodes[0, 0]
    table = "clamp" if is_clamped else "tether"
    end = periods * 2 * np.pi / frequency
    scene = write_fiber(sections, spring_stiffness) + f"""[time]
method = "trbdf2"
end = {end}
tolerance = {1e-6 * frequency}
[output]
frame_interval = {2 * np.pi / frequency / 16}
"""
    for section in held:
        scene += f"""[[{table}]]
section = {section}
stiffness = {hold}
point = [{first + section * SPACING}, 0.0, 0.0]
swing = [0.0, {swing}, 0.0]
angular_frequency = {frequency}
"""
    time, position, _, _ = run(program, scene)
    last = time > time[-1] - 2 * np.pi / frequency * (1 - 1e-6)
    height = position[last].reshape(last.sum(), sections, NODES, 3).mean(axis=2)[:, :, 1]
    # Of swing sin(omega t): the imaginary part of exp(i omega t).
    amplitude = (2j * np.exp(-1j * frequency * time[last]) @ height) / last.sum() / swing
    # Linear response: (stiffness + hold + i omega / mobility) displacement = hold * anchors' amplitudes.
    n = len(nodes)
    holding = np.zeros((3, n, 3, n))
    pull = np.zeros((3, n))
    for section in held:
        of = slice(section * NODES, (section + 1) * NODES)
        for axis in range(3):
            holding[axis, of, axis, of] += np.eye(NODES) * hold / NODES if is_clamped else hold / NODES**2
        pull[1, of] += hold / NODES
    resistance = np.linalg.inv(make_mobility(nodes, BLOB))
    response = np.linalg.solve(stiffness + holding.reshape(3 * n, 3 * n) + 1j * frequency * resistance, pull.reshape(-1))
    expected = response.reshape(3, sections, NODES).mean(axis=2)[1]
    name = "clamped" if is_clamped else "pinned"
    miss = np.linalg.norm(amplitude - expected) / np.linalg.norm(expected)
    claims.check(f"a {name} end that swings: amplitudes differ from dense matrices, relative", miss, 0.01)
    x = nodes[::NODES, 0] - nodes[0, 0]
    if is_clamped:  # the first free one stands behind the second that is held
        x, amplitude = x[1:] - SPACING, amplitude[1:]
    found, rest = fit_penetration(x, x[-1], amplitude / amplitude[0], penetration, is_clamped)
    claims.compare("... penetration length", found, penetration, "(EI/(xi omega))^(1/4), slender-body drag", 0.05)
    print(f"... a beam of that length differs by {rest:.2%}", flush=True)


def main(program):
    claims = Claims()
    check_trap(program, claims)
    check_wave(program, claims, is_clamped=True)
    check_wave(program, claims, is_clamped=False)
    return claims.finish()


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
