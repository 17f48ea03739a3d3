"""What becomes of a run that ranks share when one of them fails: all processes are gone within ten seconds, one message says
why, mpirun's exit code tells what kind of failure it was, and the run folder is whole and goes on.

Usage: test_rank_faults.py SKEIN SOURCES MPIRUN"""

import os
import shutil
import signal
import subprocess
import sys
import time
import unittest

MPIRUN = sys.argv.pop(3) if len(sys.argv) > 3 else None

from cli_case import CANNOT_CREATE, DONE, IO_ERROR, STOPPED, USAGE, InFreshFolder, main

INTERNAL, NUMERICAL, SCENE_ERROR = 70, 76, 78
SECONDS_TO_END = 10.0
RANKS = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMP_NUM_THREADS": "1"}
# Takes minutes if nothing ends it.
SCENE = """title = "ranks"
[fiber]
sections = 24
direction = [1.0, 0.5, 0.0]
[hydrodynamics]
method = "direct"
[time]
method = "rkc2"
end = 1000.0
[output]
frame_interval = 0.01
[checkpoint]
simulated_interval = 0.02
"""
# Sets variables in the environment of one rank.
ON_ONE_RANK = 'if [ "$OMPI_COMM_WORLD_RANK" = {rank} ]; then export {variables}; fi; exec "$@"'


