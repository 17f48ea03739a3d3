"""Checks `skein plot`'s script on small runs made here: check_plots.py PATH/plot_run.py

Pictures are files of their format, of a size for print, with the tube as thick as the run says; what a run lacks is
said in one line; damaged, missing and unwritable folders end with their exit codes and never with a traceback.
"""
import contextlib
import io
import os
import pathlib
import resource
import subprocess
import sys
import tempfile

import h5py
import matplotlib.image
import numpy as np

from checks import check

sys.dont_write_bytecode = True  # of the script in the sources

N_FRAMES, N_SECTIONS, SPACING, RADIUS = 25, 30, 0.004, 0.007
PICTURES = ("shapes", "angle", "curvature", "energy", "extrema", "power", "defects")
BLUE, ORANGE = (0, 114, 178), (213, 94, 0)  # of the first and the second fiber


def make_lines(times, out_of_plane):
    """Two fibers that turn clockwise, half a turn in the time 6, and bend. @returns [n_frames, 2 * N_SECTIONS, 3]"""
    arclength = (np.arange(N_SECTIONS) - 0.5 * (N_SECTIONS - 1)) * SPACING
    bend = 0.02 * np.sin(np.pi * arclength / arclength[-1])
    lines = np.empty((len(times), 2 * N_SECTIONS, 3))
    for frame, time in enumerate(times):
        cosine, sine = np.cos(np.pi * time / 6.0), -np.sin(np.pi * time / 6.0)
        x, y = cosine * arclength - sine * bend, sine * arclength + cosine * bend
        z = out_of_plane * arclength
        lines[frame, :N_SECTIONS] = np.stack([x, y, z], axis=1)
        lines[frame, N_SECTIONS:] = np.stack([x, y + 0.1, z], axis=1)
    return lines


def write_run(folder, n_frames=N_FRAMES, n_steps=400, status="done", out_of_plane=0.0, last_is_nan=False):
    """A run folder with one segment, seen through the virtual datasets of trajectory.h5."""
    (folder / "segments").mkdir(parents=True)
    times = np.linspace(0.0, 6.0, n_frames) if n_frames > 1 else np.zeros(1)
    lines = make_lines(times, out_of_plane)
    if last_is_nan:
        lines[-1] = np.nan
    step_times = np.linspace(0.01, 6.0, n_steps)
    at_steps = make_lines(step_times, out_of_plane)
    ends = at_steps[:, [N_SECTIONS - 1, -1]] - at_steps[:, [0, N_SECTIONS]]
    elements = {
        "centreline": (lines, times),
        "curvature": (np.abs(lines[:, :, 1]) * 300.0, times),
        "energy": (np.stack([step_times, 2.0 * step_times], axis=1) * 1e-6, step_times),
        "centreline_length": (np.full((n_steps, 2), (N_SECTIONS - 1) * SPACING), step_times),
        "end_to_end": (ends, step_times),
        "dt": (np.full(n_steps, 0.015), step_times),
        "evaluations": (np.arange(n_steps) * 12, step_times),
        "smallest_gap": (np.full(n_steps, np.inf), step_times),
    }
    with h5py.File(folder / "segments/000000.h5", "w") as segment, h5py.File(folder / "trajectory.h5", "w") as index:
        for name, (values, moments) in elements.items():
            for part, content in (("value", values), ("time", moments)):
                dataset = f"/observables/{name}/{part}"
                segment[dataset] = content
                if content.shape[0] == 0:
                    index[dataset] = content
                    continue
                layout = h5py.VirtualLayout(content.shape, content.dtype)
                layout[...] = h5py.VirtualSource("segments/000000.h5", dataset, content.shape)
                index.create_virtual_dataset(dataset, layout, fillvalue=np.nan if content.dtype.kind == "f" else -1)
        parameters = index.create_group("parameters")
        parameters["fiber_sections"] = np.array([N_SECTIONS] * 2, dtype="i4")
        parameters["first_section"] = np.array([0, N_SECTIONS], dtype="i4")
        parameters["fiber_radius"] = np.array([RADIUS] * 2)
        parameters["fiber_length"] = np.array([N_SECTIONS * SPACING] * 2)
        parameters.attrs["title"] = "Two fibers of $x^$ and 100 % of a_b"  # would be a broken formula
        parameters.attrs["status"] = status
    write_analysis(folder, times, lines)
    return folder


