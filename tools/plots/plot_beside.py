#!/usr/bin/env python3
"""Draws runs of one scene beside each other at equal times: what a coarser model of the fibers makes of their shapes.

Usage: plot_beside.py RUN[=NAME] ... --times T1,T2,... -o PICTURE.png
"""

import argparse
import os
import sys

sys.dont_write_bytecode = True  # the sources, or the installed program, are no place for caches
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))  # which Python's isolated mode leaves out

import isolation  # noqa: F401, first

import matplotlib.pyplot as plt
import numpy as np

import style
from output_file import replacing
from script import attempt
from shapes import add_tubes
from skein_package import Run

LABEL, GAP, TOP = 0.55, 0.08, 0.2  # inches: for a time, between panels, for the runs' names


def draw(runs, names, times):
    """A row for each time, a column for each run."""
    lines = [[run.centreline(int(np.abs(run.frame_times - t).argmin())).astype(float) for run in runs] for t in times]
    size = np.max([np.ptp(line[:, :2], axis=0) for row in lines for line in row], axis=0) + 6.0 * runs[0].radius.max()
    width = (style.WIDTH - LABEL - (len(runs) - 1) * GAP) / len(runs)
    height = width * size[1] / size[0]
    figure_height = TOP + len(times) * (height + GAP)
    figure = plt.figure(figsize=(style.WIDTH, figure_height))
    for i, (time, row) in enumerate(zip(times, lines)):
        # A row has one window, about the shape of the first run, so that distances between runs are seen.
        middle = 0.5 * (row[0][:, :2].min(axis=0) + row[0][:, :2].max(axis=0))
        for j, (run, line) in enumerate(zip(runs, row)):
            x, y = LABEL + j * (width + GAP), (len(times) - 1 - i) * (height + GAP)
            panel = figure.add_axes([x / style.WIDTH, y / figure_height, width / style.WIDTH, height / figure_height])
            panel.set_xlim(middle[0] - 0.5 * size[0], middle[0] + 0.5 * size[0])
            panel.set_ylim(middle[1] - 0.5 * size[1], middle[1] + 0.5 * size[1])
            panel.set_axis_off()
            if i == 0:
                figure.text((x + 0.5 * width) / style.WIDTH, 1.0 - 0.5 * TOP / figure_height, names[j], ha="center",
                            va="center")
            if j == 0:
                figure.text(0.08 / style.WIDTH, (y + 0.5 * height) / figure_height, f"t = {style.number(time)}",
                            va="center")
            add_tubes(panel, run, line, 72.0 * width / size[0], lambda fiber, z: style.COLOURS[j % len(style.COLOURS)])
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", nargs="+", metavar="RUN[=NAME]")
    parser.add_argument("--times", required=True, metavar="T1,T2,...")
    parser.add_argument("-o", "--output", required=True, metavar="PICTURE.png")
    options = parser.parse_args()
    pairs = [run.partition("=") for run in options.runs]
    runs = [Run(folder) for folder, _, _ in pairs]
    figure = draw(runs, [name or folder for folder, _, name in pairs], [float(t) for t in options.times.split(",")])
    with replacing(options.output) as partial:
        figure.savefig(partial, format="png")


if __name__ == "__main__":
    sys.exit(attempt(main))
