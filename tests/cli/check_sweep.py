"""Sweeps: killed at any time they end with the same tables; shards are parts of the whole; failures are kept apart.

Called as check_sweep.py PROGRAM SOURCES.
"""

import csv
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import time

from cli_case import (CANNOT_CREATE, DONE, MISSING_INPUT, PROGRAM, SCENE_ERROR, SMALL_SCENE, SOURCES, STOPPED, USAGE,
                      InFreshFolder, main)

NUMERICAL = 76
SWEEP = """scene = "base.toml"
changes = ["fiber.nodes_per_section=4", "fiber.blob=0.006", "time.end=0.6"]
[[parameter]]
key = "fiber.sections"
values = [8, 10, 12]
[[parameter]]
key = "flow.rate"
from = 1.0
to = 4.0
count = 3
spacing = "logarithmic"
"""


def read_rows(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def find_children(process):
    return [int(child) for child in pathlib.Path(f"/proc/{process}/task/{process}/children").read_text().split()]


class Sweep(InFreshFolder):
    def setUp(self):
        super().setUp()
        self.write(SMALL_SCENE, "base.toml")
        self.write(SWEEP, "sweep.toml")

    def skein(self, *arguments, **options):
        return super().skein(*arguments, **{"timeout": 300, **options})

    def tables(self, name):
        return {table: (self.folder / name / table).read_bytes() for table in ("table.csv", "table.h5", "failures.csv")}

    def list_runs(self, content, *options):
        """What --dry-run prints of a sweep, without the runs' names."""
        self.write(content, "listed.toml")
        lines = self.expect(DONE, "sweep", "listed.toml", "-o", "never", "--dry-run", *options).stdout.splitlines()
        self.assertEqual([line.split("  ")[0] for line in lines], [f"{i:05}" for i in range(len(lines))])
        return [line.split("  ", 1)[1] for line in lines]


class Whole(Sweep):
    def test_the_table_has_scene_values_and_what_was_measured(self):
        result = self.expect(DONE, "sweep", "sweep.toml", "-o", "swept", environment={"OMP_NUM_THREADS": "2"})
        self.assertIn("9 runs: 9 done", result.stdout)
        rows = read_rows(self.folder / "swept/table.csv")
        self.assertEqual([row["fiber.sections"] for row in rows], [n for n in ("8", "10", "12") for _ in range(3)])
        self.assertEqual([float(row["flow.rate"]) for row in rows], [1.0, 2.0, 4.0] * 3)
        for row in rows:
            self.assertEqual(row["state"], "done")
            length = float(row["fiber.sections"]) * 2 * 0.005 * 2 ** -0.5
            self.assertAlmostEqual(float(row["length [length]"]), length, places=12)
            self.assertEqual(float(row["last_time [time]"]), 0.6)
            self.expect(DONE, "verify", f"swept/runs/{row['run']}")
        # Its own number is measured: it grows with the rate.
        numbers = [float(row["elasto_viscous_number"]) for row in rows]
        self.assertAlmostEqual(numbers[2] / numbers[0], 4.0, places=9)
        pictures = sorted(path.name for path in (self.folder / "swept/pictures").iterdir())
        self.assertEqual(pictures, ["curvature_max_over_fiber_sections_and_flow_rate.png",
                                    "regime_over_fiber_sections_and_flow_rate.png"])
        # What is done is not touched again, and each run is what the scene by itself gives.
        before = self.snapshot(self.folder / "swept/runs")
        self.expect(DONE, "sweep", "-o", "swept", "--no-plots")
        self.assertEqual(self.snapshot(self.folder / "swept/runs"), before)
        self.expect(DONE, "run", "base.toml", "-o", "alone", "-q", "--set", "fiber.nodes_per_section=4", "--set",
                    "fiber.blob=0.006", "--set", "time.end=0.6", "--set", "fiber.sections=10", "--set", "flow.rate=4.0")
        swept = self.expect(DONE, "verify", "swept/runs/00005").stdout
        certificate = re.search("[0-9a-f]{16}", swept).group()
        self.assertIn(certificate, self.expect(DONE, "verify", "alone").stdout)

    def test_killed_at_any_time_it_ends_with_the_same_tables(self):
        start = time.monotonic()
        self.expect(DONE, "sweep", "sweep.toml", "-o", "whole", "--no-plots")
        duration = time.monotonic() - start
        chance = random.Random(18)
        # A sweep that ends before its kill starts anew, so that kills land however fast the machine is.
        n_landed = {"sweep": 0, "run": 0, "both": 0}
        for _ in range(60):
            target = min(n_landed, key=n_landed.get)
            if n_landed[target] == 3:
                break
            landed, code = self.kill_a_sweep(target, chance.uniform(0, 0.7 * duration), chance)
            n_landed[target] += landed
            if code == DONE:
                self.assertEqual(self.tables("killed"), self.tables("whole"))
                shutil.rmtree(self.folder / "killed")
        self.assertEqual(set(n_landed.values()), {3})
        self.expect(DONE, "sweep", "sweep.toml", "-o", "killed", "--no-plots")
        self.assertEqual(self.tables("killed"), self.tables("whole"))
        self.assertEqual([path for path in (self.folder / "killed").rglob("*.partial")], [])

    def kill_a_sweep(self, target, delay, chance):
        """Whether a process of a sweep was killed that was at work, and what the sweep ended with."""
        words = [PROGRAM, "sweep", "sweep.toml", "-o", "killed", "--no-plots", "--jobs", "2", "-q"]
        process = subprocess.Popen(words, cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                                   env={**os.environ, "OMP_NUM_THREADS": "1"})
        time.sleep(delay)
        landed = False
        if process.poll() is None:
            children = find_children(process.pid)
            if target != "run":
                process.kill()
                landed = True
            if target != "sweep" and children:
                os.kill(chance.choice(children), signal.SIGKILL)
                landed = True
        if target == "run":
            process.send_signal(signal.SIGTERM)
        _, messages = process.communicate(timeout=60)
        self.assertIn(process.returncode, (DONE, STOPPED, -signal.SIGKILL, -signal.SIGTERM), messages)
        return landed, process.returncode

    def test_a_run_whose_process_is_killed_is_tried_again(self):
        self.expect(DONE, "sweep", "sweep.toml", "-o", "whole", "--no-plots")
        killed = self.skein("sweep", "sweep.toml", "-o", "killed", "--no-plots", environment={"SKEIN_TEST_KILL": "step:5"})
        self.assertEqual(killed.returncode, 70, killed.stderr)
        self.assertIn("SIGKILL", killed.stderr)
        self.assertEqual({row["exit_code"] for row in read_rows(self.folder / "killed/failures.csv")}, {"70"})
        self.expect(DONE, "sweep", "-o", "killed", "--no-plots")
        self.assertEqual(self.tables("killed"), self.tables("whole"))

    def test_a_request_to_stop_leaves_the_rest_open(self):
        for stop in (["--max-walltime", "0.3"], []):
            with self.subTest(stop=stop):
                if not stop:
                    self.write("", "stopped/STOP")  # one of an earlier time counts for nothing
                    self.expect(DONE, "sweep", "-o", "stopped", "--no-plots", *stop)
                    continue
                result = self.expect(STOPPED, "sweep", "sweep.toml", "-o", "stopped", "--jobs", "1", *stop)
                self.assertIn(" open", result.stdout)
                self.assertIn("open", {row["state"] for row in read_rows(self.folder / "stopped/table.csv")})


    def test_a_base_scene_that_goes_on_from_another_run(self):
        """The state lies in the sweep's folder, which needs neither the run nor the scene's folder any more."""
        self.expect(DONE, "run", "base.toml", "-o", "parent", "-q")
        self.expect(DONE, "run", "--from", "parent", "-o", "child", "-q", "--set", "time.end=0.5")
        self.write('scene = "child/scene.toml"\n[[parameter]]\nkey = "flow.rate"\nvalues = [1.0, 2.0]\n', "on.toml")
        for moment in ("start.half", "start.after_rename", "base.toml.half", "sweep.toml.half"):
            killed = self.skein("sweep", "on.toml", "-o", "swept", environment={"SKEIN_TEST_KILL": f"{moment}:1"})
            self.assertEqual(killed.returncode, -signal.SIGKILL, killed.stderr)
        self.expect(DONE, "sweep", "on.toml", "-o", "swept", "--no-plots")
        self.expect(DONE, "run", "child/scene.toml", "-o", "alone", "-q", "--set", "flow.rate=2.0")
        for name in ("parent", "child"):
            shutil.rmtree(self.folder / name)
        self.expect(DONE, "sweep", "-o", "swept", "--no-plots")
        certificates = [re.search("[0-9a-f]{16}", self.expect(DONE, "verify", run).stdout).group()
                        for run in ("swept/runs/00001", "alone")]
        self.assertEqual(certificates[0], certificates[1])


class Failures(Sweep):
    def test_they_are_listed_with_message_and_code_and_kept_apart(self):
        self.write(SWEEP.split("[[parameter]]")[0] + """
[[parameter]]
key = "time.step"
values = [1e-4, 0.1]
""", "steps.toml")
        text = (self.folder / "steps.toml").read_text().replace('"time.end=0.6"', '"time.end=0.3", "time.method=euler"')
        self.write(text, "steps.toml")
        result = self.expect(NUMERICAL, "sweep", "steps.toml", "-o", "swept")
        self.assertIn("1 done, 1 failed", result.stdout)
        good, bad = read_rows(self.folder / "swept/table.csv")
        self.assertEqual((good["state"], bad["state"]), ("done", "failed"))
        self.assertEqual(bad["curvature_max [1/length]"], "nan")
        failure, = read_rows(self.folder / "swept/failures.csv")
        self.assertEqual((failure["run"], failure["exit_code"], failure["time.step"]), ("00001", "76", "0.1"))
        self.assertIn("node", failure["message"])
        # It would fail again: it is only tried if that is asked for.
        log = self.folder / "swept/runs/00001/run.log"
        before = log.read_bytes()
        self.expect(NUMERICAL, "sweep", "-o", "swept", "--no-plots")
        self.assertEqual(log.read_bytes(), before)
        self.expect(NUMERICAL, "sweep", "-o", "swept", "--no-plots", "--retry")
        self.assertNotEqual(log.read_bytes(), before)


class Parts(Sweep):
    def test_shards_together_are_the_whole(self):
        self.expect(DONE, "sweep", "sweep.toml", "-o", "whole", "--no-plots")
        for number in (3, 1, 2):
            self.expect(DONE, "sweep", "sweep.toml", "-o", "parts", "--shard", f"{number}/3")
            self.assertFalse((self.folder / "parts/table.csv").exists())
        before = self.snapshot(self.folder / "parts/runs")
        self.expect(DONE, "sweep", "-o", "parts", "--gather", "--no-plots")
        self.assertEqual(self.snapshot(self.folder / "parts/runs"), before)
        self.assertEqual(self.tables("parts"), self.tables("whole"))

    def test_a_job_array_does_the_same(self):
        self.expect(DONE, "sweep", "sweep.toml", "-o", "whole", "--no-plots")
        script = self.expect(DONE, "sweep", "sweep.toml", "-o", "with 'quote", "--slurm", "--tasks", "4").stdout.strip()
        text = (self.folder / script).read_text()
        self.assertIn("#SBATCH --array=1-4\n", text)
        self.assertFalse((self.folder / "with 'quote/runs").exists())
        subprocess.run(["bash", "-n", script], cwd=self.folder, check=True, timeout=60)
        for task in range(1, 5):
            subprocess.run(["bash", self.folder / script], cwd="/", check=True, timeout=60, capture_output=True,
                           env={**os.environ, "SLURM_ARRAY_TASK_ID": str(task), "SLURM_CPUS_PER_TASK": "1"})
        self.expect(DONE, "sweep", "-o", "with 'quote", "--gather", "--no-plots")
        self.assertEqual(self.tables("with 'quote"), self.tables("whole"))

    def test_what_is_no_shard_is_refused(self):
        for shard in ("0/3", "4/3", "1", "a/b", "1/0", "-1/3", "1/3/5", "1.0/3"):
            self.expect(USAGE, "sweep", "sweep.toml", "-o", "never", "--shard", shard)
        self.assertFalse((self.folder / "never").exists())


class Combinations(Sweep):
    def test_zipped_keys_go_along_with_each_other_and_crossed_ones_do_not(self):
        two = """scene = "base.toml"
[[parameter]]
key = "fiber.sections"
values = [8, 10, 12]
[[parameter]]
key = "flow.rate"
values = [1.0, 2.0, 3.0]
"""
        crossed = self.list_runs(two)
        self.assertEqual(crossed, [f"fiber.sections={n}, flow.rate={r}" for n in (8, 10, 12) for r in ("1.0", "2.0", "3.0")])
        zipped = self.list_runs('combine = "zipped"\n' + two)
        self.assertEqual(zipped, ["fiber.sections=8, flow.rate=1.0", "fiber.sections=10, flow.rate=2.0",
                                  "fiber.sections=12, flow.rate=3.0"])
        third = '[[parameter]]\nkey = "fiber.roll"\nvalues = [0, 5]\n'
        self.assertEqual(len(self.list_runs(two + third)), 18)
        with_first = two + 'with = "fiber.sections"\n' + third
        self.assertEqual(self.list_runs(with_first)[:3], [f"{zipped[0]}, fiber.roll=0", f"{zipped[0]}, fiber.roll=5",
                                                          f"{zipped[1]}, fiber.roll=0"])

    def test_draws_depend_on_nothing_but_seed_key_and_number(self):
        def draws(count, seed, *keys):
            text = f'scene = "base.toml"\ncombine = "zipped"\nseed = {seed}\n'
            for key in keys:
                text += f'[[parameter]]\nkey = "{key}"\nfrom = 1.0\nto = 4.0\ncount = {count}\nspacing = "random"\n'
            return [dict(part.split("=") for part in line.split(", ")) for line in self.list_runs(text)]

        both = draws(20, 3, "flow.rate", "fiber.roll")
        self.assertEqual(both, draws(20, 3, "fiber.roll", "flow.rate"))
        self.assertEqual([run["flow.rate"] for run in both], [run["flow.rate"] for run in draws(20, 3, "flow.rate")])
        self.assertEqual(both[:5], draws(5, 3, "flow.rate", "fiber.roll"))
        self.assertNotEqual(both[:5], draws(5, 4, "flow.rate", "fiber.roll"))
        values = [float(run[key]) for run in both for key in run]
        self.assertEqual(len(set(values)), 40)
        self.assertTrue(all(1.0 <= value < 4.0 for value in values))

    def test_texts_lists_and_single_fibers_can_differ(self):
        runs = self.list_runs("""scene = "base.toml"
[[parameter]]
key = "hydrodynamics.precision"
values = ["double", "single"]
[[parameter]]
key = "fiber[0].direction"
values = [[1.0, 0.0, 0.0], [1, 0.5, 0]]
""")
        self.assertEqual(runs[1], 'hydrodynamics.precision="double", fiber[0].direction=[1, 0.5, 0]')


    def test_the_examples_are_sound(self):
        examples = sorted((SOURCES / "configs/sweeps").glob("*.toml"))
        self.assertGreater(len(examples), 1)
        for example in examples:
            with self.subTest(example=example.name):
                listed = self.expect(DONE, "sweep", example, "-o", "never", "--dry-run").stdout
                self.assertGreater(len(listed.splitlines()), 1)


class BadInput(Sweep):
    def refuse(self, content, *expected):
        self.write(content, "bad.toml")
        result = self.expect(SCENE_ERROR, "sweep", "bad.toml", "-o", "never")
        for text in expected:
            self.assertIn(text, result.stderr)
        self.assertFalse((self.folder / "never").exists())

    def test_everything_wrong_is_named_at_its_place(self):
        key = '[[parameter]]\nkey = "fiber.sections"\n'
        self.refuse("", "bad.toml:1:1", "empty")
        self.refuse("scene = 5\n" + key, "bad.toml:1:9: scene must be text", "bad.toml:2:1: a parameter needs values")
        self.refuse('scene = "base.toml"\n', "[[parameter]]")
        self.refuse('scene = "base.toml"\nsede = 3\n' + key + "values = [8]\n", "bad.toml:2:1: unknown key 'sede'",
                    "'seed'?")
        self.refuse(f'scene = "base.toml"\n{key}values = [8]\nvalue = 9\n', "bad.toml:5:1: unknown key 'value'", "'values'?")
        self.refuse('scene = "base.toml"\n[[parameter]]\nkey = "fiber.section"\nvalues = [8]\n',
                    "bad.toml:3:7: scenes have no key 'fiber.section'", "'fiber.sections'?")
        self.refuse(f'scene = "base.toml"\n{key}from = 1\nto = 3\n', "no count")
        self.refuse(f'scene = "base.toml"\n{key}from = 8\nto = 10\ncount = 4\n', "bad.toml:6:9", "not 4 different values")
        self.refuse(f'scene = "base.toml"\n{key}from = 0\nto = 10\ncount = 4\nspacing = "logarithmic"\n', "above 0")
        self.refuse(f'scene = "base.toml"\n{key}from = 8\nto = 10\ncount = 2\nspacing = "loggarithmic"\n', "'logarithmic'?")
        self.refuse(f'scene = "base.toml"\n{key}values = []\n', "bad.toml:4:10")
        self.refuse(f'scene = "base.toml"\n{key}values = [8]\nfrom = 2\n', "one of them")
        self.refuse(f'scene = "base.toml"\n{key}values = [8]\n{key}values = [9]\n', "two parameters fiber.sections")
        self.refuse('scene = "base.toml"\ncombine = "zipped"\n' + key + 'values = [8, 9]\n[[parameter]]\nkey = "seed"\n'
                    'values = [1, 2, 3]\n', "has 3 values")
        self.refuse(f'scene = "base.toml"\n{key}values = [8]\nwith = "seed"\n', "no parameter before it")
        self.refuse('scene = "base.toml"\npictures = ["regime of length"]\n' + key + "values = [8]\n", "bad.toml:2:13")
        self.refuse('scene = "base.toml"\npictures = ["regime over lenght"]\n' + key + "values = [8]\n", "bad.toml:2:13",
                    "'length'?")

    def test_a_value_that_no_scene_can_have_is_found_before_anything_is_written(self):
        key = '[[parameter]]\nkey = "fiber.sections"\n'
        self.refuse(f'scene = "base.toml"\n{key}values = [8, -3, 10]\n[[parameter]]\nkey = "flow.rate"\nvalues = [1, "x"]\n',
                    "2 problems", "bad.toml:4:14: fiber.sections must be", "bad.toml:7:14: flow.rate must be a number")
        self.refuse(f'scene = "base.toml"\nchanges = ["time.edn=3"]\n{key}values = [8, 9]\n', "1 problem",
                    "bad.toml:2:12: unknown key 'edn'", "'end'?")
        self.write(SMALL_SCENE + "speed = 3\n", "broken.toml")
        self.refuse(f'scene = "broken.toml"\n{key}values = [8, 9]\n', "1 problem", "broken.toml:11:1: unknown key 'speed'")

    def test_missing_files_have_a_code_of_their_own(self):
        self.expect(MISSING_INPUT, "sweep", "nothing.toml", "-o", "never")
        self.expect(MISSING_INPUT, "sweep", "-o", "never")
        self.write(SWEEP.replace("base.toml", "nothing.toml"), "bad.toml")
        self.assertIn("nothing.toml", self.expect(MISSING_INPUT, "sweep", "bad.toml", "-o", "never").stderr)
        self.assertFalse((self.folder / "never").exists())


class Outputs(Sweep):
    def test_nothing_of_others_is_touched(self):
        self.make_run()
        (self.folder / "notes").mkdir()
        self.write("mine", "notes/mine.txt")
        self.write("mine", "file")
        (self.folder / "linked").symlink_to(self.folder / "notes")
        before = self.snapshot(self.folder)
        for output in ("notes", "file", "run", "linked", "."):
            with self.subTest(output=output):
                result = self.expect(CANNOT_CREATE, "sweep", "sweep.toml", "-o", output)
                self.assertIn(output, result.stderr)
                self.assertEqual(self.snapshot(self.folder), before)
        for words in (["-o", ""], ["--output="], ["-o", "never", "--picture", "regime"]):
            self.expect(USAGE, "sweep", "sweep.toml", *words)
        self.assertEqual(self.snapshot(self.folder), before)

    def test_another_sweep_in_the_same_folder_is_refused(self):
        self.expect(DONE, "sweep", "sweep.toml", "-o", "swept", "--no-plots", "--shard", "1/9")
        self.write(SWEEP.replace("0.6", "0.5"), "sweep.toml")
        result = self.expect(CANNOT_CREATE, "sweep", "sweep.toml", "-o", "swept")
        self.assertIn("another file", result.stderr)
        self.write(SWEEP, "sweep.toml")
        self.write(SMALL_SCENE.replace("small", "smaller"), "base.toml")
        self.assertIn("another scene", self.expect(CANNOT_CREATE, "sweep", "sweep.toml", "-o", "swept").stderr)
        # It needs neither file to go on.
        self.expect(DONE, "sweep", "-o", "swept", "--shard", "2/9")


if __name__ == "__main__":
    main()
