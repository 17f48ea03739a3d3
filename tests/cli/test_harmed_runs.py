"""Run folders in which something is missing, changed, cannot be read, or is not what it should be.

Called as test_harmed_runs.py PROGRAM SOURCES. Whatever is harmed: no verb hangs or calls it a bug of its own, nothing is
lost, and a run that can go on does, to the same end."""

import os
import pathlib
import shutil
import tempfile
import unittest

import cli_case
from cli_case import CANNOT_CREATE, DAMAGED, DONE, IO_ERROR, USAGE

KILLED = -9

SCENE = """[fiber]
sections = 10
nodes_per_section = 4
blob = 0.005
direction = [1.0, 0.5, 0.0]
[time]
end = 0.5
max_step = 0.01
[output]
frame_interval = 0.05
[checkpoint]
wall_interval = 0.0
simulated_interval = 0.1
"""


def skein(*arguments, before=(), **environment):
    return cli_case.skein(*arguments, before=before, environment={"ASAN_OPTIONS": "detect_leaks=0", **environment})


def content(folder):
    """Every file of a run's data, by its name."""
    parts = [folder / "scene.toml", *folder.glob("segments/*"), *folder.glob("checkpoints/*")]
    return {str(path.relative_to(folder)): path.read_bytes() for path in parts if path.is_file()}


def certificate(folder):
    return [line for line in skein("verify", folder).stdout.splitlines() if line.startswith("certificate")]


