"""A disk that is full or fails: exit code 74, the file and the bytes named, and the last checkpoint good."""

import ctypes
import os
import pathlib
import random
import re
import shutil
import subprocess

from program import DONE, IO_ERROR, require
from run_files import differences, run_unbroken

ERRORS = [("write", "ENOSPC"), ("write", "EIO"), ("fsync", "EIO"), ("rename", "ENOSPC"), ("write", "EDQUOT")]
# A sanitized program under strace: its search for leaks would need the place that strace has taken.
TRACED = {"ASAN_OPTIONS": "detect_leaks=0"}


def check_message(result, what):
    require(result.returncode == IO_ERROR, f"{what}: exit code {result.returncode}: {result.stderr}")
    require(re.search(r"'[^']+'", result.stderr), f"{what}: no file is named: {result.stderr}")
    require(re.search(r"\d+ bytes", result.stderr), f"{what}: no bytes are named: {result.stderr}")


def check_goes_on(program, folder, reference, what):
    require(not list(folder.rglob("*.partial")), f"{what}: a half-written file was left")
    if (folder / "trajectory.h5").exists():
        require(program.verify(folder).returncode == DONE, f"{what}: verify: {program.verify(folder).stderr}")
    if (folder / "scene.toml").exists():
        program.finish(folder)
        require(not differences(folder, reference), f"{what}: the end differs: {differences(folder, reference)}")


def count_calls(program, call):
    """How often a run makes a system call for a file of its folder."""
    folder = program.fresh("counted")
    trace = program.folder / "trace"
    program.call(["strace", "-f", "-y", "-e", f"trace={call}", "-o", trace, *program.run_command(folder)], **TRACED)
    return sum(1 for line in trace.read_text().splitlines() if call + "(" in line)


def fail_call(program, call, error, number, reference):
    """False where the call was not the program's own but a probe of the sanitizer it was built with."""
    what = f"{call} number {number} fails with {error}"
    folder = program.fresh("failing")
    inject = f"inject={call}:error={error}:when={number}"  # once: the message has to get out
    result = program.call(["strace", "-f", "-qq", "-o", "/dev/null", "-e", f"trace={call}", "-e", inject,
                           *program.run_command(folder)], **TRACED)
    if "SanitizerTool: CHECK failed" in result.stderr:
        return False
    check_message(result, what)
    check_goes_on(program, folder, reference, what)
    return True


def fill_disk(program, kilobytes, reference):
    what = f"a disk of {kilobytes} KiB"
    disk = program.fresh("disk")
    disk.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", f"size={kilobytes}k", "tmpfs", str(disk)]
    mounted = subprocess.run(mount, capture_output=True)
    require(mounted.returncode == 0, f"cannot mount: {mounted.stderr.decode()}")
    try:
        folder = disk / "run"
        result = program.run(folder)
        check_message(result, what)
        require(not list(disk.rglob("*.partial")), f"{what}: a half-written file was left")
        if (folder / "trajectory.h5").exists():
            require(program.verify(folder).returncode == DONE, f"{what}: verify: {program.verify(folder).stderr}")
        subprocess.run(["mount", "-o", "remount,size=64m", str(disk)], check=True)  # room is made
        if (folder / "scene.toml").exists():
            program.finish(folder)
            require(not differences(folder, reference), f"{what}: the end differs")
    finally:
        subprocess.run(["umount", str(disk)], check=True)


def limit_file_size(program, n_bytes, reference):
    """Where nothing can be mounted: a limit on the size of files."""
    what = f"files of at most {n_bytes} bytes"
    folder = program.fresh("limited")
    command = " ".join(["ulimit", "-f", str(n_bytes // 1024), ";", "exec", *map(str, program.run_command(folder))])
    result = program.call(["bash", "-c", command])
    check_message(result, what)
    check_goes_on(program, folder, reference, what)


def can_mount(program):
    if os.geteuid() != 0:
        return False
    disk = program.fresh("disk")
    disk.mkdir()
    mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", str(disk)], capture_output=True)
    if mounted.returncode == 0:
        subprocess.run(["umount", str(disk)], check=True)
    return mounted.returncode == 0


def torture(program, counts, seed=4):
    draw = random.Random(seed)
    reference = run_unbroken(program)
    remarks = []
    n_disks = counts["full_disks"]
    if can_mount(program):
        for _ in range(n_disks):
            fill_disk(program, 4 * draw.randint(8, 70), reference)
        remarks.append(f"{n_disks} full disks")
    else:
        for _ in range(n_disks):
            limit_file_size(program, 1024 * draw.randint(20, 60), reference)
        remarks.append(f"NO DISK FILLED (nothing can be mounted here): {n_disks} limits on file sizes instead")
    if shutil.which("strace"):
        calls = {call: count_calls(program, call) for call, _ in ERRORS}
        for i in range(counts["write_errors"]):
            call, error = ERRORS[i % len(ERRORS)]
            while not fail_call(program, call, error, draw.randint(1, calls[call] - 1), reference):
                pass
        remarks.append(f"{counts['write_errors']} failing calls of {sum(calls.values())}")
    else:
        remarks.append("NO CALL FAILED (strace is not installed)")
        return n_disks, "; ".join(remarks)
    return n_disks + counts["write_errors"], "; ".join(remarks)
