"""The program among others: signals, descriptors, limits, threads, the terminal, and what the environment says to Python.

Called as test_process.py PROGRAM SOURCES.
"""

import os
import pathlib
import resource
import shutil
import signal
import subprocess
import time

from cli_case import (DONE, IO_ERROR, NO_RESOURCES, PROGRAM, SCENE_ERROR, SMALL_SCENE, STOPPED, USAGE,
                      InFreshFolder, main, skein)

# Of many cheap steps: there is time to stop it.
LONG_SCENE = SMALL_SCENE.replace("end = 0.3", "end = 1000.0\nmax_step = 0.002").replace("frame_interval = 0.1",
                                                                                         "frame_interval = 1.0")
# What moves the cursor, renames the terminal and turns the direction of writing; also as single bytes.
EVIL = "a\033]0;b\007\033[2Jc\u009b31md\u202ee\x7f"
UNSEEN = set(range(0x20)) - {0x0A, 0x09} | set(range(0x7F, 0xA0)) | {0x202E}


ONE_THREAD = {**os.environ, "OMP_NUM_THREADS": "1"}


def without_settings(**more):
    """No variable that says anything about threads."""
    return {**{name: None for name in os.environ if name.startswith(("OMP_", "GOMP_", "KOKKOS_"))}, **more}