def write_analysis(folder, times, lines):
    """The tables of `skein analyze`, made up but for their shapes: one extremum travels, one stands."""
    (folder / "analysis").mkdir()
    n = len(times)
    with h5py.File(folder / "analysis/diagnostics.h5", "w") as file:
        file["time"] = times
        file.attrs["angle_origins"] = "0 direction of the flow, 1 first direction, 2 axis of strain"
        for fiber in range(2):
            group = file.create_group(f"fiber_{fiber}")
            part = lines[:, fiber * N_SECTIONS : (fiber + 1) * N_SECTIONS]
            group["signed_curvature"] = 300.0 * part[:, :, 1] * (-1.0) ** fiber
            group["arclength"] = np.tile(np.arange(N_SECTIONS) * SPACING, (n, 1))
            group["regime"] = (np.arange(n) > n // 2) * 3.0
            for i, name in enumerate(("energy", "background_power", "dissipation", "elastic_power",
                                      "viscosity_contribution", "out_of_plane", "symmetry_defect")):
                group[name] = 1e-6 * (i + 1) * (1 + fiber) * np.exp(0.1 * times)
            group["angle"], group["angle_origin"] = 30.0 * times, [0.0]  # as make_lines turns them
            track = np.zeros(n)
            group["track_points"] = np.concatenate([np.stack([track + 0, times, 0.02 + 0.01 * times, track + 5], axis=1),
                                                    np.stack([track + 1, times, track + 0.1, track - 5], axis=1)])
            group["tracks"] = np.array([[0, 6, 0.02, 0.01, 1, 1], [0, 6, 0.1, 0, 1, 0]], dtype=float)


class Result:
    def __init__(self, returncode, stdout, stderr):
        self.returncode, self.stdout, self.stderr = returncode, stdout, stderr


def plot(script, *arguments):
    """Runs the script in this process: to import matplotlib each time would take longer than the pictures."""
    sys.path.insert(0, str(pathlib.Path(script).parent))
    plot_run = __import__(pathlib.Path(script).stem)
    sys.argv = [script, *map(str, arguments)]
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            code = plot_run.main()
        except SystemExit as end:
            code = end.code
    return Result(code, out.getvalue(), err.getvalue())


def plot_in_own_process(script, *arguments):
    result = subprocess.run([sys.executable, script, *map(str, arguments)], capture_output=True, text=True)
    return Result(result.returncode, result.stdout, result.stderr)


def check_fails(script, code, words, *arguments):
    result = plot(script, *arguments)
    check(result.returncode == code, f"{arguments}: exit code {result.returncode}, not {code}: {result.stderr}")
    check(words in result.stderr, f"{arguments}: {words!r} is not in {result.stderr!r}")


def read_picture(path):
    """[height, width, 3], 0 to 255"""
    check(path.read_bytes()[:8] == b"\x89PNG\r\n\x1a\n", f"{path} is no PNG")
    pixels = (matplotlib.image.imread(path)[:, :, :3] * 255.0).round().astype(int)
    height, width, _ = pixels.shape
    check(600 <= width <= 2400 and 400 <= height <= 2400, f"{path} is {width} x {height} pixels")
    n_colours = len(np.unique(pixels.reshape(-1, 3), axis=0))
    check(n_colours > 30, f"{path} has {n_colours} colours only")
    return pixels


def count(pixels, colour):
    return int((np.abs(pixels - np.array(colour)).max(axis=2) <= 2).sum())


def check_complete_run(script, folder):
    result = plot_in_own_process(script, write_run(folder), "--times=0")
    check(result.returncode == 0 and not result.stderr, f"a good run: {result.returncode}, {result.stderr}")
    paths = [folder / "plots" / f"{name}.png" for name in PICTURES]
    check(result.stdout.split() == [str(path) for path in paths], f"not the paths of the pictures: {result.stdout}")
    pictures = {path.stem: read_picture(path) for path in paths}
    for name in ("shapes", "energy", "defects"):
        for colour in (BLUE, ORANGE):
            check(count(pictures[name], colour) > 200, f"{name}: a fiber is not drawn")

    # Along the column through its middle, the fiber is as thick as the tube, to a scale told by its own length.
    blue = np.abs(pictures["shapes"] - np.array(BLUE)).max(axis=2) <= 60
    columns = np.flatnonzero(blue.sum(axis=0))
    pixels_per_length = (columns[-1] - columns[0]) / ((N_SECTIONS - 1) * SPACING)
    slope = np.pi * 0.02 / (0.5 * (N_SECTIONS - 1) * SPACING)
    expected = 2.0 * RADIUS * np.hypot(1.0, slope) * pixels_per_length
    middle = (columns[0] + columns[-1]) // 2
    dark = pictures["shapes"][:, middle].max(axis=1) < 200
    rows = np.flatnonzero(blue[:, middle])
    first, last = rows[0], rows[-1]
    while dark[first - 1]:
        first -= 1
    while dark[last + 1]:
        last += 1
    thickness = last - first + 1
    check(abs(thickness / expected - 1.0) < 0.12, f"shapes: the tube is {thickness} pixels thick, not {expected:.1f}")


def check_options(script, folder):
    run = write_run(folder / "run", out_of_plane=3.0)
    result = plot(script, run, "--times=1,2.99,77", "--output", folder / "new/pictures", "--format", "svg")
    check(result.returncode == 0, result.stderr)
    check("no frame near t = 77: t = 6 is drawn" in result.stderr, f"silent about a time out of range: {result.stderr}")
    shapes = (folder / "new/pictures/shapes.svg").read_text()
    for text in ("t = 1<", "t = 3<", "t = 6<", "toward the eye"):
        check(text in shapes, f"shapes.svg does not say {text!r}")
    angle = (folder / "new/pictures/angle.svg").read_text()
    extrema = (folder / "new/pictures/extrema.svg").read_text()
    check(extrema.count(">0.01<") == 2, "extrema.svg: not the speed of each fiber's travelling extremum")
    check("direction of the flow)" in angle, "angle.svg does not say what angles count from")
    check(">180<" in angle and ">\u221245<" not in angle, "angle.svg: the angle does not grow to 180 degrees")
    check(not (run / "plots").exists(), "pictures were also written into the run folder")
    check_fails(script, 64, "--times", run, "--times=1,x")
    check_fails(script, 64, "--format", run, "--format=gif")


def check_flow_that_does_not_turn(script, folder):
    """Angles from an axis of strain have no passages through quarter turns, and say what they count from."""
    run = write_run(folder / "strained", out_of_plane=3.0)
    with h5py.File(run / "analysis/diagnostics.h5", "r+") as file:
        for fiber in range(2):
            file[f"fiber_{fiber}/angle_origin"][0] = 2.0
    check(plot(script, run, "--format", "svg").returncode == 0, "a flow without vorticity is not drawn")
    angle = (run / "plots/angle.svg").read_text()
    check("axis of strain)" in angle and "clockwise" not in angle, "angle.svg: angles from an axis of strain")


def check_poor_runs(script, folder):
    short = plot(script, write_run(folder / "short", n_frames=1, n_steps=0, status="running"))
    check(short.returncode == 0 and len(short.stdout.split()) == 1, f"one frame: {short.stdout}{short.stderr}")
    check(short.stderr.count(" is not drawn: ") == 6, f"not said what is missing: {short.stderr}")
    without_steps = plot(script, write_run(folder / "without_steps", n_steps=0))
    paths = [pathlib.Path(path).stem for path in without_steps.stdout.split()]
    check(paths == ["shapes", "angle", "curvature", "extrema", "power", "defects"], f"without records of steps only {paths} are drawn")
    failed = plot(script, write_run(folder / "failed", status="failed", last_is_nan=True), "--format=svg")
    check(failed.returncode == 0, failed.stderr)
    shapes = (folder / "failed/plots/shapes.svg").read_text()
    check("failed at t = 6" in shapes and "not finite" in shapes, "shapes.svg does not say that the run failed")


def check_analysis_is_of_the_run(script, folder):
    run = write_run(folder / "run")
    with h5py.File(run / "analysis/diagnostics.h5", "a") as file:
        file["time"][-1] += 1.0
    stale = plot(script, run)
    check(stale.returncode == 0 and stale.stderr.count("is not of these frames") == 3, f"a stale analysis: {stale.stderr}")
    (run / "analysis/diagnostics.h5").unlink()
    missing = plot(script, run)
    check(missing.returncode == 0 and missing.stderr.count("run 'skein analyze' first") == 3, missing.stderr)


def check_errors(script, folder):
    nowhere = plot_in_own_process(script, folder / "nowhere")
    check(nowhere.returncode == 66, f"a missing run folder: exit code {nowhere.returncode}")
    check(nowhere.stderr == f"skein plot: the run folder {folder / 'nowhere'} is not there\n", nowhere.stderr)
    (folder / "empty").mkdir()
    check_fails(script, 66, "no trajectory.h5", folder / "empty")
    (folder / "empty/trajectory.h5").write_bytes(b"not HDF5")
    check_fails(script, 65, "cannot be read", folder / "empty")
    lost = write_run(folder / "lost")
    (lost / "segments/000000.h5").unlink()
    check_fails(script, 65, "000000.h5", lost)
    poor = write_run(folder / "poor")
    with h5py.File(poor / "trajectory.h5", "a") as index:
        del index["/observables/energy"]
    check_fails(script, 65, "/observables/energy", poor)
    (folder / "file").write_text("")
    check_fails(script, 73, "cannot be written", write_run(folder / "run"), "-o", folder / "file/plots")
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (1000, hard))  # stands for a full disk
    check_fails(script, 74, "File too large", folder / "run", "-o", folder / "full")
    resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    check(not list((folder / "full").iterdir()), "a half-written picture was left")


