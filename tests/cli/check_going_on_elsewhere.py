"""New runs that begin with the state of an earlier one: `skein run --from RUN[@TIME] [SCENE] -o DIR`.

They are self-contained, begin with exactly that state at its time, are the same whatever interrupts them and with any number
of threads, and name what they begin with.

Called as check_going_on_elsewhere.py PROGRAM.
"""

import pathlib
import shutil
import signal
import struct
import sys
import tempfile
import tomllib
import unittest

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "torture"))

import program
import run_files
from program import DONE

PROGRAM = None  # set from the arguments at the end

USAGE = 64
PARENT = ["time.end=0.52", "output.frame_interval=0.1"]
CHILD = ["time.end=0.97", "fiber.spring_stiffness=0.02"]


def frames(folder):
    with h5py.File(folder / "trajectory.h5", "r") as file:
        return list(file["particles/fibers/position/time"][()]), file["particles/fibers/position/value"][()]


class GoingOnElsewhere(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.program = program.Program(PROGRAM, self.folder)
        self.parent, self.child = self.folder / "parent", self.folder / "child"

    def run_parent(self, overrides=(), code=DONE, **variables):
        result = self.program.run(self.parent, [*PARENT, *overrides], **variables)
        self.assertEqual(result.returncode, code, result.stderr)

    def run_child(self, *options, origin=None, overrides=CHILD, folder=None, code=DONE, **variables):
        command = [PROGRAM, "run", "--from", origin or self.parent, "-o", folder or self.child, "-q", *options]
        for override in overrides:
            command += ["--set", override]
        result = self.program.call(command, **variables)
        self.assertEqual(result.returncode, code, result.stderr)
        return result

    def verify(self, folder):
        result = self.program.verify(folder)
        self.assertEqual(result.returncode, DONE, result.stderr)
        return dict(line.split(": ", 1) for line in result.stdout.splitlines())

    def scene(self, folder):
        return tomllib.loads((folder / "scene.toml").read_text())

    def start_of(self, folder):
        """The one start that is there, under the name that its scene tells."""
        (start,) = folder.glob("start*")
        self.assertEqual(start.name, f"start-{self.scene(folder)['start']['checksum']}.checkpoint")
        return start

    def test_with_the_last_state_exactly(self):
        self.run_parent()
        before = {path.name: path.read_bytes() for path in self.parent.rglob("*") if path.is_file()}
        self.run_child()
        last = run_files.read_checkpoint(run_files.checkpoints(self.parent)[-1])
        times, positions = frames(self.child)
        self.assertEqual(times, [0.52, 6 * 0.1, 7 * 0.1, 0.8, 0.9, 0.97])
        self.assertEqual(positions[0].tobytes(), struct.pack(f"<{positions[0].size}d", *last["state.position"]))
        start = run_files.read_checkpoint(self.start_of(self.child))
        self.assertEqual((start["state.position"], start["state.time"]), (last["state.position"], last["state.time"]))
        scene, parent_scene = self.scene(self.child), self.scene(self.parent)
        certificate = self.verify(self.parent)["certificate"]
        named = scene.pop("start")
        self.assertEqual((named["parent"], named["certificate"], named["step"]),
                         (str(self.parent), certificate, last["state.step"][0]))
        self.assertEqual(self.verify(self.child)["begun with the state of"],
                         f"'{self.parent}' at t = 0.52, step {named['step']}, certificate {certificate}")
        self.assertEqual((scene["time"].pop("start"), scene["time"].pop("end"), scene["fiber"].pop("spring_stiffness")),
                         (0.52, 0.97, 0.02))
        del parent_scene["start"], parent_scene["time"]["start"], parent_scene["time"]["end"]
        del parent_scene["fiber"]["spring_stiffness"]
        self.assertEqual(scene, parent_scene)
        self.assertEqual(before, {path.name: path.read_bytes() for path in self.parent.rglob("*") if path.is_file()})

    def test_a_killed_one_is_equal_to_an_unbroken_one(self):
        self.run_parent()
        self.run_child()
        reference = run_files.final_state(self.child)
        shutil.rmtree(self.parent)  # a child needs it no more
        broken = self.folder / "broken"
        for moment in ("step:1", "step:9", "checkpoint.half:1", "checkpoint.after_rename:2", "segment.before_rename:1"):
            with self.subTest(moment=moment):
                shutil.copytree(self.child, broken)
                again = [PROGRAM, "run", self.child / "scene.toml", "-o", broken, "-q", "--overwrite"]
                result = self.program.call(again, SKEIN_TEST_KILL=moment)
                self.assertEqual(result.returncode, -signal.SIGKILL, result.stderr)
                result = self.program.resume(broken, threads=2)
                self.assertEqual(result.returncode, DONE, result.stderr)
                self.assertEqual(run_files.differences(broken, reference), [])
                self.verify(broken)
                shutil.rmtree(broken)

    def test_a_kill_while_the_folder_is_made(self):
        self.run_parent()
        for moment in ("start.half", "start.after_rename", "scene.toml.half",
                       "scene.toml.after_rename"):
            with self.subTest(moment=moment):
                self.run_child(code=-signal.SIGKILL, SKEIN_TEST_KILL=f"{moment}:1")
                if moment == "scene.toml.after_rename":
                    self.assertEqual(self.program.resume(self.child).returncode, DONE)
                else:
                    self.run_child("--overwrite")
                self.verify(self.child)
                shutil.rmtree(self.child)

    def test_an_earlier_child_survives_until_another_one_has_its_scene(self):
        """Killed while it is replaced, the earlier run loses nothing; once the new scene is there, so is its start."""
        self.run_parent()
        self.run_child()
        certificate, start = self.verify(self.child)["certificate"], self.start_of(self.child).read_bytes()
        other = {"origin": f"{self.parent}@0.3", "overrides": ["time.end=0.6"]}
        for moment in ("start.half", "start.before_rename", "start.after_rename", "scene.toml.half",
                       "scene.toml.before_rename"):
            with self.subTest(moment=moment):
                broken = self.folder / "broken"
                shutil.copytree(self.child, broken)
                self.run_child("--overwrite", **other, folder=broken, code=-signal.SIGKILL,
                               SKEIN_TEST_KILL=f"{moment}:1")
                self.assertEqual(self.verify(broken)["certificate"], certificate)
                for path in broken.glob("checkpoints/*"):  # so that it begins again with its start
                    path.unlink()
                result = self.program.resume(broken, "--from-start")
                self.assertEqual(result.returncode, DONE, result.stderr)
                self.assertEqual(self.verify(broken)["certificate"], certificate)
                self.run_child("--overwrite", **other, folder=broken)
                self.assertNotEqual(self.start_of(broken).read_bytes(), start)
                shutil.rmtree(broken)
        replaced = pathlib.Path(shutil.copytree(self.child, self.folder / "replaced"))
        self.run_child("--overwrite", **other, folder=replaced, code=-signal.SIGKILL,
                       SKEIN_TEST_KILL="scene.toml.after_rename:1")
        again = self.folder / "again"
        result = self.program.call([PROGRAM, "run", replaced / "scene.toml", "-o", again, "-q"])
        self.assertEqual(result.returncode, DONE, result.stderr)
        self.run_child(**other, folder=self.folder / "whole")
        self.assertEqual(self.verify(again)["certificate"], self.verify(self.folder / "whole")["certificate"])

    def test_with_a_frame(self):
        self.run_parent()
        times, positions = frames(self.parent)
        self.run_child(origin=f"{self.parent}@0.3")
        found, begun = frames(self.child)
        self.assertEqual(found[0], 3 * 0.1)  # not 0.3
        self.assertEqual(begun[0].tobytes(), positions[times.index(3 * 0.1)].tobytes())
        for time, said in [("0.33", "the nearest are at t = 0.30000000000000004 and 0.4"), ("7", "its last is at t = 0.52")]:
            result = self.run_child(origin=f"{self.parent}@{time}", folder=self.folder / "none", code=program.MISSING)
            self.assertIn(said, result.stderr)
        self.assertFalse((self.folder / "none").exists())

    def test_a_fiber_that_is_bent_is_no_start_of_a_rigid_one(self):
        self.run_parent(['fiber.model="chain"', "fiber.start_amplitude=0.02"])
        rigid = ['fiber.model="rigid"', "fiber.start_amplitude=0.0", "time.end=0.6"]
        result = self.run_child(overrides=rigid, code=program.SCENE_ERROR)
        self.assertIn("fiber 0 is rigid here, and bent by", result.stderr)
        self.assertFalse(self.child.exists())
        shutil.rmtree(self.parent)
        self.run_parent(rigid[:2])
        self.run_child(overrides=['fiber.model="chain"', "time.end=0.6"])
        self.verify(self.child)

    def test_with_the_last_good_state_of_a_run_that_failed(self):
        self.run_parent(["time.method=euler", "time.step=2e-3", "fiber.spring_stiffness=1.0"], code=program.NUMERICAL)
        last = run_files.read_checkpoint(run_files.checkpoints(self.parent)[-1])
        self.run_child(overrides=["time.method=rkc2", "time.step=0.0", "time.end=0.6", "fiber.spring_stiffness=0.02"])
        self.assertEqual(frames(self.child)[1][0].ravel().tolist(), last["state.position"])
        self.verify(self.child)

    def test_without_a_change_it_goes_on_as_the_parent_would(self):
        """To the tolerance: the integrator begins afresh."""
        self.run_parent(["time.tolerance=1e-6", "fiber.direction=[0.2, 1.0, 0.0]"])
        whole = self.folder / "whole"
        overrides = [*PARENT, "time.tolerance=1e-6", "fiber.direction=[0.2, 1.0, 0.0]", "time.end=0.9"]
        self.assertEqual(self.program.run(whole, overrides).returncode, DONE)
        self.run_child(overrides=["time.end=0.9"])
        times, positions = frames(whole)
        length = 12 * 0.005  # 12 sections, as far apart as the 6 nodes of one
        self.assertLess(np.abs(positions[-1] - frames(self.child)[1][-1]).max(), 1e-4 * length)
        self.assertGreater(np.abs(positions[-1] - positions[times.index(0.5)]).max(), 0.1 * length)

    def test_flows_keep_their_time(self):
        """A flow that stops at the parent's end moves the child no more: it only comes to rest, as the parent would."""
        overrides = ["flow.stop=0.52", "fiber.direction=[0.2, 1.0, 0.0]"]
        self.run_parent(overrides)
        self.run_child(overrides=["time.end=0.9"])
        whole = self.folder / "whole"
        self.assertEqual(self.program.run(whole, [*PARENT, *overrides, "time.end=0.9"]).returncode, DONE)
        _, positions = frames(self.child)
        _, before = frames(self.parent)
        moved, moved_before = np.abs(positions[-1] - positions[0]).max(), np.abs(before[-1] - before[0]).max()
        self.assertLess(moved, 0.1 * moved_before)
        self.assertLess(np.abs(positions[-1] - frames(whole)[1][-1]).max(), 1e-5 * moved_before)

    def test_a_newer_checkpoint_that_is_damaged_is_named(self):
        self.run_parent()
        newest, before = run_files.checkpoints(self.parent)[-1], run_files.checkpoints(self.parent)[-2]
        content = newest.read_bytes()
        newest.write_bytes(content[:-1])
        result = self.run_child()
        self.assertIn(newest.name, result.stderr)
        self.assertEqual(frames(self.child)[0][0], run_files.read_checkpoint(before)["state.time"][0])
        self.assertTrue(newest.exists())  # the parent is only read
        self.verify(self.child)

    def test_goes_on_without_its_start_where_it_has_a_checkpoint(self):
        self.run_parent()
        self.run_child(code=-signal.SIGKILL, SKEIN_TEST_KILL="step:9")
        start = self.start_of(self.child)
        start.unlink()
        self.assertEqual(self.program.resume(self.child).returncode, DONE)
        result = self.program.verify(self.child)
        self.assertEqual(result.returncode, program.DAMAGED, result.stdout)
        self.assertIn(start.name, result.stderr)

    def test_dry_run_and_a_missing_scene(self):
        self.run_parent()
        result = self.run_child("--dry-run")
        self.assertIn("from t = 0.52 to t = 0.97, begun with the state of", result.stdout)
        self.assertFalse(self.child.exists())
        result = self.program.call([PROGRAM, "run", "-o", self.child])
        self.assertEqual(result.returncode, USAGE, result.stderr)
        self.assertIn("--from RUN", result.stderr)

    def test_of_a_child_and_prolonged(self):
        self.run_parent()
        self.run_child()
        grandchild = self.folder / "grandchild"
        self.run_child(origin=self.child, folder=grandchild, overrides=["time.end=1.3"])
        self.assertEqual(self.scene(grandchild)["start"]["parent"], str(self.child))
        result = self.program.resume(grandchild, "--set", "time.end=1.44")
        self.assertEqual(result.returncode, DONE, result.stderr)
        self.verify(grandchild)
        times, _ = frames(grandchild)
        self.assertEqual((times[0], 1.3 in times, times[-1]), (0.97, True, 1.44))
        great = self.folder / "great"
        self.run_child(origin=f"{grandchild}@1.3", folder=great, overrides=["time.end=1.35"])
        self.assertNotIn("earlier_ends", self.scene(great)["time"])
        for verb in ("analyze", "info"):
            result = self.program.call([PROGRAM, verb, grandchild])
            self.assertEqual(result.returncode, DONE, result.stderr)

    def test_with_another_scene(self):
        self.run_parent()
        other = self.folder / "other.toml"
        other.write_text(program.SCENE.replace("rate = 2.5", "rate = 1.0"))
        self.run_child(other, overrides=["time.end=0.6"])
        self.assertEqual((self.scene(self.child)["flow"]["rate"], self.scene(self.child)["time"]["start"]), (1.0, 0.52))
        other.write_text(program.SCENE.replace("sections = 12", "sections = 13"))
        result = self.run_child(other, folder=self.folder / "none", code=program.SCENE_ERROR)
        self.assertIn("fiber 0 has 13 sections of 6 nodes here, and 12 of 6 in the run", result.stderr)
        result = self.run_child(self.program.three_fibers, folder=self.folder / "none", code=program.SCENE_ERROR)
        self.assertIn("has 3 fibers and the run", result.stderr)
        self.assertFalse((self.folder / "none").exists())

    def test_what_cannot_be(self):
        self.run_parent()
        for origin, overrides, code, said in [
            (None, ["fiber.sections=13"], program.SCENE_ERROR, "fiber 0 has 13 sections"),
            (None, [], program.SCENE_ERROR, "give a later end"),
            (None, ["time.end=0.5"], program.SCENE_ERROR, "time.end 0.5 is before time.start 0.52"),
            (None, ["time.start=0.1"], USAGE, "the start is that of the earlier run"),
            (None, ["start.step=1"], USAGE, "the start is that of the earlier run"),
            (f"{self.parent}@soon", [], USAGE, "'soon' no time"),
            (self.folder / "nothing", [], program.MISSING, "nothing"),
        ]:
            with self.subTest(origin=origin, overrides=overrides):
                result = self.run_child(origin=origin, overrides=overrides, code=code)
                self.assertIn(said, result.stderr)
                self.assertFalse(self.child.exists())
        result = self.run_child("--overwrite", folder=self.parent, code=program.CANNOT_CREATE)
        self.assertIn("name another output folder", result.stderr)
        self.verify(self.parent)
        self.parent.rename(self.folder / "at@0.1")
        self.run_child(origin=self.folder / "at@0.1")

    def test_a_start_that_was_changed_is_found(self):
        self.run_parent()
        self.run_child()
        start, checkpoints = self.start_of(self.child), self.child / "checkpoints"
        content = start.read_bytes()
        for damaged in (content[:-1], content[:200] + bytes([content[200] ^ 1]) + content[201:], b""):
            start.write_bytes(damaged)
            result = self.program.verify(self.child)
            self.assertEqual(result.returncode, program.DAMAGED, result.stdout)
            self.assertIn(start.name, result.stderr)
        shutil.rmtree(checkpoints)
        shutil.rmtree(self.child / "segments")
        (self.child / "segments").mkdir()
        (self.child / "trajectory.h5").unlink()
        result = self.program.resume(self.child)
        self.assertEqual(result.returncode, program.DAMAGED, result.stderr)
        start.write_bytes(content)
        self.program.finish(self.child)


if __name__ == "__main__":
    PROGRAM = sys.argv[1]
    unittest.main(argv=sys.argv[:1])
