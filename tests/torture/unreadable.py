"""Files and folders of a run that are missing, cannot be read or are something else: no verb hangs or breaks, frames are
lost only where they are computed again, and once the harm is undone the run goes on to an equal end."""

import os
import random
import shutil

from program import CANNOT_CREATE, DAMAGED, DONE, IO_ERROR, MISSING, SCENE_ERROR, require
from run_files import differences, run_unbroken


def remove(path):
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path)
    else:
        path.unlink()


def link_to_nowhere(path):
    os.symlink("/not/mounted", path)


def link_to_itself(path):
    os.symlink(path, path)


def write_nonsense(path):
    path.write_bytes(b"nonsense")


def leave_out(path):
    pass


HARMS = [link_to_nowhere, os.mkfifo, os.mkdir, write_nonsense, link_to_itself, leave_out, "EIO"]
REFUSALS = (DAMAGED, MISSING, CANNOT_CREATE, IO_ERROR, SCENE_ERROR)


def victims(folder):
    return ["segments", "checkpoints", "scene.toml", "trajectory.h5", "trajectory.xdmf",
            *(str(path.relative_to(folder)) for part in ("segments", "checkpoints") for path in (folder / part).iterdir())]


def commands(folder, program):
    field = folder.with_name("field.vti")
    return [["verify", folder], ["info", folder], ["analyze", folder, "--no-forces", "-o", folder.with_name("tables")],
            ["field", folder, "-o", field, "--points", "4"]]


def frames(folder):
    return {path.name: path.read_bytes() for path in (folder / "segments").glob("*.h5") if path.is_file()}


def call(program, arguments, failing=None):
    strace = [] if failing is None else ["strace", "-f", "-qq", "-o", "/dev/null", "-P", failing, "-e",
                                         "trace=read,pread64,getdents64", "-e",
                                         "inject=read,pread64,getdents64:error=EIO"]
    return program.call([*strace, program.path, *arguments], timeout=60, ASAN_OPTIONS="detect_leaks=0")


def harm_once(program, stopped, harm, victim, reference):
    name = harm if isinstance(harm, str) else harm.__name__
    what = f"{name} for {victim}"
    folder = program.fresh("harmed")
    shutil.copytree(stopped, folder)
    path, aside = folder / victim, program.fresh("aside")
    failing = path if harm == "EIO" else None
    if harm != "EIO":
        shutil.move(path, aside)
        harm(path)
    for arguments in commands(folder, program):
        result = call(program, arguments, failing)
        require(result.returncode in (DONE, *REFUSALS), f"{what}: {arguments[0]}: {result.returncode}: {result.stderr}")
        require("internal error" not in result.stderr, f"{what}: {arguments[0]}: {result.stderr}")
    before = frames(folder)
    result = call(program, ["resume", folder, "-q"], failing)
    require(result.returncode in (DONE, *REFUSALS), f"{what}: resume: {result.returncode}: {result.stderr}")
    require("internal error" not in result.stderr, f"{what}: resume: {result.stderr}")
    if result.returncode != DONE:
        require(frames(folder) == before, f"{what}: frames were lost: {result.stderr}")
        if harm != "EIO":
            if path.is_symlink() or path.exists():
                remove(path)
            shutil.move(aside, path)
        program.finish(folder)
    require(not differences(folder, reference), f"{what}: the end differs: {differences(folder, reference)}")
    return result.returncode == DONE


def torture(program, counts, seed=9):
    draw = random.Random(seed)
    reference = run_unbroken(program)
    stopped = program.fresh("stopped")
    program.run(stopped, SKEIN_TEST_KILL="step:50")
    harms = HARMS if shutil.which("strace") else [harm for harm in HARMS if harm != "EIO"]
    cases = [(harm, victim) for victim in victims(stopped) for harm in harms]
    draw.shuffle(cases)
    folders = [case for case in cases if case[1] in ("segments", "checkpoints")]  # a third of the cases at least
    cases = (folders[: counts["harms"] // 3] + [case for case in cases if case not in folders])[: counts["harms"]]
    n_survived = sum(harm_once(program, stopped, harm, victim, reference) for harm, victim in cases)
    remark = f"{n_survived} went on at once, the others once the harm was undone, all to an equal end"
    return len(cases), remark if "EIO" in harms else remark + "; NO READ FAILED (strace is not installed)"
