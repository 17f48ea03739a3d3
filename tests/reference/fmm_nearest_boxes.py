"""Error of far fields between two boxes that are as near as expansions ever meet. Takes a minute.

A kernel-independent method (Ying, Biros, Zorin, J. Comput. Phys. 196, 591, 2004) with boxes of half-width 1 whose
centres are 4 apart: potentials of the sources on the outer surface of their box (2.95), densities on its inner surface
(1.05), their potentials on the target box's inner surface, densities on its outer surface, velocities at the targets.
The surfaces have p points per edge; densities follow from potentials by the pseudo-inverse, applied as two factors.
Errors are relative (2-norm) to the sum of regularized Stokeslets with blob eps, for random forces at random places.

harmonic: u_i = phi_i - x_k d_i phi_k + d_i psi with phi = sum f/r and psi = sum (y.f)/r + (eps^2/2) (f.d)/r^3,
    d = x - y and x and y from a box's centre: four potentials with the densities of 1/r.
stokeslet: strengths of S_0 that match the field of S_eps.

Numbers for tests/accuracy/test_fmm_error.cpp; the last lines give the factor of (eps / half-width)^4 that blobs leave.
"""

from functools import lru_cache

import numpy as np

DISTANCE = np.array([4.0, 0.0, 0.0])
INNER, OUTER = 1.05, 2.95
N_NODES = 500


def surface(order):
    """The points of the cube |x| = 1."""
    line = np.linspace(-1.0, 1.0, order)
    grid = np.stack(np.meshgrid(line, line, line, indexing="ij"), -1).reshape(-1, 3)
    return grid[np.abs(grid).max(1) > 1.0 - 1e-12]


def laplace(target, source):
    """1/r of every pair."""
    return 1.0 / np.linalg.norm(target[:, None] - source[None], axis=-1)


def stokeslet(target, source, blob):
    """8 pi viscosity times the velocity per force, [3 n_targets, 3 n_sources]."""
    d = target[:, None] - source[None]
    core = np.sum(d**2, -1) + blob**2
    block = d[..., :, None] * d[..., None, :] + (core + blob**2)[..., None, None] * np.eye(3)
    block /= core[..., None, None]**1.5
    return block.transpose(0, 2, 1, 3).reshape(3 * len(target), 3 * len(source))


class PseudoInverse:
    """U^T first, then V S^-1: their product would lose the digits of small singular values."""

    def __init__(self, matrix, cutoff=1e-15):
        u, singular, vt = np.linalg.svd(matrix)
        kept = singular > cutoff * singular[0]
        self.first, self.last = u[:, kept].T, vt[kept].T / singular[kept]

    def __call__(self, potential):
        return self.last @ (self.first @ potential)


@lru_cache(maxsize=1)
def inverses(order, kernel):
    """Of the kernel from the inner surface to the outer one, and back."""
    inner, outer = INNER * surface(order), OUTER * surface(order)
    return PseudoInverse(kernel(outer, inner)), PseudoInverse(kernel(inner, outer))


def singular_stokeslet(target, source):
    """S_0."""
    return stokeslet(target, source, 0.0)


def harmonic_velocity(order, target, source, force, blob):
    """Targets and sources are measured from the centres of their boxes."""
    inner, outer = INNER * surface(order), OUTER * surface(order)
    upward, downward = inverses(order, laplace)
    d = outer[:, None] - source[None]
    inverse = 1.0 / np.linalg.norm(d, axis=-1)
    psi = inverse @ np.sum(source * force, 1) + 0.5 * blob**2 * np.sum(np.sum(d * force, -1) * inverse**3, 1)
    density = upward(np.column_stack([inverse @ force, psi]))
    density[:, 3] -= density[:, :3] @ DISTANCE  # psi about the target box's centre, which is DISTANCE further on
    density = downward(laplace(inner + DISTANCE, inner) @ density)
    d = target[:, None] - outer[None]
    inverse = 1.0 / np.linalg.norm(d, axis=-1)
    pull = (target @ density[:, :3].T - density[:, 3]) * inverse**3  # (x . q - q_psi) / r^3
    return inverse @ density[:, :3] + np.einsum("ij,ijk->ik", pull, d)


def stokeslet_velocity(order, target, source, force, blob):
    """The same by equivalent strengths of S_0."""
    inner, outer = INNER * surface(order), OUTER * surface(order)
    upward, downward = inverses(order, singular_stokeslet)
    strength = upward(stokeslet(outer, source, blob) @ force.ravel())
    strength = downward(singular_stokeslet(inner + DISTANCE, inner) @ strength)
    return (singular_stokeslet(target, outer) @ strength).reshape(-1, 3)


def relative_error(velocity_of, order, blob):
    """For one set of random forces and places."""
    random = np.random.default_rng(7)
    source, target = random.uniform(-1.0, 1.0, (2, N_NODES, 3))
    force = random.normal(size=(N_NODES, 3))
    exact = (stokeslet(target + DISTANCE, source, blob) @ force.ravel()).reshape(-1, 3)
    return np.linalg.norm(velocity_of(order, target, source, force, blob) - exact) / np.linalg.norm(exact)


def main():
    for order in (4, 6, 8, 10, 12, 14):
        print(f"harmonic, order {order}, blob 0: {relative_error(harmonic_velocity, order, 0.0):.2g}")
    for blob in (0.04, 0.1, 0.2, 0.4):
        error = relative_error(harmonic_velocity, 14, blob)
        print(f"harmonic, order 14, blob {blob}: {error:.2g}, {error / blob**4:.2g} of its fourth power")
    for blob in (0.0, 0.2):
        print(f"stokeslet, order 10, blob {blob}: {relative_error(stokeslet_velocity, 10, blob):.2g}")


if __name__ == "__main__":
    main()
