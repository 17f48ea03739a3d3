"""A helix that is turned at one end pushes and resists as dense matrices, slender-body and resistive-force theory say.

Called as check_helix.py PROGRAM [--fine]. Thrust, torque and drag are those of Rodenborn, Chen, Swinney, Liu and Zhang (PNAS 110,
E338, 2013), who found slender-body theory and regularized Stokeslets within some per cent of their experiments and
resistive-force theory far off: thrust / (mu spin R^2), torque / (mu spin R^3) and drag / (mu speed R), R being the helix' radius.
"""

import sys

import numpy as np

from check_swimming import find_thickness
from dense_stokes import Claims, make_mobility, run, write_tube

RADIUS, BLOB, NODES = 0.01, 0.0057, 6
SPIN = 1.0


def write_scene(sections, helix, pitch, stiffness, motion, end, frames=10, shaft=0.1, taper=0.1):
    first = -0.5 * (sections - 1) * RADIUS
    text = f"""[flow]
kind = "none"
[fiber]
{write_tube(sections, NODES, RADIUS, BLOB, RADIUS, stiffness)}
helix_radius = {helix}
helix_pitch = {pitch}
helix_shaft = {shaft}
helix_taper = {taper}
[time]
method = "trbdf2"
end = {end}
tolerance = 1e-6
[output]
frame_interval = {end / frames}
"""
    for section in (0, 8):
        text += f"""[[clamp]]
section = {section}
stiffness = 2e3
point = [{first + section * RADIUS}, 0.0, 0.0]
{motion}
"""
    return text


def axial(columns, frame):
    """Force on the fluid along x, and torque on it about the axis."""
    y, z = columns["middle_y"][frame], columns["middle_z"][frame]
    return columns["force_x"][frame], columns["torque_x"][frame] + y * columns["force_z"][frame] - z * columns["force_y"][frame]


def solve_dense(nodes):
    """[2, 2]: force and torque along the axis (rows) by unit speed along it and unit spin about it."""
    x, y, z = nodes.T
    motions = np.stack([np.r_[np.ones(len(x)), 0 * x, 0 * x], np.r_[0 * x, -z, y]], axis=1)
    return motions.T @ np.linalg.solve(make_mobility(nodes, BLOB), motions)


def solve_slender(centre, thickness):
    """The same by Lighthill's slender-body theory (SIAM Review 18, 161, 1976): 4 pi mu u = the part of f across the fiber, and the
    flow of point forces of everything farther along it than sqrt(e) / 2 of its radius; pieces are twice as long as that."""
    along = np.r_[0, np.cumsum(np.linalg.norm(np.diff(centre, axis=0), axis=1))]
    n = round(along[-1] / (np.sqrt(np.e) * thickness))
    length = along[-1] / n
    places = (np.arange(n) + 0.5) * length
    middle = np.stack([np.interp(places, along, c) for c in centre.T], axis=1)
    tangent = np.stack([np.interp(places + length / 2, along, c) - np.interp(places - length / 2, along, c) for c in centre.T], axis=1)
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
    d = middle[:, None] - middle[None]
    r = np.linalg.norm(d, axis=2) + np.eye(n)
    matrix = (np.eye(3)[:, None, :, None] / r[None, :, None, :] + np.einsum("ija,ijb->aibj", d, d) / r[None, :, None, :]**3)
    matrix *= length / (8 * np.pi)
    for i in range(n):
        matrix[:, i, :, i] = (np.eye(3) - np.outer(tangent[i], tangent[i])) / (4 * np.pi)
    x, y, z = middle.T
    motions = np.stack([np.r_[np.ones(n), 0 * x, 0 * x], np.r_[0 * x, -z, y]], axis=1)
    return motions.T @ np.linalg.solve(matrix.reshape(3 * n, 3 * n), motions) * length


