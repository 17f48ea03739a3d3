"""The program under test, and the small scenes that it is given: a run takes a seventh of a second of a processor, and as
much again or more for fsync where the run folders are on a disk."""

import os
import pathlib
import shutil
import subprocess

DONE, DAMAGED, MISSING, CANNOT_CREATE, IO_ERROR, STOPPED, NUMERICAL, SCENE_ERROR = 0, 65, 66, 73, 74, 75, 76, 78

SCENE = """title = "torture"
seed = 7
[flow]
rate = 2.5
[fiber]
sections = 12
nodes_per_section = 6
radius = 0.005
spring_stiffness = 0.0112
blob = 0.004
direction = [1.0, 0.3, 0.1]
[time]
end = 1.0
max_step = 0.02
[output]
frame_interval = 0.05
[checkpoint]
simulated_interval = 0.2
"""

INTEGRATORS = {
    "rkc2": [],
    "rkc2, fixed step": ["time.step=0.013"],
    "trbdf2": ["time.method=trbdf2"],
    "bs3": ["time.method=bs3", "time.max_step=4e-4", "time.end=0.05", "output.frame_interval=0.004"],
    "euler": ["time.method=euler", "time.step=2e-4", "time.max_step=1e-3", "time.end=0.05",
              "output.frame_interval=0.004"],
    # Leaves so small that these few nodes have a far field.
    "rkc2, fmm": ["hydrodynamics.method=fmm", "hydrodynamics.tolerance=0.01", "hydrodynamics.leaf_size=3",
                  "hydrodynamics.check_every=7"],
}

# Apart from each other in space, and each of another size.
THREE_FIBERS = SCENE.replace("[fiber]", "[[fiber]]").replace("[time]", """
[[fiber]]
sections = 9
nodes_per_section = 6
blob = 0.004
center = [0.01, 0.03, 0.004]
direction = [1.0, -0.2, 0.1]
[[fiber]]
sections = 14
nodes_per_section = 5
blob = 0.003
center = [-0.01, -0.025, 0.01]
direction = [1.0, 0.1, 0.4]
[time]""")


class Failed(Exception):
    """A promise that was not kept."""


def require(condition, message):
    if not condition:
        raise Failed(message)


class Program:
    def __init__(self, path, folder):
        self.path = str(path)
        self.folder = pathlib.Path(folder)
        self.scene = self.folder / "scene.toml"
        self.scene.write_text(SCENE)
        self.three_fibers = self.folder / "three_fibers.toml"
        self.three_fibers.write_text(THREE_FIBERS)

    def fresh(self, name):
        """A path without anything there."""
        path = self.folder / name
        if path.is_dir() and not path.is_symlink():
            shutil.rmtree(path, ignore_errors=True)
        else:
            path.unlink(missing_ok=True)
        return path

    def environment(self, threads=1, **variables):
        """With the policy that the program would start itself anew for (cli/thread_waiting): a third of a short verb's time."""
        return {**os.environ, "OMP_NUM_THREADS": str(threads), "OMP_WAIT_POLICY": "passive", **variables}

    def run_command(self, folder, overrides=(), *options, scene=None):
        command = [self.path, "run", str(scene or self.scene), "-o", str(folder), "-q", *options]
        for override in overrides:
            command += ["--set", override]
        return command

    def call(self, command, timeout=120, threads=1, preexec_fn=None, **variables):
        return subprocess.run(
            [str(word) for word in command],
            env=self.environment(threads, **variables),
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            errors="replace",
            timeout=timeout,
            preexec_fn=preexec_fn,
        )

    def start(self, command, threads=1, **variables):
        return subprocess.Popen(
            [str(word) for word in command],
            env=self.environment(threads, **variables),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )

    def run(self, folder, overrides=(), *options, scene=None, **keywords):
        return self.call(self.run_command(folder, overrides, *options, scene=scene), **keywords)

    def resume(self, folder, *options, **keywords):
        return self.call([self.path, "resume", folder, "-q", *options], **keywords)

    def verify(self, folder):
        return self.call([self.path, "verify", folder])

    def finish(self, folder):
        """Resumes to the end and checks that all is whole."""
        result = self.resume(folder)
        require(result.returncode == DONE, f"resume of {folder} ended with {result.returncode}: {result.stderr}")
        result = self.verify(folder)
        require(result.returncode == DONE, f"verify after resume of {folder}: {result.stderr}")
