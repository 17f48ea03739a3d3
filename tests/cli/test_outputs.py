"""What outputs may not do: have no name, take the place of an input, go through planted links, or outlive their run.

Called as test_outputs.py PROGRAM SOURCES.
"""

import os
import shutil
import subprocess

from cli_case import CANNOT_CREATE, DONE, MISSING_INPUT, PROGRAM, SMALL_SCENE, USAGE, InFreshFolder, main


class EmptyNames(InFreshFolder):
    def test_every_verb_and_option_refuses_them_and_writes_nothing(self):
        self.write("# my comments\n" + SMALL_SCENE)
        shutil.copytree(self.make_run(), self.folder / "other")
        before = self.snapshot(self.folder)
        for arguments in (
            ["run", "scene.toml", "-o", ""], ["run", "", "-o", "new"], ["run", "scene.toml", "--output="],
            ["run", "scene.toml", "-o", "new", "--set", ""], ["validate", ""], ["info", ""], ["verify", ""],
            ["resume", ""], ["analyze", ""], ["analyze", "run", "-o", ""], ["analyze", "run", "--output="],
            ["field", "run", "-o", ""], ["field", "", "-o", "flow.vti"], ["field", "run", "-o", "flow.vti", "--plot", ""],
            ["field", "run", "-o", "flow.vti", "--plot=", "run"], ["plot", ""], ["plot", "run", "-o", ""],
            ["plot", "--output=", "run"], ["phases", "-o", ""], ["phases", "--output="],
            ["sweep", "scene.toml", "-o", ""], ["sweep", "", "-o", "new"], ["sweep", "scene.toml", "--output=", "new"],
            ["reproduce", "lagrone2019", "-o", ""], ["reproduce", "lagrone2019", "--output=", "other"],
        ):
            with self.subTest(arguments=arguments):
                result = self.expect(USAGE, *arguments)
                self.assertEqual(result.stdout, "")
                self.assertIn("--help", result.stderr + "--help" * ("=" in result.stderr))
                self.assertEqual(self.snapshot(self.folder), before)


class Inputs(InFreshFolder):
    def test_no_field_replaces_a_part_of_the_run(self):
        run = self.make_run()
        (self.folder / "link").symlink_to(run)
        (self.folder / "index.vti").symlink_to(run / "trajectory.h5")
        before = self.snapshot(self.folder)
        for output in ("run/trajectory.h5", "link/trajectory.h5", "./run/../run/scene.toml", "run/segments/000000.h5",
                       "run/segments/flow.vti", "run/lock", "run/STOP", "index.vti", run / "run.log"):
            for options in (["-o", output], ["-o", "flow.vti", "--plot", output]):
                with self.subTest(options=options):
                    result = self.expect(CANNOT_CREATE, "field", "run", "--points", "5", *options)
                    self.assertIn(str(output), result.stderr)
                    self.assertEqual(self.snapshot(self.folder), before)
        self.expect(USAGE, "field", "run", "--points", "5", "-o", "x.png", "--plot", "./x.png")
        self.assertEqual(self.snapshot(self.folder), before)
        self.write("0.0 0.0 0.1\n", "points.csv")
        self.expect(CANNOT_CREATE, "field", "run", "--at", "points.csv", "-o", "./points.csv")
        self.assertEqual((self.folder / "points.csv").read_text(), "0.0 0.0 0.1\n")
        self.expect(DONE, "field", "run", "--points", "5", "-o", "run/flow.vti")

    def test_no_table_or_picture_goes_among_the_run_s_files(self):
        self.make_run()
        before = self.snapshot(self.folder)
        for verb in ("analyze", "plot"):
            for output in ("run/segments", "run/checkpoints/", "run/scene.toml"):
                with self.subTest(verb=verb, output=output):
                    self.expect(CANNOT_CREATE, verb, "run", "-o", output)
                    self.assertEqual(self.snapshot(self.folder), before)

    def test_the_scene_of_a_run_is_not_removed_by_running_it(self):
        run = self.make_run()
        (self.folder / "mine.toml").symlink_to(run / "scene.toml")
        before = self.snapshot(self.folder)
        for scene in ("run/scene.toml", "mine.toml"):
            result = self.expect(CANNOT_CREATE, "run", scene, "-o", "run", "--overwrite", "-q")
            self.assertIn(scene, result.stderr)
            self.assertEqual(self.snapshot(self.folder), before)
        self.expect(DONE, "run", "run/scene.toml", "-o", "again", "-q")
        self.expect(DONE, "run", "small.toml", "-o", "run", "-q", "--overwrite")


