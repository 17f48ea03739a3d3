"""What the scripts check_*.py have in common: a check that fails ends the script with its message, and runs of the program
end as they are expected to."""

import os
import pathlib
import shutil
import signal
import subprocess
import sys

DONE = 0


def check(condition, message):
    if not condition:
        sys.exit(f"{pathlib.Path(sys.argv[0]).stem}: {message}")


def skein(*arguments, codes=(DONE,), **variables):
    """Runs a program, whose path comes first, with additional variables of the environment. @returns how it ended"""
    result = subprocess.run([*map(str, arguments)], capture_output=True, text=True, env={**os.environ, **variables})
    check(result.returncode in codes, f"{arguments}: exit code {result.returncode}: {result.stdout}{result.stderr}")
    return result


def run_command(program, scene, folder, overrides, threads=1):
    """The words of a new run in a folder in which nothing is left."""
    shutil.rmtree(folder, ignore_errors=True)
    sets = [word for override in overrides for word in ("--set", override)]
    return [str(word) for word in (program, "run", scene, "-o", folder, "--threads", threads, *sets)]


def certificate(program, folder):
    """A hash of all that a run has computed."""
    said = skein(program, "verify", folder).stdout
    return next(line for line in said.splitlines() if line.startswith("certificate")).split()[-1]


def kill_and_resume(command, folder):
    """A run that is killed when it has made two checkpoints, and resumed with another number of threads."""
    skein(*command, "-q", codes=(-signal.SIGKILL,), SKEIN_TEST_KILL="checkpoint.after_rename:2")
    skein(command[0], "resume", folder, "-q", "--threads", 2)
