#!/usr/bin/env python3
"""Draws the figures of LaGrone, Cortez, Yan, Fauci 2019 from the runs of `skein reproduce`, as far as they are there."""

import argparse
import os
import sys

sys.dont_write_bytecode = True  # the sources, or the installed program, are no place for caches
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))  # which Python's isolated mode leaves out

import isolation  # noqa: F401, first

import matplotlib.pyplot as plt
import numpy as np

import shapes
import style
import tangle
import timings
from diagnostics import open_diagnostics
from kymograph import cell_edges
from script import Nothing, attempt, print_path, say
from skein_package import Run

# The times of the paper's snapshots.
ASPECT = 1.75  # of a snapshot
SHORT = {"L0139": (0, 4.95, 5.45, 5.7, 7, 10.75), "L0196": (0, 5.65, 6.5, 7.15, 8.75, 13.5),
         "L0523": (0, 6.25, 8, 10.5, 12.75, 25)}
LONG = {"L0931": (0, 4.95, 13.35, 16.25, 18.25, 20.3, 23.75, 25.5, 28, 30, 30.75, 31.25),
        "L2280": (0, 10, 24, 31, 36, 39, 44, 50, 52.5, 55, 60, 70, 85, 110)}


def open_runs(folder, suffix):
    runs = {}
    for name in (*SHORT, *LONG):
        path = os.path.join(folder, name + suffix)
        if os.path.isfile(os.path.join(path, "trajectory.h5")):
            runs[name] = Run(path)
    return runs


def frames_at(run, times):
    """(time, frame) of those times that the run has reached."""
    return [(time, int(np.abs(run.frame_times - time).argmin())) for time in times
            if time <= run.frame_times[-1] + 1e-6]


def number(run):
    """"5.37 x 10^2" as a formula: the paper's elasto-viscous number of a run's fiber."""
    value = float(np.atleast_1d(run.parameter("elasto_viscous_number_log_4e_over_rho2"))[0])
    power = int(np.floor(np.log10(value)))
    return rf"{value / 10**power:.2f}\times 10^{{{power}}}"


def draw_tube(panel, run, frame, box, points_per_length, colour):
    panel.set_xlim(box[0])
    panel.set_ylim(box[1])
    panel.set_xticks([])
    panel.set_yticks([])
    shapes.add_tubes(panel, run, run.centreline(frame).astype(float), points_per_length, lambda f, _: colour)


def add_scale(panel, length, box, text):
    """A bar of a given length in the lower right corner."""
    (x0, x1), (y0, y1) = box
    right, low = x1 - 0.04 * (x1 - x0), y0 + 0.1 * (y1 - y0)
    panel.plot([right - length, right], [low, low], color=style.OUTLINE, linewidth=1.2, solid_capstyle="butt")
    panel.text(right - 0.5 * length, low + 0.04 * (y1 - y0), text, ha="center", va="bottom", fontsize=7)


def draw_snapshots(runs):
    """Figure 2: a column for each length, a row for each snapshot; every column to its own scale."""
    columns = [(name, times) for name, times in SHORT.items() if name in runs]
    if not columns:
        raise Nothing("none of its runs is there")
    n_rows = max(len(times) for _, times in columns)
    width = style.WIDTH / 3.0
    figure, panels = plt.subplots(n_rows, len(columns), squeeze=False,
                                  figsize=(width * len(columns), 0.4 + width / ASPECT * n_rows))
    figure.subplots_adjust(left=0.01, right=0.99, bottom=0.01, top=1.0 - 0.4 / figure.get_figheight(), hspace=0.04,
                           wspace=0.02)
    panel_width = 72.0 * width * 0.97
    for c, (name, times) in enumerate(columns):
        run = runs[name]
        extents = [np.ptp(run.centreline(frame)[:, :2].astype(float), axis=0) for _, frame in frames_at(run, times)]
        widest, highest = np.max(extents, axis=0) + 4.0 * run.radius[0]
        half = 0.52 * max(widest, highest * ASPECT)
        box = ((-half, half), (-half / ASPECT, half / ASPECT))
        panels[0, c].set_title(rf"$L = {run.lengths[0]:.3f}$,  $\bar\mu = {number(run)}$")
        for row in range(n_rows):
            panel = panels[row, c]
            found = frames_at(run, times[row : row + 1])
            if not found:
                panel.axis("off")
                continue
            middle = run.centreline(found[0][1]).mean(axis=0)
            shifted = tuple((low + m, high + m) for (low, high), m in zip(box, middle))
            draw_tube(panel, run, found[0][1], shifted, panel_width / (2.0 * half), style.COLOURS[c])
            panel.text(0.03, 0.95, f"t = {found[0][0]:g}", transform=panel.transAxes, ha="left", va="top", fontsize=8)
        bar = 0.05 if name != "L0523" else 0.1
        add_scale(panels[n_rows - 1, c], bar, shifted, f"{bar:g} $L_0$")
    return figure


