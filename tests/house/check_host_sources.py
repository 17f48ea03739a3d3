"""usage: check_host_sources.py ROOT LIST AT_MOST

LIST holds a line "host FILE", "device FILE" or, where a layer is one translation unit, "united-LAYER FILE" for every
source of the program, as cmake/Layers.cmake gives them to the compilers. A source marked as the host's must reach no header of Kokkos, one that is not marked must reach one, and at most
AT_MOST units may be left to the device's compiler, which is slow: whatever parses, writes or prints is not for it.
"""

import sys
from pathlib import Path

from source_tree import IncludeGraph


def main(root, list_file, at_most):
    graph = IncludeGraph(root)
    problems, device = [], []
    united = set()  # layers whose sources the device's compiler reads as one
    for line in Path(list_file).read_text(encoding="utf-8").splitlines():
        compiler, name = line.split(" ", 1)
        file = Path(name).resolve().relative_to(Path(root).resolve())
        way = graph.way_to(file, "Kokkos")
        if compiler == "device":
            device.append(file)
        elif compiler.startswith("united-"):
            united.add(compiler)
            compiler = "device"
        if compiler == "host" and way:
            problems.append(f"{file} is marked as the host's, but reaches Kokkos: " + " -> ".join(map(str, way)))
        if compiler == "device" and not way:
            problems.append(f"{file} reaches no header of Kokkos: put it in HOST_FILES, or mark its layer HOST")
    n_units = len(device) + len(united)
    if n_units > at_most:
        problems.append(f"{n_units} translation units are left to the device's compiler, more than {at_most}:")
        problems += [f"  {file}" for file in device]
    for problem in problems:
        print(problem)
    print(f"{n_units} translation units for the device's compiler, {len(problems)} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), sys.argv[2], int(sys.argv[3])))
