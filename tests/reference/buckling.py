"""Growth rates of bends of a fiber that planar extension compresses, and the critical rates. Takes half a minute.

The fiber lies along x in u = e (-x, y, 0). Small motions v about the fiber under load:

    dv/dt = G v - M K v + (dM v) f

with the flow's gradient G, the stiffness K of springs under load, and the forces f of these springs. Without the part
of the flow that makes sections oval the fiber under load is a surface of revolution, and bends are the real angular
mode m = 1: displacements (a cos, b cos, c sin)(angle) along x, outwards and around.

"full length": load to first order in e, on the fiber at its rest length. "compressed": the steady fiber under the whole
load, which is shorter. Numbers for tests/accuracy/test_buckling.cpp and for the growth rates in docs/analysis.md.
"""

import numpy as np

import straight_tube as tube
from angular_modes import section_frames

SECTIONS = 80
ROW = 1  # the node of a section whose velocities are looked at: neither cosine nor sine of its angle is zero


def mode_basis(mode):
    """The displacement of each node by (a, b, c), [nodes_per_section, 3, 3]."""
    along = np.cos(mode * tube.angles())
    around = np.sin(mode * tube.angles()) if mode > 0 else np.ones(tube.NODES_PER_SECTION)
    return section_frames() * np.stack([along, along, around], axis=-1)[:, None, :]


def reduce(blocks, mode):
    """The operator on (a, b, c) of all sections from its blocks between node ROW of a section and every node."""
    basis = mode_basis(mode)
    rows = np.einsum("stbij,bjk->sitk", blocks, basis, optimize=True)
    return np.einsum("ri,sitk->srtk", np.linalg.inv(basis[ROW]), rows).reshape(3 * SECTIONS, 3 * SECTIONS)


def flow_matrix(rate, mode):
    """G on (a, b, c): the part of its velocities that belongs to the mode, by least squares over a section."""
    basis = mode_basis(mode).reshape(-1, 3)
    flow = (np.diag([-rate, rate, 0.0]) @ mode_basis(mode)).reshape(-1, 3)
    return np.kron(np.eye(SECTIONS), np.linalg.lstsq(basis, flow, rcond=None)[0])


class LoadedFiber:
    """Sections at x with radii, and the shift (along, outwards) that only the springs' tension feels."""

    def __init__(self, along, radius, shift=None):
        self.shape = np.stack([along, radius, np.zeros(SECTIONS)], 1)
        self.shift = np.zeros((SECTIONS, 3)) if shift is None else shift
        self.nodes = np.einsum("bij,sj->sbi", section_frames(), self.shape)
        moved = np.einsum("bij,sj->sbi", section_frames(), self.shift)
        self.stiffness = np.zeros((SECTIONS, SECTIONS, tube.NODES_PER_SECTION, 3, 3))
        self.section_force = np.zeros((SECTIONS, 3))  # along the axes of node ROW
        for apart in (-1, 0, 1):
            for node in range(tube.NODES_PER_SECTION):
                if apart != 0 or node != ROW:
                    self._add_springs(apart, node, moved)
        self.section_force = self.section_force @ section_frames()[ROW]

    def _add_springs(self, apart, node, moved):
        """From node ROW of each section to a node of the section `apart` further on."""
        own = np.arange(max(0, -apart), SECTIONS - max(0, apart))
        other = own + apart
        d = self.nodes[own, ROW] - self.nodes[other, node]
        r = np.linalg.norm(d, axis=1)
        direction = d / r[:, None]
        length = tube.rest_length(abs(apart), node - ROW)
        change = np.sum(direction * (moved[own, ROW] - moved[other, node]), axis=1)
        tension = tube.STIFFNESS * (r - length + change) / length
        along = direction[:, :, None] * direction[:, None, :]
        spring = tube.STIFFNESS / length * along + (tension / r)[:, None, None] * (np.eye(3) - along)
        self.section_force[own] -= tension[:, None] * direction
        self.stiffness[own, own, ROW] += spring
        self.stiffness[own, other, node] -= spring

    def mobility(self):
        """M between node ROW of a section and every node."""
        blocks = tube.stokeslet(self.nodes[:, ROW], self.nodes.reshape(-1, 3))
        return blocks.reshape(self.stiffness.shape)

    def mobility_change(self):
        """(dM v) f: the derivative of the velocities by positions, the forces held."""
        force = np.einsum("bij,sj->sbi", section_frames(), self.section_force)
        d = self.nodes[:, None, None, ROW] - self.nodes[None]
        f_dot_d = np.sum(force * d, axis=-1)[..., None, None]
        core = np.sum(d**2, axis=-1)[..., None, None] + tube.BLOB**2
        outer = lambda a, b: np.broadcast_to(a, d.shape)[..., :, None] * b[..., None, :]
        force_at = np.broadcast_to(force, d.shape)
        by_difference = (outer(force, 2.0 * d) + f_dot_d * np.eye(3) + outer(d, force_at)) / core**1.5
        by_difference -= 3.0 * (outer(force, d) * (core + tube.BLOB**2) + f_dot_d * outer(d, d)) / core**2.5
        by_difference /= 8.0 * np.pi
        blocks = -by_difference
        blocks[np.arange(SECTIONS), np.arange(SECTIONS), ROW] += by_difference.sum(axis=(1, 2))
        return blocks

    def operator(self, rate, mode):
        """G - M K + (dM .) f of the mode."""
        springs = reduce(self.mobility(), mode) @ reduce(self.stiffness, mode)
        return flow_matrix(rate, mode) - springs + reduce(self.mobility_change(), mode)