class Signals(InFreshFolder):
    def start(self, before=None):
        self.write(LONG_SCENE, "long.toml")
        shutil.rmtree(self.folder / "run", ignore_errors=True)
        process = subprocess.Popen([PROGRAM, "run", "long.toml", "-o", "run"], cwd=self.folder, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, preexec_fn=before, env=ONE_THREAD)
        self.addCleanup(process.kill)
        while not (self.folder / "run/trajectory.h5").exists() and process.poll() is None:
            time.sleep(0.01)
        return process

    def check_stopped(self, process, name):
        _, messages = process.communicate(timeout=30)
        self.assertEqual(process.returncode, STOPPED, messages)
        self.assertIn(f"it received {name}", messages)
        self.assertTrue(list((self.folder / "run/checkpoints").iterdir()))
        self.expect(DONE, "verify", "run")

    def test_what_ends_processes_ends_a_run_with_a_checkpoint(self):
        for name in ("SIGINT", "SIGTERM", "SIGHUP", "SIGXCPU", "SIGUSR1", "SIGUSR2", "SIGALRM"):
            with self.subTest(signal=name):
                process = self.start()
                process.send_signal(getattr(signal, name))
                self.check_stopped(process, name)

    def test_nohup_is_respected(self):
        process = self.start(lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        process.send_signal(signal.SIGHUP)
        time.sleep(0.3)
        self.assertIsNone(process.poll())
        process.send_signal(signal.SIGTERM)
        self.check_stopped(process, "SIGTERM")

    def test_a_limit_on_processor_time_is_such_a_signal(self):
        process = self.start(lambda: resource.setrlimit(resource.RLIMIT_CPU, (1, 20)))
        self.check_stopped(process, "SIGXCPU")


class Descriptors(InFreshFolder):
    def test_messages_never_land_in_files_of_the_run(self):
        self.write(SMALL_SCENE)
        for closed in ((0,), (1,), (2,), (1, 2), (0, 1, 2)):
            with self.subTest(closed=closed):
                process = subprocess.run([PROGRAM, "run", "scene.toml", "-o", "run", "--overwrite"], cwd=self.folder,
                                         stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                         env=ONE_THREAD, preexec_fn=lambda: [os.close(number) for number in closed], timeout=60)
                self.assertEqual(process.returncode, DONE)
                for line in (self.folder / "run/events.jsonl").read_text().splitlines():
                    self.assertTrue(line.startswith('{"event": '), line)
                self.assertFalse((self.folder / "run/lock").exists())
                self.assertTrue((self.folder / "run/scene.toml").read_text().startswith("title"))
                self.expect(DONE, "verify", "run")


class WriteErrors(InFreshFolder):
    def limited(self, n_bytes):
        return {"preexec_fn": lambda: (signal.signal(signal.SIGXFSZ, signal.SIG_DFL),
                                       resource.setrlimit(resource.RLIMIT_FSIZE, (n_bytes, n_bytes)))}

    def test_a_limit_on_files_is_an_error_of_every_verb_that_writes(self):
        self.make_run()
        for arguments in (["run", "small.toml", "-o", "new"], ["analyze", "run", "-o", "tables"],
                          ["field", "run", "-o", "flow.vti"], ["plot", "run", "-o", "pictures"]):
            with self.subTest(arguments=arguments):
                result = self.expect(IO_ERROR, *arguments, **self.limited(1000))
                self.assertIn("File too large", result.stderr)
                self.assertEqual(list(self.folder.rglob("*.partial")), [])

    def test_a_reader_of_stdout_that_is_gone_is_an_error_of_every_verb_that_prints(self):
        self.make_run()
        for arguments in (["defaults"], ["info", "run"], ["verify", "run"], ["validate", "small.toml"], ["--help"],
                          ["analyze", "run"], ["run", "small.toml", "-o", "x", "--dry-run"], ["plot", "run"]):
            with self.subTest(arguments=arguments):
                reader, writer = os.pipe()
                os.close(reader)
                try:
                    result = self.expect(IO_ERROR, *arguments, stdout=writer)
                finally:
                    os.close(writer)
                self.assertIn("standard output", result.stderr)
                self.assertNotIn("internal", result.stderr)


class Threads(InFreshFolder):
    def expect_refusal(self, code, words, *options, environment=(), **others):
        result = self.expect(code, "run", "scene.toml", "-o", "run", *options,
                             environment=without_settings(**dict(environment)), **others)
        self.assertIn(words, result.stderr)
        self.assertNotIn("internal", result.stderr)
        self.assertFalse((self.folder / "run").exists(), "something was written")

    def setUp(self):
        super().setUp()
        if "backend: OpenMP" not in skein("--version").stdout:
            self.skipTest("needs OpenMP")
        self.write(SMALL_SCENE)

    def test_more_than_there_can_be_are_refused(self):
        for number in ("513", "600", "4096", "1000000", "99999999999", "0", "-1", "two"):
            self.expect_refusal(USAGE, "--threads", "--threads", number)
            for variable in ("KOKKOS_NUM_THREADS",):
                self.expect_refusal(USAGE, f"{variable}={number}", environment={variable: number})
        self.expect_refusal(USAGE, "OMP_NUM_THREADS=1000", environment={"OMP_NUM_THREADS": "1000"})
        self.expect_refusal(USAGE, "OMP_THREAD_LIMIT", "--threads", "4", environment={"OMP_THREAD_LIMIT": "2"})
        self.expect(DONE, "run", "scene.toml", "-o", "run", "-q", "--threads", "2",
                    environment=without_settings(OMP_NUM_THREADS="1000"))
        self.expect(DONE, "run", "scene.toml", "-o", "many", "-q", "--threads", "512", "--dry-run")

    def test_small_scenes_take_fewer_unless_more_are_asked_for(self):
        n_processors = len(os.sched_getaffinity(0))
        if n_processors < 2:
            self.skipTest("needs two processors")

        def threads_of(nodes, *options, environment=without_settings(OMP_NUM_THREADS=None)):
            name = f"run_{len(list(self.folder.iterdir()))}"
            said = self.expect(DONE, "run", "scene.toml", "-o", name, "--set", "time.end=1e-4", "--set", f"fiber.sections={nodes // 10}",
                               "--set", "fiber.nodes_per_section=10", *options, environment=environment)
            line = self.expect(DONE, "info", name).stdout.split("threads: ")[1].splitlines()[0]
            self.assertIn(f"threads: {line}\n", said.stdout + said.stderr)
            return line

        self.assertEqual(threads_of(490), f"1 of {n_processors}, because 490 nodes keep no more busy; --threads or OMP_NUM_THREADS "
                                          "asks for more")
        self.assertRegex(threads_of(500), "^2 of|^2, all processors")
        self.assertEqual(threads_of(490, "--threads", "2"), "2, as many as the run was given; 490 nodes keep no more than 1 busy")
        self.assertEqual(threads_of(490, environment=without_settings(OMP_NUM_THREADS="2")),
                         "2, as OMP_NUM_THREADS asks for; 490 nodes keep no more than 1 busy")
        self.assertEqual(threads_of(500, environment=without_settings(KOKKOS_NUM_THREADS="1")), "1, as KOKKOS_NUM_THREADS asks for")
        # Copies by placement count, too.
        self.assertRegex(threads_of(100, "--set", 'placement.kind="grid"', "--set", "placement.grid=[1.0, 5.0, 1.0]"), "^2 of|^2, all processors")

    def test_settings_of_kokkos_that_are_none(self):
        self.expect_refusal(USAGE, "KOKKOS_NUM_THREADS=abc", environment={"KOKKOS_NUM_THREADS": "abc"})
        self.expect_refusal(USAGE, "KOKKOS_NUM_THREADS=2x", "--threads", "1", environment={"KOKKOS_NUM_THREADS": "2x"})

    def test_stacks_that_are_too_small_are_refused(self):
        for size in ("64k", "64", "1023 K", "1000000B"):
            self.expect_refusal(USAGE, f"OMP_STACKSIZE={size}", environment={"OMP_STACKSIZE": size})
        self.expect_refusal(USAGE, "ulimit -s",
                            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_STACK, (2**19, resource.RLIM_INFINITY)))
        self.expect_refusal(NO_RESOURCES, "OMP_STACKSIZE", "--threads", "2", environment={"OMP_STACKSIZE": "1000000G"})
        self.expect(DONE, "run", "scene.toml", "-o", "run", "-q", environment=without_settings(OMP_STACKSIZE="1M"))

    def test_threads_that_do_not_start_are_an_error(self):
        if os.geteuid() == 0:
            options = {"user": 65534, "preexec_fn": lambda: resource.setrlimit(resource.RLIMIT_NPROC, (1, 1))}
            self.folder.chmod(0o777)
            try:
                subprocess.run([PROGRAM, "--version"], user=65534, capture_output=True, check=True)
            except (OSError, subprocess.CalledProcessError):
                self.skipTest("another user cannot start the program here")
        else:
            options = {"preexec_fn": lambda: resource.setrlimit(resource.RLIMIT_NPROC, (1, 1))}
        self.expect_refusal(NO_RESOURCES, "cannot be started", "--threads", "4", **options)

    def test_a_run_is_not_touched_where_threads_are_refused(self):
        self.expect(STOPPED, "run", "scene.toml", "-o", "stopped", "-q", "--max-walltime", "0.001")
        before = self.snapshot(self.folder)
        self.expect(USAGE, "resume", "stopped", environment=without_settings(OMP_STACKSIZE="64k"))
        self.assertEqual(self.snapshot(self.folder), before)


