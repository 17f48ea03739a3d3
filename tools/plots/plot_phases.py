#!/usr/bin/env python3
"""Draws what `skein phases` found: regime, half period and largest curvature over the fiber's length."""

import os
import sys

sys.dont_write_bytecode = True  # the sources, or the installed program, are no place for caches
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))  # which Python's isolated mode leaves out

import isolation  # noqa: F401, first

import matplotlib.pyplot as plt
import numpy as np

import style
from diagnostics import REGIMES
from table import draw_table_of

SERIES = (("straight at first", "o", style.COLOURS[0]), ("perturbed", "D", style.COLOURS[1]))


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


if __name__ == "__main__":
    sys.exit(draw_table_of("phases", __doc__, draw))
