"""usage: check_headers.py ROOT BUILD JOBS

Every header compiles alone, whatever is included before it. The options are those of a source of its own layer. A header
that reaches Kokkos anyway is compiled on Kokkos_Core.hpp, read once and kept precompiled: this hides nothing but the order
of Kokkos and itself, and takes a tenth of the time.
"""

import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from compile_commands import read_commands
from source_tree import SKIPPED, IncludeGraph, find_sources


def layer_of(file):
    """include/skein/fmm/fmm_sum.hpp and src/fmm/octree.hpp belong to fmm; kernels are a layer of their own."""
    parts = file.parts
    return "kernels" if parts[0] == "kernels" else parts[2] if parts[0] == "include" else parts[1]


def include_options(options):
    """The folders that these options name, `-I/path` as one word and `-isystem /path` as two."""
    found, words = [], iter(options)
    for word in words:
        if word in ("-I", "-isystem"):
            found += [word, next(words)]
        elif word.startswith("-I"):
            found.append(word)
    return found


def main(root, build, jobs):
    graph = IncludeGraph(root)
    of_layer = {}
    for source, command in read_commands(build).items():
        path = Path(source)
        if path.is_relative_to(root / "src") or path.is_relative_to(root / "kernels"):
            of_layer.setdefault(layer_of(path.relative_to(root)), command)
    if any("nvcc" in command[0] for command in of_layer.values()):
        print("skipped: nvcc_wrapper compiles no header by itself; the builds for hosts check them")
        return SKIPPED
    headers = find_sources(root, "include", "src", "kernels", endings=(".hpp",))

    with tempfile.TemporaryDirectory() as folder:
        on_kokkos = Path(folder) / "kokkos.hpp"
        on_kokkos.write_text("#include <Kokkos_Core.hpp>\n", encoding="utf-8")
        compiler, options = of_layer["physics"]
        if any(graph.way_to(header, "Kokkos") for header in headers):
            subprocess.run([compiler, *options, "-x", "c++-header", str(on_kokkos), "-o", f"{on_kokkos}.gch"], check=True)

        def compile_alone(header):
            compiler, options = of_layer[layer_of(header)]
            first = []
            if graph.way_to(header, "Kokkos"):
                compiler, options = of_layer["physics"]
                first = ["-include", str(on_kokkos)]
                options = options + include_options(of_layer[layer_of(header)][1])
            # Included by its path: `#pragma once` in a main file is a warning.
            result = subprocess.run([compiler, *options, *first, "-fsyntax-only", "-x", "c++", "-"], text=True,
                                    input=f'#include "{root / header}"\n', capture_output=True)
            return header, result.returncode, result.stderr

        with ThreadPoolExecutor(jobs) as pool:
            results = list(pool.map(compile_alone, headers))
    failed = [(header, text) for header, code, text in results if code != 0 or text]
    for header, text in failed:
        print(f"{header} does not compile alone:\n{text}")
    print(f"{len(headers)} headers, {len(failed)} problems")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), Path(sys.argv[2]), int(sys.argv[3])))
