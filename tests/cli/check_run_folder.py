"""Checks that a run folder is what others' readers expect: check_run_folder.py DIR

h5py sees H5MD 1.1 with one array per quantity, with units and growing times; VTK's XDMF readers, where this machine has
them (in this Python's VTK, or in a pvpython on PATH), see closed tubes of the fibers' radius at every time.
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

import h5py
import numpy as np

from checks import check

QUAD = 9  # VTK's number for a quadrilateral
NO_DIMENSION = {"/observables/error/value", "/observables/evaluations/value", "/observables/symmetry_defect/value",
                "/observables/nodes_inside/value", "/observables/crossings/value", "/observables/velocity_error/value", "/observables/fmm_order/value", "/observables/fmm_misses/value",
                "/parameters/elasto_viscous_number"}
PER_FIBER = ("energy", "centreline_length", "curvature_max", "symmetry_defect", "out_of_plane", "end_to_end")
PER_STEP = ("smallest_gap", "nodes_inside", "depth", "crossings", "dt", "error", "estimated_error", "spectral_radius",
            "evaluations", "velocity_error", "fmm_order", "fmm_misses")


def check_h5md(index):
    check(list(index["h5md"].attrs["version"]) == [1, 1], "/h5md has no version 1.1")
    check(index["h5md/author"].attrs["name"], "/h5md/author has no name")
    check(index["h5md/creator"].attrs["name"] == "skein", "/h5md/creator is not skein")
    box = index["particles/fibers/box"].attrs
    check(box["dimension"] == 3 and list(box["boundary"]) == ["none"] * 3, "the box is not an open one")
    check(index["parameters"].attrs["status"] in ("running", "done", "stopped", "failed"), "the status is unknown")
    check(index["parameters"].attrs["scene"], "/parameters has no scene")
    surface = index["connectivity/surface"]
    check(index[surface.attrs["particles_group"]] == index["particles/fibers"], "the surface belongs to no particles")


def check_units(index):
    def visit(name, item):
        if isinstance(item, h5py.Dataset) and item.dtype.kind == "f" and "/" + name not in NO_DIMENSION:
            check(item.attrs.get("unit"), f"/{name} has no unit")

    index.visititems(visit)


def check_series(index, element, n_rows, row_shape, infinite_allowed=False, nan_allowed=False):
    value = index[element]["value"]
    check(value.shape == (n_rows, *row_shape), f"/{element}/value has shape {value.shape}, not {(n_rows, *row_shape)}")
    values = value[...]
    check(nan_allowed or not np.isnan(values).any(), f"/{element}/value holds NaN")
    check(infinite_allowed or nan_allowed or np.isfinite(values).all(), f"/{element}/value is not finite")
    time, step = index[element]["time"][...], index[element]["step"][...]
    check(time.shape == step.shape == (n_rows,), f"/{element}: times or steps are missing")
    check(time.dtype == np.float64 and step.dtype == np.int64, f"/{element}: times or steps have the wrong type")
    check((np.diff(time) > 0).all() and (np.diff(step) >= 0).all(), f"/{element}: times or steps do not grow")
    check(index[element]["value"].attrs.get("unit") or f"/{element}/value" in NO_DIMENSION, f"/{element} has no unit")


def check_index(index):
    check_h5md(index)
    check_units(index)
    parameters = index["parameters"]
    sections, per_section = parameters["fiber_sections"][...], parameters["fiber_nodes_per_section"][...]
    n_fibers, n_nodes, n_sections = len(sections), int((sections * per_section).sum()), int(sections.sum())
    check(parameters["blob"].shape == (n_nodes,), "/parameters/blob does not have one number for each node")

    position = index["particles/fibers/position"]
    n_frames = position["time"].shape[0]
    check(n_frames > 0, "there is no frame")
    check_series(index, "particles/fibers/position", n_frames, (n_nodes, 3))
    check_series(index, "observables/centreline", n_frames, (n_sections, 3))
    check_series(index, "observables/curvature", n_frames, (n_sections,))
    check(index["observables/centreline/time"] == position["time"], "frames do not share their times")
    n_steps = index["observables/energy/time"].shape[0]
    for name in PER_FIBER:
        check_series(index, f"observables/{name}", n_steps, (n_fibers, 3) if name == "end_to_end" else (n_fibers,))
    for name in PER_STEP:
        check_series(index, f"observables/{name}", n_steps, (), infinite_allowed=name == "smallest_gap",
                     nan_allowed=name == "velocity_error")  # where none was measured
    # The sum grows where a step has an estimate, and nowhere else.
    growth = np.diff(index["observables/estimated_error/value"][...], prepend=0.0)
    check(np.array_equal(growth > 0, index["observables/error/value"][...] > 0), "estimated_error is no sum of estimates")

    # The centreline is made of the section's centroids, and nodes lie about a radius from it.
    centroids, distances, radii = [], [], []
    first = 0
    x = position["value"][...].astype(float)
    for n, m, radius in zip(sections, per_section, parameters["fiber_radius"][...]):
        rings = x[:, first:first + n * m].reshape(n_frames, n, m, 3)
        centroids.append(rings.mean(axis=2))
        distances.append(np.median(np.linalg.norm(rings - centroids[-1][:, :, None], axis=3)))
        radii.append(radius)
        first += n * m
    error = np.abs(np.concatenate(centroids, axis=1) - index["observables/centreline/value"][...]).max()
    check(error < 1e-5 * np.abs(x).max(), f"the centreline is off the sections' centroids by {error}")
    check(np.allclose(distances, radii, rtol=0.1), f"nodes lie at {distances} from the centreline, not at {radii}")
    return n_frames


def expected_cells(index):
    per_section = index["parameters/fiber_nodes_per_section"][...]
    tubes = ((index["parameters/fiber_sections"][...] - 1) * per_section).sum()
    return int(tubes + (2 * ((per_section - 1) // 2)).sum())


def check_surface(index):
    """Every edge is shared by two cells that run along it in opposite directions, and the volume is positive."""
    surface = index["connectivity/surface"][...]
    check(len(surface) == expected_cells(index), f"the surface has {len(surface)} cells, not {expected_cells(index)}")
    edges = np.concatenate([surface[:, [k, (k + 1) % 4]] for k in range(4)])
    edges = edges[edges[:, 0] != edges[:, 1]]  # a triangle repeats its last node
    there = {tuple(edge) for edge in edges}
    check(len(there) == len(edges), "two cells run along an edge in the same direction")
    check(all((b, a) in there for a, b in there), "the surface is open")
    a, b, c, d = (index["particles/fibers/position/value"][0].astype(float)[surface[:, k]] for k in range(4))
    volume = (np.einsum("ij,ij->", a, np.cross(b, c)) + np.einsum("ij,ij->", a, np.cross(c, d))) / 6
    check(volume > 0, "the surface is inside out")


def check_xdmf_text(folder, index):
    """Follows each reference of the XDMF by hand."""
    position = index["particles/fibers/position"]
    grids = ElementTree.parse(folder / "trajectory.xdmf").findall("./Domain/Grid/Grid")
    check(len(grids) == position["time"].shape[0], f"the XDMF has {len(grids)} frames")
    for frame, grid in enumerate(grids):
        check(float(grid.find("Time").get("Value")) == position["time"][frame], f"XDMF: frame {frame} has another time")
        source = grid.find("./Geometry/DataItem")
        file, dataset = source.text.strip().split(":")
        with h5py.File(folder / file, "r") as segment:
            values = segment[dataset]
            check(values.shape == tuple(map(int, source.get("Dimensions").split())), f"XDMF: frame {frame}: wrong shape")
            check(values.dtype.itemsize == int(source.get("Precision")), f"XDMF: frame {frame}: wrong precision")
            check((values[...] == position["value"][frame]).all(), f"XDMF: frame {frame} shows other positions")


def find_readers():
    """Python interpreters that may have VTK's XDMF readers."""
    return [python for python in (sys.executable, shutil.which("pvpython")) if python]


