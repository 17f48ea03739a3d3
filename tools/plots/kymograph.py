"""Curvature against arclength and time."""

import matplotlib.pyplot as plt
import numpy as np

import style
from script import Nothing

MAX_FIBERS = 4
MAX_FRAMES = 1200  # more than a panel has rows of pixels


def cell_edges(centres):
    """[n + 1] edges of cells about [n] centres."""
    middle = 0.5 * (centres[1:] + centres[:-1])
    return np.concatenate(([centres[0]], middle, [centres[-1]]))


def draw(run, options):
    if len(run.frame_times) < 2:
        raise Nothing("the run holds one frame only")
    shown = min(run.n_fibers, MAX_FIBERS)
    stride = -(-len(run.frame_times) // MAX_FRAMES)
    times = run.frame_times[::stride]
    values = run.dataset("/observables/curvature/value")
    lengths = run.lengths
    curvatures = [values[: len(run.frame_times) : stride, run.fiber_sections(f)] for f in range(shown)]
    colours, bar = style.shown_range(np.concatenate([c.ravel() for c in curvatures]))

    figure, panels = plt.subplots(1, shown, sharey=True, squeeze=False, layout="constrained",
                                  figsize=(4.2 if shown == 1 else style.WIDTH, 5.2))
    for fiber, (panel, curvature) in enumerate(zip(panels[0], curvatures)):
        # Sections divide the length evenly.
        arclength = np.linspace(0.0, lengths[fiber], curvature.shape[1] + 1)
        image = panel.pcolormesh(arclength, cell_edges(times), curvature, cmap="inferno", rasterized=True, **colours)
        panel.set_facecolor(style.FAINT)  # shows through where a value is not finite
    style.label_kymographs(figure, panels[0], image, "curvature", run.n_fibers, **bar)
    figure.suptitle(style.describe_fibers(run, 55 if shown == 1 else 95), fontsize=9)
    return figure
