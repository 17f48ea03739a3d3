"""The command line as users and scripts meet it: messages, exit codes, and nothing written after an error.

Called as test_cli.py PROGRAM SOURCES, PROGRAM being the binary and SOURCES the root of the sources.
Each bad_scenes/*.toml begins with the lines that the program must print about it:
    #! file:line:column: message     (an end "..." stands for any text: the TOML parser's own words)
    #$ arguments                     (added to the command)
"""

import json
import os
import pathlib
import subprocess

from cli_case import DONE, IO_ERROR, MISSING_INPUT, PROGRAM, SCENE_ERROR, SOURCES, USAGE, InFreshFolder, main, skein


def problem_lines(stderr):
    """The problems in a message: all but the heading and the indented docs."""
    return [line for line in stderr.splitlines()[1:] if not line.startswith(" ")]


def matches(line, expected):
    return line.startswith(expected[:-3]) if expected.endswith("...") else line == expected


class BadScenes(InFreshFolder):
    def test_every_bad_scene_is_refused_with_its_messages(self):
        scenes = sorted((SOURCES / "tests/cli/bad_scenes").glob("*.toml"))
        self.assertGreaterEqual(len(scenes), 28)
        for scene in scenes:
            lines = scene.read_text().splitlines()
            expected = [line[3:] for line in lines if line.startswith("#! ")]
            arguments = [word for line in lines if line.startswith("#$ ") for word in line[3:].split()]
            run_folder = self.folder / "result"
            for verb in (["validate", scene.name], ["run", scene.name, "-o", run_folder]):
                with self.subTest(scene=scene.name, verb=verb[0]):
                    result = skein(*verb, *arguments, cwd=scene.parent)
                    self.assertEqual(result.returncode, SCENE_ERROR, result.stderr)
                    self.assertEqual(result.stdout, "")
                    found = problem_lines(result.stderr)
                    self.assertGreater(len(expected), 0)
                    self.assertEqual(len(found), len(expected), result.stderr)
                    for line, wanted in zip(found, expected):
                        self.assertTrue(matches(line, wanted), f"\nfound    {line}\nexpected {wanted}")
                    self.assertFalse(run_folder.exists(), "an output was made")

    def check_single(self, content, expected):
        result = self.validate_content(content)
        self.assertEqual(result.returncode, SCENE_ERROR, result.stderr)
        self.assertEqual(len(problem_lines(result.stderr)), 1)
        self.assertIn(expected, result.stderr)

    def test_a_scene_through_a_pipe_is_refused_as_one_in_a_file(self):
        """Also for what is only known once fibers are placed: a pipe gives its bytes once."""
        through_pipe = ("sh", "-c", 'cat "$3" | "$0" "$1" "$2"')
        scene = SOURCES / "tests/cli/bad_scenes/overlap.toml"
        result = skein("validate", "/dev/stdin", scene, before=through_pipe)
        self.assertEqual(result.returncode, SCENE_ERROR, result.stderr)
        expected = scene.read_text().splitlines()[0].removeprefix("#! overlap.toml")
        self.assertEqual(problem_lines(result.stderr), [f"/dev/stdin{expected}"])

    def test_a_far_field_is_asked_of_placed_fibers(self):
        """Not of one fiber that is to be placed many times, and is short."""
        near = (SOURCES / "tests/cli/bad_scenes/fmm_blob_against_placed.toml").read_text()
        far = self.validate_content(near.replace("grid = [2, 2, 2]", "grid = [12, 2, 2]"))
        self.assertEqual(far.returncode, DONE, far.stderr)
        self.assertIn("fast multipole method", far.stdout)

    def test_an_empty_file_is_called_empty(self):
        self.check_single("", "scene.toml:1:1: the file is empty")
        self.check_single(" \n\t\n", "scene.toml:1:1: the file is empty")

    def test_a_binary_file_is_called_binary(self):
        self.check_single(pathlib.Path(PROGRAM).read_bytes()[:4096], "scene.toml:1:1: this is a binary file")

    def test_invalid_utf8_is_found_at_its_place(self):
        self.check_single(b'[fiber]\n\ntitle = "a\xff"\n', "scene.toml:3:")

    def test_a_file_of_more_than_64_mib_is_refused(self):
        self.check_single("[fiber]\n" + "#" * (64 * 1024 * 1024), "64 MiB")
        result = self.validate_content("[fiber]\n" + "#" * (15 * 1024 * 1024))
        self.assertEqual(result.returncode, DONE, result.stderr)

    def test_deep_nesting_does_not_exhaust_the_stack(self):
        deep_key = ".".join(["a"] * 2_000_000) + " = 1\n"
        nested_inline = "x = " + "{" + ".".join(["b"] * 31) + " = "
        for content in ["[fiber]\nx = " + "[" * 1_000_000, "[fiber]\n" + deep_key, "[" + deep_key[:-5] + "]\n"]:
            self.check_single(content, "not valid TOML")
        depth = 200
        self.check_single("[fiber]\n" + nested_inline + ("{" + ".".join(["b"] * 31) + " = ") * depth + "1"
                          + "}" * (depth + 1), "unknown key 'x' in [fiber]")

    def test_control_characters_of_a_scene_do_not_reach_the_terminal(self):
        result = self.validate_content('[fiber]\n"a\\u001b[31m" = 1\n')
        self.assertEqual(result.returncode, SCENE_ERROR)
        self.assertNotIn("\033", result.stderr)

    def test_a_doc_line_follows_the_problem(self):
        result = self.validate_content("[fiber]\nblobb = 1.0\n")
        self.assertTrue(result.stderr.splitlines()[2].startswith("    fiber.blob: "), result.stderr)

    def test_problems_as_json(self):
        result = self.validate_content("[fiber]\nblob = -1.0\n", "--json", "--set", "flow.rate=fast")
        self.assertEqual(result.returncode, SCENE_ERROR)
        report = json.loads(result.stdout)
        self.assertFalse(report["valid"])
        first, second = report["problems"]
        self.assertEqual((first["source"], first["line"], first["column"]), ("scene.toml", 2, 8))
        self.assertEqual((second["source"], second["line"]), ("--set flow.rate=fast", 0))


