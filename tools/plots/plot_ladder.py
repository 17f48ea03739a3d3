#!/usr/bin/env python3
"""Draws what `skein bench ladder` found: error against cost of tubes of fewer nodes, a panel for each length."""

import os
import sys

sys.dont_write_bytecode = True  # the sources, or the installed program, are no place for caches
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))  # which Python's isolated mode leaves out

import isolation  # noqa: F401, first

import matplotlib.pyplot as plt
import numpy as np

import style
from table import draw_table_of

SERIES = (("shape", "o", "shape, over $L$"), ("half_period", "s", "half period"), ("hook_radius", "^", "hook radius"),
          ("snaking_speed", "D", "snaking speed"), ("curvature_max", "x", "largest curvature"))
LEAST = 1e-5  # below it, nothing is seen


def find_front(seconds, errors):
    """Which points no other beats in both cost and error."""
    return np.array([not ((seconds < s) & (errors <= e)).any() and not ((seconds <= s) & (errors < e)).any()
                     for s, e in zip(seconds, errors)])


def draw_length(panel, rows, table):
    seconds = table["seconds"][rows]
    nodes = table["nodes_per_section"][rows].astype(int)
    worst = np.zeros(len(seconds))
    for i, (name, marker, label) in enumerate(SERIES):
        errors = table[f"{name}_error"][rows]
        if not np.isfinite(errors).any():
            continue
        if name != "curvature_max":  # is of the sections' distance, too
            worst = np.fmax(worst, errors)
        panel.plot(seconds, np.fmax(errors, LEAST), marker, color=style.COLOURS[i], markersize=4, label=label)
    front = find_front(seconds, worst)
    order = np.argsort(seconds[front])
    panel.plot(seconds[front][order], np.fmax(worst[front][order], LEAST), "-", color="#888888", linewidth=0.9, zorder=0,
               label="none is cheaper and better")
    for x, y, n in zip(seconds, worst, nodes):
        panel.annotate("chain" if n == 1 else f"{n}", (x, max(y, LEAST)), textcoords="offset points", xytext=(0, 6), ha="center", fontsize=7)
    panel.set_xscale("log")
    panel.margins(x=0.12)
    panel.set_yscale("log")
    panel.grid(True, color="#e4e4e4", linewidth=0.6)
    panel.set_axisbelow(True)
    panel.set_xlabel("wall time (s)")


def draw(table):
    lengths = np.unique(table["length"])
    figure, panels = plt.subplots(1, len(lengths), sharey=True, squeeze=False, layout="constrained",
                                  figsize=(max(3.6, style.WIDTH * len(lengths) / 3.0), 3.8))
    for panel, length in zip(panels[0], lengths):
        rows = table["length"] == length
        is_compared = np.isfinite(table["shape_error"])
        reference = table["nodes_per_section"][rows & ~is_compared]
        draw_length(panel, rows & is_compared, table)
        panel.set_title(f"$L = {length:g}$, against {reference.max():.0f} nodes")
    panels[0, 0].set_ylabel("error")
    figure.get_layout_engine().set(rect=(0.0, 0.13, 1.0, 0.87))
    # Not every fiber answers every question.
    handles = {label: handle for panel in panels[0] for handle, label in zip(*panel.get_legend_handles_labels())}
    labels = [label for _, _, label in SERIES if label in handles]
    labels += [label for label in handles if label not in labels]
    figure.legend([handles[label] for label in labels], labels, loc="lower center", ncol=3, frameon=False)
    return figure


if __name__ == "__main__":
    sys.exit(draw_table_of("ladder", __doc__, draw))