class Overwriting(InFreshFolder):
    def test_tables_and_pictures_of_the_earlier_run_go(self):
        run = self.make_run()
        self.expect(DONE, "plot", "run")
        self.assertEqual({path.name for path in run.iterdir()} & {"analysis", "plots"}, {"analysis", "plots"})
        (run / "plots/mine.txt").write_text("mine")
        self.expect(DONE, "run", "small.toml", "-o", "run", "-q", "--overwrite", "--set", "time.end=0.1")
        self.assertFalse((run / "analysis").exists())
        self.assertEqual([path.name for path in (run / "plots").iterdir()], ["mine.txt"])


class PlantedLinks(InFreshFolder):
    """A folder that others can write to: what they leave in it leads to a precious file, or waits for ever."""

    NAMES = ("lock", "run.log", "events.jsonl", "trajectory.h5.partial", "trajectory.xdmf.partial",
             "segments/000000.h5.partial", "checkpoints/000001.checkpoint.partial")

    def test_links_are_not_followed_and_pipes_are_not_waited_for(self):
        self.write(SMALL_SCENE, "small.toml")
        self.expect(75, "run", "small.toml", "-o", "stopped", "-q", "--max-walltime", "0.001")
        precious = self.write("precious", "precious")
        for name in self.NAMES:
            for plant in (lambda path: path.symlink_to(precious), lambda path: path.symlink_to(self.folder / "nowhere"),
                          os.mkfifo):
                with self.subTest(name=name):
                    run = self.folder / "run"
                    shutil.rmtree(run, ignore_errors=True)
                    shutil.copytree(self.folder / "stopped", run)
                    (run / name).unlink(missing_ok=True)
                    plant(run / name)
                    code = DONE if name.endswith(".partial") else CANNOT_CREATE
                    result = self.expect(code, "resume", "run", "-q")
                    if code == CANNOT_CREATE:
                        self.assertIn(name, result.stderr)
                        (run / name).unlink()
                        self.expect(DONE, "resume", "run", "-q")
                    self.assertEqual(precious.read_text(), "precious")
                    self.assertFalse((self.folder / "nowhere").exists())
                    self.expect(DONE, "verify", "run")


class RunsToReadOnly(InFreshFolder):
    def test_pictures_elsewhere_leave_the_run_alone(self):
        run = self.make_run()
        before = self.snapshot(run)
        result = self.expect(DONE, "plot", "run", "-o", "pictures")
        self.assertNotIn("not analyzed", result.stderr)
        self.assertNotIn("is not drawn", result.stderr)
        self.assertEqual(self.snapshot(run), before)
        self.assertEqual({path.name for path in (self.folder / "pictures/analysis").iterdir()},
                         {"diagnostics.csv", "diagnostics.h5"})

    def test_as_a_user_who_may_not_write(self):
        if os.geteuid() != 0:
            self.skipTest("needs root, to be another user")
        run = self.make_run()
        self.folder.chmod(0o755)
        mine = self.folder / "mine"
        mine.mkdir(mode=0o777)
        mine.chmod(0o777)
        try:
            subprocess.run([PROGRAM, "--version"], user=65534, capture_output=True, check=True)
        except (OSError, subprocess.CalledProcessError):
            self.skipTest("another user cannot start the program here")
        environment = {"HOME": "/nonexistent"}
        self.expect(DONE, "analyze", run, "-o", mine / "tables", user=65534, environment=environment)
        result = self.expect(DONE, "plot", run, "-o", mine / "pictures", user=65534, environment=environment)
        self.assertNotIn("not drawn", result.stderr)
        result = self.expect(CANNOT_CREATE, "plot", run, user=65534, environment=environment)
        self.assertIn("plots", result.stderr)


class Nothing(InFreshFolder):
    def test_a_folder_that_is_no_run_is_said_to_be_none(self):
        (self.folder / "empty").mkdir()
        for verb in (["analyze", "empty"], ["plot", "empty"], ["plot", "empty", "-o", "x"], ["field", "empty", "-o", "x.vti"]):
            self.expect(MISSING_INPUT, *verb)
        self.assertEqual([path.name for path in self.folder.iterdir()], ["empty"])


if __name__ == "__main__":
    main()
