"""Asked to stop, by signals, a file or the wall time: exit code 75, soon, and the run can go on to the same end."""

import random
import signal
import subprocess
import time

from program import CANNOT_CREATE, DONE, STOPPED, require
from run_files import checkpoints, differences, final_state

# A longer run whose steps are cheap: there is time to stop it.
OVERRIDES = ["time.end=20.0", "time.max_step=0.002", "checkpoint.simulated_interval=5.0", "output.frame_interval=0.5"]


def begin(program, folder, *options):
    process = program.start(program.run_command(folder, OVERRIDES, *options))
    while not (folder / "trajectory.xdmf").exists() and process.poll() is None:
        time.sleep(0.002)
    return process


def wait_for_stop(process, asked, what):
    """Seconds until the run stopped; None if it was at its end already."""
    _, messages = process.communicate(timeout=30)
    seconds = time.monotonic() - asked
    if process.returncode == DONE:
        return None
    require(process.returncode == STOPPED, f"{what}: exit code {process.returncode}: {messages}")
    require(seconds < 10.0, f"{what}: took {seconds:.1f} s")
    return seconds


def stop_once(program, folder, name, wait, late):
    """Asks a new run to stop after `wait` seconds, in the way that is named. A walltime may end `late` seconds late."""
    asked = time.monotonic()
    if name == "walltime":
        process = program.start(program.run_command(folder, OVERRIDES, "--max-walltime", f"{wait:.3f}"))
        seconds = wait_for_stop(process, asked, name)
        require(seconds is None or seconds <= wait + late, f"{name}: {wait:.2f} s allowed, {seconds} s taken")
        return seconds if seconds is None else 0.0
    process = begin(program, folder)
    time.sleep(wait)
    if name == "OUTPUT_NOW" and not check_output_now(folder, process):
        process.communicate()
        return None
    asked = time.monotonic()
    if name == "STOP":
        (folder / "STOP").touch()
    else:
        for _ in range(2 if name == "two SIGINT" else 1):
            process.send_signal(signal.SIGTERM if name == "OUTPUT_NOW" else getattr(signal, name.split()[-1]))
    return wait_for_stop(process, asked, name)


def check_goes_on(program, folder, reference, what):
    require(program.verify(folder).returncode == DONE, f"{what}: verify fails")
    program.finish(folder)
    require(not differences(folder, reference), f"{what}: the end differs: {differences(folder, reference)}")


def torture(program, counts, seed=3):
    draw = random.Random(seed)
    folder = program.fresh("unbroken")
    started = time.monotonic()
    require(program.run(folder, OVERRIDES).returncode == DONE, "the unbroken run fails")
    duration = time.monotonic() - started
    reference = final_state(folder)
    late = max(0.3, 0.1 * duration)  # beside other processes a checkpoint may take longer than any before
    slowest, n_done = 0.0, 0
    for _ in range(counts["stops"]):
        for name in ("SIGINT", "SIGTERM", "SIGHUP", "SIGXCPU", "SIGUSR1", "SIGUSR2", "SIGALRM", "two SIGINT", "STOP",
                     "OUTPUT_NOW", "walltime"):
            wait = draw.uniform(0.2, 0.5) * duration
            for _ in range(6):  # a machine with more time than before may finish first
                folder = program.fresh("stopped")
                seconds = stop_once(program, folder, name, wait, late)
                if seconds is not None:
                    break
                wait *= 0.6
            require(seconds is not None, f"{name}: the runs ended before they were stopped")
            slowest = max(slowest, seconds)
            check_goes_on(program, folder, reference, name)
            require(not (folder / "STOP").exists(), "STOP is still there")
            n_done += 1
    check_locks(program)
    return n_done, f"slowest {slowest:.2f} s; a second writer refused"


def newest(folder):
    return max((int(path.stem) for path in checkpoints(folder)), default=0)


def check_output_now(folder, process):
    """True if a checkpoint was made on the way, False if the run was at its end already."""
    before = newest(folder)
    (folder / "OUTPUT_NOW").touch()
    deadline = time.monotonic() + 10.0
    while (folder / "OUTPUT_NOW").exists() and time.monotonic() < deadline and process.poll() is None:
        time.sleep(0.01)
    while newest(folder) == before and time.monotonic() < deadline and process.poll() is None:
        time.sleep(0.01)
    if process.poll() == DONE:
        return False
    require(process.poll() is None, "the run ended instead of writing")
    require(not (folder / "OUTPUT_NOW").exists() and newest(folder) > before, "no checkpoint was made")
    return True


def check_locks(program):
    folder = program.fresh("locked")
    process = begin(program, folder)
    for result in (program.resume(folder), program.run(folder, [], "--overwrite")):
        require(result.returncode == CANNOT_CREATE, f"a second writer ended with {result.returncode}: {result.stderr}")
        require(str(process.pid) in result.stderr, f"the writer is not named: {result.stderr}")
    process.kill()
    process.communicate()
    require((folder / "lock").exists(), "the killed run's lock is gone by itself")
    # Of another process that has the number now, and of another host.
    (folder / "lock").write_text((folder / "lock").read_text().replace("began ", "began 1"))
    require(program.resume(folder, "--max-walltime", "0.5").returncode in (DONE, STOPPED), "a dead one's lock is kept")
    (folder / "lock").write_text("host elsewhere.example\nprocess 1\nbegan 1@1\n")
    result = program.resume(folder, "--max-walltime", "0.5")
    if is_on_local_file_system(folder):  # nobody holds it, so that host is a name that a container had
        require(result.returncode in (DONE, STOPPED), f"another host's lock that nobody holds: {result.stderr}")
    else:
        require(result.returncode == CANNOT_CREATE, f"another host's lock, where it may write: {result.stderr}")
    require("elsewhere.example" in result.stderr, f"another host's lock: {result.stderr}")


def is_on_local_file_system(folder):
    kind = subprocess.run(["stat", "-f", "-c", "%T", str(folder)], capture_output=True, text=True).stdout.strip()
    return kind in ("ext2/ext3", "xfs", "btrfs", "tmpfs", "overlayfs", "zfs", "f2fs")