class Memory(InFreshFolder):
    def processor_seconds(self):
        """Of the programs that have ended: the machine may have other things to do."""
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        return used.ru_utime + used.ru_stime

    def test_a_scene_that_cannot_fit_is_refused_at_once_with_an_estimate(self):
        if b"AddressSanitizer" in pathlib.Path(PROGRAM).read_bytes():
            self.skipTest("the sanitizer's shadow memory is larger than what may be had")
        self.write("[fiber]\nsections = 50000\nnodes_per_section = 18\n[placement]\nkind = \"grid\"\n"
                   "grid = [111, 1, 1]\nspacing = [1000.0, 1.0, 1.0]\n")
        limit = {"preexec_fn": lambda: resource.setrlimit(resource.RLIMIT_AS, (2**33, 2**33))}
        for arguments in (["run", "scene.toml", "-o", "run"], ["validate", "scene.toml"]):
            begin = self.processor_seconds()
            result = self.expect(NO_RESOURCES, *arguments, **limit)
            self.assertLess(self.processor_seconds() - begin, 2.0)
            self.assertRegex(result.stderr, r"take at least 69\.9 GB of memory, and this process can have [\d.]+ GB")
        self.assertFalse((self.folder / "run").exists())

    def test_a_great_many_unknown_keys_take_a_moment(self):
        self.write("[fiber]\n" + "".join(f"key_{number} = {number}\n" for number in range(700_000)))
        begin = self.processor_seconds()
        result = self.expect(SCENE_ERROR, "validate", "scene.toml")
        self.assertLess(self.processor_seconds() - begin, 6.0)
        self.assertLess(len(result.stderr.splitlines()), 300)
        self.assertIn("unknown key 'key_0' in [fiber]", result.stderr)