def check_through_vtk(folder, index, version):
    """Returns whether a reader of this version of the format was found."""
    script = pathlib.Path(__file__).with_name("read_xdmf.py")
    with tempfile.TemporaryDirectory() as scratch:
        result = pathlib.Path(scratch) / "seen.npz"
        for python in find_readers():
            run = subprocess.run([python, str(script), str(folder / "trajectory.xdmf"), str(result), str(version)],
                                 capture_output=True, text=True)
            if run.returncode != 77:
                output = run.stdout + run.stderr
                check(run.returncode == 0 and not output, f"VTK's XDMF {version} reader complains:\n{output}")
                compare_with_vtk(np.load(result), index, f"VTK's XDMF {version} reader")
                return True
    return False


def compare_with_vtk(seen, index, reader):
    position = index["particles/fibers/position"]
    times = position["time"][...]
    check((seen["times"] == times).all() and len(seen["times"]) == len(times), f"{reader} sees times {seen['times']}")
    check((seen["cells"] == index["connectivity/surface"][...]).all(), f"{reader} sees other cells")
    check((seen["cell_types"] == QUAD).all(), f"{reader} sees cells that are no quadrilaterals")
    check((seen["fiber"] == index["parameters/node_fiber"][...]).all(), f"{reader} sees other fibers")
    check((seen["section"] == index["parameters/node_section"][...]).all(), f"{reader} sees other sections")
    for frame in range(len(times)):
        points, expected = seen[f"points_{frame}"], position["value"][frame]
        check(points.dtype == expected.dtype, f"{reader} turns {expected.dtype} into {points.dtype}")
        check((points == expected).all(), f"{reader}: frame {frame} has other points")
        bounds = np.stack([expected.min(axis=0), expected.max(axis=0)], axis=1).ravel()
        check(np.allclose(seen[f"bounds_{frame}"], bounds, rtol=1e-6), f"{reader}: frame {frame} has other bounds")


def main():
    require_vtk = sys.argv[2:] == ["--require-vtk"]
    check(len(sys.argv) == 2 or require_vtk, "usage: check_run_folder.py DIR [--require-vtk]")
    folder = pathlib.Path(sys.argv[1])
    with h5py.File(folder / "trajectory.h5", "r") as index:
        n_frames = check_index(index)
        check_surface(index)
        check_xdmf_text(folder, index)
        readers = [version for version in (2, 3) if check_through_vtk(folder, index, version)]
    check(readers or not require_vtk, "no XDMF reader of VTK was found; tools/setup.sh --with-tests installs one")
    check(not list(folder.rglob("*.partial")), "a half-written file was left")
    seen_by = ", ".join(f"VTK's XDMF {version} reader" for version in readers) or "no XDMF reader of VTK on this machine"
    print(f"{folder}: {n_frames} frames, seen alike by h5py and {seen_by}")


main()
