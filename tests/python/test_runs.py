"""Runs from Python against those of the program: test_runs.py PROGRAM SOURCES."""

import contextlib
import gc
import json
import os
import signal
import threading
import time
import tomllib

import h5py
import numpy as np

from python_case import DONE, SMALL_SCENE, InFreshFolder, main, skein


def arrays_of(folder):
    """Every array of numbers in a run's index."""
    found = {}
    with h5py.File(folder / "trajectory.h5") as file:
        file.visititems(lambda name, item: found.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None)
    return found


class Runs(InFreshFolder):
    def expect_same_arrays(self, one, other):
        these, those = arrays_of(one), arrays_of(other)
        self.assertEqual(these.keys(), those.keys())
        for name, values in these.items():
            if not name.startswith("parameters/segments"):  # how the run was cut into files
                np.testing.assert_array_equal(values, those[name], name)

    def run_both(self, on_frame=None):
        file = self.write(SMALL_SCENE, "small.toml")
        self.expect(DONE, "run", "small.toml", "-o", "program", "-q")
        return skein.run(str(file), self.folder / "script", on_frame)

    def test_arrays_are_those_of_the_program(self):
        frames = []
        run = self.run_both(frames.append)
        self.expect_same_arrays(self.folder / "program", self.folder / "script")
        self.assertEqual((self.folder / "program/scene.toml").read_text(), run.scene_text)
        self.assertEqual((run.status, len(run), run.n_fibers), ("done", 4, 1))
        for live, saved in zip(frames, run, strict=True):
            self.assertEqual((live.step, live.time), (saved.step, saved.time))
            for one, other in zip(live[2:], saved[2:]):
                np.testing.assert_array_equal(one, other)
        self.assertEqual(run[-1].time, 0.3)
        self.assertRaises(IndexError, lambda: run[4])

    def test_arrays_have_the_shapes_that_are_told(self):
        run = skein.Run(self.make_run())
        self.assertEqual(run.positions.shape, (4, 60, 3))
        self.assertEqual(run.centrelines.shape, (4, 10, 3))
        self.assertEqual((run.fiber_nodes(0), run.fiber_sections(0)), (slice(0, 60), slice(0, 10)))
        self.assertEqual(run.series["energy"].shape, (run.n_steps, 1))
        self.assertEqual((run.series.unit("energy"), run.series.unit("error")), ("force*length", ""))
        np.testing.assert_array_equal(run.series["time"], run.step_times)
        self.assertIn("velocity_error", list(run.series))
        self.assertEqual(len(run.series), len(set(run.series)))
        self.assertEqual(run.scene["fiber"]["sections"], 10)
        self.assertEqual(float(run.parameter("viscosity")), run.scene["fluid"]["viscosity"])

    def test_a_dictionary_is_the_scene_that_a_file_is(self):
        file = self.write(SMALL_SCENE)
        of_file = skein.Scene(file, {"fiber.roll": np.float64(30.0), "title": 'of "two"'})
        tables = tomllib.loads(SMALL_SCENE)
        tables["title"] = 'of "two"'
        tables["fiber"].update(roll=30, direction=np.array([1.0, 0.5, 0.0]))
        self.assertEqual(skein.Scene(tables).text, of_file.text)
        several = skein.Scene({"fiber": [{"center": (0.0, 0.05 * i, 0.0), "sections": 8} for i in range(3)]})
        self.assertEqual(len(tomllib.loads(several.text)["fiber"]), 3)

    def test_a_run_without_a_folder_goes_with_its_last_user(self):
        run = skein.run(skein.Scene(self.write(SMALL_SCENE)))
        folder = run.folder
        self.assertEqual(len(run), 4)
        self.assertTrue(os.path.isdir(folder))
        del run
        gc.collect()
        self.assertFalse(os.path.exists(folder))

    def test_an_interrupt_leaves_a_run_that_goes_on_to_the_same_end(self):
        def interrupt(frame):
            if frame.time > 0.05:
                os.kill(os.getpid(), signal.SIGINT)
                time.sleep(0.2)  # until a thread has taken it

        with self.assertRaises(KeyboardInterrupt):
            self.run_both(interrupt)
        stopped = skein.Run(self.folder / "script")
        self.assertEqual(stopped.status, "stopped")
        self.assertLess(stopped.frame_times[-1], 0.3)
        self.assertEqual(skein.resume(stopped).status, "done")
        self.expect_same_arrays(self.folder / "program", self.folder / "script")
        self.assertEqual(skein.resume(stopped).status, "done")  # nothing is left to do
        self.expect(DONE, "verify", "script")

    def test_on_frame_stops_a_run_and_says_why(self):
        scene = skein.Scene(self.write(SMALL_SCENE))
        run = skein.run(scene, self.folder / "asked", lambda frame: frame.time < 0.15)
        self.assertEqual((run.status, run.frame_times[-1]), ("stopped", 0.2))
        self.assertIn("on_frame returned False", (self.folder / "asked/run.log").read_text())

        def fail(frame):
            raise LookupError(f"at {frame.time:g}")

        with self.assertRaisesRegex(LookupError, "at 0"):
            skein.run(scene, self.folder / "failed", fail)
        self.assertEqual(skein.Run(self.folder / "failed").status, "stopped")

    def test_walltime_stops_a_run(self):
        long = skein.Scene(self.write(SMALL_SCENE), {"time.end": 1e4, "output.frame_interval": 1e3})
        self.assertEqual(skein.run(long, self.folder / "run", max_walltime=1.5).status, "stopped")

    def test_a_run_is_read_while_it_goes_on(self):
        seen, statuses, folder = [], [], self.folder / "run"

        def look(frame):
            (folder / "OUTPUT_NOW").touch()
            if not seen:
                with contextlib.suppress(skein.MissingInput):  # no frame is on disk yet
                    seen.append(skein.Run(folder))
                    statuses.append(seen[0].status)
            return len(seen) < 2 or len(seen[0]) < 3

        def refresh():
            while not done.is_set():
                if seen and seen[0].refresh():
                    seen.append(len(seen[0]))

        done = threading.Event()
        reader = threading.Thread(target=refresh)
        reader.start()
        scene = skein.Scene(self.write(SMALL_SCENE), {"time.end": 400.0, "output.frame_interval": 0.5})
        try:
            run = skein.run(scene, folder, look, max_walltime=120.0)
        finally:
            done.set()
            reader.join()
        self.assertEqual((statuses, run.status), (["running"], "stopped"))
        self.assertGreater(len(seen), 1)

    def test_other_threads_go_on_while_it_runs(self):
        counts, done = [0], threading.Event()

        def count():
            while not done.is_set():
                counts[0] += 1

        # Only what is counted between two calls tells: while a call lasts, Python's own threads take turns.
        between, last = [0], [None]

        def look(frame):
            if last[0] is not None:
                between[0] += counts[0] - last[0]
            last[0] = counts[0]
            return between[0] <= 1000

        thread = threading.Thread(target=count)
        scene = skein.Scene(self.write(SMALL_SCENE), {"time.end": 400.0, "output.frame_interval": 0.3})
        thread.start()
        try:
            run = skein.run(scene, self.folder / "run", look, max_walltime=120.0)
        finally:
            done.set()
            thread.join()
        self.assertGreater(between[0], 1000)
        self.assertEqual(run.status, "stopped")

    def test_a_run_that_begins_with_another_ones_state(self):
        parent = skein.Run(self.make_run("parent"))
        scene = skein.Scene.going_on_from(parent, changes={"time.end": 0.5})
        child = skein.run(scene, self.folder / "child")
        self.assertEqual((child.frame_times[0], child.frame_times[-1]), (0.3, 0.5))
        np.testing.assert_array_equal(child.positions[0], parent.positions[-1])
        self.expect(DONE, "run", "--from", "parent", "-o", "program", "-q", "--set", "time.end=0.5")
        self.expect_same_arrays(self.folder / "program", self.folder / "child")

    def test_what_analyze_measures_is_read(self):
        run = skein.Run(self.make_run())
        summary = skein.analyze(run)
        self.assertEqual(len(run.diagnostics["fiber_0/angle"]), 4)
        self.assertIn("fiber_0/regime", run.diagnostics)
        self.assertEqual(summary, json.loads(self.expect(DONE, "analyze", "run", "--json").stdout))


if __name__ == "__main__":
    main()