class Terminal(InFreshFolder):
    def check_clean(self, text):
        """Also its bytes, of which some terminals take 0x80 to 0x9f for controls."""
        self.assertEqual({ord(c) for c in text} & UNSEEN, set(), repr(text))

    def test_nothing_of_titles_names_and_hosts_reaches_it_raw(self):
        title = EVIL.encode("unicode_escape").decode().replace("\\x", "\\u00")
        self.write(f'title = "{title}"\n' + SMALL_SCENE.split("\n", 1)[1])
        name = "run" + EVIL
        results = [self.expect(DONE, *arguments) for arguments in (
            ["validate", "scene.toml"], ["run", "scene.toml", "-o", name], ["info", name], ["info", name, "--json"],
            ["analyze", name], ["verify", name], ["resume", name], ["field", name, "-o", "flow" + EVIL + ".vti", "--points", "5"],
            ["run", "scene.toml", "-o", "x", "--dry-run"])]
        results += [self.skein(*arguments) for arguments in (
            ["info", "none" + EVIL], ["run", "none" + EVIL, "-o", "x"], ["verb" + EVIL], ["info", "--" + EVIL],
            ["plot", "none" + EVIL], ["validate", "scene.toml", "--set", EVIL + "=1"],
            ["validate", "scene.toml", "--set", f"flow.kind='{EVIL}'"], ["run", "scene.toml", "-o", name],
            ["run", "scene.toml", "-o", "x", "--max-walltime", EVIL], ["field", name, "-o", "y.vti", "--plane", EVIL], ["field", name, "-o", "y" + EVIL])]
        (self.folder / name / "lock").write_text(f"host evil{EVIL.replace(' ', '')}\nprocess 1\nbegan 1@1\n")
        results.append(self.skein("resume", name))
        self.assertIn("left by process 1", results[-1].stderr)
        for result in results:
            self.check_clean(result.stdout)
            self.check_clean(result.stderr)
        self.check_clean((self.folder / name / "run.log").read_text())

    def test_pictures_path_is_as_it_is_for_programs_alone(self):
        import pty

        run = self.make_run("run\033[2J")
        result = self.expect(DONE, "plot", run.name)
        self.assertTrue(pathlib.Path(result.stdout.splitlines()[0]).is_file())
        self.check_clean(result.stderr)
        master, slave = pty.openpty()
        self.addCleanup(os.close, master)
        result = self.skein("plot", run.name, "--times", "0", stdout=slave)
        os.close(slave)
        self.check_clean(os.read(master, 65536).decode().replace("\r\n", "\n"))


class PythonsEnvironment(InFreshFolder):
    """Module systems set it for another Python, and the current folder may be somebody else's."""

    def setUp(self):
        super().setUp()
        self.make_run()
        self.trap = self.folder / "trap"
        self.trap.mkdir()
        for name in ("numpy", "matplotlib", "h5py", "os", "isolation", "sitecustomize", "usercustomize"):
            (self.trap / f"{name}.py").write_text("open('sprung', 'w').close()\nraise ImportError('of another Python')\n")
        evil = self.trap / "ffmpeg"
        evil.write_text("#!/bin/sh\ntouch sprung\n")
        evil.chmod(0o755)
        (self.trap / "matplotlibrc").write_text("animation.ffmpeg_path: ./ffmpeg\nbackend: nonsense\nfont.size: 40\n")

    def plot(self, **environment):
        result = skein("plot", self.folder / "run", "--format", "svg", cwd=self.trap, environment=environment)
        self.assertEqual((result.returncode, result.stderr), (DONE, ""))
        self.assertFalse((self.trap / "sprung").exists())
        return (self.folder / "run/plots/angle.svg").read_text()

    def test_pictures_do_not_depend_on_it(self):
        trap = str(self.trap)
        sizes = [self.plot().count("font:") for _ in range(1)]
        picture = self.plot(PYTHONPATH=trap, PYTHONHOME="/nowhere", PYTHONSTARTUP=trap, PYTHONUSERBASE=trap,
                            MPLBACKEND="nonsense", MATPLOTLIBRC=trap, MPLCONFIGDIR=trap, HOME="/nonexistent")
        self.assertEqual(picture.count("font:"), sizes[0])
        self.assertNotIn("40px", picture)

    def test_a_movie_is_made_by_no_program_of_the_current_folder(self):
        result = skein("plot", self.folder / "run", "--movie", cwd=self.trap,
                       environment={"PATH": f".::{os.environ['PATH']}"})
        self.assertFalse((self.trap / "sprung").exists())
        made = shutil.which("ffmpeg") is not None
        self.assertEqual(result.returncode, DONE if made else 66, result.stderr)
        self.assertEqual((self.folder / "run/plots/movie.mp4").exists(), made)
        self.assertEqual(list(self.folder.rglob("*.partial")), [])


if __name__ == "__main__":
    main()
