"""What is wrong is said as the program says it: test_errors.py PROGRAM SOURCES."""

import os
import subprocess
import sys

import numpy as np

from python_case import SMALL_SCENE, InFreshFolder, main, skein

POINTS = np.linspace(0.0, 1.0, 12).reshape(4, 3)
TUMBLING = {"fiber": {"sections": 10, "nodes_per_section": 6, "blob": 0.0045}, "time": {"end": 0.3}}


class Errors(InFreshFolder):
    def expect_error(self, kind, words, call):
        with self.assertRaises(kind) as caught:
            call()
        self.assertIs(type(caught.exception), kind)
        self.assertIn(words, str(caught.exception))
        return caught.exception

    def test_bad_calls(self):
        self.make_run("there")
        scene = skein.Scene(TUMBLING)
        for kind, words, call in [
            (skein.SceneError, "unknown key 'lenght'", lambda: skein.Scene({"fiber": {"lenght": 1.0}})),
            (skein.SceneError, "fiber.sections", lambda: skein.Scene(TUMBLING, {"fiber.sections": -3})),
            (skein.UsageError, "and no object", lambda: skein.Scene({"fiber": {"sections": object()}})),
            (skein.UsageError, "and not 3", lambda: skein.Scene({"fiber": {3: 4}})),
            (skein.UsageError, "and no int", lambda: skein.Scene(7)),
            (skein.MissingInput, "nowhere.toml", lambda: skein.Scene("nowhere.toml")),
            (skein.MissingInput, "nowhere", lambda: skein.Run("nowhere")),
            (skein.MissingInput, "nowhere", lambda: skein.resume("nowhere")),
            (skein.MissingInput, "nowhere", lambda: skein.analyze("nowhere")),
            (skein.MissingInput, "run 'skein analyze' first", lambda: skein.Run(self.folder / "there").diagnostics),
            (skein.CannotCreate, "there", lambda: skein.run(scene, self.folder / "there")),
            (skein.UsageError, "on_frame", lambda: skein.run(scene, on_frame=3)),
            (skein.UsageError, "tolerance", lambda: skein.plan(scene, tolerance=2.0)),
            (skein.UsageError, "positions: an array [n, 3] is needed, and this one is [4, 2]",
             lambda: skein.mobility(POINTS[:, :2], POINTS, 0.1)),
            (skein.UsageError, "4 positions and 3 forces", lambda: skein.mobility(POINTS, POINTS[:3], 0.1)),
            (skein.UsageError, "blobs[2] is -1", lambda: skein.mobility(POINTS, POINTS, [1.0, 1.0, -1.0, 1.0])),
            (skein.UsageError, "blobs: one number", lambda: skein.mobility(POINTS, POINTS, [1.0, 1.0])),
            (skein.UsageError, "forces[1, 2] is nan",
             lambda: skein.mobility(POINTS, np.where(POINTS == POINTS[1, 2], np.nan, POINTS), 0.1)),
            (skein.UsageError, "targets", lambda: skein.mobility(POINTS, POINTS, 0.1, targets=[1.0, 2.0, 3.0])),
            (skein.UsageError, "positions: an array of numbers", lambda: skein.mobility("points", POINTS, 0.1)),
            (skein.UsageError, "tolerance = 2", lambda: skein.mobility(POINTS, POINTS, 0.1, tolerance=2.0)),
            (skein.UsageError, "viscosity = 0", lambda: skein.mobility(POINTS, POINTS, 0.1, viscosity=0.0)),
            (skein.UsageError, "positive number", lambda: skein.Mobility(viscosity=float("nan"))),
            (KeyError, "there are", lambda: skein.Run(self.folder / "there").series["enrgy"]),
            (AttributeError, "no 'simulate'", lambda: skein.simulate),
        ]:
            with self.subTest(words):
                self.expect_error(kind, words, call)

    def test_texts_are_those_of_the_program(self):
        file = str(self.write(SMALL_SCENE + "lenght = 3\n[fluid]\nviscosity = -1.0\n"))
        result = self.skein("run", file, "-o", "run")
        error = self.expect_error(skein.SceneError, "viscosity", lambda: skein.Scene(file))
        self.assertEqual(result.returncode, error.code)
        for line in str(error).splitlines():
            self.assertIn(line, result.stderr)

    def test_a_blow_up_keeps_the_last_good_state(self):
        scene = skein.Scene(self.write(SMALL_SCENE), {"time.method": "euler", "time.step": 0.02, "time.end": 5.0})
        error = self.expect_error(skein.NumericalFailure, "node", lambda: skein.run(scene, self.folder / "run"))
        self.assertIsInstance(error, ArithmeticError)
        self.assertEqual(skein.Run(self.folder / "run").status, "failed")

    def test_threads_are_set_before_anything_is_computed(self):
        skein.mobility(POINTS, POINTS, 0.1)
        self.expect_error(skein.UsageError, "cannot change later", lambda: skein.set_threads(2))

    def test_runs_do_not_begin_within_each_other(self):
        scene = skein.Scene(TUMBLING)
        self.expect_error(skein.UsageError, "on_frame of another", lambda: skein.run(
            scene, on_frame=lambda frame: skein.run(scene)))

    def test_velocities_are_found_within_on_frame(self):
        found = []
        skein.run(skein.Scene(TUMBLING), on_frame=lambda frame: found.append(
            skein.mobility(frame.centreline, np.ones_like(frame.centreline), 0.01).velocities))
        self.assertTrue(np.isfinite(found).all())

    def test_a_forked_process_says_what_it_cannot_do(self):
        skein.mobility(POINTS, POINTS, 0.1)
        child = os.fork()
        if child == 0:
            try:
                skein.mobility(POINTS, POINTS, 0.1)
            except skein.UsageError as error:
                os._exit(0 if "forked" in str(error) else 2)
            os._exit(1)
        self.assertEqual(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), 0)

    def test_reading_needs_no_compiled_part(self):
        folder = self.make_run()
        package = os.path.dirname(skein.__file__)
        (self.folder / "skein").mkdir()
        for name in os.listdir(package):
            if name.endswith(".py"):
                os.symlink(os.path.realpath(os.path.join(package, name)), self.folder / "skein" / name)
        code = ("import skein\nprint(len(skein.Run('run')))\n"
                "try:\n    skein.Mobility()\nexcept skein.Error as error:\n    print(error)")
        result = subprocess.run([sys.executable, "-c", code], cwd=folder.parent, capture_output=True, text=True,
                                env={**os.environ, "PYTHONPATH": str(self.folder)})
        self.assertEqual(result.stdout.splitlines()[0], "4", result.stderr)
        self.assertIn("only reads runs", result.stdout)


if __name__ == "__main__":
    main()
