"""Springs, stiffness and elasto-viscous numbers of the paper's fibers. Takes a second.

EI: the straight fiber is bent into an arc of curvature kappa whose centreline keeps its length and whose sections stay
circular and perpendicular to it; EI = 2 E / (kappa^2 L), L = N_f ds. A fiber of N_f sections has N_f - 1 links, so that
of a fiber without ends is N_f / (N_f - 1) times as large. EA and GJ: second derivatives of the energy of one link by a
stretch and a twist that leave sections rigid and plane, per length, by differences of fourth order. At equilibrium each
section of a fiber without ends is displaced alike, in its own frame, so that the energy of its springs is least: a
linear least-squares problem for three components of every node.

Numbers for tests/unit/test_calibration.cpp and tests/unit/test_spring_network.cpp.
"""

import numpy as np

import straight_tube as tube

PAPER_SECTIONS = (80, 113, 301, 536, 1313)


def bent_nodes(sections, curvature):
    """The fiber bent into an arc in the x-y plane."""
    turn = curvature * tube.places_along(sections)[:, None]
    distance = 1.0 / curvature - tube.RADIUS * np.cos(tube.angles())  # from the arc's centre
    height = np.broadcast_to(tube.RADIUS * np.sin(tube.angles()), (sections, tube.NODES_PER_SECTION))
    return np.stack([distance * np.sin(turn), 1.0 / curvature - distance * np.cos(turn), height], axis=-1)


def bending_rigidity(sections, curvature, stiffness=tube.STIFFNESS):
    """EI of a fiber with ends."""
    energy = tube.spring_energy(bent_nodes(sections, curvature), stiffness)
    return 2.0 * energy / (curvature**2 * sections * tube.spacing())


def link_modulus(deform, step):
    """The second derivative of the energy of one link by what `deform(nodes, amount)` does, per length."""
    nodes = tube.straight_nodes(2)
    energy = lambda amount: tube.spring_energy(deform(nodes, amount))
    second = (16.0 * (energy(step) + energy(-step)) - energy(2.0 * step) - energy(-2.0 * step)) / (12.0 * step**2)
    return second / tube.spacing()


def stretched(nodes, strain):
    """Sections further apart."""
    return nodes * [1.0 + strain, 1.0, 1.0]


def twisted(nodes, twist):
    """Sections turned about the axis by the twist times their x."""
    angle = twist * nodes[..., 0]
    y, z = nodes[..., 1], nodes[..., 2]
    return np.stack([nodes[..., 0], np.cos(angle) * y - np.sin(angle) * z, np.sin(angle) * y + np.cos(angle) * z], -1)


def relaxed_modulus(elongation, stiffness=tube.STIFFNESS, nodes_per_section=tube.NODES_PER_SECTION):
    """Twice the least energy per length and strain squared; `elongation(apart, first, second)` is the first-order change
    of a spring's length per strain, sections rigid, between nodes that stand at [x, y, z]."""
    ring = tube.straight_nodes(1, nodes_per_section)[0]
    rows, right = [], []
    for apart, steps, is_twice in tube.spring_families(nodes_per_section):
        weight = np.sqrt(stiffness / tube.rest_length(apart, steps, nodes_per_section) * (0.5 if is_twice else 1.0))
        for node in range(nodes_per_section):
            other = (node + steps) % nodes_per_section
            first, second = ring[node], ring[other] + [apart * tube.spacing(nodes_per_section), 0.0, 0.0]
            direction = (second - first) / np.linalg.norm(second - first)
            row = np.zeros((nodes_per_section, 3))
            row[other] += direction
            row[node] -= direction
            rows.append(weight * row.ravel())
            right.append(weight * elongation(first, second))
    rows, right = np.array(rows), np.array(right)
    answer = np.linalg.lstsq(rows, -right, rcond=1e-10)[0]  # rigid motions cost nothing
    return np.sum((rows @ answer + right)**2) / tube.spacing(nodes_per_section)


def bending_elongation(first, second):
    """By a curvature towards y: u = (-x y, x^2 / 2, 0)."""
    field = lambda p: np.array([-p[0] * p[1], 0.5 * p[0]**2, 0.0])
    return (field(second) - field(first)) @ (second - first) / np.linalg.norm(second - first)


def stretching_elongation(first, second):
    return (second[0] - first[0])**2 / np.linalg.norm(second - first)


def elasto_viscous_number(sections, stiffness):
    """8 pi rate L^4 / (c EI) with c = ln(4 e / rho^2), rho = R / L, and the fiber's own EI."""
    length = sections * tube.spacing()
    c = np.log(4.0 * np.e * (length / tube.RADIUS)**2)
    return 8.0 * np.pi * tube.SHEAR_RATE * length**4 / (c * bending_rigidity(sections, 0.1, stiffness))


def main():
    lengths = [tube.rest_length(apart, steps) for apart, steps, _ in tube.spring_families()]
    print(f"rest lengths: {min(lengths):.9g} .. {max(lengths):.9g}")
    for sections in (2, 80):
        print(f"springs of {sections} sections: {153 * sections + 324 * (sections - 1)} by the formula, ", end="")
        count = sum((sections - apart) * 18 // (2 if is_twice else 1)
                    for apart, _, is_twice in tube.spring_families())
        print(f"{count} counted")
    for curvature in (0.1, 10.0, 50.0, 100.0):
        values = [bending_rigidity(n, curvature) * n / (n - 1) for n in (80, 301)]
        print(f"EI without ends, curvature {curvature:g}: {values[0]:.6g}, {values[1]:.6g} from 80 and 301 sections")
    print(f"EI of 80 sections: {bending_rigidity(80, 0.1):.6g}")
    print(f"EA: {link_modulus(stretched, 1e-3):.6g}")
    print(f"GJ: {link_modulus(twisted, 1.0):.6g}")
    for nodes in (18, 9, 6, 3):
        moduli = [relaxed_modulus(strain, tube.STIFFNESS, nodes) for strain in (bending_elongation, stretching_elongation)]
        print(f"at equilibrium, {nodes} nodes a section: EI {moduli[0]:.6g}, EA {moduli[1]:.6g}")
    for stiffness in (tube.STIFFNESS, 0.011237):
        numbers = [f"{elasto_viscous_number(n, stiffness):.4g}" for n in PAPER_SECTIONS]
        print(f"mu_bar, k = {stiffness:g}, {PAPER_SECTIONS} sections: {', '.join(numbers)}")


if __name__ == "__main__":
    main()