class GoodScenes(InFreshFolder):
    def test_every_shipped_scene_is_valid_without_a_warning(self):
        scenes = sorted((SOURCES / "configs").glob("*.toml"))
        self.assertGreaterEqual(len(scenes), 16)
        for scene in scenes:
            with self.subTest(scene=scene.name):
                result = skein("validate", scene)
                self.assertEqual((result.returncode, result.stderr), (DONE, ""))
                self.assertRegex(result.stdout, r"\d{4} nodes")
                self.assertRegex(scene.read_text(), r"^# \w[^\n]{40}", "the first lines say what it shows")
                self.assertRegex(result.stdout, r"(?m)^mobility: ")

    def test_defaults_are_a_valid_scene(self):
        result = skein("defaults")
        self.assertEqual(result.returncode, DONE)
        validated = self.validate_content(result.stdout)
        self.assertEqual((validated.returncode, validated.stderr), (DONE, ""))

    def test_the_reference_page_is_up_to_date(self):
        page = (SOURCES / "docs/scene.md").read_text()
        self.assertEqual(skein("defaults", "--markdown").stdout, page, "run: skein defaults --markdown > docs/scene.md")

    def test_an_override_changes_the_scene(self):
        for count, n_nodes in ((40, 720), (50, 900)):
            result = self.validate_content("[fiber]\nsections = 20\n", "--set", f"fiber.sections={count}")
            self.assertIn(f"{n_nodes} nodes", result.stdout)

    def test_the_method_is_named_with_its_reason(self):
        for overrides, expected in [
            ([], "direct sum, pairs in double precision; chosen because"),
            (["fiber.sections=301"], "harmonic far field of order 6 in single precision"),
            (["fiber.sections=301", "time.tolerance=1e-5"], "order 7 in single precision"),
            (["fiber.sections=301", "time.step=1e-3"], "order 7 in single precision"),
            (["fiber.sections=101", "hydrodynamics.tolerance=1e-9"], "chosen because with blobs of 0.00225"),
            (["fiber.sections=301", "hydrodynamics.tolerance=1e-12"], "chosen because tolerance = 1e-12 is below"),
            (["hydrodynamics.method=direct", "hydrodynamics.precision=single"], "pairs in single precision"),
            (["hydrodynamics.method=fmm", "hydrodynamics.precision=double", "hydrodynamics.check_every=0",
              "hydrodynamics.order=9", "hydrodynamics.tolerance=1e-5"], "order 9 in double precision, about 90 nodes a leaf of half-width 0.00663 or more "
              "(for the blobs), tails of the blobs by polynomials of degree 4, error of at most 3e-07 expected by the order and 1e-05 by the blobs, 1e-05 allowed; never "
              "checked"),
        ]:
            with self.subTest(overrides=overrides):
                arguments = [word for override in overrides for word in ("--set", override)]
                result = self.validate_content("[fiber]\n", *arguments)
                self.assertEqual((result.returncode, result.stderr), (DONE, ""))
                line, rungs, contact = result.stdout.splitlines()[-3:]
                self.assertTrue(line.startswith("mobility: "))
                self.assertIn(expected, line)
                self.assertTrue(rungs.startswith("resolution: "))
                self.assertTrue(contact.startswith("contact: "))

    def test_a_doubtful_blob_is_warned_of(self):
        for blob, word in (("0.006", "too thick"), ("0.0008", "leaks")):
            result = self.validate_content(f"[fiber]\nblob = {blob}\n")
            self.assertEqual(result.returncode, DONE)
            self.assertRegex(result.stderr, rf"^skein: warning: scene.toml:2:8: fiber.blob .*{word}")
            report = json.loads(self.validate_content(f"[fiber]\nblob = {blob}\n", "--json").stdout)
            self.assertTrue(report["valid"])
            self.assertEqual(len(report["warnings"]), 1)


