"""Elastic energy and who gives and takes it: the background flow's work, the fluid's dissipation, the springs."""

import style
from diagnostics import REGIMES, open_diagnostics, regime_spans
from script import Nothing


def draw(run, options):
    if len(run.frame_times) < 2:
        raise Nothing("the run holds one frame only")
    with open_diagnostics(run) as file:
        if "energy" not in file["fiber_0"]:
            raise Nothing("the forces were not analyzed")
        fibers = [file[f"fiber_{f}"] for f in range(run.n_fibers)]
        total = {name: sum(fiber[name][()] for fiber in fibers)
                 for name in ("energy", "background_power", "dissipation", "elastic_power", "viscosity_contribution")}
        regimes = fibers[0]["regime"][()]
    times = run.frame_times
    figure, (top, middle, bottom) = style.make_panels(run, 3, 5.6)
    style.plot_series(top, times, total["energy"], color=style.OUTLINE)
    top.set_ylabel("elastic energy\n($F_0 L_0$)")
    for name, label, colour in (("background_power", "work of the flow", style.COLOURS[0]),
                                ("dissipation", "dissipation", style.COLOURS[1]),
                                ("elastic_power", "into the springs", style.COLOURS[2])):
        style.plot_series(middle, times, total[name], color=colour, label=label)
    middle.set_ylabel("power\n($F_0 L_0 / T$)")
    middle.legend(frameon=False, ncol=3, loc="lower center", bbox_to_anchor=(0.5, 0.98), borderaxespad=0.1)
    cubed = (run.lengths**3).sum()
    style.plot_series(bottom, times, total["viscosity_contribution"] / cubed, color=style.OUTLINE)
    bottom.set_ylabel("growth of viscosity\n/ ($n L^3 \\mu$)")
    for panel in (top, middle, bottom):
        panel.ticklabel_format(axis="y", style="sci", scilimits=(-2, 3), useMathText=True)
    if run.n_fibers == 1:
        shade_regimes(top, times, regimes)
    return figure


def shade_regimes(panel, times, codes):
    """Names of the regimes along the top of a panel, where there is room for them."""
    low, high = panel.get_ylim()
    panel.set_ylim(low, high + 0.18 * (high - low))
    duration = times[-1] - times[0]
    for first, end, code in regime_spans(times, codes):
        if code > 0:
            panel.axvspan(first, end, color=style.COLOURS[code - 1], alpha=0.13, linewidth=0)
        if end - first > 0.06 * duration:
            panel.text(0.5 * (first + end), 0.97, REGIMES[code], transform=panel.get_xaxis_transform(), ha="center",
                       va="top", fontsize=7.5)
        elif end - first > 0.015 * duration:
            panel.text(0.5 * (first + end), 0.95, REGIMES[code], transform=panel.get_xaxis_transform(), ha="center",
                       va="top", fontsize=7.5, rotation=90)
