"""`skein reproduce` and `skein phases` with fibers of six nodes a section: stopped, gone on with, compared and drawn.

Usage: check_reproduce.py SKEIN FOLDER"""

import csv
import json
import os
import pathlib
import shutil
import sys

from checks import check, skein

DONE, USAGE, CANNOT_CREATE, STOPPED, NUMERICAL = 0, 64, 73, 75, 76


def check_table(program, folder):
    rows = json.loads(skein(program, "reproduce", "lagrone2019", "table1", "--json", "--no-plots", "-o", folder).stdout)
    check(len(rows) == 14 and all(row["verdict"] == "agrees" for row in rows), f"table 1: {rows}")
    # Whoever else uses the machine: not the numbers.
    result = skein(program, "reproduce", "lagrone2019", "figure8", "--json", "-o", folder, codes=(DONE, NUMERICAL))
    check({row["verdict"] for row in json.loads(result.stdout)} <= {"agrees", "DIFFERS"}, f"figure 8: {result.stdout}")
    check((folder / "figure8.png").stat().st_size > 10000, f"figure 8 is not drawn: {result.stderr}")
    skein(program, "reproduce", "somebody2020", codes=(USAGE,))
    skein(program, "reproduce", "lagrone2019", "figure1", codes=(USAGE,))


def check_figures(program, folder):
    words = (program, "reproduce", "lagrone2019", "--rung", 6, "-o", folder, "-q")
    skein(*words, "--max-walltime", 1.5, "--no-plots", codes=(STOPPED,))
    first = (folder / "L0139_6/checkpoints").stat().st_mtime_ns
    rows = list(csv.DictReader(open(folder / "comparison.csv", newline="")))
    check(any(row["verdict"] == "not reached" for row in rows), "all rows are reached by a run that was stopped")
    result = skein(*words)
    check((folder / "L0139_6/checkpoints").stat().st_mtime_ns >= first, "the first run was begun again")
    rows = {row["quantity"]: row for row in csv.DictReader(open(folder / "comparison.csv", newline=""))}
    check(len(rows) > 40, f"{len(rows)} rows")
    # Such fibers answer as those of eighteen nodes do.
    for quantity, row in rows.items():
        check(row["verdict"] == "agrees", f"{quantity}: {row}")
    check(f"{len(rows)} rows: " in result.stdout, result.stdout)
    for name in ("figure2_6.png", "figure3_6.png", "figure7_6.png"):
        check((folder / name).stat().st_size > 10000, f"{name} is not drawn: {result.stderr}")
    index = folder / "L0523_6/trajectory.h5"
    written = index.stat().st_mtime_ns
    skein(*words, "--no-plots")
    check(index.stat().st_mtime_ns == written, "a run that was done is run again")


def check_phases(program, folder):
    words = (program, "phases", "--from", 0.14, "--to", 0.2, "--count", 2, "--rung", 6, "--end", 8, "-q",
             "-o", folder, "--perturbation", "fiber.roll=5.0")
    text = skein(*words).stdout
    regimes = [line.split()[-1] for line in text.splitlines()[1:]]
    check(regimes == ["tumble", "S", "tumble", "S"], f"regimes {text}")
    check((folder / "phases.png").stat().st_size > 10000, "the diagram is not drawn")
    with open(folder / "phases.csv", newline="") as file:
        rows = list(csv.reader(file))
    check([row[rows[0].index("perturbed")] for row in rows[1:]] == ["0", "0", "1", "1"], f"{rows}")
    perturbed = next(path for path in folder.iterdir() if path.name.startswith("perturbed"))
    check("roll = 5.0" in (perturbed / "scene.toml").read_text(), "the perturbation is not in the scene")
    longer = [word if word != 8 else 9 for word in words]
    skein(*longer, codes=(CANNOT_CREATE,))  # another scene in the same folders


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    check_table(program, folder / "table")
    check_figures(program, folder / "figures")
    check_phases(program, folder / "phases")


if __name__ == "__main__":
    main()
