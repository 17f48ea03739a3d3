"""Velocities that forces cause in a viscous fluid, at any points."""

from typing import NamedTuple

import numpy as np

from .errors import UsageError
from .native import _native


class Velocities(NamedTuple):
    """What forces do to the fluid."""

    velocities: np.ndarray  #: [n_targets, 3], length / time, in Fortran's order
    error: float  #: relative, 2-norm, of 64 of the velocities against direct sums; 0 for direct sums themselves
    method: str  #: in words


class Mobility:
    """Velocities by the regularized Stokeslets of points, for any number of calls with one tolerance.

    u(x) = sum_i ((r^2 + 2 eps_i^2) f_i + (f_i . d) d) / (8 pi mu (r^2 + eps_i^2)^(3/2)), d = x - x_i, r^2 = d . d, in free
    space (Cortez, Fauci, Medovikov 2005); every point acts on itself, too. The fast multipole method's operators are
    kept between calls; its tree follows the points. Few points, and tolerances below what the method promises, are summed
    directly. An error above the tolerance is found by the check of each call, and the order raised.

        mobility = skein.Mobility(tolerance=1e-6)
        velocities, error, method = mobility(positions, forces, blobs)
    """

    def __init__(self, tolerance=1e-6, viscosity=1.0):
        """@param tolerance  relative error of all velocities together (2-norm); 0: direct sums in double precision
        @param viscosity  > 0, force * time / length^2"""
        self.tolerance, self.viscosity = float(tolerance), float(viscosity)
        self._native = _native.PointMobility(self.tolerance, self.viscosity)

    def __repr__(self):
        return f"skein.Mobility(tolerance={self.tolerance:g}, viscosity={self.viscosity:g})"

    def __call__(self, positions, forces, blobs, targets=None):
        """@param positions  [n, 3] of the sources, length
        @param forces     [n, 3], on the fluid
        @param blobs      one length over which forces are spread, or [n], > 0
        @param targets    [m, 3] where velocities are asked for; at the sources without
        @returns Velocities

        Arrays of doubles in Fortran's order (each coordinate contiguous) are used where they are; others are copied."""
        positions = _numbers("positions", positions)
        blobs = _numbers("blobs", blobs)
        if blobs.ndim == 0:
            blobs = np.full(positions.shape[0] if positions.ndim else 0, blobs)
        return Velocities(*self._native.find_velocities(positions, _numbers("forces", forces), blobs,
                                                        None if targets is None else _numbers("targets", targets)))

    @property
    def misses(self):
        """How many calls found an error above the tolerance, and were made again with a higher order."""
        return self._native.misses

    def operator(self, positions, blobs):
        """The map from forces to velocities at fixed sources, [3 n, 3 n], as a SciPy LinearOperator: for its iterative
        solvers. A vector holds x, y, z of the first point, then of the second, and so on. Its transpose is itself if the
        blobs are all equal, and is not there otherwise."""
        from scipy.sparse.linalg import LinearOperator

        positions = np.asfortranarray(_numbers("positions", positions))
        if positions.ndim != 2 or positions.shape[1] != 3:
            raise UsageError(f"positions: an array [n, 3] is needed, and this one is {list(positions.shape)}")
        n = positions.shape[0]
        blobs = np.broadcast_to(_numbers("blobs", blobs), (n,))

        def apply(vector):
            return self(positions, np.reshape(vector, (n, 3)), blobs).velocities.reshape(-1)

        transposed = apply if n == 0 or np.all(blobs == blobs[0]) else None
        return LinearOperator((3 * n, 3 * n), matvec=apply, rmatvec=transposed, dtype=float)


def mobility(positions, forces, blobs, targets=None, tolerance=1e-6, viscosity=1.0):
    """Velocities that forces at some points cause at these points, or at others: one call of a Mobility.

    @param positions  [n, 3] of the sources, length
    @param forces     [n, 3], on the fluid
    @param blobs      one length over which forces are spread, or [n], > 0
    @param targets    [m, 3], length; at the sources without
    @returns Velocities(velocities [n or m, 3], error, method)

    What the last call's Mobility holds is used again where tolerance and viscosity are the same: operators, and 200 bytes a
    point, but not after calls with more than 300 000 points. Results do not depend on it."""
    global _kept
    used = _kept if _kept is not None and (_kept.tolerance, _kept.viscosity) == (tolerance, viscosity) else None
    _kept = None  # also where the call fails
    used = used or Mobility(tolerance, viscosity)
    found = used(positions, forces, blobs, targets)
    if not used.misses and len(found.velocities) <= _most_points_kept and len(positions) <= _most_points_kept:
        _kept = used
    return found


_kept = None  # of the last call of mobility()
_most_points_kept = 300_000


def _numbers(name, values):
    try:
        return np.asarray(values, dtype=float)
    except (TypeError, ValueError) as error:
        raise UsageError(f"{name}: an array of numbers is needed ({error})") from None
