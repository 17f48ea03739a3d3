"""Runs that go on to a later end: `skein resume RUN --set time.end=LATER`.

What such a run holds must be what an unbroken run of the scene that it has then holds, in every bit; whatever happens while
the end is moved; and nothing but the end may have been changed.

Called as check_prolonging.py PROGRAM.
"""

import pathlib
import shutil
import signal
import sys
import tempfile
import tomllib
import unittest

import h5py

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "torture"))

import program
import run_files
from program import DONE

PROGRAM = None  # set from the arguments at the end

USAGE = 64
SHORT = ["time.end=0.52", "output.frame_interval=0.1"]


def frame_times(folder):
    with h5py.File(folder / "trajectory.h5", "r") as file:
        return list(file["particles/fibers/position/time"][()])


class Prolonging(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.program = program.Program(PROGRAM, folder.name)
        self.run_folder = pathlib.Path(folder.name) / "run"

    def begin(self, *options, **keywords):
        result = self.program.run(self.run_folder, SHORT, *options, **keywords)
        if not keywords:
            self.assertEqual(result.returncode, DONE, result.stderr)

    def prolong(self, end, *options, code=DONE, **keywords):
        result = self.program.resume(self.run_folder, "--set", f"time.end={end}", *options, **keywords)
        self.assertEqual(result.returncode, code, result.stderr)
        return result

    def scene(self):
        return (self.run_folder / "scene.toml").read_text()

    def certificate(self):
        result = self.program.verify(self.run_folder)
        self.assertEqual(result.returncode, DONE, result.stderr)
        return result.stdout.split("certificate: ")[1].split()[0]

    def expect_as_unbroken(self):
        """As a new run of the scene that the folder has now."""
        self.certificate()
        unbroken = self.run_folder.parent / "unbroken"
        result = self.program.run(unbroken, scene=self.run_folder / "scene.toml", threads=2)
        self.assertEqual(result.returncode, DONE, result.stderr)
        self.assertEqual(run_files.differences(self.run_folder, run_files.final_state(unbroken)), [])
        shutil.rmtree(unbroken)

    def test_a_run_that_is_done_goes_on(self):
        self.begin()
        first = self.scene()
        self.prolong(0.83)
        self.assertEqual(frame_times(self.run_folder),
                         [0.0, 0.1, 0.2, 3 * 0.1, 0.4, 0.5, 0.52, 6 * 0.1, 7 * 0.1, 0.8, 0.83])
        changed = tomllib.loads(self.scene())
        self.assertEqual((changed["time"].pop("end"), changed["time"].pop("earlier_ends")), (0.83, [0.52]))
        unchanged = tomllib.loads(first)
        self.assertEqual(unchanged["time"].pop("end"), 0.52)
        self.assertEqual(changed, unchanged)
        self.expect_as_unbroken()

    def test_twice_and_with_other_threads(self):
        self.begin()
        certificates = {self.certificate()}
        self.prolong(0.6, threads=2)
        certificates.add(self.certificate())
        self.prolong(0.83)
        certificates.add(self.certificate())
        self.assertEqual(len(certificates), 3)
        self.assertEqual(tomllib.loads(self.scene())["time"]["earlier_ends"], [0.52, 0.6])
        self.expect_as_unbroken()

    def test_a_run_that_was_stopped_before_its_end(self):
        self.begin(SKEIN_TEST_KILL="step:12")
        self.prolong(0.83)
        self.assertIn(0.52, frame_times(self.run_folder))
        self.expect_as_unbroken()

    def test_a_run_that_failed(self):
        self.begin(SKEIN_TEST_NAN="position:12")
        self.assertIn("failed", self.program.verify(self.run_folder).stdout)
        self.prolong(0.83)
        self.expect_as_unbroken()

    def test_a_kill_at_any_moment_of_the_change(self):
        self.begin()
        done = self.run_folder.parent / "done"
        self.run_folder.rename(done)
        for moment in ("scene.toml.half", "scene.toml.before_rename", "scene.toml.after_rename",
                       "trajectory.h5.half", "trajectory.h5.before_rename", "trajectory.h5.after_rename", "step"):
            with self.subTest(moment=moment):
                shutil.copytree(done, self.run_folder)
                before = self.certificate()
                self.prolong(0.83, code=-signal.SIGKILL, SKEIN_TEST_KILL=f"{moment}:1")
                self.assertEqual(self.certificate(), before)
                self.prolong(0.83)
                self.expect_as_unbroken()
                shutil.rmtree(self.run_folder)

    def test_after_the_change_nothing_needs_to_be_said_again(self):
        self.begin()
        self.prolong(0.83, code=-signal.SIGKILL, SKEIN_TEST_KILL="scene.toml.after_rename:1")
        self.assertIn("its end was moved to 0.83", self.program.verify(self.run_folder).stderr)
        self.program.finish(self.run_folder)
        self.assertEqual(frame_times(self.run_folder)[-1], 0.83)
        self.assertEqual(self.prolong(0.83).stdout, "")

    def test_only_a_later_end_is_allowed(self):
        self.begin()
        scene, state = self.scene(), run_files.final_state(self.run_folder)
        for override, said in [
            ("fluid.viscosity=2.0", "viscosity = 2.0\n'skein run --from"),
            ("time.tolerance=1e-5", "tolerance = 1e-05\n'skein run --from"),
            ("time.end=0.3", "can only become later, not 0.3"),
            ("time.earlier_ends=[0.2]", "earlier_ends = [0.2]\n'skein run --from"),
            ("fiber.sections=13", "sections = 13\n'skein run --from"),
        ]:
            with self.subTest(override=override):
                result = self.program.resume(self.run_folder, "--set", override)
                self.assertEqual(result.returncode, USAGE, result.stderr)
                self.assertIn(said, result.stderr)
                both = self.program.resume(self.run_folder, "--set", "time.end=0.9", "--set", override)
                if not override.startswith("time.end"):
                    self.assertEqual(both.returncode, USAGE, both.stderr)
        for override in ("time.end=soon", "tim.end=3"):
            result = self.program.resume(self.run_folder, "--set", override)
            self.assertEqual(result.returncode, program.SCENE_ERROR, result.stderr)
        many = ", ".join(str(0.001 * n) for n in range(1, 65))
        (self.run_folder / "scene.toml").write_text(scene.replace("end = 0.52", f"end = 0.52\nearlier_ends = [{many}]"))
        changed = self.scene()
        self.assertEqual(self.prolong(0.9, code=program.SCENE_ERROR).stdout, "")
        self.assertEqual(self.scene(), changed)  # 65 earlier ends could not be read again
        (self.run_folder / "scene.toml").write_text(scene)
        self.assertEqual(run_files.differences(self.run_folder, state), [])

    def test_what_is_refused_changes_nothing(self):
        self.begin()
        newest = run_files.checkpoints(self.run_folder)[-1]
        newest.write_bytes(newest.read_bytes()[:-1])
        for override in ("time.end=0.3", "fluid.viscosity=2.0"):
            self.assertEqual(self.program.resume(self.run_folder, "--set", override).returncode, USAGE)
            self.assertTrue(newest.exists())
        self.prolong(0.83)
        self.expect_as_unbroken()

    def test_nothing_but_the_end_may_differ(self):
        self.begin()
        self.prolong(0.83)
        scene = self.scene()
        for before, after in [("viscosity = 1.0", "viscosity = 2.0"), ("end = 0.83", "end = 0.9"),
                              ("earlier_ends = [0.52]", "earlier_ends = [0.6]"), ("earlier_ends = [0.52]\n", "")]:
            with self.subTest(after=after):
                self.assertEqual(scene.count(before), 1)
                (self.run_folder / "scene.toml").write_text(scene.replace(before, after))
                result = self.program.verify(self.run_folder)
                self.assertEqual(result.returncode, program.DAMAGED, result.stdout)
        (self.run_folder / "scene.toml").write_text(scene)
        self.certificate()


if __name__ == "__main__":
    PROGRAM = sys.argv[1]
    unittest.main(argv=sys.argv[:1])
