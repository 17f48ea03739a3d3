"""Velocities from Python against sums written here: test_mobility.py PROGRAM SOURCES."""

import subprocess
import sys
import unittest
import unittest.mock

import numpy as np

from python_case import main, skein
from skein import fluid

VISCOSITY, BLOB = 1.7, 0.03
RANDOM = np.random.default_rng(1)


def sum_directly(positions, forces, blobs, targets, viscosity):
    """The formula of Mobility, point by point."""
    velocities = np.empty_like(targets)
    square = np.broadcast_to(blobs, len(positions)) ** 2
    for i, target in enumerate(targets):
        apart = target - positions
        r2 = np.einsum("ij,ij->i", apart, apart)
        along = np.einsum("ij,ij->i", apart, forces)
        terms = (r2 + 2.0 * square)[:, None] * forces + along[:, None] * apart
        velocities[i] = (terms / ((r2 + square) ** 1.5)[:, None]).sum(axis=0)
    return velocities / (8.0 * np.pi * viscosity)


def relative_error(got, wanted):
    return np.linalg.norm(got - wanted) / np.linalg.norm(wanted)


def draw(n):
    return RANDOM.uniform(-1.0, 1.0, (n, 3)), RANDOM.uniform(-1.0, 1.0, (n, 3))


class Mobility(unittest.TestCase):
    def test_few_points_are_summed_as_the_formula_says(self):
        positions, forces = draw(40)
        blobs, targets = RANDOM.uniform(0.01, 0.1, 40), draw(7)[0]
        for tolerance in (1e-6, 0.0):
            at_sources = skein.mobility(positions, forces, blobs, tolerance=tolerance, viscosity=VISCOSITY)
            apart = skein.mobility(positions, forces, blobs, targets, tolerance, VISCOSITY)
            self.assertEqual((at_sources.error, at_sources.method), (0.0, "direct sum"))
            for found, where in ((at_sources, positions), (apart, targets)):
                exact = sum_directly(positions, forces, blobs, where, VISCOSITY)
                self.assertLess(relative_error(found.velocities, exact), 1e-13)

    def test_many_points_meet_the_tolerance_that_is_measured(self):
        positions, forces = draw(8000)
        some = slice(0, None, 20)
        exact = sum_directly(positions, forces, 1e-3, positions[some], VISCOSITY)
        for tolerance in (1e-3, 1e-5):
            found = skein.mobility(positions, forces, 1e-3, tolerance=tolerance, viscosity=VISCOSITY)
            true = relative_error(found.velocities[some], exact)
            self.assertLess(true, tolerance)
            self.assertLess(found.error, tolerance)
            self.assertGreater(found.error, true / 20.0)
            self.assertLess(found.error, true * 20.0)
            self.assertIn("order", found.method)

    def test_the_order_of_memory_changes_no_bit(self):
        positions, forces = draw(900)
        blobs, targets = np.full(900, BLOB), draw(800)[0]
        wanted = skein.mobility(positions, forces, BLOB, targets).velocities
        self.assertTrue(wanted.flags.f_contiguous)
        wide = np.asfortranarray(np.concatenate([targets, positions[:800]], axis=1))
        for arrays in [
            (np.asfortranarray(positions), np.asfortranarray(forces), blobs, wide[:, :3]),
            (positions.tolist(), forces.tolist(), blobs.tolist(), targets.tolist()),
            (np.repeat(positions, 2, axis=0)[::2], forces[::-1][::-1], np.repeat(blobs, 2)[::2], targets),
        ]:
            np.testing.assert_array_equal(skein.mobility(*arrays).velocities, wanted)

    def test_calls_do_not_depend_on_those_before(self):
        positions, forces = draw(3000)
        mobility = skein.Mobility(1e-4, VISCOSITY)
        first = mobility(positions, forces, 1e-3).velocities.copy()
        mobility(2.0 * positions, forces, 1e-3)
        np.testing.assert_array_equal(mobility(positions, forces, 1e-3).velocities, first)
        np.testing.assert_array_equal(skein.mobility(positions, forces, 1e-3, tolerance=1e-4,
                                                     viscosity=VISCOSITY).velocities, first)

    def test_the_function_keeps_what_serves_the_next_call_and_no_more(self):
        made = []

        class Counted(fluid.Mobility):
            def __init__(self, *arguments):
                super().__init__(*arguments)
                made.append(self)

        positions, forces = draw(20)
        with unittest.mock.patch.object(fluid, "Mobility", Counted), unittest.mock.patch.object(fluid, "_kept", None):
            for tolerance, n_made in ((1e-4, 1), (1e-4, 1), (1e-5, 2), (1e-4, 3), (1e-4, 3)):
                skein.mobility(positions, forces, BLOB, tolerance=tolerance)
                self.assertEqual(len(made), n_made)
            self.assertRaises(skein.UsageError, lambda: skein.mobility(positions, forces[:3], BLOB, tolerance=1e-4))
            with unittest.mock.patch.object(fluid, "_most_points_kept", 19):
                skein.mobility(positions, forces, BLOB, tolerance=1e-4)  # anew, after the error
                skein.mobility(positions, forces, BLOB, tolerance=1e-4)  # anew, as there were too many points
            self.assertEqual(len(made), 5)
            with unittest.mock.patch.object(Counted, "misses", 1):
                skein.mobility(positions, forces, BLOB, tolerance=1e-4)
            skein.mobility(positions, forces, BLOB, tolerance=1e-4)  # anew, as the order was raised
            self.assertEqual(len(made), 7)

    def test_a_mobility_may_live_until_python_ends(self):
        code = ("import numpy as np, skein\nkept = skein.Mobility(1e-4)\n"
                "points = np.random.default_rng(1).uniform(-1.0, 1.0, (3000, 3))\n"
                "kept(points, points, 1e-3)\nskein.mobility(points, points, 1e-3)")
        ended = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=100)
        self.assertEqual((ended.returncode, ended.stderr), (0, ""))

    def test_nothing_gives_nothing(self):
        self.assertEqual(skein.mobility(np.empty((0, 3)), np.empty((0, 3)), 0.1).velocities.shape, (0, 3))
        np.testing.assert_array_equal(skein.mobility(np.empty((0, 3)), np.empty((0, 3)), 0.1, [[1.0, 2.0, 3.0]]).velocities, 0.0)

    def test_the_operator_is_one_of_scipy(self):
        try:
            from scipy.sparse.linalg import gmres
        except ImportError:
            self.skipTest("there is no SciPy")
        positions, forces = draw(20)
        operator = skein.Mobility(viscosity=VISCOSITY).operator(positions, BLOB)
        velocities = sum_directly(positions, forces, BLOB, positions, VISCOSITY)
        np.testing.assert_allclose(operator @ forces.reshape(-1), velocities.reshape(-1), rtol=1e-12)
        one, other = RANDOM.normal(size=(2, 60))
        np.testing.assert_allclose(one @ (operator @ other), (operator.T @ one) @ other, rtol=1e-12)
        solution, status = gmres(operator, velocities.reshape(-1), restart=60, atol=0.0)
        self.assertEqual(status, 0)
        np.testing.assert_allclose(operator @ solution, velocities.reshape(-1), rtol=1e-2)
        uneven = skein.Mobility().operator(positions, np.linspace(0.1, 0.2, 20))
        self.assertRaises(NotImplementedError, lambda: uneven.rmatvec(one))


if __name__ == "__main__":
    main()
