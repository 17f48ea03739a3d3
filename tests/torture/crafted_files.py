"""HDF5 files that were made to harm, under a right seal: each is refused with its name, and nothing else happens."""

import random
import resource
import shutil

import h5py

import crafts
from hdf5_seal import unsealed, write_sealed
from program import DAMAGED, DONE, require

INDEX_ARRAYS = [f"/parameters/segments/{name}" for name in ("frames", "steps", "last_time")]
INDEX_ATTRIBUTES = [("/parameters", "status"), ("/parameters", "title"), ("/parameters/segments", "xxh3")]
FRAME_ARRAYS = ["/particles/fibers/position/time", "/particles/fibers/position/step", "/particles/fibers/position/value",
                "/observables/centreline/value", "/observables/curvature/value"]
STEP_ARRAYS = ["/observables/energy/time", "/observables/energy/step", "/observables/energy/value",
               "/observables/dt/value", "/observables/fmm_order/value"]
SEGMENT_ATTRIBUTES = [("/", name) for name in ("number", "first_frame", "first_record", "xxh3", "previous_xxh3")]
MEMORY = 4 << 30
CHANGES = ("spoil", "reverse", "make_foreign_text")  # found by comparing numbers, where they are not impossible


def list_crafts():
    """(file, object, craft, words) of every combination."""
    cases = []
    for file, arrays, attributes in (("trajectory.h5", INDEX_ARRAYS, INDEX_ATTRIBUTES),
                                     ("segments/000001.h5", FRAME_ARRAYS + STEP_ARRAYS, SEGMENT_ATTRIBUTES)):
        for craft in crafts.OF_ARRAYS:
            cases += [(file, name, lambda f, draw, n=name, c=craft: c(f, n, draw), craft.__name__) for name in arrays]
        for craft in crafts.OF_ATTRIBUTES:
            cases += [(file, f"{owner}@{name}", lambda f, draw, o=owner, n=name, c=craft: c(f, o, n, draw),
                       craft.__name__) for owner, name in attributes]
    return cases


def limit_memory():
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))


def craft_file(path, change, draw):
    """@returns whether the file is another one now"""
    before = unsealed(path)
    path.write_bytes(before)
    with h5py.File(path, "r+") as file:
        try:
            change(file, draw)
        except (TypeError, ValueError, IndexError, RuntimeError, OSError):  # this array cannot be made so
            path.write_bytes(before)
    after = path.read_bytes()
    write_sealed(path, after)
    return after != before


def is_harmless(words, name):
    """A text is a text, whatever it says, and a title may be left out."""
    return (words == "make_foreign_text" and name in ("/parameters@status", "/parameters@title")
            or words == "remove_attribute" and name == "/parameters@title")


def check_verb(program, command, path, folder, what):
    result = program.call(command, preexec_fn=limit_memory)
    require(result.returncode in (DONE, DAMAGED), f"{what}: {command[1]} ends with {result.returncode}: {result.stderr}")
    require("internal error" not in result.stderr, f"{what}: {command[1]}: {result.stderr}")
    require("root:" not in result.stdout + result.stderr, f"{what}: {command[1]} shows another file")
    if result.returncode == DAMAGED:
        require(path.name in result.stderr, f"{what}: {command[1]} does not name {path.name}: {result.stderr}")
    return result


def torture(program, counts, seed=9):
    draw = random.Random(seed)
    whole = program.fresh("whole")
    require(program.run(whole, ["time.end=0.5"]).returncode == DONE, "the run fails")
    shutil.copy(whole / "segments/000001.h5", program.folder / "other.h5")
    cases = list_crafts()
    draw.shuffle(cases)
    n_crafted = n_refused = 0
    for i in range(counts["crafted_files"]):
        file, name, change, words = cases[i % len(cases)]
        what = f"{words} of {name} in {file}"
        folder = program.fresh("crafted")
        shutil.copytree(whole, folder)
        path = folder / file
        if not craft_file(path, change, draw):
            continue
        n_crafted += 1
        results = [check_verb(program, [program.path, verb, folder], path, folder, what) for verb in ("info", "verify")]
        result = program.folder / "crafted.vti"
        others = ([program.path, "analyze", folder],
                  [program.path, "field", folder, "--points", "3", "-o", result], [program.path, "resume", folder, "-q"])
        results.append(check_verb(program, others[i % len(others)], path, folder, what))
        refusals = [r.stderr for r in results if r.returncode == DAMAGED]
        n_refused += bool(refusals)
        if is_harmless(words, name):
            continue
        require(refusals, f"{what}: nobody finds it")
        group = name.split("@")[0].rsplit("/", 1)[0]
        require(words in CHANGES or any(group in text for text in refusals), f"{what}: nobody names {group}: {refusals}")
    return n_crafted, f"{n_refused} refused with file and object; links, storage elsewhere, shapes, types, texts, filters"
