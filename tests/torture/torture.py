"""Everything a run must survive, and one table: torture.py SKEIN FOLDER [--short | --campaign] [--share 0.2] [MODULE...]

FOLDER is filled with run folders. The exit code is 0 if every promise was kept."""

import argparse
import importlib
import math
import os
import pathlib
import signal
import subprocess
import sys
import time
import traceback

from program import Failed, Program

# name of the module: the promise in words
PROMISES = {
    "kills": "killed at any time",
    "restarts": "exact restart",
    "stops": "signals, files, walltime",
    "write_errors": "disk full, write errors",
    "damaged_checkpoints": "damaged checkpoints",
    "damaged_files": "damaged files",
    "crafted_files": "crafted HDF5 files",
    "unreadable": "unreadable files, folders",
    "bad_scenes": "bad scenes",
    "faults": "not a number",
    "readers": "read while it writes",
    "planted": "planted links and pipes",
    "descriptors": "descriptors closed",
}
COUNTS = {
    "short": dict(kills=6, restarts=5, stops=1, full_disks=2, write_errors=5, damages=8, files=20, crafted_files=40, harms=8, scenes=60,
                  faults=4, readings=20, planted=12, descriptors=7),
    "usual": dict(kills=50, restarts=24, stops=5, full_disks=10, write_errors=40, damages=200, files=300, crafted_files=370, harms=60,
                  scenes=2000, faults=50, readings=200, planted=120, descriptors=14),
    # By what single tries take some forty minutes of one core, where FOLDER is in memory.
    "campaign": dict(kills=1000, restarts=96, stops=10, full_disks=20, write_errors=100, damages=500, files=2000,
                     crafted_files=400, harms=200, scenes=8000, faults=120, readings=1000, planted=300, descriptors=28),
}


def torture(name, program, counts):
    try:
        count, remark = importlib.import_module(name).torture(program, counts)
        return count, True, remark
    except (Failed, subprocess.TimeoutExpired) as error:
        return 0, False, str(error)
    except Exception:  # the others are still worth knowing
        return 0, False, traceback.format_exc()


def processor_seconds():
    """What this process and those that it has waited for have taken: unlike the wall time, no other work stretches it."""
    taken = os.times()
    return sum(taken[:4])


def read_share(text):
    share = float(text)
    if not 0.0 < share <= 1.0:
        raise ValueError
    return share


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("program", type=pathlib.Path)
    arguments.add_argument("folder", type=pathlib.Path)
    size = arguments.add_mutually_exclusive_group()
    size.add_argument("--short", dest="size", action="store_const", const="short")
    size.add_argument("--campaign", dest="size", action="store_const", const="campaign")
    arguments.add_argument("--share", type=read_share, default=1.0, help="of the counts, each rounded up; default 1")
    arguments.add_argument("modules", nargs="*", metavar="MODULE", help=f"only these: {', '.join(PROMISES)}")
    options = arguments.parse_intermixed_args()
    counts = {name: math.ceil(options.share * n) for name, n in COUNTS[options.size or "usual"].items()}
    options.folder.mkdir(parents=True, exist_ok=True)
    program = Program(options.program.resolve(), options.folder.resolve())

    if signal.getsignal(signal.SIGHUP) == signal.SIG_IGN:  # as under nohup: runs would inherit that they ignore it
        signal.signal(signal.SIGHUP, lambda *_: None)
    kept = True
    print(f"{'promise':26}{'count':>7}  {'passed':8}{'seconds':>8}{'of a core':>11}  remark", flush=True)
    for name in options.modules or PROMISES:
        started, taken = time.monotonic(), processor_seconds()
        count, passed, remark = torture(name, program, counts)
        kept = kept and passed
        seconds, taken = time.monotonic() - started, processor_seconds() - taken
        print(f"{PROMISES[name]:26}{count:7}  {'yes' if passed else 'NO':8}{seconds:8.1f}{taken:11.1f}  {remark}", flush=True)
    return 0 if kept else 1


if __name__ == "__main__":
    sys.exit(main())
