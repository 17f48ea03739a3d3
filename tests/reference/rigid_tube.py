"""Resistance of the rigid tube and its turning in shear. Takes half a minute and 1 GB.

The nodes of a straight fiber of 80 sections move as one body: the forces f on the fluid solve M f = U, M the matrix of
regularized Stokeslets. Sums of f are the resistance to translations and rotations about the middle. A free tube in the
shear u = (rate y, 0, 0) has the angular velocity at which the torque is zero. By Jeffery (Proc. R. Soc. A 102, 161,
1922) the rates of turning across and along the flow are as r_e^2 to 1, and a half turn takes pi (r_e + 1/r_e) / rate.

Numbers for tests/accuracy/test_rigid_tube.cpp.
"""

import numpy as np

import straight_tube as tube

SECTIONS = 80


def resistances(nodes):
    """Axial and transverse force, torque across, and the effective aspect ratio."""
    n = len(nodes)
    mobility = np.empty((n, 3, n, 3))
    for first in range(0, n, 100):
        rows = slice(first, first + 100)
        mobility[rows] = tube.stokeslet(nodes[rows], nodes).transpose(0, 2, 1, 3)
    x, y, z = nodes.T
    zero = np.zeros(n)
    one = np.ones(n)
    motions = {
        "along": np.stack([one, zero, zero], 1),
        "across": np.stack([zero, one, zero], 1),
        "turning": np.stack([-y, x, zero], 1),      # about z
        "flow": np.stack([y, zero, zero], 1),       # shear of rate 1 along the tube
        "flow_across": np.stack([zero, -x, zero], 1)  # the same flow, seen from a tube across it
    }
    velocities = np.stack([u.ravel() for u in motions.values()], 1)
    forces = dict(zip(motions, np.linalg.solve(mobility.reshape(3 * n, 3 * n), velocities).T))
    inner = lambda a, b: float(motions[a].ravel() @ forces[b])
    turning = inner("turning", "turning")
    along, across = inner("turning", "flow") / turning, inner("turning", "flow_across") / turning
    return inner("along", "along"), inner("across", "across"), turning, np.sqrt(across / along)


def main():
    for sections, nodes_per_section in ((SECTIONS, 18), (54, 12)):
        nodes = tube.straight_nodes(sections, nodes_per_section).reshape(-1, 3)
        along, across, turning, ratio = resistances(nodes)
        print(f"{sections} sections of {nodes_per_section} nodes:")
        print(f"  axial F/U {along:.6g}, transverse {across:.6g}, T/omega {turning:.6g}")
        print(f"  r_e {ratio:.5g}, half turn {np.pi * (ratio + 1.0 / ratio) / tube.SHEAR_RATE:.5g}")


if __name__ == "__main__":
    main()
