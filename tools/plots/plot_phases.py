#!/usr/bin/env python3
"""Draws what `skein phases` found: regime, half period and largest curvature over the fiber's length."""

import argparse
import csv
import os
import sys

sys.dont_write_bytecode = True  # the sources, or the installed program, are no place for caches
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))  # which Python's isolated mode leaves out

import isolation  # noqa: F401, first

import matplotlib.pyplot as plt
import numpy as np

import style
from diagnostics import REGIMES
from run_reader import MISSING, PlotError
from script import attempt, print_path

SERIES = (("straight at first", "o", style.COLOURS[0]), ("perturbed", "D", style.COLOURS[1]))


def read_table(path):
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.reader(file))
    except OSError as error:
        raise PlotError(MISSING, f"{path} cannot be read: {error.strerror}") from None
    values = np.array([[float(cell) for cell in row] for row in rows[1:]])
    return {name.split(" [")[0]: values[:, i] for i, name in enumerate(rows[0])}


def draw(table):
    figure, panels = plt.subplots(3, 1, sharex=True, figsize=(style.WIDTH, 6.4), layout="constrained",
                                  gridspec_kw={"height_ratios": [1.5, 1.0, 1.0]})
    top, middle, bottom = panels
    for kind, (label, marker, colour) in enumerate(SERIES):
        rows = table["perturbed"] == kind
        if not rows.any():
            continue
        order = np.argsort(table["length"][rows])
        length = table["length"][rows][order]
        look = {"marker": marker, "markersize": 5, "color": colour, "markeredgecolor": "white",
                "markeredgewidth": 0.5, "linewidth": 0.7, "label": label}
        shift = 0.09 if (table["perturbed"] == 1).any() else 0.0  # two fibers at one place stay visible
        top.plot(length, table["regime"][rows][order] + (shift if kind == 0 else -shift), **look)
        middle.plot(length, table["half_period"][rows][order], **look)
        bottom.plot(length, table["curvature_max"][rows][order], **look)
    highest = int(table["regime"].max())
    top.set_yticks(range(max(highest, 3) + 1), REGIMES[: max(highest, 3) + 1])
    top.set_ylim(-0.5, max(highest, 3) + 0.5)
    top.set_ylabel("regime reached")
    top.legend(frameon=False, loc="upper left")
    middle.set_ylabel("half period ($T$)")
    bottom.set_ylabel("largest curvature\n($1/L_0$)")
    bottom.set_xlabel("length ($L_0$)")
    for panel in panels:
        panel.grid(True, color="#e4e4e4", linewidth=0.6)
        panel.set_axisbelow(True)
    lengths, numbers = np.unique(table["length"]), None
    numbers = np.array([table["elasto_viscous_number"][table["length"] == value].mean() for value in lengths])
    add_numbers(top, lengths, numbers)
    figure.align_ylabels()
    return figure


def add_numbers(panel, lengths, numbers):
    """The elasto-viscous number along the top: powers of ten where the lengths reach them."""
    if len(lengths) < 2:
        return
    powers = np.arange(np.ceil(np.log10(numbers[0])), np.floor(np.log10(numbers[-1])) + 1)
    axis = panel.secondary_xaxis("top")
    axis.set_xticks(np.interp(powers, np.log10(numbers), lengths), [f"$10^{{{int(p)}}}$" for p in powers])
    axis.set_xlabel(r"elasto-viscous number $8\pi\mu\dot\gamma L^4/(c\,EI)$, $c=\ln(4e/\rho^2)$")


def draw_table(options):
    figure = draw(read_table(os.path.join(options.folder, "phases.csv")))
    print_path(style.save(figure, options.folder, "phases", options.format), options.to_stderr)


def main():
    parser = argparse.ArgumentParser(description=__doc__, allow_abbrev=False)
    parser.add_argument("folder", help="of skein phases")
    parser.add_argument("--format", choices=["png", "pdf", "svg"], default="png")
    parser.add_argument("--to-stderr", action="store_true", help="the picture's path goes to stderr")
    options = parser.parse_args()
    return attempt(lambda: draw_table(options))


if __name__ == "__main__":
    sys.exit(main())
