"""Signed curvature against arclength and time, with the extrema that were followed and their speeds."""

import matplotlib.pyplot as plt
import numpy as np

import style
from diagnostics import open_diagnostics, split_tracks
from kymograph import MAX_FIBERS, MAX_FRAMES, cell_edges
from script import Nothing

TRAVELLING = 1
LONG = 0.03  # of the run's time: a shorter track gets no word


def draw_tracks(panel, fiber, duration, length):
    """The extrema as lines, and the speeds of those that travel."""
    for times, arclength, (first, last, intercept, speed, _, wave) in split_tracks(fiber):
        panel.plot(arclength, times, color=style.OUTLINE, linewidth=1.4)
        panel.plot(arclength, times, color="#ffd23f", linewidth=0.7)
        if wave != TRAVELLING or last - first < LONG * duration:
            continue
        # Beside the middle of the line, towards the end of the fiber that it came from.
        middle = len(times) // 2
        to_left = arclength[middle] < 0.5 * length
        panel.annotate(f"{abs(speed):.3g}", (arclength[middle], times[middle]), xytext=(-5 if to_left else 5, 0),
                       textcoords="offset points", ha="right" if to_left else "left", va="center", fontsize=7.5,
                       bbox={"boxstyle": "round,pad=0.15", "facecolor": "white", "edgecolor": "none", "alpha": 0.85})


def draw(run, options):
    if len(run.frame_times) < 2:
        raise Nothing("the run holds one frame only")
    with open_diagnostics(run) as file:
        shown = min(run.n_fibers, MAX_FIBERS)
        stride = -(-len(run.frame_times) // MAX_FRAMES)
        times = run.frame_times[::stride]
        curvatures = [file[f"fiber_{f}/signed_curvature"][::stride] for f in range(shown)]
        colours, bar = style.shown_range(np.concatenate([c.ravel() for c in curvatures]), signed=True)
        figure, panels = plt.subplots(1, shown, sharey=True, squeeze=False, layout="constrained",
                                      figsize=(4.4 if shown == 1 else style.WIDTH, 5.2))
        for f, (panel, curvature) in enumerate(zip(panels[0], curvatures)):
            length = run.lengths[f]
            edges = np.linspace(0.0, length, curvature.shape[1] + 1)
            image = panel.pcolormesh(edges, cell_edges(times), curvature, cmap="RdBu_r", rasterized=True, **colours)
            draw_tracks(panel, file[f"fiber_{f}"], times[-1] - times[0], length)
            panel.set_xlim(0.0, length)
    style.label_kymographs(figure, panels[0], image, "signed curvature", run.n_fibers, **bar)
    figure.suptitle(style.describe_fibers(run, 55 if shown == 1 else 95)
                    + "\nlines: followed extrema; numbers: speeds ($L_0/T$)", fontsize=9)
    return figure
