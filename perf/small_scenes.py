"""Times of an evaluation of small tubes, by number of threads and by how long waiting threads spin.
small_scenes.py SKEIN [--spin TURNS ...] [--repeats N]; `chrt -r 1` before it keeps everything else from the processors."""

import argparse
import json
import os
import pathlib
import subprocess
import tempfile

SCENE = """[fiber]
nodes_per_section = {nodes}
sections = {sections}
spring_stiffness = 0.04
[time]
end = {end}
[output]
frame_interval = 100.0
"""
SIZES = ((4, 13, 2.0), (4, 25, 1.0), (5, 30, 1.0), (4, 50, 0.5), (6, 50, 0.5), (6, 83, 0.2), (18, 80, 0.1), (18, 301, 0.05))
PARTS = ("fluid", "springs_and_flow", "integrator", "observables")


def time_evaluation(program, scene, threads, spin):
    """Microseconds of all parts of a step but its output, over the number of evaluations."""
    with tempfile.TemporaryDirectory() as folder:
        run, file = pathlib.Path(folder) / "run", pathlib.Path(folder) / "scene.toml"
        file.write_text(scene)
        subprocess.run([program, "run", file, "-o", run, "-q", "--threads", str(threads)], check=True,
                       env={**os.environ, "GOMP_SPINCOUNT": str(spin)})
        end = json.loads((run / "events.jsonl").read_text().splitlines()[-1])
    return 1e6 * sum(end[f"{part}_seconds"] for part in PARTS) / end["evaluations"]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program")
    parser.add_argument("--spin", type=int, nargs="+", default=[1000])
    parser.add_argument("--repeats", type=int, default=3)
    options = parser.parse_args()
    columns = [(1, options.spin[0])] + [(2, spin) for spin in options.spin]
    print("nodes  " + "  ".join(f"{threads} thread{'s' * (threads > 1)}, {spin} turns" for threads, spin in columns) + "  (us)")
    for nodes, sections, end in SIZES:
        scene = SCENE.format(nodes=nodes, sections=sections, end=end)
        times = [[time_evaluation(options.program, scene, *column) for column in columns] for _ in range(options.repeats)]
        print(f"{nodes * sections:5}  " + "  ".join(f"{sorted(column)[len(column) // 2]:9.1f}" for column in zip(*times)), flush=True)


if __name__ == "__main__":
    main()
