"""Velocity fields of a run: check_field.py PROGRAM RUN RESULT_FOLDER [--require-vtk]

What `skein field` writes, read by VTK's own reader, against sums over the run's nodes in long double.
"""

import os
import subprocess
import sys

import h5py
import numpy as np

PROGRAM, RUN, FOLDER = sys.argv[1:4]
USAGE, DAMAGED, MISSING = 64, 65, 66
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
    springs = make_springs(run)
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


def make_springs(run):
    """[n, 2]: every pair inside a section, and every pair between neighbouring ones."""
    (n_sections,), (n,) = run["/parameters/fiber_sections"][()], run["/parameters/fiber_nodes_per_section"][()]
    inside = [(s * n + a, s * n + b) for s in range(n_sections) for a in range(n) for b in range(a)]
    between = [(s * n + a, s * n + n + b) for s in range(n_sections - 1) for a in range(n) for b in range(n)]
    return np.array(inside + between)


def check_grid():
    points, _, _, image = read(write("box.vti", "--frame", 0, "--box", "-0.1,0.1,-0.05,0.05,0,0.02", "--points", 21))
    assert image.GetDimensions() == (21, 11, 3), image.GetDimensions()
    assert np.allclose(points.min(axis=0), (-0.1, -0.05, 0)) and np.allclose(points.max(axis=0), (0.1, 0.05, 0.02))
    points, _, time, image = read(write("plane.vti", "--time", 0.12, "--plane", "y=0.01", "--points", 30))
    assert image.GetDimensions()[1] == 1 and (points[:, 1] == 0.01).all() and abs(time - 0.1) < 1e-12
    assert max(image.GetDimensions()) == 30


def check_box_is_covered():
    """The first points lie on the near sides and the last on the far ones; no spacing is above that of the longest."""
    for box, n_points, expected in [("0,1,0,0.37,0,0.1", 10, (10, 5, 2)), ("-0.3,0.05,-7e-6,0,1,1.2", 33, (33, 2, 20)),
                                    ("0,0.1,0,0.3,0,0.2", 4, (2, 4, 3)), ("5,5.1,0,0.3,2,2", 31, (11, 31, 1))]:
        points, _, _, image = read(write("covered.vti", f"--box={box}", "--points", n_points))
        low, high = np.array(box.split(","), dtype=float).reshape(3, 2).T
        assert image.GetDimensions() == expected, (box, image.GetDimensions())
        assert np.allclose(points.min(axis=0), low, rtol=0, atol=1e-14), (box, points.min(axis=0))
        assert np.allclose(points.max(axis=0), high, rtol=0, atol=1e-14), (box, points.max(axis=0))
        longest = (high - low).max() / (n_points - 1)
        assert all(s <= longest * (1 + 1e-9) for s in image.GetSpacing()), (box, image.GetSpacing())


def check_points(run):
    """Velocities at points from a text, as a table and as arrays, against the sums."""
    points = np.random.default_rng(3).uniform(-0.1, 0.1, (40, 3))
    text = os.path.join(FOLDER, "probes.txt")
    np.savetxt(text, points, header="x y z")  # as a comment, as NumPy writes it
    table = np.genfromtxt(write("probes.csv", "--at", text, "--frame", 1), delimiter=",", names=True)
    path = write("probes.h5", "--at", text, "--frame", 1)
    with h5py.File(path, "r") as file:
        position, velocity, disturbance = (file[name][()] for name in ("position", "velocity", "disturbance"))
        assert file["velocity"].attrs["unit"] == "length/time"
        assert file["time"][()] == run["/particles/fibers/position/time"][1]
    assert np.array_equal(position, points)
    for axis, name in enumerate("xyz"):
        assert np.array_equal(table[f"velocity_{name}_lengthtime"], velocity[:, axis]), table.dtype.names
        assert np.array_equal(table[f"disturbance_{name}_lengthtime"], disturbance[:, axis])
    nodes = run["/particles/fibers/position/value"]
    springs, at_rest = make_springs(run), nodes[0].astype(LONG)
    rest = np.sqrt(((at_rest[springs[:, 0]] - at_rest[springs[:, 1]]) ** 2).sum(axis=1))
    expected = expect_disturbance(nodes[1], springs, rest, LONG("0.0112"), LONG("0.00225"), LONG(1), points)
    assert abs(expected - disturbance).max() < 1e-8 * abs(expected).max()
    shear = np.zeros_like(points)
    shear[:, 0] = 2.5 * points[:, 1]
    assert abs(velocity - disturbance - shear).max() < 1e-14