def solve_resistive(centre, thickness, pitch, name):
    """The same with drags per length along and across, of Gray and Hancock (1955) or of Lighthill (1976), at the local radius and
    inclination."""
    pieces = np.diff(centre, axis=0)
    length = np.linalg.norm(pieces, axis=1)
    turn = np.max(length / np.abs(pieces[:, 0])) * abs(pitch)  # along the fiber
    if name == "Gray and Hancock":
        tangential = 2 * np.pi / (np.log(2 * abs(pitch) / thickness) - 0.5)
        normal = 4 * np.pi / (np.log(2 * abs(pitch) / thickness) + 0.5)
    else:
        tangential, normal = 2 * np.pi / np.log(0.18 * turn / thickness), 4 * np.pi / (np.log(0.18 * turn / thickness) + 0.5)
    tangent = pieces / length[:, None]
    x, y, z = ((centre[1:] + centre[:-1]) / 2).T
    motions = np.stack([np.stack([1 + 0 * x, 0 * x, 0 * x]), np.stack([0 * x, -z, y])])
    along = np.einsum("mai,ia->mi", motions, tangent)
    forces = normal * motions + (tangential - normal) * along[:, None, :] * tangent.T[None]
    return np.einsum("mai,nai,i->mn", motions, forces, length)


def check_helix(program, claims, sections, helix, pitch, stiffness=5e3):
    spin_end = 0.8
    turning = write_scene(sections, helix, pitch, stiffness, f"spin = {SPIN}", spin_end)
    _, position, columns, _ = run(program, turning)
    force, torque = (value / SPIN for value in axial(columns[0], -1))
    speed = 0.1
    moving = f"swing = [{speed / 1e-3}, 0.0, 0.0]\nangular_frequency = 1e-3"  # a thousandth of a radian of its swing
    _, _, columns, _ = run(program, write_scene(sections, helix, pitch, stiffness, moving, spin_end))
    drag = axial(columns[0], -1)[0] / speed
    nodes = position[0]
    centre = nodes.reshape(sections, NODES, 3).mean(axis=1)
    thickness = find_thickness({"radius": RADIUS, "nodes_per_section": NODES, "blob": BLOB, "spacing": RADIUS})
    print(f"a helix of R = {helix / thickness:.1f} radii of the filament, pitch {pitch / helix:.3g} R, axial length "
          f"{np.ptp(centre[:, 0]) / helix:.3g} R")
    found = {"thrust": abs(force) / helix**2, "torque": torque / helix**3, "drag": drag / helix}
    references = [("dense matrices", solve_dense(nodes), (0.01, 0.01, 0.01)),
                  ("Lighthill's slender-body theory", solve_slender(centre, thickness), (0.15, 0.05, 0.05))]
    for name in ("Gray and Hancock", "Lighthill"):
        references.append((f"resistive-force theory of {name}", solve_resistive(centre, thickness, pitch, name), None))
    for source, matrix, within in references:
        numbers = {"thrust": abs(matrix[0, 1]) / helix**2, "torque": matrix[1, 1] / helix**3, "drag": matrix[0, 0] / helix}
        for index, (what, value) in enumerate(found.items()):
            if within is None:
                claims.state(what, value, numbers[what], source)
            else:
                claims.compare(what, value, numbers[what], source, within[index])
    claims.check("... the sign of the thrust differs from that of the handedness", float(np.sign(force) != np.sign(matrix[0, 1])), 0)
    from_axis = np.linalg.norm(position[[0, -1], :, 1:], axis=2)
    claims.check("... nodes come nearer to the axis or go away from it, over R", abs(np.diff(from_axis, axis=0)).max() / helix, 0.05)


def main(program, option=""):
    claims = Claims()
    if option == "--fine":
        check_helix(program, claims, 300, 0.12, 0.6)
        check_helix(program, claims, 300, 0.12, 1.2)
    check_helix(program, claims, 140, 0.08, -0.32)
    return claims.finish()


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
