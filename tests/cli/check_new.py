"""What a new user starts from: the scenes that come with the program, and the manual's page.

Called as check_new.py PROGRAM SOURCES.
"""

import re
import tomllib

from cli_case import CANNOT_CREATE, DONE, SOURCES, USAGE, InFreshFolder, main


class NewScenes(InFreshFolder):
    def setUp(self):
        super().setUp()
        self.examples = {path.stem: path for path in (SOURCES / "configs").glob("*.toml")}

    def test_all_are_listed_with_their_titles(self):
        lines = self.expect(DONE, "new", "--list").stdout.splitlines()
        self.assertEqual([line.split()[0] for line in lines], sorted(self.examples))
        for line in lines:
            name, title = line.split(maxsplit=1)
            self.assertEqual(title, tomllib.loads(self.examples[name].read_text(encoding="utf-8"))["title"])

    def test_each_is_written_as_it_is_and_is_sound(self):
        for name, path in self.examples.items():
            with self.subTest(name=name):
                said = self.expect(DONE, "new", name).stdout
                self.assertIn(f"skein run {name}.toml -o {name}", said)
                self.assertEqual((self.folder / f"{name}.toml").read_bytes(), path.read_bytes())
                self.expect(DONE, "validate", f"{name}.toml")
        self.assertEqual(len(list(self.folder.iterdir())), len(self.examples))

    def test_what_is_there_stays(self):
        self.write("# my notes", "tumbling.toml")
        self.assertIn("-o FILE", self.expect(CANNOT_CREATE, "new", "tumbling").stderr)
        self.expect(DONE, "new", "tumbling", "-o", "other.toml")
        self.expect(CANNOT_CREATE, "new", "short_fiber", "-o", "other.toml")
        self.assertEqual((self.folder / "tumbling.toml").read_text(), "# my notes")
        self.assertEqual((self.folder / "other.toml").read_bytes(), self.examples["tumbling"].read_bytes())

    def test_names_that_there_are_none_of(self):
        self.assertIn("--list", self.expect(USAGE, "new").stderr)
        for name in ("tumblin", "", "../configs/tumbling", "sweeps/regimes", "tumbling.toml"):
            self.assertIn("tumbling" if name else "nothing is written there", self.expect(USAGE, "new", name).stderr)
        self.assertEqual(list(self.folder.iterdir()), [])


class ManPage(InFreshFolder):
    def test_it_has_every_verb_with_every_option(self):
        page = self.expect(DONE, "help", "--man").stdout
        plain = page.replace("\\-", "-").replace("\\fB", "").replace("\\fR", "").replace("\\fI", "")
        sections = dict(re.findall(r"^\.SS skein (\w+)(.*?)(?=^\.S[SH] )", plain, re.DOTALL | re.MULTILINE))
        listed = self.expect(DONE, "help").stdout.split("Subcommands:")[1].split("\n\n")[0]
        self.assertEqual(sorted(sections), sorted(re.findall(r"^  (\w+) ", listed, re.MULTILINE)))
        for verb, section in sections.items():
            named = re.findall(r"^\s+(?:-\w,)?(--[\w-]+)", self.expect(DONE, "help", verb).stdout, re.MULTILINE)
            for option in named:
                if option != "--help":
                    self.assertRegex(section, rf"\n(-\w, )?{option}\b", verb)

    def test_lines_are_text_or_what_man_knows(self):
        known = {"TH", "SH", "SS", "TP", "PP", "B", "nf", "fi", '\\"'}
        for line in self.expect(DONE, "help", "--man").stdout.splitlines():
            if line.startswith("."):
                self.assertIn(line[1:].split()[0], known, line)
            self.assertFalse(line.startswith("'"), line)


if __name__ == "__main__":
    main()
