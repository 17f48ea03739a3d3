"""The fibers in motion, as MP4 by ffmpeg: the x-y plane, tubes of their true radius."""

import os
import subprocess

import matplotlib
import matplotlib.animation
import matplotlib.pyplot as plt
import numpy as np

import shapes
import style
from output_file import replacing, write_error
from skein_package import MissingInput, OutputError

FRAMES_PER_SECOND = 25
MAX_FRAMES = 750  # half a minute
MOVIE_DPI = 150


def find_ffmpeg():
    """By the folders of PATH that are named from the root: what lies in the current folder may be somebody else's."""
    for folder in os.environ.get("PATH", os.defpath).split(os.pathsep):
        program = os.path.join(folder, "ffmpeg")
        if os.path.isabs(folder) and os.path.isfile(program) and os.access(program, os.X_OK):
            return program
    raise MissingInput("a movie needs ffmpeg: tools/setup.sh --with-movies installs it")


def save(run, folder):
    """@returns the movie's path"""
    matplotlib.rcParams["animation.ffmpeg_path"] = find_ffmpeg()
    path = os.path.join(folder, "movie.mp4")
    try:
        with replacing(path) as partial:
            draw(run, partial)
    except subprocess.CalledProcessError as error:
        raise OutputError(f"{path} cannot be written: ffmpeg ended with {error.returncode}") from None
    except OSError as error:
        raise write_error(path, error) from None
    return path


def draw(run, path):
    stride = -(-len(run.frame_times) // MAX_FRAMES)
    frames = range(0, len(run.frame_times), stride)
    lines = [run.centreline(frame).astype(float) for frame in frames]
    corners, size, _ = shapes.window_of(lines, run.radius.max())
    width = style.WIDTH
    height = float(np.clip(width * size[1] / size[0], 1.6, 6.0)) + 0.9
    figure = plt.figure(figsize=(round(width * MOVIE_DPI / 2) * 2 / MOVIE_DPI, round(height * MOVIE_DPI / 2) * 2 / MOVIE_DPI))
    panel = figure.add_axes([0.1, 0.45 / height, 0.87, (height - 0.8) / height])
    writer = matplotlib.animation.FFMpegWriter(fps=FRAMES_PER_SECOND, codec="libx264",
                                               extra_args=["-pix_fmt", "yuv420p", "-crf", "18", "-f", "mp4"])
    with writer.saving(figure, path, MOVIE_DPI):
        for frame, line, corner in zip(frames, lines, corners):
            panel.clear()
            panel.set_xlim(corner[0], corner[0] + size[0])
            panel.set_ylim(corner[1], corner[1] + size[1])
            panel.set_aspect("equal")
            panel.set_xlabel("$x$ ($L_0$)")
            panel.set_ylabel("$y$ ($L_0$)")
            panel.set_title(f"t = {run.frame_times[frame]:.2f} $T$")
            panel.apply_aspect()
            points = 72.0 * panel.get_position().width * figure.get_figwidth() / size[0]
            shapes.add_tubes(panel, run, line, points, lambda f, _: style.COLOURS[f % len(style.COLOURS)])
            writer.grab_frame()
    plt.close(figure)
