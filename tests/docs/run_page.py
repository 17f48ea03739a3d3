"""Runs the code blocks of a page in order, in a folder of its own: run_page.py PAGE PROGRAM SOURCES BUILD.

The folder looks like a clone that has been built: configs, examples, perf, tools and build/openmp are there, and `skein` is
on PATH and in Python. Shell blocks run by bash, Python blocks share their names, TOML is written to the file that a comment
names or, without one, has to be a scene; C++ stands in a file that is tested elsewhere. A text block is what the block before
it prints: its lines come in this order, `...` stands for anything. page_blocks.py says how a page marks what cannot run.
"""

import contextlib
import io
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import traceback

from page_blocks import read_blocks

LINKED = ("configs", "examples", "perf", "tools", "docs", "include")


class Failure(Exception):
    """Of a block."""


class Runner:
    def __init__(self, program, sources, build, folder):
        self.program, self.sources, self.folder = pathlib.Path(program), pathlib.Path(sources), pathlib.Path(folder)
        self.names = {"__name__": "__main__"}
        self.output = None  # of the last block that ran
        for name in LINKED:
            (self.folder / name).symlink_to(self.sources / name)
        (self.folder / "build").mkdir()
        (self.folder / "build/openmp").symlink_to(build)
        tools = self.folder / ".tools"
        tools.mkdir()
        python = tools / "python3"  # the one that has numpy and h5py, whichever is first on PATH
        python.write_text(f'#!/bin/sh\nexec "{sys.executable}" "$@"\n')
        python.chmod(0o755)
        os.environ["PATH"] = f"{tools}:{self.program.parent}:{os.environ['PATH']}"

    def run(self, block):
        remarks = block.remarks
        if "not run" in remarks:
            self.output = None
            return f"not run: {remarks['not run']}"
        if "before" in remarks:
            self.call_shell(remarks["before"])
        if "from" in remarks and block.language != "cpp" or "file" in remarks and block.language != "toml":
            raise Failure(f"'file' is for TOML, 'from' for C++, and this is {block.language}")
        getattr(self, f"run_{block.language}")(block)
        return "runs"

    def call_shell(self, text):
        done = subprocess.run(["bash", "-euo", "pipefail", "-c", text], cwd=self.folder, text=True, errors="replace",
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=300)
        if done.returncode:
            raise Failure(f"exit code {done.returncode}:\n{done.stdout[-4000:]}")
        return done.stdout

    def run_sh(self, block):
        self.output = self.call_shell(block.text)

    def run_python(self, block):
        said = io.StringIO()
        try:
            with contextlib.redirect_stdout(said), contextlib.chdir(self.folder):
                exec(compile("\n" * block.line + block.text, "page", "exec"), self.names)  # lines are those of the page
        except Exception:
            raise Failure(traceback.format_exc(limit=-3)) from None
        finally:
            self.output = said.getvalue()

    def run_toml(self, block):
        name = block.remarks.get("file", "")
        path = self.folder / (name.lstrip("+") or "a_scene_of_the_page.toml")
        with open(path, "a" if name.startswith("+") else "w", encoding="utf-8") as file:
            file.write(block.text)
            if not name and "[fiber]" not in block.text and "[[fiber]]" not in block.text:
                file.write("\n[fiber]\n")  # tables that a page shows are of a scene that has a fiber, too
        if "[[parameter]]" in path.read_text():
            return  # a sweep, which another block runs
        done = subprocess.run([self.program, "validate", path], capture_output=True, text=True, timeout=60)
        self.output = done.stdout + done.stderr
        if done.returncode:
            raise Failure(f"this is no scene:\n{self.output}")

    def run_cpp(self, block):
        path = block.remarks.get("from")
        if not path:
            raise Failure("C++ says by a comment in which file it stands: <!-- from: PATH -->")
        if block.text.rstrip("\n") not in (self.sources / path).read_text(encoding="utf-8"):
            raise Failure(f"this does not stand so in {path}")

    def run_text(self, block):
        if self.output is None:
            raise Failure("there is nothing before it that prints")
        printed = iter([" ".join(line.split()) for line in self.output.splitlines()])
        for line in block.text.splitlines():
            pattern = re.compile(".*".join(map(re.escape, " ".join(line.split()).split("..."))))
            if not any(pattern.fullmatch(other) for other in printed):
                raise Failure(f"nothing like this line is printed, or not here: {line}\n--- printed:\n{self.output}")


def main(page, program, sources, build):
    blocks, problems = read_blocks(pathlib.Path(page).read_text(encoding="utf-8"))
    for line, words in problems:
        print(f"{page}:{line}: {words}")
    with tempfile.TemporaryDirectory() as folder:
        runner = Runner(program, sources, build, folder)
        for block in blocks:
            if problems:
                break
            try:
                print(f"{page}:{block.line}: {block.language} {runner.run(block)}", flush=True)
            except (Failure, subprocess.TimeoutExpired) as failure:
                print(f"{page}:{block.line}: {block.language}: {failure}")
                return 1
        runner.names.clear()
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
