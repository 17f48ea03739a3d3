#!/usr/bin/python3
"""Time against error of direct sums and of the fast multipole method: draws what `bench_fmm chart` printed.

Usage: bench_fmm chart > chart.csv; plot_fmm.py chart.csv fmm_error_time.png
"""
import csv
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

STYLES = {
    "direct_double": ("black", "*", "direct, double"),
    "direct_single": ("gray", "*", "direct, single"),
    "fmm_harmonic": ("tab:blue", "o", "FMM, harmonic"),
    "fmm_stokeslet": ("tab:orange", "s", "FMM, Stokeslets"),
    "fmm_regularized": ("tab:green", "^", "FMM, regularized"),
}


def read_rows(path):
    with open(path, encoding="utf-8") as file:
        lines = [line for line in file if line.strip() and not line.startswith("#")]
    rows = list(csv.DictReader(lines))
    if not rows or "method" not in rows[0]:
        sys.exit(f"{path}: not the output of 'bench_fmm chart'")
    for row in rows:
        row["nodes"], row["ms"], row["error"] = int(row["nodes"]), float(row["ms"]), float(row["error"])
    return rows


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    rows = read_rows(sys.argv[1])
    sizes = sorted({row["nodes"] for row in rows})
    figure, axes = plt.subplots(1, len(sizes), figsize=(4 * len(sizes), 4), sharex=True, squeeze=False)
    for axis, size in zip(axes[0], sizes):
        here = [row for row in rows if row["nodes"] == size]
        for method, (color, marker, label) in STYLES.items():
            points = sorted((row["error"], row["ms"]) for row in here if row["method"] == method)
            axis.plot(*zip(*points), marker=marker, color=color, linestyle="-" if len(points) > 1 else "none",
                      label=label) if points else None
            for row in here:
                if row["method"] == method and row["p"] != "0":
                    axis.annotate(row["p"], (row["error"], row["ms"]), fontsize=6, textcoords="offset points", xytext=(3, 3))
        # The fastest that is at least as accurate, from left to right: a staircase.
        best, stairs = float("inf"), []
        for row in sorted(here, key=lambda row: row["error"]):
            if row["ms"] < best:
                best = row["ms"]
                stairs.append((row["error"], best))
        axis.step(*zip(*stairs), where="post", color="tab:red", linewidth=3, alpha=0.3, label="fastest choice")
        axis.set(xscale="log", yscale="log", title=f"{size} nodes", xlabel="relative error")
        axis.grid(alpha=0.3)
    axes[0][0].set_ylabel("ms per evaluation")
    axes[0][0].legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(sys.argv[2], dpi=150)


if __name__ == "__main__":
    main()
