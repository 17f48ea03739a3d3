"""What tests of the command line have in common: the program, its exit codes, and a fresh folder for each test."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

DONE, USAGE, DAMAGED, MISSING_INPUT, NO_RESOURCES, CANNOT_CREATE, IO_ERROR, STOPPED, SCENE_ERROR = (
    0, 64, 65, 66, 71, 73, 74, 75, 78)
PROGRAM, SOURCES = (sys.argv[1], pathlib.Path(sys.argv[2])) if len(sys.argv) > 2 else (None, None)

# A run of some tenths of a second.
SMALL_SCENE = """title = "small"
[fiber]
sections = 10
nodes_per_section = 6
blob = 0.0045
direction = [1.0, 0.5, 0.0]
[time]
end = 0.3
[output]
frame_interval = 0.1
"""


def skein(*arguments, before=(), cwd=None, environment=None, timeout=60, **options):
    """Runs the program, behind the words of `before`, and returns how it ended; `environment` adds to this process's, and
    None takes away."""
    variables = {**os.environ, "OMP_NUM_THREADS": "1", **(environment or {})}
    return subprocess.run(
        [*map(str, before), PROGRAM, *map(str, arguments)],
        cwd=cwd,
        env={name: value for name, value in variables.items() if value is not None},
        **{"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True,
           "errors": "replace", "timeout": timeout, **options},
    )


class InFreshFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, content, name="scene.toml"):
        path = self.folder / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    def skein(self, *arguments, **options):
        return skein(*arguments, cwd=self.folder, **options)

    def expect(self, code, *arguments, **options):
        """Runs in the folder and checks the exit code. @returns how it ended"""
        result = self.skein(*arguments, **options)
        self.assertEqual(result.returncode, code, f"{arguments}: {result.stdout}{result.stderr}")
        return result

    def validate_content(self, content, *arguments):
        self.write(content)
        return self.skein("validate", "scene.toml", *arguments)

    def make_run(self, name="run"):
        self.write(SMALL_SCENE, "small.toml")
        self.expect(DONE, "run", "small.toml", "-o", name, "-q")
        return self.folder / name

    def snapshot(self, folder):
        """Every file below a folder, with its content and time."""
        return {path: (path.stat().st_mtime_ns, path.read_bytes() if path.is_file() else None)
                for path in sorted(folder.rglob("*"))}


def main():
    unittest.main(argv=sys.argv[:1])