def draw_long(name):
    def draw(runs):
        """Figures 4 and 5: one row for each snapshot, all to one scale."""
        if name not in runs:
            raise Nothing("its run is not there")
        run = runs[name]
        found = frames_at(run, LONG[name])
        lines = [run.centreline(frame).astype(float) for _, frame in found]
        middles = [0.5 * (line.min(axis=0) + line.max(axis=0)) for line in lines]
        half = 0.52 * max(np.ptp(line[:, 0]) for line in lines) + run.radius[0]
        heights = [max(np.ptp(line[:, 1]) + 6.0 * run.radius[0], 0.06 * half) for line in lines]
        width = style.WIDTH - 0.75
        figure_height = sum(heights) * width / (2.0 * half) + 0.06 * len(found) + 0.4
        figure = plt.figure(figsize=(style.WIDTH, figure_height))
        y = figure_height - 0.36
        for (time, frame), middle, height in zip(found, middles, heights):
            inches = height * width / (2.0 * half)
            y -= inches
            panel = figure.add_axes([0.7 / style.WIDTH, y / figure_height, width / style.WIDTH, inches / figure_height])
            draw_tube(panel, run, frame, ((middle[0] - half, middle[0] + half),
                                          (middle[1] - 0.5 * height, middle[1] + 0.5 * height)),
                      72.0 * width / (2.0 * half), style.COLOURS[0])
            panel.axis("off")
            figure.text(0.62 / style.WIDTH, (y + 0.5 * inches) / figure_height, f"t = {time:g}", ha="right", va="center",
                        fontsize=8)
            y -= 0.06
        figure.suptitle(rf"$L = {run.lengths[0]:.3f}$,  $\bar\mu = {number(run)}$", y=1.0 - 0.08 / figure_height,
                        va="top", fontsize=9)
        return figure
    return draw


