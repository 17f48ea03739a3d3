"""What was measured in the runs of a sweep over one of its columns: a curve, or one for each value of another."""

import matplotlib.pyplot as plt
import numpy as np

import style

MARKERS = "oDs^vP"
MANY = len(style.COLOURS)  # curves that colours and a legend can tell apart


def set_axis(axis, column, values):
    """Ticks in words, or a logarithmic scale, where the column asks for it."""
    if column.words:
        highest = int(np.nanmax(values)) if np.isfinite(values).any() else 0
        shown = range(max(highest, min(2, len(column.words) - 1)) + 1)
        axis.set_ticks(list(shown), [column.words[i] for i in shown])
        axis.set_view_interval(-0.4, shown[-1] + 0.4, ignore=True)
    elif column.is_wide():
        getattr(axis.axes, f"set_{axis.axis_name}scale")("log")
    axis.set_label_text(column.label)


def draw_series(panel, x, y, is_line, **look):
    order = np.argsort(x, kind="stable")
    keep = order[np.isfinite(y[order])]
    panel.plot(x[keep], y[keep], linestyle="-" if is_line else "", linewidth=0.8, markersize=4.5 if len(keep) < 60 else 3,
               markeredgecolor="white", markeredgewidth=0.4, **look)


def draw_curves(table, value, x, by, drawn):
    """@param by  a column, or None  @param drawn  names of parameters whose values are random"""
    figure, panel = plt.subplots(figsize=(style.WIDTH, 3.6), layout="constrained")
    done = table.is_done
    groups = np.unique(by.values[done]) if by else np.array([np.nan])
    are_many = len(groups) > MANY
    colours = [plt.get_cmap("viridis")(by.scale()(group)) for group in groups] if are_many else style.COLOURS
    for i, group in enumerate(groups):
        rows = done & (by.values == group) if by else done
        is_line = x.name not in drawn and len(np.unique(x.values[rows])) == rows.sum()
        draw_series(panel, x.values[rows], value.values[rows], is_line, color=colours[i], marker=MARKERS[0 if are_many else i],
                    label=by.shown(group) if by else None)
    set_axis(panel.xaxis, x, x.values)
    set_axis(panel.yaxis, value, value.values[done])
    if table.is_failed.any():
        panel.plot(x.values[table.is_failed], np.full(table.is_failed.sum(), 0.02), "x", color=style.FAINT, markersize=4,
                   transform=panel.get_xaxis_transform(), label=None if are_many else "failed")
    if are_many and not by.words:
        figure.colorbar(plt.cm.ScalarMappable(by.scale(), "viridis"), ax=panel, label=by.label, pad=0.02)
    elif by or table.is_failed.any():
        panel.legend(title=by.label if by else None, frameon=False, loc="center left", bbox_to_anchor=(1.0, 0.5))
    panel.grid(True, color="#e4e4e4", linewidth=0.6)
    panel.set_axisbelow(True)
    return figure