class CommandLine(InFreshFolder):
    def check_usage_error(self, arguments, expected):
        result = skein(*arguments, cwd=self.folder)
        self.assertEqual((result.returncode, result.stdout), (USAGE, ""), result.stderr)
        self.assertIn(expected, result.stderr)
        self.assertTrue(result.stderr.startswith("skein: "))
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_wrong_usage_is_explained(self):
        for arguments, expected in [
            ([], "A subcommand is required"),
            (["rnu", "scene.toml"], "unknown verb 'rnu'; did you mean 'run'?"),
            (["xyzzy"], "unknown verb 'xyzzy'"),
            (["help", "rnu"], "unknown verb 'rnu'; did you mean 'run'?"),
            (["help", "run", "resume"], "unexpected argument 'resume'"),
            (["completion"], "shell is required"),
            (["completion", "fish"], "fish"),
            (["--verson"], "unknown option '--verson'; did you mean '--version'?"),
            (["run", "scene.toml"], "--output"),
            (["run", "scene.toml", "--outptu", "result"], "unknown option '--outptu'; did you mean '--output'?"),
            (["run", "-o", "result"], "scene is required"),
            (["run", "scene.toml", "-o", "result", "--overwite"], "did you mean '--overwrite'?"),
            (["run", "scene.toml", "-o", "result", "--threads", "0"], "--threads"),
            (["run", "scene.toml", "-o", "result", "--threads", "two"], "--threads"),
            (["run", "scene.toml", "-o", "result", "--max-walltime", "soon"], "'soon' is no duration"),
            (["run", "scene.toml", "-o", "result", "-q", "-v"], "unknown option '-v'"),
            (["field", "result", "-o", "end.vti", "--frame", "1", "--time", "2"], "--frame excludes --time"),
            (["validate", "a.toml", "b.toml"], "unexpected argument 'b.toml'"),
            (["plot", "result", "--times", "early"], "--times"),
        ]:
            with self.subTest(arguments=arguments):
                self.check_usage_error(arguments, expected)

    def test_a_missing_input_is_named(self):
        for arguments in (["validate", "none.toml"], ["run", "none.toml", "-o", "result"], ["info", "none"],
                          ["resume", "none"], ["verify", "none"], ["plot", "none"], ["validate", "."]):
            with self.subTest(arguments=arguments):
                result = skein(*arguments, cwd=self.folder)
                self.assertEqual((result.returncode, result.stdout), (MISSING_INPUT, ""), result.stderr)
                self.assertIn(arguments[1], result.stderr)
                self.assertEqual(list(self.folder.iterdir()), [])

    def test_help_has_examples(self):
        for verb in ([], ["run"], ["resume"], ["verify"], ["validate"], ["defaults"], ["info"], ["plot"]):
            with self.subTest(verb=verb):
                result = skein(*verb, "--help")
                self.assertEqual((result.returncode, result.stderr), (DONE, ""))
                self.assertIn("Examples:\n  skein ", result.stdout)

    def test_the_verb_help_says_what_the_option_says(self):
        self.assertEqual(skein("help").stdout, skein("--help").stdout)
        for verb in ("run", "resume", "help", "completion"):
            with self.subTest(verb=verb):
                result = skein("help", verb)
                self.assertEqual((result.returncode, result.stderr), (DONE, ""))
                self.assertEqual(result.stdout, skein(verb, "--help").stdout)
                self.assertIn(f"skein {verb}", result.stdout)

    def test_version_tells_the_build(self):
        result = skein("--version")
        self.assertEqual(skein("-V").stdout, result.stdout)
        self.assertEqual((result.returncode, result.stderr), (DONE, ""))
        for name in ("skein: ", "commit: ", "compiler: ", "Kokkos: ", "backend: "):
            self.assertIn(name, result.stdout)

    def test_a_full_disk_behind_stdout_is_an_error(self):
        if not os.path.exists("/dev/full"):
            self.skipTest("there is no /dev/full")
        for arguments in (["defaults"], ["--help"], ["run", "--help"], ["--version"]):
            with self.subTest(arguments=arguments), open("/dev/full", "w") as full:
                result = subprocess.run([PROGRAM, *arguments], stdout=full, stderr=subprocess.PIPE, text=True, timeout=60)
                self.assertEqual(result.returncode, IO_ERROR)
                self.assertIn("standard output", result.stderr)


