"""What grows out of nothing: the departure from the plane and from odd symmetry."""

import numpy as np

import style
from diagnostics import open_diagnostics
from script import Nothing

MAX_FIBERS = 6


def draw(run, options):
    if len(run.frame_times) < 2:
        raise Nothing("the run holds one frame only")
    with open_diagnostics(run) as file:
        shown = min(run.n_fibers, MAX_FIBERS)
        out = [file[f"fiber_{f}/out_of_plane"][()] for f in range(shown)]
        odd = [file[f"fiber_{f}/symmetry_defect"][()] for f in range(shown)]
    times = run.frame_times
    figure, (top, bottom) = style.make_panels(run, 2, 4.6)
    for f in range(shown):
        for panel, values in ((top, out[f]), (bottom, odd[f])):
            style.plot_series(panel, times, np.where(values > 0.0, values, np.nan), label=str(f),
                              color=style.COLOURS[f])
    for panel in (top, bottom):
        panel.set_yscale("log")
        low, high = panel.get_ylim()
        panel.set_ylim(max(low, 1e-18), 3.0 * high)
    top.axhline(run.radius.min(), color=style.FAINT, linewidth=0.8, linestyle="--")
    top.set_ylim(top=3.0 * max(run.radius.min(), top.get_ylim()[1] / 3.0))
    top.annotate("fiber radius", (times[-1], run.radius.min()), xytext=(-2, -3), textcoords="offset points", ha="right",
                 va="top", fontsize=7.5, color=style.FAINT)
    top.set_ylabel("out of the plane\n($L_0$)")
    bottom.set_ylabel("departure from odd\nsymmetry / length")
    style.label_fibers(top, shown, run.n_fibers)
    return figure
