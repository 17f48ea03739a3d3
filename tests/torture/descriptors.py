"""Started with some of the descriptors 0 to 2 closed: no message lands in a file of the run."""

import itertools
import os
import subprocess

from program import DONE, STOPPED, require
from run_files import differences, run_unbroken


def call(program, command, closed):
    environment = program.environment()
    del environment["OMP_WAIT_POLICY"]  # so that the program starts itself anew, with what is closed
    result = subprocess.run([str(word) for word in command], env=environment, timeout=120,
                            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                            preexec_fn=lambda: [os.close(number) for number in closed])
    return result.returncode


def check_files(folder, what):
    for line in (folder / "events.jsonl").read_text().splitlines():
        require(line.startswith('{"event": '), f"{what}: in events.jsonl stands {line}")
    for line in (folder / "run.log").read_text().splitlines():
        require(line[:10].strip().replace(".", "").isdigit(), f"{what}: in run.log stands {line}")
    require(not (folder / "lock").exists(), f"{what}: the lock is left")


def torture(program, counts):
    reference = run_unbroken(program)
    choices = [closed for n in (1, 2, 3) for closed in itertools.combinations((0, 1, 2), n)]
    for _, closed in zip(range(counts["descriptors"]), itertools.cycle(choices)):
        what = f"{closed} closed"
        folder = program.fresh("descriptors")
        # Loud: all that is said has to go somewhere.
        command = [word for word in program.run_command(folder, [], "--max-walltime", "0.3") if word != "-q"]
        code = call(program, command, closed)
        require(code in (DONE, STOPPED), f"{what}: run ended with {code}")
        check_files(folder, what)
        code = call(program, [program.path, "resume", folder], closed)
        require(code == DONE, f"{what}: resume ended with {code}")
        check_files(folder, what)
        require(program.verify(folder).returncode == DONE, f"{what}: verify: {program.verify(folder).stderr}")
        require(not differences(folder, reference), f"{what}: the end differs: {differences(folder, reference)}")
    return counts["descriptors"], "each choice of 0, 1 and 2; run and resume"
