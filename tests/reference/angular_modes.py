"""Small motions of a straight fiber in a fluid at rest, dx/dt = -M K x, taken apart into angular modes.

A section looks the same from each of its nodes: displacements (along x, outwards, around) times exp(i m angle) with one
m = 0 .. N_c/2 go into displacements of the same kind. So the operators of all nodes fall apart into matrices of
3 N_f rows, one of each mode. M is the matrix of regularized Stokeslets, K the stiffness of the springs at rest.
"""

import numpy as np

import straight_tube as tube


def section_frames():
    """The axes (along x, outwards, around) at each node of a section as columns, [nodes_per_section, 3, 3]."""
    cosine, sine = np.cos(tube.angles()), np.sin(tube.angles())
    frames = np.zeros((tube.NODES_PER_SECTION, 3, 3))
    frames[:, 0, 0] = 1.0
    frames[:, 1, 1], frames[:, 2, 1] = cosine, sine
    frames[:, 1, 2], frames[:, 2, 2] = -sine, cosine
    return frames


def mode_matrix(blocks, mode):
    """The operator of one mode from its blocks between node 0 of a section and every node, in the fixed axes.

    blocks: [sections, sections, nodes_per_section, 3, 3]; the result is [3 sections, 3 sections].
    """
    phase = np.exp(1j * mode * tube.angles())
    sections = len(blocks)
    matrix = np.einsum("stbij,bjk,b->sitk", blocks, section_frames(), phase, optimize=True)
    return matrix.reshape(3 * sections, 3 * sections)


def mobility_blocks(sections, blob):
    """Velocity of node 0 of each section per force on every node."""
    nodes = tube.straight_nodes(sections)
    blocks = tube.stokeslet(nodes[:, 0], nodes.reshape(-1, 3), blob)
    return blocks.reshape(sections, sections, tube.NODES_PER_SECTION, 3, 3)


def stiffness_blocks(sections):
    """Minus the force on node 0 of each section per displacement of every node: springs at rest."""
    nodes = tube.straight_nodes(sections)
    blocks = np.zeros((sections, sections, tube.NODES_PER_SECTION, 3, 3))
    for section in range(sections):
        for other in range(max(0, section - 1), min(sections, section + 2)):
            for node in range(tube.NODES_PER_SECTION):
                if section == other and node == 0:
                    continue
                d = nodes[section, 0] - nodes[other, node]
                length = np.linalg.norm(d)
                spring = tube.STIFFNESS / length * np.outer(d, d) / length**2
                blocks[section, section, 0] += spring
                blocks[section, other, node] -= spring
    return blocks


class SmallMotions:
    """The rates of decay of every motion of a mode, ascending, and the motions."""

    def __init__(self, sections, blob=tube.BLOB):
        self.mobility = mobility_blocks(sections, blob)
        self.stiffness = stiffness_blocks(sections)

    def decay(self, mode):
        """With M = C C^H the rates are the eigenvalues of C^H K C; the motions are C times its eigenvectors."""
        lower = np.linalg.cholesky(mode_matrix(self.mobility, mode))
        rates, vectors = np.linalg.eigh(lower.conj().T @ mode_matrix(self.stiffness, mode) @ lower)
        return rates, lower @ vectors
