"""What was measured in the runs of a sweep over two of its columns: cells of a grid, or dots where there is none."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import BoundaryNorm, ListedColormap

import style
from sweep_curves import set_axis

# Of regimes, in growing order of complexity: light to dark, told apart without colours, too.
ORDERED = ["#f2f0d8", "#b7ddb0", "#6bbcb4", "#3b8bb5", "#3a539b", "#3b1f5f"]


def find_edges(centers, is_wide):
    """Borders of cells around sorted values."""
    places = np.log(centers) if is_wide else centers
    if len(places) == 1:
        half = 0.5
        edges = np.array([places[0] - half, places[0] + half])
    else:
        middle = 0.5 * (places[1:] + places[:-1])
        edges = np.concatenate(([2 * places[0] - middle[0]], middle, [2 * places[-1] - middle[-1]]))
    return np.exp(edges) if is_wide else edges


def choose_colours(value):
    """Keywords of pcolormesh and scatter, and of the bar."""
    if not value.words:
        return {"cmap": "viridis", "norm": value.scale()}, {}
    n = len(value.words)
    colours = ORDERED if n == len(ORDERED) else [plt.get_cmap("viridis")(i / max(n - 1, 1)) for i in range(n)]
    return {"cmap": ListedColormap(colours[:n]), "norm": BoundaryNorm(np.arange(n + 1) - 0.5, n)}, {"ticks": range(n)}


def combine(value, values):
    """Of several runs at one place: the most complex regime, else the mean."""
    known = values[np.isfinite(values)]
    if not known.size:
        return np.nan
    return known.max() if value.words else known.mean()


def make_grid(x, y, value, done):
    """Values by rows of y and columns of x; None where most places of such a grid would be empty."""
    columns, rows = np.unique(x.values), np.unique(y.values)
    if columns.size * rows.size > 2 * len(np.unique(np.stack((x.values, y.values)), axis=1)[0]):
        return None
    grid = np.full((rows.size, columns.size), np.nan)
    for i, row in enumerate(rows):
        for j, column in enumerate(columns):
            grid[i, j] = combine(value, value.values[done & (y.values == row) & (x.values == column)])
    return columns, rows, grid


def draw_map(table, value, x, y):
    figure, panel = plt.subplots(figsize=(0.8 * style.WIDTH, 4.2), layout="constrained")
    done = table.is_done
    colours, bar = choose_colours(value)
    grid = make_grid(x, y, value, done)
    set_axis(panel.xaxis, x, x.values)
    set_axis(panel.yaxis, y, y.values)
    if grid is None:
        rows = done & np.isfinite(value.values)
        image = panel.scatter(x.values[rows], y.values[rows], c=value.values[rows], s=22, edgecolors="#555555",
                              linewidths=0.4, **colours)
    else:
        columns, rows, values = grid
        image = panel.pcolormesh(find_edges(columns, x.is_wide()), find_edges(rows, y.is_wide()), values,
                                 edgecolors="white", linewidth=0.3, **colours)
        panel.margins(0)
    lost = table.is_failed | (done & ~np.isfinite(value.values))
    if lost.any():
        panel.plot(x.values[lost], y.values[lost], "x", color=style.FAINT, markersize=4)
        panel.set_title(r"$\times$: failed, or no answer", loc="right", fontsize=8, color="#555555")
    shown = figure.colorbar(image, ax=panel, pad=0.02, label="" if value.words else value.label, **bar)
    if value.words:
        shown.ax.set_yticklabels(value.words)
        shown.ax.tick_params(length=0)
        shown.minorticks_off()
        shown.ax.set_title(value.name, fontsize=9, loc="left")
    return figure
