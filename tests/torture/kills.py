"""SIGKILL at any moment: nothing unreadable, at most one checkpoint interval lost, the end equal in every bit."""

import random
import signal
import time

from program import DONE, require
from run_files import checkpoints, differences, final_state, read_checkpoint, step_times

END, INTERVAL = 1.0, 0.2  # of the run and between checkpoints, in program.SCENE
POINTS = [
    f"{kind}.{point}"
    for kind in ("checkpoint", "segment", "trajectory.h5", "trajectory.xdmf")
    for point in ("half", "before_rename", "after_rename")
]


def resume_time(folder):
    found = checkpoints(folder)
    return read_checkpoint(found[-1])["state.time"][0] if found else 0.0


def check_after_kill(program, folder, reference):
    if (folder / "trajectory.h5").exists():
        result = program.verify(folder)
        require(result.returncode == DONE, f"verify after the kill: {result.stderr}")
    program.finish(folder)
    require(not differences(folder, reference), f"the end differs: {differences(folder, reference)}")
    require(not list(folder.rglob("*.partial")), "a half-written file was left")


def kill_inside_write(program, point, count, reference):
    folder = program.fresh("killed")
    result = program.run(folder, SKEIN_TEST_KILL=f"{point}:{count}")
    require(result.returncode == -signal.SIGKILL, f"not killed at {point}:{count}, ended with {result.returncode}")
    if point.startswith("checkpoint"):
        safe = count if point.endswith("after_rename") else count - 1
        found = checkpoints(folder)
        require((int(found[-1].stem) if found else 0) == safe, f"not the newest checkpoint is there: {found}")
    check_after_kill(program, folder, reference)


def kill_after_step(program, step, times, reference):
    folder = program.fresh("killed")
    result = program.run(folder, SKEIN_TEST_KILL=f"step:{step}")
    require(result.returncode == -signal.SIGKILL, f"not killed at step {step}, ended with {result.returncode}")
    lost = times[step - 1] - resume_time(folder)
    largest_step = max(b - a for a, b in zip((0.0, *times), times))
    require(0.0 <= lost <= INTERVAL + largest_step, f"killed at step {step}: {lost} of simulated time lost")
    check_after_kill(program, folder, reference)


def kill_at_random(program, seconds, reference):
    folder = program.fresh("killed")
    process = program.start(program.run_command(folder))
    while not (folder / "scene.toml").exists() and process.poll() is None:
        time.sleep(0.001)
    time.sleep(seconds)
    process.kill()
    process.communicate()
    check_after_kill(program, folder, reference)


def torture(program, counts, seed=1):
    draw = random.Random(seed)
    folder = program.fresh("unbroken")
    started = time.monotonic()
    result = program.run(folder)
    seconds = time.monotonic() - started
    require(result.returncode == DONE, result.stderr)
    reference, times = final_state(folder), step_times(folder)
    n_checkpoints = round(END / INTERVAL)
    n_inside = round(0.3 * counts["kills"])
    for i in range(n_inside):
        kill_inside_write(program, POINTS[i % len(POINTS)], draw.randint(1, n_checkpoints - 1), reference)
    n_steps = (counts["kills"] - n_inside) // 2
    for _ in range(n_steps):
        kill_after_step(program, draw.randint(1, len(times) - 1), times, reference)
    for _ in range(counts["kills"] - n_inside - n_steps):
        kill_at_random(program, draw.uniform(0.0, seconds), reference)
    return counts["kills"], f"{n_inside} inside writes, {len(reference)} arrays equal in every bit"