def check_point_errors():
    text = os.path.join(FOLDER, "wrong.csv")
    for content, place, words in [("x,y,z\n0,0,0\n0,zero,0\n", "3:3", "'zero'"), ("1 2\n", "1:3", "only 2 values"),
                                  ("0 0 nan\n", "1:5", "'nan'"), ("", "1:1", "no point")]:
        with open(text, "w") as file:
            file.write(content)
        result = skein(RUN, "--at", text, "-o", os.path.join(FOLDER, "not_written.csv"))
        assert result.returncode == DAMAGED and f"{text}:{place}: " in result.stderr and words in result.stderr, result


def check_methods():
    """The scene's own sums, or direct ones in double where they are asked for."""
    folder = os.path.join(FOLDER, "single")
    scene = os.path.join(FOLDER, "single.toml")
    with open(scene, "w") as file:
        file.write("[fiber]\nsections = 20\nstart_amplitude = 0.1\n[hydrodynamics]\nprecision = 'single'\n"
                   "[time]\nend = 0.0\n")
    result = subprocess.run([PROGRAM, "run", scene, "-o", folder, "-q", "--overwrite"], capture_output=True, text=True)
    assert result.returncode == 0, result.stderr
    fields = {}
    for options in ((), ("--direct",)):
        path = os.path.join(FOLDER, "sum.vti")
        result = skein(folder, "--points", 20, "--plane", "y=0.001", *options, "-o", path)
        assert result.returncode == 0 and ("single" in result.stderr) == (not options), result.stderr
        fields[options] = read(path)[1]["disturbance"]
    size = abs(fields[()]).max()
    error = abs(fields[()] - fields[("--direct",)]).max() / size
    assert 1e-10 < error < 1e-4, error


def check_errors():
    for arguments, code, words in [
        ([RUN, "--box", "nan,1,0,1,0,1"], USAGE, "--box: nan"),
        ([RUN, "--box=-inf,1,0,1,0,1"], USAGE, "--box: -inf"),
        ([RUN, "--box=-1e308,1e308,0,1,0,1"], USAGE, "--box: -1e+308"),
        ([RUN, "--box", "0,1,0,1,0,1e101"], USAGE, "--box: 1e+101"),
        ([RUN, "--box", "1e9,1.000000000000001e9,0,0,0,0"], USAGE, "told apart"),
        ([RUN, "--box", "1,1,2,2,3,3"], USAGE, "no extent"),
        ([RUN, "--box", "0,1,0,1,0,1", "--points", 1], USAGE, "--points"),
        ([RUN, "--box", "0,1,0,1,0,1", "--points", 2000], USAGE, "more than 1e+08"),
        ([RUN, "--plane", "z=inf"], USAGE, "--plane"),
        ([RUN, "--plane", "z=1e200"], USAGE, "--plane: 1e+200"),
        ([RUN, "--time", "nan"], USAGE, "--time nan"),
        ([RUN, "--time", "inf"], USAGE, "--time inf"),
        ([RUN, "--time", "1e99"], USAGE, "--time 1e+99: the run has frames from t = 0 to 0.3"),
        ([RUN, "--time", "0.31"], USAGE, "to 0.3"),
        ([RUN, "--time=-0.01"], USAGE, "from t = 0"),
        ([RUN, "--at", "points.txt", "--points", 3], USAGE, "--at"),
        ([RUN, "--at", "points.txt"], USAGE, ".csv or .h5"),
        ([RUN, "--frame", -99], USAGE, "frames 0 to"),
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
        assert "internal error" not in result.stderr, result.stderr
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
        check_points(run)
    check_point_errors()
    check_grid()
    check_box_is_covered()
    check_methods()
    check_errors()
    check_picture()


main()