class RankFaults(InFreshFolder):
    def setUp(self):
        super().setUp()
        self.write(SCENE)
        self.run_folder = self.folder / "run"

    def launch(self, *words, rank=1, n_ranks=3, variables="", wrapper=""):
        script = wrapper or (ON_ONE_RANK.format(rank=rank, variables=variables) if variables else 'exec "$@"')
        command = [MPIRUN, "--oversubscribe", "-n", str(n_ranks), "sh", "-c", script, "sh", sys.argv[1], *map(str, words)]
        self.started = time.monotonic()
        self.process = subprocess.Popen(command, cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                        start_new_session=True, env={**os.environ, **RANKS})
        self.addCleanup(self.tidy, self.process)
        return self.process

    def tidy(self, process):
        process.kill()
        for pid in self.ranks():
            os.kill(pid, signal.SIGKILL)
        process.stdout.close()

    def ranks(self):
        """Processes of this run that are there."""
        listed = subprocess.run(["ps", "-eo", "pid,stat,args"], capture_output=True, text=True).stdout.splitlines()
        found = []
        for line in listed:
            pid, state, words = line.split(None, 2)
            if words.startswith(sys.argv[1]) and not state.startswith("Z"):
                try:
                    if os.readlink(f"/proc/{pid}/cwd") == str(self.folder):
                        found.append(int(pid))
                except OSError:
                    pass
        return found

    def wait_for_steps(self):
        """Until there are frames: all ranks are at work."""
        until = time.monotonic() + 60.0
        while time.monotonic() < until:
            if self.process.poll() is not None:
                self.fail(f"ended early with {self.process.returncode}: {self.process.stdout.read()}")
            if len(list((self.run_folder / "checkpoints").glob("*.checkpoint"))) >= 2:
                return
            time.sleep(0.1)
        self.fail("the run made no steps")

    def wait_for_fault(self):
        """@returns when a rank began to fail"""
        until = time.monotonic() + 60.0
        while not (self.folder / "rank_fault").exists() and time.monotonic() < until:
            time.sleep(0.05)
        self.assertTrue((self.folder / "rank_fault").exists(), "nothing failed")
        return time.monotonic()

    def rank_pid(self, rank):
        for pid in self.ranks():
            with open(f"/proc/{pid}/environ", encoding="utf-8", errors="replace") as file:
                if f"OMPI_COMM_WORLD_RANK={rank}\0" in file.read() + "\0":
                    return pid
        self.fail(f"there is no rank {rank}")

    def finish(self, codes, message, since=None, goes_on=True, waits=True):
        """All end in time, with the code and the message, and the run goes on."""
        since = time.monotonic() if since is None else since
        said, _ = self.process.communicate(timeout=60.0)
        seconds = time.monotonic() - since
        while self.ranks() and time.monotonic() - since < SECONDS_TO_END:
            time.sleep(0.1)
        self.assertEqual(self.ranks(), [], "ranks are left")
        if waits:
            self.assertLess(seconds, SECONDS_TO_END, said)
        self.assertIn(self.process.returncode, codes, said)
        # What mpirun says of itself is beside the point.
        own = [line for line in said.splitlines() if line.startswith("skein: ")]
        if message:
            self.assertRegex("\n".join(own), message, said)
            self.assertEqual(len(own), 1, f"not one message: {said}")
        if goes_on:
            self.expect(DONE, "verify", "run")
            self.assert_goes_on()
        return said

    def assert_goes_on(self):
        until = time.monotonic() + SECONDS_TO_END
        while True:
            result = self.skein("resume", "run", "-q", "--max-walltime", "2", environment=RANKS)
            # A process that is killed may be listed no more, and still hold its lock for a moment.
            if result.returncode != CANNOT_CREATE or time.monotonic() > until:
                break
            time.sleep(0.2)
        self.assertEqual(result.returncode, STOPPED, result.stderr)
        self.expect(DONE, "verify", "run")

    def start(self, *options, **fault):
        self.launch("run", "scene.toml", "-o", "run", "--quiet", *options, **fault)

    def start_and_send(self, number, rank):
        """To one rank of a run that has made steps. @returns the time"""
        self.start()
        self.wait_for_steps()
        since = time.monotonic()
        os.kill(self.rank_pid(rank), number)
        return since

    def test_a_rank_that_throws(self):
        self.start(variables="SKEIN_TEST_RANK=throw:200")
        self.finish([INTERNAL], "rank 1: SKEIN_TEST_RANK asks for this error", self.wait_for_fault())

    def test_a_rank_that_is_killed(self):
        since = self.start_and_send(signal.SIGKILL, rank=2)
        # mpirun notices it, says so, and ends the others.
        said = self.finish([128 + signal.SIGKILL], None, since)
        self.assertRegex(said, r"exited on signal 9 \(Killed\)")

    def test_rank_0_that_is_killed(self):
        since = self.start_and_send(signal.SIGKILL, rank=0)
        said = self.finish([128 + signal.SIGKILL], None, since)
        self.assertRegex(said, r"exited on signal 9 \(Killed\)")

    def test_a_rank_that_is_stopped(self):
        since = self.start_and_send(signal.SIGSTOP, rank=1)
        self.finish([IO_ERROR], "rank 1 has not been heard of for 5 s", since)
        log = (self.run_folder / "run.log").read_text(encoding="utf-8")
        self.assertIn("rank 1 has not been heard of", log)
        self.assertIn("the last good state", log)

    def test_rank_0_that_is_stopped(self):
        since = self.start_and_send(signal.SIGSTOP, rank=0)
        self.finish([IO_ERROR], "rank 0 has not been heard of for 5 s", since)

    def test_a_rank_that_sleeps(self):
        self.start(variables="SKEIN_TEST_RANK=sleep:1")
        since = self.wait_for_fault()  # in its first sum, before there is a checkpoint
        self.finish([IO_ERROR], "rank 1: does nothing for [56] s in the middle of a sum", since, goes_on=False)
        self.assert_goes_on()

    def test_a_rank_that_computes_for_ever(self):
        self.start(variables="SKEIN_TEST_RANK=spin:200")
        self.finish([IO_ERROR], "rank 1: comes to no end of its part of a sum", self.wait_for_fault())

    def test_a_full_disk_on_rank_0(self):
        """A limit on the size of files stands for it, as in the tests of one process."""
        self.start(wrapper='if [ "$OMPI_COMM_WORLD_RANK" = 0 ]; then ulimit -f 60; fi; exec "$@"')
        said = self.finish([IO_ERROR], "cannot write [0-9]+ bytes to .*File too large", waits=False, goes_on=False)
        self.assertNotIn("internal", said)
        self.assert_goes_on()

    def test_a_velocity_of_a_rank_that_is_no_number(self):
        self.start(variables="SKEIN_TEST_RANK=nan:200")
        self.finish([NUMERICAL], "node [0-9]+", self.wait_for_fault())

    def test_a_signal_to_mpirun(self):
        """SIGUSR1 reaches the ranks and mpirun ends as they do. On SIGTERM the ranks stop alike, but Open MPI's mpirun has an
        exit code of its own for it."""
        for number, codes in ((signal.SIGUSR1, [STOPPED]), (signal.SIGTERM, [1, STOPPED, 128 + signal.SIGTERM])):
            with self.subTest(signal=number):
                shutil.rmtree(self.run_folder, ignore_errors=True)
                self.start()
                self.wait_for_steps()
                since = time.monotonic()
                self.process.send_signal(number)
                self.finish(codes, None, since, goes_on=False)
                log = (self.run_folder / "run.log").read_text(encoding="utf-8")
                self.assertRegex(log, "stopped at t = .*: it received SIG")
                self.expect(DONE, "verify", "run")
                self.assert_goes_on()

    def test_a_scene_that_is_wrong(self):
        self.write(SCENE.replace("sections = 24", "sections = -24"))
        self.start()
        said = self.finish([SCENE_ERROR], None, goes_on=False)
        self.assertEqual(said.count("problem in the scene"), 1, said)

    def test_verbs_that_have_no_use_for_ranks(self):
        self.launch("info", "run")
        self.finish([USAGE], "3 ranks were started, and 'skein info' has no use for them", goes_on=False)

    def test_a_wish_of_the_environment_that_is_none(self):
        self.start(variables="SKEIN_GPU_AWARE_MPI=maybe", rank=0)
        self.finish([USAGE], "SKEIN_GPU_AWARE_MPI is neither on nor off", goes_on=False)


if __name__ == "__main__":
    main()
