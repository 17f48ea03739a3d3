"""Executes the cells of a notebook in order, in a folder of its own: run_notebook.py NOTEBOOK. A cell that fails is named."""

import contextlib
import json
import pathlib
import sys
import tempfile

path = pathlib.Path(sys.argv[1]).resolve()
notebook = json.loads(path.read_text())
if notebook.get("nbformat") != 4 or not all("cell_type" in cell for cell in notebook["cells"]):
    sys.exit(f"{path} is no notebook of format 4")
cells = ["".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == "code"]
if not cells:
    sys.exit(f"{path} has no code")
names = {"__name__": "__main__"}
with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
    for number, cell in enumerate(cells, 1):
        try:
            exec(compile(cell, f"{path.name}[{number}]", "exec"), names)
        except Exception as error:
            raise SystemExit(f"{path.name}: cell {number} fails: {type(error).__name__}: {error}\n{cell}") from error
    names.clear()
print(f"{path.name}: {len(cells)} cells")
