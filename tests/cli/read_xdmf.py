"""Reads an XDMF file through VTK's own reader, at every time: read_xdmf.py FILE RESULT.npz [2|3]

Runs in any Python whose VTK has the reader, and in ParaView's pvpython. The result holds times, and for each the points
and the cells; exit 77 where this VTK has no such reader.
"""
import sys

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy


def make_reader(version):
    try:
        if version == 2:
            from vtkmodules.vtkIOXdmf2 import vtkXdmfReader as Reader
        else:
            from vtkmodules.vtkIOXdmf3 import vtkXdmf3Reader as Reader
    except ImportError:
        sys.exit(77)
    return Reader()


def leaves(data):
    """The meshes in what a reader returns, which may be one mesh or a tree of them."""
    if not data.IsA("vtkCompositeDataSet"):
        return [data]
    iterator = data.NewIterator()
    found = []
    while not iterator.IsDoneWithTraversal():
        found.append(iterator.GetCurrentDataObject())
        iterator.GoToNextItem()
    return found


def main():
    path, result, version = sys.argv[1], sys.argv[2], int(sys.argv[3]) if len(sys.argv) > 3 else 2
    reader = make_reader(version)
    reader.SetFileName(path)
    reader.UpdateInformation()
    information = reader.GetOutputInformation(0)
    key = reader.GetExecutive().TIME_STEPS()
    times = [information.Get(key, i) for i in range(information.Length(key))]

    arrays = {"times": np.array(times)}
    for i, time in enumerate(times):
        reader.UpdateTimeStep(time)
        (mesh,) = leaves(reader.GetOutputDataObject(0))
        arrays[f"points_{i}"] = vtk_to_numpy(mesh.GetPoints().GetData()).copy()  # the reader frees it
        arrays[f"bounds_{i}"] = np.array(mesh.GetBounds())
        if i == 0:
            n_cells = mesh.GetNumberOfCells()
            arrays["cell_types"] = np.array([mesh.GetCellType(c) for c in range(n_cells)])
            arrays["cells"] = np.array([[mesh.GetCell(c).GetPointId(k) for k in range(4)] for c in range(n_cells)])
            for name in ("fiber", "section"):
                arrays[name] = vtk_to_numpy(mesh.GetPointData().GetArray(name)).copy()
    np.savez(result, **arrays)


main()
