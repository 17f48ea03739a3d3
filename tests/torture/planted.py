"""What somebody leaves in a run's folder where the run is going to write: links to precious files, pipes that nobody reads,
devices. Nothing outside is touched, nothing waits, and once it is taken away the run goes on to the same end."""

import os
import random
import shutil

from program import CANNOT_CREATE, DONE, require
from run_files import checkpoints, differences, run_unbroken

KEPT = ["lock", "run.log", "events.jsonl"]  # continued where they are there: an error
# Under their own names an index and a checkpoint would be read: not this promise.
REPLACED = ["trajectory.h5.partial", "trajectory.xdmf.partial", "segments/{segment}.h5.partial",
            "checkpoints/{checkpoint}.checkpoint.partial", "trajectory.xdmf", "segments/{segment}.h5"]


def plant_link(path, precious):
    path.symlink_to(precious)


def plant_relative_link(path, precious):
    path.symlink_to(os.path.relpath(precious, path.parent))


def plant_dangling_link(path, precious):
    path.symlink_to(precious.with_name("nowhere"))


def plant_pipe(path, precious):
    os.mkfifo(path)


def plant_device(path, precious):
    path.symlink_to("/dev/full")


PLANTS = [plant_link, plant_relative_link, plant_dangling_link, plant_pipe, plant_device]


def choose_name(folder, draw):
    """A file that the run is going to write, under the name that it gets or that it has until it is whole."""
    if draw.random() < 0.5:
        return draw.choice(KEPT)
    numbers = {"segment": f"{len(list(folder.glob('segments/*.h5'))):06}",
               "checkpoint": f"{int(checkpoints(folder)[-1].stem) + 1:06}"}
    return draw.choice(REPLACED).format(**numbers)


def is_whole(precious):
    return precious.read_text() == "precious" and not precious.with_name("nowhere").exists()


def torture(program, counts, seed=8):
    draw = random.Random(seed)
    reference = run_unbroken(program)
    stopped = program.fresh("stopped")
    program.run(stopped, SKEIN_TEST_KILL="step:30")
    (stopped / "lock").unlink()
    outside = program.fresh("outside")
    outside.mkdir()
    precious = outside / "precious"
    precious.write_text("precious")
    n_refused = 0
    for i in range(counts["planted"]):
        folder = program.fresh("planted")
        shutil.copytree(stopped, folder)
        plant, name = PLANTS[i % len(PLANTS)], choose_name(folder, draw)
        what = f"{plant.__name__} at {name}"
        path = folder / name
        path.unlink(missing_ok=True)
        plant(path, precious)
        result = program.resume(folder)
        require(is_whole(precious), f"{what}: something outside was written")
        if name in KEPT:
            require(result.returncode == CANNOT_CREATE, f"{what}: exit code {result.returncode}: {result.stderr}")
            require(name in result.stderr, f"{what}: not named: {result.stderr}")
            path.unlink()
            n_refused += 1
        else:
            require(result.returncode == DONE, f"{what}: exit code {result.returncode}: {result.stderr}")
        program.finish(folder)
        require(not differences(folder, reference), f"{what}: the end differs: {differences(folder, reference)}")
        require(is_whole(precious), f"{what}: something outside was written")
    return counts["planted"], f"{n_refused} refused until taken away, the others replaced; nothing outside touched"
