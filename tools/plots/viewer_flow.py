"""The background flow at points, as `skein view` writes it: a table with the columns time, x, y, z, u, v, w."""

import numpy as np

from skein_package import DamagedData
from viewer_data import pack


def read_flow(path):
    """@returns points [n, 3] and velocities [n_times, n, 3], ready for JSON"""
    try:
        rows = np.loadtxt(path, delimiter=",", skiprows=1, ndmin=2)
    except (OSError, ValueError) as error:
        raise DamagedData(f"{path} cannot be read: {error}") from None
    times = np.unique(rows[:, 0])
    rows = rows.reshape(len(times), -1, 7)
    points = rows[0, :, 1:4]
    apart = [np.diff(np.unique(points[:, axis])) for axis in range(3)]
    spacings = [float(steps.min()) for steps in apart if len(steps)] or [1.0]
    return {"times": times.tolist(), "points": pack(points.astype("<f4")), "widest": max(spacings), "narrowest": min(spacings),
            "velocities": pack(rows[:, :, 4:7].astype("<f4"))}
