"""A bit flipped, bytes zeroed, an end cut off, in any file that a run's numbers rest on: verify names the file, no other verb
takes it for whole where it reads it, and nobody breaks."""

import random

from damaged_checkpoints import append, cut, flip, zero
from program import DAMAGED, DONE, require

DAMAGES = [flip, flip, flip, zero, cut, append]


def commands(program, folder):
    field = folder.with_name("field.vti")
    return [[program.path, "info", folder], [program.path, "analyze", folder, "--no-forces", "-o", folder.with_name("tables")],
            [program.path, "field", folder, "--points", "3", "-o", field]]


def torture(program, counts, seed=10):
    draw = random.Random(seed)
    folder = program.fresh("whole")
    require(program.run(folder).returncode == DONE, "the run fails")
    files = [folder / "scene.toml", folder / "trajectory.h5", *sorted(folder.glob("segments/*.h5")),
             *sorted(folder.glob("checkpoints/*.checkpoint"))]
    n_noticed = 0
    for i in range(counts["files"]):
        victim, damage = draw.choice(files), DAMAGES[i % len(DAMAGES)]
        what = f"{damage.__name__} of {victim.relative_to(folder)}"
        whole = victim.read_bytes()
        victim.write_bytes(damage(whole, draw, None))
        result = program.verify(folder)
        require(result.returncode == DAMAGED, f"{what}: verify ends with {result.returncode}: {result.stderr}")
        require(victim.name in result.stderr, f"{what}: verify does not name it: {result.stderr}")
        command = commands(program, folder)[i % 3]
        result = program.call(command)
        require(result.returncode in (DONE, DAMAGED), f"{what}: {command[1]}: {result.returncode}: {result.stderr}")
        require("internal error" not in result.stderr, f"{what}: {command[1]}: {result.stderr}")
        reads_it = victim.parent.name != "checkpoints" and (victim.parent.name != "segments" or command[1] == "analyze")
        require(result.returncode == DAMAGED or not reads_it, f"{what}: {command[1]} takes it for whole")
        n_noticed += result.returncode == DAMAGED
        victim.write_bytes(whole)
    require(program.verify(folder).returncode == DONE, "put back, it is not whole")
    return counts["files"], f"all found by verify; {n_noticed} by info, analyze or field, which read a part"
