#!/usr/bin/python3
"""What bench_chart and bench_fmm measured, as pictures.

Usage: bench_chart > chart.csv; plot_fmm.py chart.csv fmm_error_time.png [perf/peers.csv]
       bench_fmm pair sixteen > pair.csv; plot_fmm.py pair.csv fmm_error_blob.png
The first: time against error of direct sums and of the fast multipole method, beside other programs' where a table of
theirs is named. The second: error between the nearest
well-separated boxes against the blobs' size.
"""
import csv
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

STYLES = {
    "direct_double": ("black", "*", "direct, double"),
    "direct_single": ("gray", "*", "direct, single"),
    "fmm_harmonic": ("tab:blue", "o", "FMM by tolerance, order beside it"),
    "fmm_stokeslet": ("tab:orange", "s", "FMM, Stokeslets"),
    "fmm_regularized": ("tab:green", "^", "FMM, regularized"),
}
PEERS = {"PVFMM": ("tab:purple", "P"), "DMK": ("tab:brown", "X"), "DMK float": ("tab:pink", "X"), "FMM3D": ("tab:olive", "D")}
SHAPES = {"straight": "straight tube", "spiral": "coiled tube", "uniform": "cube"}
NUMBERS = ("nodes", "ms", "error", "eps_over_h", "cutoff", "floor_law", "p")


def read_tables(path):
    """Rows of the lines behind each header; the program's other lines begin with #."""
    rows, names = [], None
    with open(path, encoding="utf-8") as file:
        for cells in csv.reader(line for line in file if line.strip() and not line.startswith("#")):
            if cells[0] in ("shape", "far_field"):
                names = cells
            elif names and len(cells) == len(names):
                row = dict(zip(names, cells))
                rows.append({name: float(value) if name in NUMBERS else value for name, value in row.items()})
    return rows


def draw_peers(axis, rows):
    """Points of other programs, each beside its own of other settings."""
    for method, (color, marker) in PEERS.items():
        points = sorted((row["error"], row["ms"]) for row in rows if row["method"] == method)
        if points:
            axis.plot(*zip(*points), marker=marker, color=color, markersize=6, linewidth=0.7, linestyle=":", label=method)


def draw_stairs(axis, rows):
    """The fastest that is at least as accurate, from left to right; its method where it changes."""
    best, stairs = float("inf"), []
    for row in sorted(rows, key=lambda row: row["error"]):
        if row["ms"] < best:
            best = row["ms"]
            stairs.append((row["error"], best))
    if stairs:
        stairs.append((1.0, best))
        axis.step(*zip(*stairs), where="post", color="tab:red", linewidth=4, alpha=0.3,
                  label="fastest choice")


def draw_chart(rows, peers):
    panels = list(dict.fromkeys((row["shape"], row["nodes"]) for row in rows))
    figure, axes = plt.subplots(1, len(panels), figsize=(4.2 * len(panels), 4.8), sharex=True, squeeze=False)
    for axis, panel in zip(axes[0], panels):
        here = [row for row in rows if (row["shape"], row["nodes"]) == panel]
        draw_peers(axis, [row for row in peers if (row["shape"], row["nodes"]) == panel])
        for method, (color, marker, label) in STYLES.items():
            points = sorted((row["p"], row["error"], row["ms"]) for row in here if row["method"] == method)
            if not points:
                continue
            axis.plot([p[1] for p in points], [p[2] for p in points], marker=marker, color=color, markersize=4,
                      linewidth=1, linestyle="-" if len(points) > 1 else "none", label=label)
            for order, error, ms in points:
                if method == "fmm_harmonic":
                    axis.annotate(f"{order:.0f}", (error, ms), fontsize=6, textcoords="offset points", xytext=(-2, -9))
        draw_stairs(axis, here)
        axis.set(xscale="log", yscale="log", title=f"{SHAPES[panel[0]]}, {panel[1]:.0f} nodes", xlabel="relative error", xlim=(3e-16, 0.3))
        axis.grid(alpha=0.3)
    axes[0][0].set_ylabel("ms per evaluation")
    handles = {}
    for axis in axes[0]:
        handles.update({label: handle for handle, label in zip(*axis.get_legend_handles_labels())})
    figure.legend(handles.values(), handles.keys(), loc="lower center", ncol=min(len(handles), 6), fontsize=8)
    figure.tight_layout(rect=(0, 0.09, 1, 1))
    return figure


def draw_pair(rows):
    panels = [
        ("stokeslet", "Stokeslets, all singular values", lambda row: row["cutoff"] == 1e-15),
        ("stokeslet", "Stokeslets, best of four cutoffs", lambda row: True),
        ("harmonic", "four harmonic potentials, best of four cutoffs", lambda row: True),
    ]
    figure, axes = plt.subplots(1, len(panels), figsize=(4.4 * len(panels), 4.5), sharex=True, sharey=True)
    for axis, (field, title, chosen) in zip(axes, panels):
        here = [row for row in rows if row["far_field"] == field and chosen(row) and row["error"] > 0.0]
        for order in sorted({row["p"] for row in here}):
            best = {}
            for row in here:
                if row["p"] == order:
                    ratio = row["eps_over_h"]
                    best[ratio] = min(row["error"], best.get(ratio, float("inf")))
            axis.plot(*zip(*sorted(best.items())), marker="o", markersize=4, label=f"p = {order:.0f}",
                      color=plt.get_cmap("viridis")((order - 4.0) / 13.0))
        law = sorted({(row["eps_over_h"], row["floor_law"]) for row in rows})
        axis.plot(*zip(*law), color="black", linestyle=":", label="0.011 (eps/h)^4")
        axis.set(xscale="log", yscale="log", title=title, xlabel="eps / half-width", ylim=(1e-13, 1.0))
        axis.grid(alpha=0.3)
        axis.legend(fontsize=7)
    axes[0].set_ylabel("relative error between the nearest boxes")
    figure.tight_layout()
    return figure


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    rows = read_tables(sys.argv[1])
    charted = [row for row in rows if row.get("method") in STYLES]
    paired = [row for row in rows if "eps_over_h" in row]
    if not charted and not paired:
        sys.exit(f"{sys.argv[1]}: holds no output of 'bench_chart' or 'bench_fmm pair'")
    peers = read_tables(sys.argv[3]) if len(sys.argv) == 4 else []
    (draw_chart(charted, peers) if charted else draw_pair(paired)).savefig(sys.argv[2], dpi=150)


if __name__ == "__main__":
    main()
