"""Streamlines of a velocity field on a plane of constant z: plot_field.py RUN FIELD.vti PICTURE

Left the whole velocity, right what the fibers add to the background flow; colours are speeds.
"""

import os
import re
import sys

sys.dont_write_bytecode = True  # the sources, or the installed program, are no place for caches
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))  # which Python's isolated mode leaves out

import isolation  # noqa: F401, first

import numpy as np

import style
from script import attempt, print_path
from shapes import add_tubes
from skein_package import DamagedData, Error, Run, UsageError
from style import plt


def read_image(path):
    """@returns x, y, time and {name: [ny, nx, 3]} of an image that is a plane of constant z."""
    with open(path, "rb") as file:
        content = file.read()
    start = content.index(b"<AppendedData")
    head, data = content[:start].decode(), content[content.index(b"_", start) + 1 :]

    def numbers(name):
        return [float(word) for word in re.search(rf'{name}="([^"]*)"', head).group(1).split()]

    extent, origin, spacing = numbers("WholeExtent"), numbers("Origin"), numbers("Spacing")
    nx, ny, nz = (int(extent[2 * axis + 1]) + 1 for axis in range(3))
    if nz != 1 or nx < 2 or ny < 2:
        raise UsageError(f"{path}: only a plane of constant z is drawn; write it with --plane z")
    fields = {}
    order = "<" if "LittleEndian" in head else ">"
    for name, offset in re.findall(r'Name="(\w+)" NumberOfComponents="3" format="appended" offset="(\d+)"', head):
        values = np.frombuffer(data, dtype=f"{order}f8", count=3 * nx * ny, offset=int(offset) + 8)
        fields[name] = values.reshape(ny, nx, 3)
    time = float(re.search(r'Name="TimeValue"[^>]*>([^<]*)<', head).group(1))
    # Streamlines need coordinates that are even to the last bits.
    return (np.linspace(origin[0], origin[0] + (nx - 1) * spacing[0], nx),
            np.linspace(origin[1], origin[1] + (ny - 1) * spacing[1], ny), time, fields)


def draw(run, x, y, time, fields):
    frame = int(np.argmin(abs(run.frame_times - time)))
    line = run.centreline(frame).astype(float)
    titles = {"velocity": "velocity", "disturbance": "disturbance by the fibers"}
    gap, left, bottom, top = 0.85, 0.65, 0.5, 0.75
    panel_width = min((style.WIDTH - left - 2 * gap) / 2, 4.5 * (x[-1] - x[0]) / (y[-1] - y[0]))
    panel_height = panel_width * (y[-1] - y[0]) / (x[-1] - x[0])
    width, height = left + 2 * (panel_width + gap), bottom + panel_height + top
    figure = plt.figure(figsize=(width, height))
    for column, (name, title) in enumerate(titles.items()):
        field = fields[name]
        speed = np.linalg.norm(field, axis=2)
        corner = left + column * (panel_width + gap)
        panel = figure.add_axes([corner / width, bottom / height, panel_width / width, panel_height / height])
        shade = panel.pcolormesh(x, y, speed, cmap="viridis", shading="gouraud", rasterized=True, vmin=0.0)
        if np.isfinite(field).all() and speed.max() > 0.0:
            panel.streamplot(x, y, field[:, :, 0], field[:, :, 1], color="white", linewidth=0.6, arrowsize=0.6,
                             density=1.1)
        add_tubes(panel, run, line, 72.0 * panel_width / (x[-1] - x[0]), lambda f, z: "#f2f2f2")
        panel.set_xlim(x[0], x[-1])
        panel.set_ylim(y[0], y[-1])
        panel.set_title(title, pad=4)
        panel.set_xlabel("$x$ ($L_0$)")
        panel.xaxis.set_major_locator(plt.MaxNLocator(4))
        panel.tick_params(labelleft=column == 0)
        if column == 0:
            panel.set_ylabel("$y$ ($L_0$)")
        bar = figure.add_axes([(corner + panel_width + 0.08) / width, bottom / height, 0.1 / width,
                               panel_height / height])
        figure.colorbar(shade, cax=bar, label="speed ($L_0/T$)")
    figure.suptitle(f"{style.describe_fibers(run)}, t = {style.number(run.frame_times[frame])}",
                    y=1.0 - 0.08 / height, va="top", fontsize=9)
    return figure


def draw_file(folder, image, picture):
    run = Run(folder)
    try:
        content = read_image(image)
    except Error:
        raise
    except (OSError, ValueError, AttributeError) as error:
        raise DamagedData(f"{image} cannot be read: {error}") from None
    name, extension = os.path.splitext(os.path.basename(picture))
    if extension not in (".png", ".pdf", ".svg"):
        raise UsageError(f"{picture}: the name of a picture ends in .png, .pdf or .svg")
    print_path(style.save(draw(run, *content), os.path.dirname(picture), name, extension[1:]))


def main():
    return attempt(lambda: draw_file(*sys.argv[1:]))


if __name__ == "__main__":
    sys.exit(main())
