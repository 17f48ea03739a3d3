"""Checkpoints cut off, with bits flipped, zeroed, of another run: each is found and named, and an older one used."""

import random
import shutil

from program import DAMAGED, DONE, require
from run_files import checkpoints, differences, read_checkpoint, run_unbroken


def cut(data, draw, _):
    return data[: draw.randrange(len(data))]


def flip(data, draw, _):
    changed = bytearray(data)
    changed[draw.randrange(len(changed))] ^= 1 << draw.randrange(8)
    return bytes(changed)


def zero(data, draw, _):
    begin = draw.randrange(len(data) - 64)
    changed = data[:begin] + bytes(64) + data[begin + 64 :]
    return changed if changed != data else flip(data, draw, _)


def append(data, draw, _):
    return data + draw.randbytes(draw.randint(1, 100))


def randomize(data, draw, _):
    return draw.randbytes(len(data))


def exchange(data, draw, other):
    return other


DAMAGES = [cut, flip, zero, append, flip, randomize, exchange, flip]


def torture(program, counts, seed=5):
    draw = random.Random(seed)
    reference = run_unbroken(program)
    stopped = program.fresh("stopped")
    program.run(stopped, SKEIN_TEST_KILL="step:50")
    other = program.fresh("other")
    require(program.run(other, ["flow.rate=2.25"]).returncode == DONE, "the other run fails")
    foreign = checkpoints(other)[-1].read_bytes()
    pristine = [path.name for path in checkpoints(stopped)]
    require(len(pristine) == 3, f"not three checkpoints: {pristine}")
    for i in range(counts["damages"]):
        folder = program.fresh("damaged")
        shutil.copytree(stopped, folder)
        damage = DAMAGES[i % len(DAMAGES)]
        n_damaged = 1 + (i // len(DAMAGES)) % 3
        victims = checkpoints(folder)[-n_damaged:]
        for victim in victims:
            victim.write_bytes(damage(victim.read_bytes(), draw, foreign))
        what = f"{damage.__name__} of {[victim.name for victim in victims]}"
        result = program.verify(folder)
        require(result.returncode == DAMAGED, f"{what}: verify finds nothing")
        for victim in victims:
            require(victim.name in result.stderr, f"{what}: verify does not name {victim.name}: {result.stderr}")
        check_resume(program, folder, victims, what, reference)
    return counts["damages"], "cut, bits flipped, zeroed, appended, random, another run's; one to all three"


def check_resume(program, folder, victims, what, reference):
    n_good = 3 - len(victims)
    expected = read_checkpoint(checkpoints(folder)[n_good - 1]) if n_good else None
    limit = ["--max-walltime", "0.001"] if n_good else []  # enough to say from where it goes on
    result = program.call([program.path, "resume", folder, *limit])
    for victim in victims:
        require(victim.name in result.stderr, f"{what}: resume does not name {victim.name}: {result.stderr}")
    if not n_good:
        require(result.returncode == DAMAGED, f"{what}: exit code {result.returncode}: {result.stderr}")
        return
    require(f"step {expected['state.step'][0]};" in result.stderr, f"{what}: not the older one: {result.stderr}")
    require(len(list(folder.glob("checkpoints/*.damaged"))) == len(victims), f"{what}: the damaged are not set apart")
    program.finish(folder)
    require(not differences(folder, reference), f"{what}: the end differs: {differences(folder, reference)}")