class WhatARunWrites(InFreshFolder):
    """is read back: refused before the first byte, or good for verify and resume."""

    TINY = "[fiber]\nsections = 4\nnodes_per_section = 3\nblob = 0.0045\n[time]\nend = 0.05\n"
    LATIN_1 = "caf\udce9"  # the byte 0xe9 alone

    def run_to_the_end(self, folder, *arguments):
        self.write(self.TINY)
        result = skein("run", "scene.toml", "-o", folder, "-q", *arguments, cwd=self.folder)
        self.assertEqual(result.returncode, DONE, result.stderr)
        for verb in (["verify"], ["info"], ["resume", "-q"], ["analyze"]):
            result = skein(*verb, folder, cwd=self.folder)
            self.assertEqual(result.returncode, DONE, f"{verb}: {result.stderr}")

    def test_a_title_in_another_encoding_is_refused(self):
        self.write(self.TINY)
        for title in (self.LATIN_1, f'"{self.LATIN_1}"', "\udced\udca0\udc80"):
            result = skein("run", "scene.toml", "-o", "result", "-q", "--set", f"title={title}", cwd=self.folder)
            self.assertEqual(result.returncode, SCENE_ERROR, result.stderr)
            self.assertIn("is no UTF-8", result.stderr)
            self.assertEqual([path.name for path in self.folder.iterdir()], ["scene.toml"])

    def test_unusual_titles_serve(self):
        titles = ("caf\u00e9 \u6587 \U0001f9ec", '"a\\u0085\\u200f\\\\\\"b"', "\u00ad\ufffe \u2028")
        for number, title in enumerate(titles):
            self.run_to_the_end(f"result{number}", "--set", f"title={title}")

    def test_verify_says_what_it_does_not_look_at(self):
        self.make_run()
        (self.folder / "run/trajectory.xdmf").write_text("")
        self.assertIn("not looked at: trajectory.xdmf", self.expect(DONE, "verify", "run").stdout)

    def test_a_folder_whose_name_is_no_utf8_serves(self):
        self.run_to_the_end(self.LATIN_1)

    def test_a_scene_that_grows_too_large_by_its_escapes_is_refused(self):
        self.write('title = "' + "\\b" * 12_000_000 + '"\n' + self.TINY)  # each is written as \u0008
        result = skein("run", "scene.toml", "-o", "result", "-q", cwd=self.folder)
        self.assertEqual(result.returncode, SCENE_ERROR, result.stderr)
        self.assertIn("no more than 64 MiB", result.stderr)
        self.assertEqual([path.name for path in self.folder.iterdir()], ["scene.toml"])


class Threads(InFreshFolder):
    def test_bound_threads_get_a_processor_each(self):
        if len(os.sched_getaffinity(0)) < 2 or "backend: OpenMP" not in skein("--version").stdout:
            self.skipTest("needs two processors and OpenMP")
        scene = (pathlib.Path(SOURCES) / "configs" / "tumbling.toml").resolve()
        kept = {name: value for name, value in os.environ.items()
                if name not in ("OMP_WAIT_POLICY", "GOMP_SPINCOUNT", "OMP_PLACES")}
        result = subprocess.run(
            [PROGRAM, "run", scene, "-o", "result", "--set", "time.end=1e-6", "-q", "--threads", "2"], cwd=self.folder,
            env={**kept, "OMP_PROC_BIND": "true", "OMP_DISPLAY_AFFINITY": "true", "OMP_AFFINITY_FORMAT": "on %A"},
            capture_output=True, text=True, timeout=60)
        self.assertEqual(result.returncode, DONE, result.stderr)
        lines = [line for line in result.stderr.splitlines() if line.startswith("on ")]
        self.assertGreaterEqual(len(set(lines)), 2, result.stderr)


class OnATerminal(InFreshFolder):
    def error_on_terminal(self, **environment):
        import pty

        master, slave = pty.openpty()
        try:
            variables = {name: value for name, value in os.environ.items() if name != "NO_COLOR"}
            subprocess.run([PROGRAM, "rnu"], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=slave,
                           env={**variables, "TERM": "xterm", **environment}, timeout=60)
            return os.read(master, 4096).decode()
        finally:
            os.close(master)
            os.close(slave)

    def test_colour_is_for_terminals_that_want_it(self):
        self.assertIn("\033[1;31mskein:", self.error_on_terminal())
        self.assertNotIn("\033", self.error_on_terminal(NO_COLOR="1"))
        self.assertNotIn("\033", self.error_on_terminal(TERM="dumb"))
        self.assertNotIn("\033", skein("rnu", environment={"TERM": "xterm"}).stderr)


if __name__ == "__main__":
    main()
