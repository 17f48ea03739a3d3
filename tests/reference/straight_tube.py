"""The paper's fiber and its fluid, written from the formulas alone: what the scripts beside this file share.

Source of the formulas: LaGrone, Cortez, Yan, Fauci, "Complex dynamics of long, flexible fibers in shear" (2019); of the
regularized Stokeslet: Cortez, Fauci, Medovikov, Phys. Fluids 17, 031504 (2005). Lengths, times and forces are in the
paper's units, with a viscosity of 1. Nothing here is taken from the program that the numbers test.
"""

import numpy as np

RADIUS = 0.005
NODES_PER_SECTION = 18
STIFFNESS = 0.0112
BLOB = 0.00225
SHEAR_RATE = 2.5


def spacing(nodes_per_section=NODES_PER_SECTION):
    """The distance of sections: the chord between neighbouring nodes of a section."""
    return 2.0 * RADIUS * np.sin(np.pi / nodes_per_section)


def angles(nodes_per_section=NODES_PER_SECTION):
    """The angle of each node of a section; angle 0 points along y."""
    return 2.0 * np.pi * np.arange(nodes_per_section) / nodes_per_section


def places_along(sections, nodes_per_section=NODES_PER_SECTION):
    """The x of each section of a straight fiber about the origin."""
    return (np.arange(sections) - 0.5 * (sections - 1)) * spacing(nodes_per_section)


def straight_nodes(sections, nodes_per_section=NODES_PER_SECTION):
    """The nodes of a straight fiber along x, [sections, nodes_per_section, 3]."""
    nodes = np.empty((sections, nodes_per_section, 3))
    nodes[..., 0] = places_along(sections, nodes_per_section)[:, None]
    nodes[..., 1] = RADIUS * np.cos(angles(nodes_per_section))
    nodes[..., 2] = RADIUS * np.sin(angles(nodes_per_section))
    return nodes


def spring_families(nodes_per_section=NODES_PER_SECTION):
    """Each kind of spring once: (sections apart, steps around the section, both ends counted twice).

    Inside a section the springs of d and N_c - d steps are the same ones; where N_c is even, those to the node
    opposite are met from both of their ends.
    """
    for steps in range(1, nodes_per_section // 2 + 1):
        yield 0, steps, 2 * steps == nodes_per_section
    for steps in range(nodes_per_section):
        yield 1, steps, False


def rest_length(apart, steps, nodes_per_section=NODES_PER_SECTION):
    """The length of a spring in the straight fiber."""
    chord = 2.0 * RADIUS * np.sin(np.pi * steps / nodes_per_section)
    return np.hypot(apart * spacing(nodes_per_section), chord)


def spring_vectors(nodes, apart, steps):
    """From the far node of each spring of a family to its near one, [sections - apart, nodes_per_section, 3]."""
    return nodes[:len(nodes) - apart] - np.roll(nodes, -steps, axis=1)[apart:]


def spring_energy(nodes, stiffness=STIFFNESS):
    """The sum of k l (r/l - 1)^2 / 2 over all springs."""
    energy = 0.0
    for apart, steps, is_twice in spring_families(nodes.shape[1]):
        length = rest_length(apart, steps, nodes.shape[1])
        strain = np.linalg.norm(spring_vectors(nodes, apart, steps), axis=-1) / length - 1.0
        energy += 0.5 * stiffness * length * np.sum(strain**2) * (0.5 if is_twice else 1.0)
    return energy


def spring_forces(nodes, stiffness=STIFFNESS):
    """Minus the gradient of the energy, [sections, nodes_per_section, 3]."""
    force = np.zeros_like(nodes)
    sections = len(nodes)
    for apart, steps, is_twice in spring_families(nodes.shape[1]):
        d = spring_vectors(nodes, apart, steps)
        r = np.linalg.norm(d, axis=-1, keepdims=True)
        pull = stiffness * (r / rest_length(apart, steps, nodes.shape[1]) - 1.0) / r * d
        if is_twice:
            pull *= 0.5
        force[:sections - apart] -= pull
        force[apart:] += np.roll(pull, steps, axis=1)
    return force


def stokeslet(target, source, blob=BLOB):
    """The velocity at each target per force at each source, [n_targets, n_sources, 3, 3]."""
    d = target[:, None, :] - source[None, :, :]
    r_squared = np.sum(d**2, axis=-1)
    core = r_squared + blob**2
    block = d[..., :, None] * d[..., None, :]
    block += (r_squared + 2.0 * blob**2)[..., None, None] * np.eye(3)
    return block / (8.0 * np.pi * core**1.5)[..., None, None]
