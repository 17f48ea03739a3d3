"""What bash makes of `skein completion bash`: a real bash, which is given the script and asked what it would complete.

Called as check_completion.py PROGRAM BASH. One case types into bash on a terminal, with a tab; the others call the function
that the script gave to bash with the words as bash splits them.
"""

import os
import pathlib
import pty
import re
import select
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM = BASH = None  # set from the arguments at the end

ASK = """
source "$1"; shift
compopt() { :; }  # knows no completion that is under way
COMP_WORDS=(skein "$@"); COMP_CWORD=$#; COMP_LINE="${COMP_WORDS[*]}"
"$(complete -p skein | sed 's/.*-F \\([^ ]*\\).*/\\1/')"
((${#COMPREPLY[@]})) && printf '%s\\n' "${COMPREPLY[@]}"
exit 0
"""


def skein(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=True, timeout=60).stdout


def split_as_bash_does(line):
    """Words of a line that has no quotes: "=" is a word of its own. The last one is the one under the cursor."""
    words = []
    for word in line.split(" "):
        words += [part for part in re.split("(=)", word) if part] or [""]
    return words


class Completion(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.script = self.folder / ".script"
        self.script.write_text(skein("completion", "bash"))
        (self.folder / "scene.toml").write_text("[fiber]\n")
        (self.folder / "a run").mkdir()
        (self.folder / "result").mkdir()

    def complete(self, line, breaks=None):
        words = split_as_bash_does(line) if breaks is None else line.split(" ")
        ask = ASK if breaks is None else f"COMP_WORDBREAKS='{breaks}'\n" + ASK
        result = subprocess.run([BASH, "--norc", "-c", ask, "bash", self.script, *words], cwd=self.folder, text=True,
                                capture_output=True, timeout=60)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return result.stdout.splitlines()

    def test_it_is_sound_bash(self):
        subprocess.run([BASH, "-n", self.script], check=True, timeout=60)

    def test_every_verb_of_the_help_text_is_offered(self):
        listed = re.findall(r"^  ([a-z]+)  +[A-Z]", skein("--help").split("Subcommands:")[-1].split("SUBCOMMANDS:")[-1],
                            re.MULTILINE)
        self.assertGreaterEqual(len(listed), 13)
        self.assertEqual(self.complete(""), [*listed, "-h", "--help", "-V", "--version"])
        self.assertEqual(self.complete("re"), [verb for verb in listed if verb.startswith("re")])
        self.assertEqual(self.complete("help ver"), ["verify"])

    def test_every_option_of_a_verbs_help_text_is_offered(self):
        for verb in self.complete(""):
            if verb.startswith("-"):
                continue
            with self.subTest(verb=verb):
                options = re.findall(r"^  (-[^ ]+)", skein(verb, "--help"), re.MULTILINE)
                listed = {name for names in options for name in names.split(",")}
                self.assertEqual(set(self.complete(f"{verb} -")), listed)
                for word in self.complete(f"{verb} --"):
                    self.assertTrue(word.startswith("--"))

    def test_every_key_of_a_scene_is_offered_after_set(self):
        table, keys = "", []
        for line in skein("defaults").splitlines():
            line = line.removeprefix("# ")
            if found := re.fullmatch(r"\[([a-z]+)\]", line):
                table = found[1] + "."
            elif found := re.match(r"([a-z_]+) = ", line):
                keys.append(table + found[1] + "=")
        self.assertGreater(len(keys), 60)
        self.assertEqual(self.complete("run scene.toml --set "), keys)
        self.assertEqual(self.complete("validate scene.toml --set time.me"), ["time.method="])
        self.assertEqual(self.complete("phases --perturbation fiber.start_a"), ["fiber.start_amplitude="])
        self.assertEqual(self.complete("run scene.toml --set fiber[1].rad"), ["fiber[1].radius="])

    def test_a_choices_words_are_offered_behind_its_key(self):
        self.assertEqual(self.complete("run s --set hydrodynamics.method="), ["auto", "direct", "fmm"])
        self.assertEqual(self.complete("run s --set time.method=r"), ["rkc2", "rk4"])
        self.assertEqual(self.complete("run s --set=time.method=tr"), ["trbdf2"])
        self.assertEqual(self.complete("run s --set flow[2].kind=v"), ["vortices"])
        self.assertEqual(self.complete("run s --set time.end="), [])

    def test_words_of_options_and_places(self):
        self.assertEqual(self.complete("plot result --format "), ["png", "pdf", "svg"])
        self.assertEqual(self.complete("plot --format=p"), ["png", "pdf"])
        self.assertEqual(self.complete("reproduce "), ["lagrone2019"])
        self.assertIn("figure7", self.complete("reproduce lagrone2019 f"))
        self.assertEqual(self.complete("completion "), ["bash"])

    def test_files_and_folders(self):
        self.assertEqual(sorted(self.complete("run ")), [".script", "a run", "result", "scene.toml"])
        self.assertEqual(sorted(self.complete("run scene.toml -o ")), ["a run", "result"])
        self.assertEqual(self.complete("run --output=res"), ["result"])
        self.assertEqual(self.complete("resume --threads 2 r"), ["result"])
        self.assertEqual(self.complete("resume result "), [])
        self.assertEqual(self.complete("run scene.toml --threads "), [])
        self.assertEqual(self.complete("run --quiet s"), ["scene.toml"])
        self.assertEqual(self.complete("run --from r"), ["result"])

    def test_where_equal_signs_do_not_break_words(self):
        self.assertEqual(self.complete("run s --set time.method=r", breaks=" :"), ["time.method=rkc2", "time.method=rk4"])
        self.assertEqual(self.complete("run --output=res", breaks=" :"), ["--output=result"])

    def test_a_tab_on_a_terminal(self):
        child, terminal = pty.fork()
        if child == 0:
            os.chdir(self.folder)
            os.execve(BASH, [BASH, "--norc", "--noprofile", "-i"], {"PATH": os.environ["PATH"], "TERM": "dumb", "PS1": "$ "})
        try:
            os.write(terminal, b"skein() { printf '<%s>' \"$@\"; echo; }; source .script\n")
            os.write(terminal, b"skein validate sc\t--se\ttime.meth\ttrb\t--js\t\n")
            seen, limit = b"", time.monotonic() + 30
            wanted = b"<validate><scene.toml><--set><time.method=trbdf2><--json>"
            while wanted not in seen and time.monotonic() < limit:
                if select.select([terminal], [], [], 0.2)[0]:
                    seen += os.read(terminal, 4096)
            self.assertIn(wanted, seen)
        finally:
            os.write(terminal, b"\x03\nexit\n")
            os.close(terminal)
            os.waitpid(child, 0)


if __name__ == "__main__":
    PROGRAM, BASH = sys.argv[1], sys.argv[2]
    unittest.main(argv=sys.argv[:1])