class HarmedRuns(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.pristine = pathlib.Path(scratch.name)
        cls.scene = cls.pristine / "scene.toml"
        cls.scene.write_text(SCENE)
        assert skein("run", cls.scene, "-o", cls.pristine / "done", "-q").returncode == DONE
        killed = skein("run", cls.scene, "-o", cls.pristine / "killed", "-q", SKEIN_TEST_KILL="step:60")
        assert killed.returncode == KILLED
        assert len(list(cls.pristine.glob("killed/segments/*"))) > 2
        cls.certificate = certificate(cls.pristine / "done")
        assert cls.certificate

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def copy(self, name):
        target = self.folder / name
        shutil.rmtree(target, ignore_errors=True)
        return pathlib.Path(shutil.copytree(self.pristine / name, target, symlinks=True))

    def expect(self, result, code, *words):
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertNotIn("internal error", result.stderr)
        for word in words:
            self.assertIn(str(word), result.stderr)

    def expect_goes_on(self, run):
        self.expect(skein("resume", run, "-q"), DONE)
        self.assertEqual(certificate(run), self.certificate)
        self.assertFalse(list(run.rglob("*.partial")))

    # Checkpoints that are not seen are not taken for none.

    def test_frames_survive_checkpoints_that_cannot_be_listed(self):
        harms = {
            "a link to nowhere": lambda path: path.symlink_to("/not/mounted"),
            "a file": lambda path: path.write_text("mine"),
            "a pipe": os.mkfifo,
        }
        run = self.copy("killed")
        before = content(run)
        checkpoints = run / "checkpoints"
        checkpoints.rename(self.folder / "elsewhere")
        for name, harm in harms.items():
            with self.subTest(name):
                harm(checkpoints)
                for options in ([], ["--from-start"]):
                    self.expect(skein("resume", run, "-q", *options), IO_ERROR, checkpoints)
                self.expect(skein("verify", run), IO_ERROR, checkpoints)
                checkpoints.unlink()
        (self.folder / "elsewhere").rename(checkpoints)
        self.assertEqual(content(run), before)
        self.expect_goes_on(run)

    def test_frames_without_a_checkpoint_are_dropped_on_request_only(self):
        run = self.copy("killed")
        shutil.rmtree(run / "checkpoints")
        before = content(run)
        self.expect(skein("resume", run, "-q"), DAMAGED, "no checkpoint", "--from-start")
        self.expect(skein("verify", run), DAMAGED, "no checkpoint")
        self.assertEqual(content(run), before)
        self.expect(skein("resume", run, "-q", "--from-start"), DONE)
        self.assertEqual(certificate(run), self.certificate)

    def test_a_run_with_a_good_checkpoint_does_not_start_again(self):
        run = self.copy("killed")
        before = content(run)
        self.expect(skein("resume", run, "-q", "--from-start"), USAGE, "is a good checkpoint")
        self.assertEqual(content(run), before)

    def test_damaged_checkpoints_alone_keep_the_frames(self):
        run = self.copy("killed")
        for path in run.glob("checkpoints/*"):
            path.write_bytes(b"damaged")
        before = content(run)
        self.expect(skein("resume", run, "-q"), DAMAGED, "none of the", "--from-start")
        self.assertEqual(content(run), before)
        self.expect(skein("resume", run, "-q", "--from-start"), DONE, "renamed")
        self.assertEqual(certificate(run), self.certificate)

    def test_a_run_killed_before_any_interval_goes_on_from_its_start(self):
        for point in ("segment.after_rename:1", "checkpoint.half:1", "checkpoint.after_rename:1", "checkpoint.half:2",
                      "trajectory.h5.half:1", "trajectory.h5.after_rename:2"):
            with self.subTest(point):
                run = self.folder / point
                self.assertEqual(skein("run", self.scene, "-o", run, "-q", SKEIN_TEST_KILL=point).returncode, KILLED)
                self.expect_goes_on(run)

    def test_nothing_is_removed_where_the_run_cannot_go_on(self):
        run = self.copy("killed")
        newest = max(run.glob("checkpoints/*.checkpoint"))
        newest.write_bytes(b"damaged")
        segments = len(list(run.glob("segments/*.h5")))
        (run / "events.jsonl").unlink()
        (run / "events.jsonl").mkdir()
        result = skein("resume", run, "-q")
        self.assertIn(result.returncode, (CANNOT_CREATE, IO_ERROR), result.stderr)
        self.assertIn("events.jsonl", result.stderr)
        self.assertEqual(len(list(run.glob("segments/*.h5"))), segments)
        (run / "events.jsonl").rmdir()
        self.expect_goes_on(run)

    def test_a_leftover_that_cannot_be_removed_is_named(self):
        run = self.copy("killed")
        (run / "segments" / "000099.h5" / "mine").mkdir(parents=True)
        self.expect(skein("resume", run, "-q"), IO_ERROR, "segments/000099.h5")
        shutil.rmtree(run / "segments" / "000099.h5")
        self.expect_goes_on(run)

    def test_what_others_keep_in_a_run_folder_stays(self):
        run = self.copy("killed")
        mine = [run / "data.partial", run / "segments" / "notes.txt", run / "checkpoints" / "copy.partial"]
        for path in mine:
            path.write_text("mine")
        self.expect(skein("resume", run, "-q"), DONE)
        for path in mine:
            self.assertEqual(path.read_text(), "mine")

    # A run that is done is brought in order.

    def test_a_run_killed_after_its_last_checkpoint_is_done_on_resume(self):
        last = int(max(self.pristine.glob("done/checkpoints/*.checkpoint")).stem)
        for point in ("after_rename", "before_rename"):
            with self.subTest(point):
                run = self.folder / point
                kill = f"checkpoint.{point}:{last}"
                self.assertEqual(skein("run", self.scene, "-o", run, "-q", SKEIN_TEST_KILL=kill).returncode, KILLED)
                self.assertIn("status: running", skein("info", run).stdout)
                self.expect_goes_on(run)
                self.assertIn("status: done", skein("info", run).stdout)

    def test_files_beside_the_frames_are_mended(self):
        index, xdmf = "trajectory.h5", "trajectory.xdmf"
        harms = {
            "no index": lambda run: (run / index).unlink(),
            "a cut index": lambda run: (run / index).write_bytes((run / index).read_bytes()[:3000]),
            "a changed index": lambda run: (run / index).write_bytes((run / index).read_bytes().replace(b"done", b"gone")),
            "no xdmf": lambda run: (run / xdmf).unlink(),
            "half an index": lambda run: (run / (index + ".partial")).write_text("half"),
            "half a segment": lambda run: (run / "segments" / "000009.h5.partial").write_text("half"),
            "half a checkpoint": lambda run: (run / "checkpoints" / "000009.checkpoint.partial").write_text("half"),
        }
        for name, harm in harms.items():
            with self.subTest(name):
                run = self.copy("done")
                harm(run)
                self.expect(skein("resume", run), DONE, "mended", "nothing is left to do")
                self.assertEqual(certificate(run), self.certificate)
                self.assertFalse(list(run.rglob("*.partial")))
                self.assertTrue((run / xdmf).is_file())
                self.expect(skein("analyze", run, "--no-forces"), DONE)

    def test_a_run_in_order_is_not_written_again(self):
        run = self.copy("done")
        before = (run / "trajectory.h5").stat().st_mtime_ns
        result = skein("resume", run)
        self.expect(result, DONE, "nothing is left to do")
        self.assertNotIn("mended", result.stderr)
        self.assertEqual((run / "trajectory.h5").stat().st_mtime_ns, before)

    def test_an_index_that_is_gone_or_damaged_is_made_anew_on_the_way(self):
        for name, harm in {"gone": os.unlink, "cut": lambda path: os.truncate(path, 3000)}.items():
            with self.subTest(name):
                run = self.copy("killed")
                harm(run / "trajectory.h5")
                result = skein("verify", run)
                self.expect(result, DAMAGED, "trajectory.h5", "'skein resume' writes this file anew")
                self.assertNotIn("frames: 0", result.stdout)
                self.expect_goes_on(run)

    # Every verb looks at what it rests on.

    def verbs(self, run):
        return {
            "analyze": ["analyze", run],
            "field": ["field", run, "-o", self.folder / "field.vti", "--time", "0.2"],  # in segment 1
            "info": ["info", run],
            "plot": ["plot", run],
            "resume": ["resume", run, "-q"],
            "verify": ["verify", run],
        }

    def test_an_edited_scene_is_found_by_every_verb(self):
        for name in ("done", "killed"):
            run = self.copy(name)
            for edit in ("spring_stiffness = 1.0", "broken ="):
                text = (self.pristine / name / "scene.toml").read_text()
                (run / "scene.toml").write_text(text.replace("viscosity = 1.0", edit, 1))
                self.assertNotEqual((run / "scene.toml").read_text(), text)
                before = content(run)
                for verb, command in self.verbs(run).items():
                    with self.subTest(f"{verb}, {edit}"):
                        self.expect(skein(*command), DAMAGED, run / "scene.toml")
                self.assertEqual(content(run), before)
            (run / "scene.toml").write_text(text)
            self.expect_goes_on(run)
        self.assertFalse((self.folder / "field.vti").exists())

    def test_a_segment_of_another_run_is_found_by_every_verb(self):
        other = self.folder / "other"
        self.assertEqual(skein("run", self.scene, "-o", other, "-q", "--set", "flow.rate=2.25").returncode, DONE)
        run = self.copy("done")
        shutil.copy(other / "segments" / "000001.h5", run / "segments" / "000001.h5")
        for verb, command in self.verbs(run).items():
            if verb == "info":  # rests on the index alone
                continue
            with self.subTest(verb):
                self.expect(skein(*command), DAMAGED, "segments/000001.h5")

    def test_a_changed_segment_is_not_drawn(self):
        run = self.copy("done")
        path = run / "segments" / "000001.h5"
        changed = bytearray(path.read_bytes())
        changed[len(changed) // 2] ^= 1
        path.write_bytes(changed)
        self.expect(skein("plot", run), DAMAGED, path)
        self.assertFalse((run / "plots").exists())

    # What cannot be read is told with its reason.

    def test_no_verb_hangs_or_fails_inside_on_what_is_no_file(self):
        pristine = self.pristine / "killed"
        names = ["scene.toml", "trajectory.h5", "segments/000001.h5", "segments"]
        newest = max(pristine.glob("checkpoints/*.checkpoint")).relative_to(pristine)
        kinds = {"a folder": os.mkdir, "a pipe": os.mkfifo, "a link to itself": lambda path: os.symlink(path, path)}
        for name in [*names, newest]:
            for kind, make in kinds.items():
                if name == "segments" and kind == "a folder":
                    continue
                run = self.copy("killed")
                path = run / name
                shutil.rmtree(path) if path.is_dir() else path.unlink()
                make(path)
                for verb, command in self.verbs(run).items():
                    if verb == "resume" or (verb in ("analyze", "field", "info", "plot") and name == newest):
                        continue
                    with self.subTest(f"{verb}, {kind} in place of {name}"):
                        result = skein(*command)
                        expected = (IO_ERROR, DAMAGED) if name == "segments" else (IO_ERROR,)
                        self.assertIn(result.returncode, expected, result.stderr)
                        self.assertNotIn("internal error", result.stderr)
                        self.assertIn(str(path), result.stderr)

    def test_resume_takes_the_older_checkpoint_where_the_newest_is_no_file(self):
        for kind, make in {"a folder": os.mkdir, "a pipe": os.mkfifo,
                           "a link to nowhere": lambda path: os.symlink("/not/there", path)}.items():
            with self.subTest(kind):
                run = self.copy("killed")
                newest = max(run.glob("checkpoints/*.checkpoint"))
                newest.unlink()
                make(newest)
                self.expect(skein("resume", run), DONE, newest, "cannot be read", "renamed")
                self.assertEqual(certificate(run), self.certificate)

    @unittest.skipUnless(shutil.which("strace"), "strace is not installed")
    def test_errors_of_reading_are_told_and_survived(self):
        run = self.copy("killed")
        newest = max(run.glob("checkpoints/*.checkpoint"))

        def failing(path):
            return ["strace", "-f", "-qq", "-o", "/dev/null", "-P", path, "-e", "trace=read,pread64", "-e",
                    "inject=read,pread64:error=EIO"]

        for name in ("trajectory.h5", "segments/000001.h5", "scene.toml"):
            for verb, command in self.verbs(run).items():
                # A field is that of one frame, which is in another segment.
                if verb == "resume" or (verb in ("info", "field") and name.startswith("segments")):
                    continue
                with self.subTest(f"{verb}, {name}"):
                    self.expect(skein(*command, before=failing(run / name)), IO_ERROR, run / name, "Input/output error")
        with self.subTest("no checkpoint can serve without its segment"):
            before = content(run)
            result = skein("resume", run, "-q", before=failing(run / "segments/000000.h5"))
            first = min(run.glob("checkpoints/*.checkpoint"))
            if result.returncode != DONE:  # else the first checkpoint needed none
                self.expect(result, IO_ERROR, "segments/000000.h5", "Input/output error", first)
                self.assertEqual(content(run), before)
        with self.subTest("the newest checkpoint"):
            run = self.copy("killed")
            self.expect(skein("resume", run, before=failing(newest)), DONE, newest, "Input/output error")
            self.assertEqual(certificate(run), self.certificate)

    # Killed before there was a scene.

    def test_a_folder_without_a_scene_yet_can_be_used_again(self):
        for point in ("half", "before_rename"):
            with self.subTest(point):
                run = self.folder / point
                killed = skein("run", self.scene, "-o", run, "-q", SKEIN_TEST_KILL=f"scene.toml.{point}:1")
                self.assertEqual(killed.returncode, KILLED)
                self.assertFalse((run / "scene.toml").exists())
                self.expect(skein("run", self.scene, "-o", run, "-q"), DONE)
                self.assertEqual(certificate(run), self.certificate)

    def test_a_run_killed_while_it_was_replaced_can_be_replaced(self):
        for point in ("half", "before_rename", "after_rename"):
            with self.subTest(point):
                run = self.copy("done")
                command = ["run", self.scene, "-o", run, "-q", "--overwrite"]
                self.assertEqual(skein(*command, SKEIN_TEST_KILL=f"scene.toml.{point}:1").returncode, KILLED)
                self.expect(skein(*command), DONE)
                self.assertEqual(certificate(run), self.certificate)


if __name__ == "__main__":
    cli_case.main()
