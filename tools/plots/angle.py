"""How the fibers turn: the angle of the end-to-end vector, and its length."""

import numpy as np

import style
from diagnostics import open_diagnostics, read_words
from script import Nothing

MAX_FIBERS = 6
LABORATORY = "$+x$"  # what angles count from where the run is not analyzed
TURNING = (0, 1)  # codes of angle_origin in flows with vorticity


def read_end_to_end(run, n_fibers):
    """Times, vectors [n, n_fibers, 3], and the lengths [n, n_fibers] to compare them with."""
    if run.n_steps > 1:
        return run.step_times, run.steps("end_to_end", n_fibers), run.steps("centreline_length", n_fibers)
    if len(run.frame_times) < 2:
        raise Nothing("the run holds one moment only")
    # Without records of steps, frames still tell the ends.
    stride = max(1, len(run.frame_times) // style.MAX_POINTS)
    value = run.dataset("/observables/centreline/value")
    ends = [(run.fiber_sections(f).start, run.fiber_sections(f).stop - 1) for f in range(n_fibers)]
    vectors = np.stack([value[::stride, last] - value[::stride, first] for first, last in ends], axis=1)
    lengths = np.broadcast_to(run.lengths[:n_fibers], vectors.shape[:2])
    return run.frame_times[::stride], vectors, lengths


def measured_angles(run, n_fibers):
    """Times, degrees [n_fibers][n] as `skein analyze` measures them, whether the flow turns the fibers, and from what
    the angles count."""
    with open_diagnostics(run) as file:
        groups = [file[f"fiber_{f}"] for f in range(n_fibers)]
        if not all("angle_origin" in group for group in groups):
            raise Nothing("the tables of 'skein analyze' are of an older version")
        origins = {int(group["angle_origin"][0]) for group in groups}
        words = read_words(file, "angle_origins")
        counts_from = words[origins.pop()] if len(origins) == 1 else "direction that the flow has there"
        turning = all(int(group["angle_origin"][0]) in TURNING for group in groups)
        return run.frame_times, [group["angle"][()] for group in groups], turning, counts_from


def clockwise_angle(vectors):
    """Degrees clockwise from +x in the x-y plane, without jumps: for a run that is not analyzed. Moments that are not
    finite stay so."""
    angle = -np.arctan2(vectors[:, 1], vectors[:, 0])
    finite = np.isfinite(angle)
    angle[finite] = np.unwrap(angle[finite])
    return np.degrees(angle)


def first_passages(times, angle):
    """(time, level, sense) where the fiber first comes to each multiple of 90 degrees; sense: 1 clockwise, or -1."""
    finite = np.isfinite(angle)
    times, angle = times[finite], angle[finite]
    if len(angle) < 2:
        return []
    sense = 1.0 if angle.max() - angle[0] >= angle[0] - angle.min() else -1.0
    turned = sense * angle
    passages = []
    # A fiber that starts aligned is not marked for staying so.
    level = 90.0 * np.ceil((turned[0] + 1.0) / 90.0)
    while level <= turned.max():
        i = int(np.argmax(turned >= level))
        weight = (level - turned[i - 1]) / (turned[i] - turned[i - 1])
        passages.append((times[i - 1] + weight * (times[i] - times[i - 1]), sense * level, sense))
        level += 90.0
    return passages


def mark_passages(panel, passages, with_times, last_time):
    for time, level, sense in passages:
        vertical = round(level / 90.0) % 2 == 1
        panel.plot(time, level, marker="^" if vertical else "o", markersize=5, color="white",
                   markeredgecolor=style.OUTLINE, linestyle="", zorder=3)
        if with_times:
            # The curve rises, or falls, through the mark: there is room before and above it, or after and below.
            side = -1 if time > 0.3 * last_time else 1
            above = -side * sense
            panel.annotate(f"{'vertical' if vertical else 'aligned'}  t = {style.number(time)}", (time, level),
                           xytext=(5 * side, 2 * above), textcoords="offset points", fontsize=8, zorder=4,
                           ha="right" if side < 0 else "left", va="bottom" if above > 0 else "top")


def draw(run, options):
    shown = min(run.n_fibers, MAX_FIBERS)
    times, vectors, lengths = read_end_to_end(run, shown)
    try:
        angle_times, angles, turning, counts_from = measured_angles(run, shown)
    except Nothing:
        angle_times, angles = times, [clockwise_angle(vectors[:, fiber]) for fiber in range(shown)]
        turning, counts_from = True, LABORATORY
    figure, (top, bottom) = style.make_panels(run, 2, 5.0)
    lowest, highest = 0.0, 0.0
    for fiber in range(shown):
        angle = angles[fiber]
        style.plot_series(top, angle_times, angle, label=str(fiber), color=style.COLOURS[fiber])
        passages = first_passages(angle_times, angle) if turning else []
        mark_passages(top, passages, shown == 1 and len(passages) <= 12, angle_times[-1])
        distance = np.linalg.norm(vectors[:, fiber], axis=1) / lengths[:, fiber]
        style.plot_series(bottom, times, distance, color=style.COLOURS[fiber])
        if np.isfinite(angle).any():
            lowest, highest = min(lowest, np.nanmin(angle)), max(highest, np.nanmax(angle))
    turned = highest - lowest
    step = 45.0 if turned <= 225.0 else 90.0 * max(1, round(turned / 90.0 / 6.0))
    if turned > 60.0:
        top.set_yticks(np.arange(step * np.floor(lowest / step), highest + 0.5 * step, step))
    top.margins(y=0.12)  # room for the words beside the highest mark
    sense = "degrees clockwise" if turning else "degrees"
    top.set_ylabel(f"end-to-end angle\n({sense} from the\n{counts_from})" if counts_from != LABORATORY else
                   f"end-to-end angle in $x$-$y$\n({sense} from {counts_from})")
    bottom.set_ylabel("end-to-end distance\n/ centreline length")
    low, high = bottom.get_ylim()
    low = min(low, 0.995)  # a rigid fiber gives a flat line, not rounding errors
    bottom.set_ylim(low, max(high, 1.0 + 0.05 * (1.0 - low)))
    if shown > 1:
        for mark, name in (("^", "vertical"), ("o", "aligned")):
            top.plot([], [], marker=mark, color="white", markeredgecolor=style.OUTLINE, linestyle="", label=name)
    style.label_fibers(top, shown, run.n_fibers)
    return figure
