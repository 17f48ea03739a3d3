"""usage: compile_commands.py BUILD > compile_commands.json

The compile commands of a build folder, without what ties them to that build: output, a cache, and g++'s precompiled headers,
on which clang's tools stop. Without the checks of the house it serves editors.
"""

import json
import re
import shlex
import sys
from pathlib import Path

WITH_ARGUMENT = ("-o", "-include", "-MF", "-MT")
LEFT_OUT = ("-c", "-Winvalid-pch", "-fpch-preprocess", "-MD", "-MMD")


def read_commands(build):
    """{source: (compiler, options)}"""
    commands = {}
    for entry in json.loads((Path(build) / "compile_commands.json").read_text(encoding="utf-8")):
        words = shlex.split(entry["command"])
        while not Path(words[0]).name.split("-")[0].startswith(("c++", "g++", "clang", "nvcc", "hipcc")):
            words.pop(0)  # env, ccache and their like
        source, options, at = entry["file"], [], 1
        sources = read_united(source)
        while at < len(words):
            if words[at] in WITH_ARGUMENT:
                at += 2
                continue
            if words[at] not in LEFT_OUT and words[at] != source:
                options.append(words[at])
            at += 1
        commands.update((source, (words[0], options)) for source in sources)
    return commands


def read_united(source):
    """The sources that one of CMake's united ones includes; any other is by itself."""
    if Path(source).parent.name != "Unity":
        return [source]
    return re.findall(r'^#include "(.*)"$', Path(source).read_text(encoding="utf-8"), re.MULTILINE)


def main(build):
    entries = [{"directory": str(Path(build).resolve()), "file": source, "arguments": [compiler, *options, "-c", source]}
               for source, (compiler, options) in read_commands(build).items()]
    json.dump(entries, sys.stdout, indent=1)


if __name__ == "__main__":
    main(sys.argv[1])
