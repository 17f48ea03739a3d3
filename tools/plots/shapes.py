"""The fibers at chosen times: tubes of their true radius, seen along -z, all panels to one scale."""

import math

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection

import style

N_DEFAULT = 8
MAX_HEIGHT = 6.8  # inches, of all rows
LEFT, RIGHT, BOTTOM, COLUMN_GAP, ROW_GAP = 0.62, 0.15, 0.48, 0.14, 0.27  # inches
COLOUR_BAR = 0.8  # inches
THIN = 1.2  # points: a thinner tube has no room for dark sides
OUT_OF_PLANE = 5.0  # radii of z beyond which a picture needs its third dimension


def choose_frames(run, wanted):
    """The frames nearest to the wanted times, and notes about times that the run does not have."""
    times = run.frame_times
    if not wanted:
        return telling_frames(run), []
    frames = [int(np.abs(times - t).argmin()) for t in wanted]
    reach = np.diff(times).max() if len(times) > 1 else 0.0
    notes = [f"no frame near t = {t:g}: t = {style.number(times[f])} is drawn instead"
             for t, f in zip(wanted, frames) if abs(times[f] - t) > max(reach, 1e-9)]
    return list(dict.fromkeys(frames)), notes


def telling_frames(run):
    """Frames at equal amounts of motion, with some weight on time: a fiber rests for most of a period."""
    n = len(run.frame_times)
    if n <= N_DEFAULT:
        return list(range(n))
    frame_stride, section_stride = -(-n // 500), -(-run.n_sections // 200)
    lines = run.dataset("/observables/centreline/value")[:n:frame_stride, ::section_stride].astype(float)
    lines -= lines.mean(axis=1, keepdims=True)
    motion = np.sqrt(np.nansum(np.diff(lines, axis=0) ** 2, axis=(1, 2)))
    motion = np.where(np.isfinite(motion), motion, 0.0)
    times = run.frame_times[::frame_stride]
    share = 0.7 * motion / max(motion.sum(), 1e-300) + 0.3 * np.diff(times) / (times[-1] - times[0])
    progress = np.concatenate(([0.0], np.cumsum(share)))
    aims = np.linspace(0.0, progress[-1], N_DEFAULT)
    frames = [frame_stride * int(np.abs(progress - aim).argmin()) for aim in aims]
    return sorted({*frames[:-1], n - 1})


def window_of(lines, radius):
    """Lower left corners [n, 2] of the panels' windows and their common size [2]: one place for all where that is not
    much larger than the largest shape, else each about its own shape."""
    low = np.array([np.nanmin(line[:, :2], axis=0) if np.isfinite(line).any() else [np.nan] * 2 for line in lines])
    high = np.array([np.nanmax(line[:, :2], axis=0) if np.isfinite(line).any() else [np.nan] * 2 for line in lines])
    if not np.isfinite(low).any():
        low, high = np.zeros_like(low), np.ones_like(high)
    own = np.nanmax(high - low, axis=0)
    common = np.nanmax(high, axis=0) - np.nanmin(low, axis=0)
    moving = bool((common > 1.5 * own.max()).any())
    size = own if moving else common
    middle = 0.5 * (low + high) if moving else np.tile(0.5 * (np.nanmax(high, axis=0) + np.nanmin(low, axis=0)),
                                                       (len(lines), 1))
    size = size + 2.0 * radius + 0.06 * size.max()
    size = np.maximum(size, 0.22 * size.max())  # room for tick labels beside a fiber that lies flat
    return np.nan_to_num(middle) - 0.5 * size, size, moving


def arrange(n, size, width, column_gap, row_gap):
    """Columns, and the panels' width in inches, for the largest panels on a page."""
    best = None
    for columns in range(1, n + 1):
        panel = min((width - (columns - 1) * column_gap) / columns, 4.5 * size[0] / size[1])
        rows = math.ceil(n / columns)
        fits = rows * (panel * size[1] / size[0] + row_gap) <= MAX_HEIGHT
        score = (fits, panel * (n / (rows * columns)) ** 3)
        if panel > 0.3 and (best is None or score > best[0]):
            best = (score, columns, panel)
    return best[1], best[2]


def add_tubes(panel, run, line, points_per_length, colour_of):
    """Every piece between two sections as a stroke as wide as the tube with dark sides, the nearest to the eye last."""
    starts = np.arange(run.n_sections - 1)
    ends_fiber = np.isin(starts + 1, run.first_section)
    starts = starts[~ends_fiber]
    starts = starts[np.isfinite(line[starts]).all(axis=1) & np.isfinite(line[starts + 1]).all(axis=1)]
    fiber = np.searchsorted(run.first_section, starts, side="right") - 1
    height = 0.5 * (line[starts, 2] + line[starts + 1, 2])
    # Pieces at the same height, up to rounding, stay in the order along the fiber.
    order = np.argsort(np.round(height / run.radius[fiber] * 100.0), kind="stable")

    def stretch(f, start, more):
        """The piece with as many neighbours on either side as the fiber has."""
        sections = run.fiber_sections(f)
        part = line[max(start - more, sections.start) : min(start + 2 + more, sections.stop), :2]
        return part[np.isfinite(part).all(axis=1)]

    strokes, widths, colours = [], [], []
    for start, f in zip(starts[order], fiber[order]):
        full = 2.0 * run.radius[f] * points_per_length
        side = min(0.5, 0.2 * full) if full > THIN else 0.0
        # The dark stroke reaches over the neighbours, so that no gap opens in a bend; the filling hides its ends.
        if side > 0.0:
            strokes.append(stretch(f, start, 1))
            widths.append(full)
            colours.append(style.OUTLINE)
        strokes.append(stretch(f, start, 2))
        widths.append(full - 2.0 * side)
        colours.append(colour_of(f, 0.5 * (line[start, 2] + line[start + 1, 2])))
    tubes = LineCollection(strokes, linewidths=widths, colors=colours, capstyle="butt", joinstyle="round")
    panel.add_collection(tubes)


def draw(run, options):
    frames, notes = choose_frames(run, options.times)
    options.notes.extend(notes)
    lines = [run.centreline(frame).astype(float) for frame in frames]
    corners, size, moving = window_of(lines, run.radius.max())

    heights = np.concatenate([line[np.isfinite(line).all(axis=1), 2] for line in lines])
    low, high = (heights.min(), heights.max()) if heights.size else (0.0, 0.0)
    is_3d = high - low > OUT_OF_PLANE * run.radius.min()
    scale = plt.cm.ScalarMappable(plt.Normalize(low, high), "viridis")

    def colour_of(fiber, z):
        return scale.to_rgba(z) if is_3d else style.COLOURS[fiber % len(style.COLOURS)]

    right = RIGHT + (COLOUR_BAR if is_3d else 0.0)
    column_gap, row_gap = (0.5, 0.45) if moving else (COLUMN_GAP, ROW_GAP)
    columns, panel_width = arrange(len(frames), size, style.WIDTH - LEFT - right, column_gap, row_gap)
    rows = math.ceil(len(frames) / columns)
    panel_height = panel_width * size[1] / size[0]
    title = style.describe_fibers(run) + ("; the windows follow the fibers" if moving else "")
    top = 0.16 * (1 + title.count("\n")) + 0.06
    grid_width = columns * panel_width + (columns - 1) * column_gap
    grid_height = rows * panel_height + (rows - 1) * row_gap + ROW_GAP
    width, height = max(style.WIDTH, LEFT + grid_width + right), BOTTOM + grid_height + top
    left = LEFT + 0.5 * (width - LEFT - right - grid_width)

    figure = plt.figure(figsize=(width, height))
    for i, (frame, line, corner) in enumerate(zip(frames, lines, corners)):
        row, column = divmod(i, columns)
        x = left + column * (panel_width + column_gap)
        y = BOTTOM + (rows - 1 - row) * (panel_height + row_gap)
        panel = figure.add_axes([x / width, y / height, panel_width / width, panel_height / height])
        panel.set_xlim(corner[0], corner[0] + size[0])
        panel.set_ylim(corner[1], corner[1] + size[1])
        panel.xaxis.set_major_locator(plt.MaxNLocator(max(2, min(6, int(panel_width / 0.55)))))
        panel.yaxis.set_major_locator(plt.MaxNLocator(max(2, min(6, int(panel_height / 0.35)))))
        panel.tick_params(labelleft=moving or column == 0, labelbottom=moving or i + columns >= len(frames), length=2.5)
        panel.set_title(f"t = {style.number(run.frame_times[frame])}", pad=3)
        add_tubes(panel, run, line, 72.0 * panel_width / size[0], colour_of)
        if not np.isfinite(line).all():
            panel.text(0.5, 0.5, "some positions are not finite", transform=panel.transAxes, ha="center", va="center")
    middle = (BOTTOM + 0.5 * grid_height) / height
    figure.text((left + 0.5 * grid_width) / width, 0.1 / height, "$x$ ($L_0$)", ha="center", va="bottom")
    figure.text((left - 0.5) / width, middle, "$y$ ($L_0$)", ha="center", va="center", rotation=90)
    figure.suptitle(title, y=1.0 - 0.08 / height, va="top", fontsize=9)
    if is_3d:
        bar = figure.add_axes([(left + grid_width + 0.12) / width, (middle - 0.35 * grid_height / height),
                               0.11 / width, 0.7 * grid_height / height])
        figure.colorbar(scale, cax=bar, label="$z$ ($L_0$), toward the eye")
    return figure