def check_planted_links(script, folder):
    """What somebody left where pictures are going to be written loses its name, and is not opened."""
    run, pictures = write_run(folder / "run"), folder / "pictures"
    pictures.mkdir()
    (folder / "precious").write_text("precious")
    (pictures / "shapes.png.partial").symlink_to(folder / "precious")
    (pictures / "angle.png").symlink_to(folder / "precious")
    os.mkfifo(pictures / "curvature.png.partial")
    result = plot(script, run, "-o", pictures)
    check(result.returncode == 0 and len(result.stdout.split()) == len(PICTURES), result.stderr)
    check((folder / "precious").read_text() == "precious", "a planted link was followed")
    check({path.name for path in pictures.iterdir()} == {f"{name}.png" for name in PICTURES}, "something is left")
    read_picture(pictures / "angle.png")


def check_messages():
    """No control character of a title or a name reaches a terminal."""
    from script import printable

    check(printable("caf\u00e9 \u05d0 a\nb") == "caf\u00e9 \u05d0 a\nb", "letters are changed")
    raw = os.fsdecode(b"\x1b[2J\x9b\r") + "\u009b\u202e\u2028"
    check(printable(raw).isascii() and printable(raw).isprintable(), "a control character is let through")


class LongRun:
    """As much of a run as the picture of the tangle asks for: one helix of hexagons, at t = 110."""

    n_sections, lengths, frame_times = 200, np.array([2.28]), np.array([0.0, 110.0])

    def dataset(self, name):
        check(name == "/particles/fibers/position/value", f"the tangle asks for {name}")
        turn, around = np.linspace(0.0, 12.0, self.n_sections)[:, None], np.linspace(0.0, 2.0 * np.pi, 7)[None, :6]
        wide = 0.1 + 0.01 * np.cos(around)
        nodes = np.stack([wide * np.cos(turn), wide * np.sin(turn), 0.02 * turn + 0.01 * np.sin(around)], axis=2)
        return np.stack([np.full_like(nodes, np.nan), nodes]).reshape(2, -1, 3)


