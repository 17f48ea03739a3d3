"""Figure 6: the longest fiber at the end, its surface seen from the side; colours run from one end to the other."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection

import style
from script import Nothing

RUN, TIME = "L2280", 110.0
ELEVATION, AZIMUTH = 35.0, -65.0  # degrees: of the eye above the plane of the shear, and about the vorticity
DARKEST = 0.35  # of a face that is seen edge on


def view():
    """Unit vectors to the right, upwards and to the eye. The plane of the shear is the ground, z its normal."""
    up, around = np.radians(ELEVATION), np.radians(AZIMUTH)
    eye = np.array([np.cos(up) * np.cos(around), np.cos(up) * np.sin(around), np.sin(up)])
    right = np.array([-np.sin(around), np.cos(around), 0.0])
    return right, np.cross(eye, right), eye


def faces_of(nodes):
    """Quadrilaterals between neighbouring sections, [n, 4, 3], and their places along the fiber, [n]."""
    around = np.roll(nodes, -1, axis=1)
    corners = np.stack([nodes[:-1], around[:-1], around[1:], nodes[1:]], axis=2)
    place = np.repeat(np.linspace(0.0, 1.0, len(corners)), corners.shape[1])
    return corners.reshape(-1, 4, 3), place


def draw(runs):
    if RUN not in runs:
        raise Nothing("its run is not there")
    run = runs[RUN]
    if run.frame_times[-1] < TIME - 1e-6:
        raise Nothing(f"its run has not come to t = {TIME:g} yet")
    frame = int(np.abs(run.frame_times - TIME).argmin())
    position = run.dataset("/particles/fibers/position/value")[frame].astype(float)
    faces, place = faces_of(position.reshape(run.n_sections, -1, 3))
    right, up, eye = view()
    normal = np.cross(faces[:, 2] - faces[:, 0], faces[:, 3] - faces[:, 1])
    light = np.abs(normal @ eye) / np.maximum(np.linalg.norm(normal, axis=1), 1e-300)
    colours = plt.get_cmap("viridis")(place)
    colours[:, :3] *= (DARKEST + (1.0 - DARKEST) * light)[:, None]
    order = np.argsort(faces.mean(axis=1) @ eye)  # the farthest first
    flat = np.stack([faces @ right, faces @ up], axis=2)[order]

    low, high = flat.min(axis=(0, 1)), flat.max(axis=(0, 1))
    low[1] -= 0.1 * (high[1] - low[1])  # room for the scale
    middle, half = 0.5 * (low + high), 0.53 * (high - low)
    width = style.WIDTH
    figure = plt.figure(figsize=(width, width * half[1] / half[0] + 0.6))
    panel = figure.add_axes([0.0, 0.3 / figure.get_figheight(), 1.0, 1.0 - 0.6 / figure.get_figheight()])
    panel.add_collection(PolyCollection(flat, facecolors=colours[order], edgecolors=colours[order], linewidths=0.1))
    panel.set_xlim(middle[0] - half[0], middle[0] + half[0])
    panel.set_ylim(middle[1] - half[1], middle[1] + half[1])
    panel.axis("off")
    bar = 0.1
    left = middle[0] - 0.95 * half[0]
    panel.plot([left, left + bar], [low[1], low[1]], color=style.OUTLINE, linewidth=1.2, solid_capstyle="butt")
    panel.text(left + 0.5 * bar, low[1] + 0.02 * half[1], f"{bar:g} $L_0$", ha="center", va="bottom", fontsize=7)
    figure.suptitle(rf"$L = {run.lengths[0]:.2f}$ at t = {run.frame_times[frame]:g}, {ELEVATION:g} degrees above the plane "
                    "of the shear", fontsize=9, y=1.0 - 0.08 / figure.get_figheight(), va="top")
    return figure