def draw_curvature(runs):
    """Figure 3: unsigned curvature over arclength and time, a panel for each length."""
    names = [name for name in (*SHORT, *LONG) if name in runs]
    if not names:
        raise Nothing("none of its runs is there")
    figure, panels = plt.subplots(1, len(names), squeeze=False, layout="constrained",
                                  figsize=(max(3.4, style.WIDTH * len(names) / 3.0), 3.7))
    for i, (panel, name) in enumerate(zip(panels[0], names)):
        run = runs[name]
        stride = -(-len(run.frame_times) // 1200)
        with open_diagnostics(run) as file:
            curvature = np.abs(file["fiber_0/signed_curvature"][::stride])
        edges = np.linspace(0.0, run.lengths[0], curvature.shape[1] + 1)
        colours, extent = style.shown_range(curvature)
        image = panel.pcolormesh(edges, cell_edges(run.frame_times[::stride]), curvature, cmap="inferno", rasterized=True,
                                 **colours)
        panel.set_title(f"({'abcde'[i]})  $L = {run.lengths[0]:.3f}$")
        panel.set_xlabel("arclength ($L_0$)")
        panel.xaxis.set_major_locator(plt.MaxNLocator(3))
        bar = figure.colorbar(image, ax=panel, fraction=0.08, pad=0.03, **extent)
        bar.ax.tick_params(labelsize=7)
        if i == len(names) - 1:
            bar.set_label("curvature ($1/L_0$)")
    panels[0, 0].set_ylabel(style.TIME_LABEL)
    return figure


def draw_hooks(runs):
    """Figure 7: a hook with its circle, and radius and speed of the hooks over the elasto-viscous number."""
    found = []
    for name, run in runs.items():
        with open_diagnostics(run) as file:
            row = file["fiber_0/snaking"][()]
            if len(row):
                radii = [file[f"fiber_0/{end}_hook_radius"][()] for end in ("first", "last")]
                within = (run.frame_times >= row[0, 0] - 1e-9) & (run.frame_times <= row[0, 1] + 1e-9)
                found.append((name, run, row[0], np.concatenate([r[within] for r in radii])))
    if not found:
        raise Nothing("no run has hooks")
    figure, (left, right) = plt.subplots(1, 2, figsize=(style.WIDTH, 3.1), layout="constrained")
    _, run, (begin, end, radius, *_), _ = found[0]
    draw_hook(left, figure, run, 0.5 * (begin + end))
    numbers = [float(np.atleast_1d(r.parameter("elasto_viscous_number_log_4e_over_rho2"))[0]) for _, r, _, _ in found]
    spread = [np.abs(np.array([np.nanmin(radii), np.nanmax(radii)]) - row[2]) for _, _, row, radii in found]
    right.errorbar(numbers, [row[2] for _, _, row, _ in found], yerr=np.array(spread).T, fmt="o", capsize=3,
                   color=style.COLOURS[0], label="hook radius ($L_0$)")
    right.plot(numbers, [row[3] for _, _, row, _ in found], "D", color=style.COLOURS[1], label="snaking speed ($L_0/T$)")
    right.set_xscale("log")
    right.set_xlim(10.0 ** np.floor(np.log10(min(numbers)) - 0.3), 10.0 ** np.ceil(np.log10(max(numbers)) + 0.3))
    right.xaxis.set_minor_formatter(plt.NullFormatter())
    right.set_ylim(0.0, 1.5 * max(row[3] for _, _, row, _ in found))
    right.set_xlabel(r"elasto-viscous number $\bar\mu$")
    right.legend(frameon=False, loc="upper left")
    right.grid(True, color="#e4e4e4", linewidth=0.6)
    return figure


def draw_hook(panel, figure, run, time):
    frame = int(np.abs(run.frame_times - time).argmin())
    line = run.centreline(frame).astype(float)
    with open_diagnostics(run) as file:
        place, radius = file["fiber_0/first_hook_place"][frame], file["fiber_0/first_hook_radius"][frame]
        center = file["fiber_0/first_hook_center"][frame]
        arclength = file["fiber_0/arclength"][frame]
    section = int(np.abs(arclength - place).argmin())
    half = 6.0 * radius
    middle = line[section, :2] + np.array([0.6 * half * np.sign(line[:, 0].mean() - line[section, 0]), 0.0])
    panel.set_box_aspect(0.8)
    panel.set_xlim(middle[0] - half, middle[0] + half)
    panel.set_ylim(middle[1] - 0.8 * half, middle[1] + 0.8 * half)
    panel.xaxis.set_major_locator(plt.MaxNLocator(4))
    panel.yaxis.set_major_locator(plt.MaxNLocator(5))
    figure.draw_without_rendering()
    inches = panel.get_position().width * figure.get_figwidth()
    shapes.add_tubes(panel, run, line, 72.0 * inches / (2.0 * half), lambda f, _: "#b9d7ea")
    angle = np.linspace(0.0, 2.0 * np.pi, 100)
    panel.plot(center[0] + radius * np.cos(angle), center[1] + radius * np.sin(angle), color=style.COLOURS[1], zorder=4)
    panel.set_title(f"hook of L = {run.lengths[0]:.3f} at t = {run.frame_times[frame]:.4g}: radius {radius:.3g} $L_0$")
    panel.set_xlabel("$x$ ($L_0$)")
    panel.set_ylabel("$y$ ($L_0$)")


FIGURES = {"figure2": draw_snapshots, "figure3": draw_curvature, "figure4": draw_long("L0931"),
           "figure5": draw_long("L2280"), "figure6": tangle.draw, "figure7": draw_hooks}


def draw_all(options):
    suffix = "" if options.rung is None else f"_{options.rung}"
    runs = open_runs(options.folder, suffix)
    figures = {**FIGURES, "figure8": lambda _: timings.draw(options.folder)}
    for name, draw in figures.items():
        try:
            figure = draw(runs)
        except Nothing as reason:
            say(f"{name} is not drawn: {reason}")
            continue
        print_path(style.save(figure, options.folder, name + suffix, options.format), options.to_stderr)


def main():
    parser = argparse.ArgumentParser(description=__doc__, allow_abbrev=False)
    parser.add_argument("folder", help="of skein reproduce")
    parser.add_argument("--rung", help="of the runs, where they were asked for with one")
    parser.add_argument("--format", choices=["png", "pdf", "svg"], default="png")
    parser.add_argument("--to-stderr", action="store_true", help="the pictures' paths go to stderr")
    options = parser.parse_args()
    return attempt(lambda: draw_all(options))


if __name__ == "__main__":
    sys.exit(main())
