"""The compile commands of a build folder, without what ties them to that build: output, precompiled headers, a cache."""

import json
import shlex
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
        while at < len(words):
            if words[at] in WITH_ARGUMENT:
                at += 2
                continue
            if words[at] not in LEFT_OUT and words[at] != source:
                options.append(words[at])
            at += 1
        commands[source] = (words[0], options)
    return commands
