"""Figure 8: wall time of a sum over the nodes of a straight fiber, directly and by the fast multipole method."""

import os

import matplotlib.pyplot as plt
import numpy as np

import style
from script import Nothing

PAPER_CROSSOVER, PAPER_LARGEST, PAPER_SPEEDUP = 1.7e4, 23634, 1.6


def draw(folder):
    path = os.path.join(folder, "timings.csv")
    if not os.path.isfile(path):
        raise Nothing("its times are not measured")
    nodes, direct, fmm, _ = np.genfromtxt(path, delimiter=",", skip_header=1, unpack=True)
    figure, panel = plt.subplots(figsize=(0.62 * style.WIDTH, 3.3), layout="constrained")
    panel.loglog(nodes, 1e3 * direct, "s-", color=style.COLOURS[1], label="direct sum, double precision")
    panel.loglog(nodes, 1e3 * fmm, "o-", color=style.COLOURS[0], label="fast multipole method, error below 1e-4")
    panel.axvline(PAPER_CROSSOVER, color=style.FAINT, linewidth=0.8, linestyle="--")
    panel.annotate(f"the paper's lines cross\n({PAPER_SPEEDUP:g} times at {PAPER_LARGEST} nodes)", (PAPER_CROSSOVER, 0.02),
                   xycoords=("data", "axes fraction"), xytext=(-4, 4), textcoords="offset points", ha="right", va="bottom",
                   fontsize=7, color=style.FAINT)
    panel.annotate(f"{direct[-1] / fmm[-1]:.1f} times", (nodes[-1], 1e3 * np.sqrt(direct[-1] * fmm[-1])), ha="center",
                   va="center", fontsize=8, bbox={"facecolor": "white", "edgecolor": "none", "pad": 1.5})
    panel.set_xticks([1000, 3000, 10000, 30000], ["1000", "3000", "10 000", "30 000"])
    panel.xaxis.set_minor_formatter(plt.NullFormatter())
    panel.set_xlim(0.8 * nodes[0], 35000)
    panel.set_xlabel("nodes of a straight fiber")
    panel.set_ylabel("time of a sum (ms)")
    panel.grid(True, which="major", color="#e4e4e4", linewidth=0.6)
    panel.legend(frameon=False, loc="upper left")
    return figure
