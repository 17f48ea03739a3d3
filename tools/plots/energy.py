"""Elastic energy, and what the integrator did: step size, evaluations, and how close the fibers came to touch."""

import numpy as np

import style
from script import Nothing

MAX_FIBERS = 6
N_RATES = 150  # buckets of time over which evaluations are counted: single steps may be very short


def evaluations_per_time(times, evaluations):
    """Mean rates over equal buckets of time, and the buckets' edges."""
    edges = np.linspace(times[0], times[-1], N_RATES + 1)
    counts = np.diff(np.interp(edges, times, evaluations))
    return counts / np.diff(edges), edges


def draw(run, options):
    if run.n_steps < 2:
        raise Nothing("the run holds no records of steps" if run.n_steps == 0 else "the run holds one step only")
    times = run.step_times
    shown = min(run.n_fibers, MAX_FIBERS)
    energy = run.steps("energy", shown)
    dt = run.steps("dt")
    gap = run.steps("smallest_gap")
    has_gap = np.isfinite(gap).any()

    figure, panels = style.make_panels(run, 4 if has_gap else 3, 6.6 if has_gap else 5.4)
    for fiber in range(shown):
        style.plot_series(panels[0], times, energy[:, fiber], label=str(fiber), color=style.COLOURS[fiber])
    panels[0].set_ylabel("elastic energy\n($F_0 L_0$)")
    panels[0].ticklabel_format(axis="y", style="sci", scilimits=(-2, 3), useMathText=True)
    style.label_fibers(panels[0], shown, run.n_fibers)

    style.plot_series(panels[1], times, dt, color=style.OUTLINE)
    panels[1].set_ylabel("step size\n($T$)")
    # The first steps may be shorter than all others by many orders.
    settled = dt[(times >= times[0] + 0.01 * (times[-1] - times[0])) & (dt > 0.0)]
    if settled.size and settled.max() > 20.0 * settled.min():
        panels[1].set_yscale("log")
        panels[1].set_ylim(0.5 * settled.min(), 2.0 * settled.max())
    else:
        panels[1].set_ylim(bottom=0.0)

    panels[2].stairs(*evaluations_per_time(times, run.steps("evaluations")), color=style.OUTLINE, linewidth=1.1,
                     baseline=None)
    panels[2].set_ylabel("evaluations\nper time ($1/T$)")
    panels[2].set_ylim(bottom=0.0)

    if has_gap:
        style.plot_series(panels[3], times, gap, color=style.OUTLINE)
        panels[3].axhline(0.0, color=style.COLOURS[1], linewidth=0.8, linestyle="--")  # surfaces touch
        panels[3].set_ylabel("smallest gap\n($L_0$)")
    return figure
