"""The common look of all pictures: sizes for a page of 7.2 inches, colours that colour-blind readers can tell apart."""

import io
import os
import textwrap

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from output_file import write_error, write_whole

WIDTH = 7.2  # inches, of a page of two columns
DPI = 200
MAX_POINTS = 3000  # of a curve: more than it has pixels
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"]  # Okabe and Ito 2008
OUTLINE = "#1a1a1a"
FAINT = "#8c8c8c"

TIME_LABEL = "time ($T$)"

plt.rcParams.update(
    {
        "font.size": 9,
        "axes.titlesize": 9,
        "axes.labelsize": 9,
        "xtick.labelsize": 8,
        "ytick.labelsize": 8,
        "legend.fontsize": 8,
        "axes.linewidth": 0.7,
        "lines.linewidth": 1.1,
        "axes.formatter.useoffset": False,
        "axes.prop_cycle": plt.cycler(color=COLOURS),
        "figure.dpi": DPI,
        "savefig.dpi": DPI,
        "pdf.fonttype": 42,
        "svg.fonttype": "none",
    }
)


def number(value):
    return f"{value:.4g}"


def describe_fibers(run, line_width=95):
    """ "fiber of length 0.139 L0", with the title of the scene and an unusual end of the run."""
    lengths = run.lengths
    low, high = number(lengths.min()), number(lengths.max())
    length = f"{low} $L_0$" if low == high else f"{low} to {high} $L_0$"
    text = f"fiber of length {length}" if run.n_fibers == 1 else f"{run.n_fibers} fibers of length {length}"
    # A dollar sign would start a formula.
    title = " ".join(run.attribute("title").split()).replace("$", r"\$")
    if title:
        text = "\n".join(textwrap.wrap(title, line_width)[:2]) + "\n" + text
    status = run.attribute("status")
    if status in ("failed", "stopped", "running"):
        text += f" ({status} at t = {number(max(run.frame_times[-1], run.step_times[-1] if run.n_steps else 0.0))})"
    return text


def make_panels(run, n, height):
    """Panels above each other with one time axis."""
    figure, panels = plt.subplots(n, 1, sharex=True, squeeze=False, figsize=(WIDTH, height), layout="constrained")
    figure.suptitle(describe_fibers(run), fontsize=9)
    for panel in panels[:, 0]:
        panel.grid(True, color="#e4e4e4", linewidth=0.6)
        panel.set_axisbelow(True)
    panels[-1, 0].set_xlabel(TIME_LABEL)
    figure.align_ylabels()
    return figure, panels[:, 0]


def thin(times, values):
    """Fewer points of the same look: of each bucket of points the lowest and the highest."""
    keep = np.isfinite(values)
    times, values = times[keep], values[keep]
    if len(times) <= MAX_POINTS:
        return times, values
    edges = np.linspace(0, len(times), MAX_POINTS // 2 + 1).astype(int)
    chosen = {0, len(times) - 1}
    for first, end in zip(edges[:-1], edges[1:]):
        bucket = values[first:end]
        chosen.update((first + int(bucket.argmin()), first + int(bucket.argmax())))
    chosen = np.array(sorted(chosen))
    return times[chosen], values[chosen]


def plot_series(panel, times, values, **look):
    """A curve, or dots where the points are few."""
    times, values = thin(times, values)
    panel.plot(times, values, marker="." if len(times) < 30 else "", **look)


def label_fibers(panel, shown, n_fibers):
    if n_fibers > 1:
        title = "fiber" if shown == n_fibers else f"fiber (first {shown} of {n_fibers})"
        columns = len(panel.get_legend_handles_labels()[0])
        panel.legend(title=title, ncol=columns, frameon=False, loc="lower center", bbox_to_anchor=(0.5, 1.0))


def shown_range(values, signed=False):
    """Limits of colours, and which ends of the bar go on beyond them, as keywords of pcolormesh and of colorbar.

    A kink of a few sections for a moment is ten times as sharp as the hooks are, which would then be black.
    """
    sizes = np.abs(values[np.isfinite(values)])
    if not sizes.size or not sizes.max() > 0.0:
        return {"vmin": -1.0 if signed else 0.0, "vmax": 1.0}, {"extend": "neither"}
    highest, usual = sizes.max(), np.percentile(sizes, 99.8)
    cut = 0.0 < usual < 0.5 * highest
    limit = usual if cut else highest
    return ({"vmin": -limit if signed else 0.0, "vmax": limit},
            {"extend": ("both" if signed else "max") if cut else "neither"})


def label_kymographs(figure, panels, image, quantity, n_fibers, **bar):
    """Labels panels of arclength and time, one for each fiber shown, and their common colours."""
    shown = len(panels)
    for fiber, panel in enumerate(panels):
        panel.set_xlabel("arclength ($L_0$)")
        panel.xaxis.set_major_locator(plt.MaxNLocator(5 if shown == 1 else 3))
        if n_fibers > 1:
            panel.set_title(f"fiber {fiber}" + (f" of {n_fibers}" if shown < n_fibers else ""))
    panels[0].set_ylabel(TIME_LABEL)
    figure.colorbar(image, ax=panels, label=f"{quantity} ($1/L_0$)", fraction=0.08, pad=0.03, **bar)


def save(figure, folder, name, file_format):
    """Writes the whole picture or none. @returns its path"""
    path = os.path.join(folder, f"{name}.{file_format}")
    image = io.BytesIO()
    figure.savefig(image, format=file_format)
    plt.close(figure)
    try:
        write_whole(path, image.getvalue())
    except OSError as error:
        raise write_error(path, error) from None
    return path
