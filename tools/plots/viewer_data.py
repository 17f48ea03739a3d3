"""What the viewer's page holds of a run: centrelines, colours and curves, thinned and packed so that the page stays small.

Arrays travel as base64 of little-endian numbers. Places are sixteen-bit steps of a box about each frame's fibers: 65536 of
them across the largest frame, 1.5e-5 of it, where half-precision numbers would have 5e-4.
"""

import base64

import numpy as np

import style
from diagnostics import open_diagnostics, read_words
from script import Nothing
from skein_package import DamagedData

MAX_FRAMES = 1000
MAX_POINTS = 2_000_000  # of centrelines, all frames together: 13.3 bytes each in the page, 27 MB
MAX_CURVE = 1500  # points of a curve
MAX_CURVES = 64  # fibers with curves of their own
STEPS = 65535  # of a sixteen-bit number


def pack(array):
    return base64.b64encode(np.ascontiguousarray(array).tobytes()).decode()


def pack_range(values, signed):
    """Numbers as sixteen-bit steps from the smallest to the largest, not a number is 65535; and which of them colours show."""
    colours, _ = style.shown_range(values, signed)
    finite = np.isfinite(values)
    low, high = (float(values[finite].min()), float(values[finite].max())) if finite.any() else (0.0, 0.0)
    span = high - low or 1.0
    steps = np.where(finite, np.round((np.where(finite, values, low) - low) / span * (STEPS - 1)), STEPS)
    return {"low": low, "high": high, "steps": pack(steps.astype("<u2")), "signed": signed,
            "shown": [float(colours["vmin"]), float(colours["vmax"])]}


def choose_points(run):
    """@returns the frames that are shown, and the sections of each fiber; both ends of a fiber are among them"""
    n_frames = min(len(run.frame_times), MAX_FRAMES)
    every = max(1, -(-run.n_sections * n_frames // MAX_POINTS))
    sections = []
    for fiber in range(run.n_fibers):
        where = run.fiber_sections(fiber)
        n_kept = max(2, -(-run.sections[fiber] // every))
        sections.append(np.unique(np.round(np.linspace(where.start, where.stop - 1, n_kept)).astype(int)))
    if sum(map(len, sections)) > MAX_POINTS:
        raise Nothing(f"a run of {run.n_fibers} fibers is too large for a page")
    n_frames = max(1, min(n_frames, MAX_POINTS // sum(map(len, sections))))
    return np.unique(np.round(np.linspace(0, len(run.frame_times) - 1, n_frames)).astype(int)), sections


def pack_places(run, frames, kept):
    """Centrelines of the shown frames, each about its middle. @returns also how far neighbours are apart over how far they
    are at rest, less one"""
    middles, halves, centred, stretch = [], [], [], []
    rest = np.repeat(run.lengths / run.sections, run.sections)
    for frame in frames:
        line = run.centreline(frame)
        if not np.isfinite(line).all():
            raise DamagedData(f"{run.path}: centrelines of frame {frame} are not numbers")
        spacing = np.linalg.norm(np.diff(line, axis=0, append=line[-1:]), axis=1)
        strain = spacing / rest - 1.0
        for fiber in range(run.n_fibers):  # behind the last section there is none
            strain[run.fiber_sections(fiber).stop - 1] = strain[max(run.fiber_sections(fiber).stop - 2, 0)]
        stretch.append(strain[kept])
        line = line[kept].astype(float)
        middle = 0.5 * (line.min(axis=0) + line.max(axis=0))
        middles.append(middle)
        halves.append(np.abs(line - middle).max())
        centred.append(line - middle)
    half = max(max(halves), 1e-30)
    steps = [np.round((line / half + 1.0) * 0.5 * STEPS).astype("<u2") for line in centred]
    return ({"half": half, "middles": pack(np.array(middles, "<f4")), "steps": pack(np.array(steps))},
            np.array(stretch, dtype=np.float32))


def curvatures(run, frames, sections):
    """[n_frames, n_points], signed where the run was analyzed. @returns also whether it is"""
    kept = np.concatenate(sections)
    values = run.dataset("/observables/curvature/value")
    found = np.array([values[frame] for frame in frames], dtype=np.float32)[:, kept]
    try:
        with open_diagnostics(run) as file:
            first = 0
            for fiber, where in enumerate(sections):
                signed = file[f"fiber_{fiber}/signed_curvature"][()]
                if signed.shape != (len(run.frame_times), run.sections[fiber]):
                    return found, False
                found[:, first : first + len(where)] = signed[frames][:, where - run.first_section[fiber]]
                first += len(where)
        return found, True
    except (Nothing, KeyError):
        return found, False


def regimes(run, frames):
    """Codes [n_frames, n_fibers] and their words, or nothing where the run was not analyzed."""
    try:
        with open_diagnostics(run) as file:
            codes = np.stack([file[f"fiber_{fiber}/regime"][()][frames] for fiber in range(run.n_fibers)], axis=1)
            return {"codes": pack(codes.astype("u1")), "words": read_words(file, "regimes")}
    except (Nothing, KeyError):
        return None


def thin(times, n_curves):
    n_kept = max(2, min(len(times), MAX_CURVE, 20_000 // max(1, n_curves)))
    return np.unique(np.round(np.linspace(0, len(times) - 1, n_kept)).astype(int))


def curve(times, values):
    """Of some fibers: [n_times], [n_times, n_fibers]"""
    return {"times": pack(np.asarray(times, "<f4")), "values": pack(np.asarray(values, "<f4").T), "fibers": values.shape[1]}


def measure_curves(run):
    """The elastic energy of steps, and the angle of the end-to-end vector as far as it was measured."""
    n_fibers = min(run.n_fibers, MAX_CURVES)
    curves = {}
    if run.n_steps > 1:
        kept = thin(run.step_times, n_fibers)
        curves["energy"] = curve(run.step_times[kept], run.steps("energy", n_fibers)[kept])
    try:
        with open_diagnostics(run) as file:
            kept = thin(run.frame_times, n_fibers)
            angles = np.stack([file[f"fiber_{fiber}/angle"][()][kept] for fiber in range(n_fibers)], axis=1)
            curves["angle"] = curve(run.frame_times[kept], angles)
    except (Nothing, KeyError):
        pass  # the page says that it is not there
    return curves


def read_view(run):
    """All of it, ready for JSON."""
    frames, sections = choose_points(run)
    places, stretch = pack_places(run, frames, np.concatenate(sections))
    values, is_signed = curvatures(run, frames, sections)
    return {
        "title": run.attribute("title"), "status": run.attribute("status"), "flow_words": run.attribute("flow"),
        "times": [float(time) for time in run.frame_times[frames]], "all_frames": len(run.frame_times),
        "points": [len(part) for part in sections], "radius": [float(radius) for radius in run.radius],
        "lengths": [float(length) for length in run.lengths], "places": places,
        "curvature": pack_range(values, is_signed), "tension": pack_range(stretch, True),
        "regimes": regimes(run, frames), "curves": measure_curves(run),
    }
