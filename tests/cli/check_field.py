"""Velocity fields of a run: check_field.py PROGRAM RUN RESULT_FOLDER [--require-vtk]

What `skein field` writes, read by VTK's own reader, against sums over the run's nodes in long double.
"""

import os
import subprocess
import sys

import h5py
import numpy as np

PROGRAM, RUN, FOLDER = sys.argv[1:4]
USAGE, MISSING = 64, 66
LONG = np.longdouble


def skein(*arguments):
    return subprocess.run([PROGRAM, "field", *map(str, arguments)], capture_output=True, text=True, timeout=100)


def write(name, *arguments):
    path = os.path.join(FOLDER, name)
    result = skein(RUN, *arguments, "-o", path)
    assert result.returncode == 0, result.stderr
    return path


def read(path):
    """@returns points, {name: vectors}, time"""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLImageDataReader

    reader = vtkXMLImageDataReader()
    reader.SetFileName(path)
    reader.Update()
    image = reader.GetOutput()
    assert image.GetNumberOfPoints() > 0, path
    points = np.array([image.GetPoint(i) for i in range(image.GetNumberOfPoints())])
    data = image.GetPointData()
    fields = {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)).copy() for i in range(data.GetNumberOfArrays())}
    time = vtk_to_numpy(image.GetFieldData().GetArray("TimeValue"))[0]
    return points, fields, time, image


def expect_disturbance(position, springs, rest, stiffness, blob, viscosity, points):
    position = position.astype(LONG)
    d = position[springs[:, 0]] - position[springs[:, 1]]
    r = np.sqrt((d**2).sum(axis=1))
    pull = (stiffness * (r / rest - 1) / r)[:, None] * d
    force = np.zeros_like(position)
    np.add.at(force, springs[:, 0], -pull)
    np.add.at(force, springs[:, 1], pull)
    velocities = []
    for x in points.astype(LONG):
        d = x - position
        r2 = (d**2).sum(axis=1)
        scale = 1 / (8 * np.arccos(LONG(-1)) * viscosity * (r2 + blob**2) ** LONG(1.5))
        velocities.append((scale[:, None] * ((r2 + 2 * blob**2)[:, None] * force
                                             + (force * d).sum(axis=1)[:, None] * d)).sum(axis=0))
    return np.array(velocities)


def check_values(path, run, frame):
    points, fields, time, _ = read(path)
    position = run["/particles/fibers/position/value"]
    assert time == run["/particles/fibers/position/time"][frame]
    springs = run["/connectivity/springs"][()] if "springs" in run["/connectivity"] else find_springs(run)
    at_rest = position[0].astype(LONG)
    rest = np.sqrt(((at_rest[springs[:, 0]] - at_rest[springs[:, 1]]) ** 2).sum(axis=1))
    chosen = np.linspace(0, len(points) - 1, 60).astype(int)
    # The scene of configs/tumbling.toml.
    expected = expect_disturbance(position[frame], springs, rest, LONG("0.0112"), LONG("0.00225"), LONG(1),
                                  points[chosen])
    size = abs(expected).max()
    error = abs(fields["disturbance"][chosen] - expected).max() / size
    assert size > 1e-4 and error < 1e-8, (size, error)
    shear = np.zeros_like(points)
    shear[:, 0] = 2.5 * points[:, 1]
    error = abs(fields["velocity"] - fields["disturbance"] - shear).max()
    assert error < 1e-14, error


def find_springs(run):
    (name,) = [name for name in run["/connectivity"] if run["/connectivity"][name].shape[-1:] == (2,)]
    return run["/connectivity"][name][()]


def check_grid():
    points, _, _, image = read(write("box.vti", "--frame", 0, "--box", "-0.1,0.1,-0.05,0.05,0,0.02", "--points", 21))
    assert image.GetDimensions() == (21, 11, 3), image.GetDimensions()
    assert np.allclose(points.min(axis=0), (-0.1, -0.05, 0)) and np.allclose(points.max(axis=0), (0.1, 0.05, 0.02))
    points, _, time, image = read(write("plane.vti", "--time", 0.12, "--plane", "y=0.01", "--points", 30))
    assert image.GetDimensions()[1] == 1 and (points[:, 1] == 0.01).all() and abs(time - 0.1) < 1e-12
    assert max(image.GetDimensions()) == 30


def check_errors():
    for arguments, code, words in [
        ([RUN, "--plane", "w"], USAGE, "--plane w"),
        ([RUN, "--plane", "z=here"], USAGE, "'here' is no number"),
        ([RUN, "--frame", 99], USAGE, "frames 0 to"),
        ([RUN, "--frame", 1, "--time", 0.1], USAGE, "excludes"),
        ([RUN, "--box", "1,0,0,1,0,1"], USAGE, "1 is above 0"),
        ([RUN, "--box", "1,0"], USAGE, "--box"),
        ([os.path.join(FOLDER, "none")], MISSING, "none"),
    ]:
        path = os.path.join(FOLDER, "not_written.vti")
        result = skein(*arguments, "-o", path)
        assert result.returncode == code and words in result.stderr, (arguments, result.returncode, result.stderr)
        assert not os.path.exists(path)


def check_picture():
    picture = os.path.join(FOLDER, "field.png")
    write("drawn.vti", "--points", 40, "--plot", picture)
    with open(picture, "rb") as file:
        assert file.read(8) == b"\x89PNG\r\n\x1a\n"
    result = skein(RUN, "--points", 10, "--plane", "y", "-o", os.path.join(FOLDER, "y.vti"), "--plot", picture)
    assert result.returncode == USAGE and "--plane z" in result.stderr, result.stderr


def main():
    os.makedirs(FOLDER, exist_ok=True)
    try:
        import vtkmodules.vtkIOXML  # noqa: F401
    except ImportError:
        sys.exit("VTK is not there" if "--require-vtk" in sys.argv else 0)
    with h5py.File(os.path.join(RUN, "trajectory.h5"), "r") as run:
        last = len(run["/particles/fibers/position/time"]) - 1
        check_values(write("last.vti", "--points", 60), run, last)
        check_values(write("first.vti", "--frame", 1, "--plane", "x=0.02", "--points", 40), run, 1)
    check_grid()
    check_errors()
    check_picture()


main()