def check_tangle(script, folder):
    sys.path.insert(0, str(pathlib.Path(script).parent))
    import style
    import tangle
    from script import Nothing

    right, up, eye = tangle.view()
    check(np.allclose(np.stack([right, up, eye]) @ np.stack([right, up, eye]).T, np.eye(3)), "the view is oblique")
    check(np.linalg.det(np.stack([right, up, eye])) > 0.0, "the view is a mirror image")
    figure = tangle.draw({"L2280": LongRun()})
    faces, = figure.axes[0].collections
    check(len(faces.get_paths()) == 199 * 6, "faces are missing")
    check(np.isfinite(figure.axes[0].get_xlim()).all(), "the frame at t = 110 is not the one that is drawn")
    check(os.path.getsize(style.save(figure, folder, "figure6", "png")) > 10000, "the tangle is not drawn")
    short = LongRun()
    short.frame_times = np.array([0.0, 100.0])
    for runs in ({}, {"L2280": short}):
        try:
            tangle.draw(runs)
            check(False, "a tangle is drawn from nothing")
        except Nothing:
            pass


def main():
    script = sys.argv[1]
    for part in (check_complete_run, check_planted_links, check_options, check_flow_that_does_not_turn, check_poor_runs,
                 check_analysis_is_of_the_run, check_errors, check_tangle):
        with tempfile.TemporaryDirectory() as folder:
            part(script, pathlib.Path(folder))
    check_messages()


if __name__ == "__main__":
    main()