def compress(rate, is_full_length):
    """The fiber at rest in the flow."""
    fiber = LoadedFiber(tube.places_along(SECTIONS), np.full(SECTIONS, tube.RADIUS))
    for _ in range(20):
        mobility = reduce(fiber.mobility(), 0)
        velocity = flow_matrix(rate, 0) @ fiber.shape.ravel() + mobility @ fiber.section_force.ravel()
        slope = -mobility @ reduce(fiber.stiffness, 0) if is_full_length else fiber.operator(rate, 0)
        step = np.linalg.lstsq(slope, -velocity, rcond=1e-12)[0].reshape(SECTIONS, 3)
        if is_full_length:
            return LoadedFiber(fiber.shape[:, 0], fiber.shape[:, 1], step)
        fiber = LoadedFiber(*(fiber.shape + step)[:, :2].T)
        if np.abs(step[:, :2]).max() < 1e-10 * tube.RADIUS:
            return fiber
    raise RuntimeError("no steady compressed fiber found")


def growth_rates(rate, is_even, is_full_length):
    """Of bends whose deflection is even or odd along the fiber, the fastest first."""
    values, vectors = np.linalg.eig(compress(rate, is_full_length).operator(rate, 1))
    outward = vectors[1::3]
    mirrored = np.real(np.sum(outward.conj() * outward[::-1], axis=0))
    return np.sort(values.real[(mirrored > 0.0) == is_even])[::-1]


def critical_rate(is_even, is_full_length, low, high):
    """2 e at which the second growth rate passes zero, by the secant method; the first is that of a rigid motion."""
    growth = lambda double_rate: growth_rates(0.5 * double_rate, is_even, is_full_length)[1]
    at_low, at_high = growth(low), growth(high)
    while abs(high - low) > 1e-6:
        low, high, at_low = high, high - at_high * (high - low) / (at_high - at_low), at_high
        at_high = growth(high)
    return high


def main():
    for name, is_full_length in (("full length", True), ("compressed", False)):
        even, odd = growth_rates(1.25, True, is_full_length), growth_rates(1.25, False, is_full_length)
        print(f"{name}, 2 e = 2.5: even {even[0]:.5g} (C), {even[1]:.5g} (drift); "
              f"odd {odd[0]:.5g} (turning), {odd[1]:.5g} (S)")
        print(f"{name}, critical 2 e: C {critical_rate(True, is_full_length, 0.42, 0.43):.5g}, "
              f"S {critical_rate(False, is_full_length, 1.8, 1.9):.5g}")


if __name__ == "__main__":
    main()
