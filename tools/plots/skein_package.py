"""The package `skein`, by which the scripts read runs: of the sources, or the one that was installed with these scripts.

It is looked for at its place alone, so that what else lies beside it is not imported.
"""

import importlib.util
import os
import sys

PACKAGE = "../../src/python/skein"  # from here; in an installed copy of this file the place where it was installed


def load_package():
    folder = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), PACKAGE))
    start = os.path.join(folder, "__init__.py")
    if not os.path.isfile(start):
        raise ImportError(f"the package {folder} is not there")
    specification = importlib.util.spec_from_file_location("skein", start, submodule_search_locations=[folder])
    sys.modules["skein"] = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(sys.modules["skein"])


load_package()

from skein.errors import CannotCreate, DamagedData, Error, MissingInput, OutputError, UsageError  # noqa: E402, F401
from skein.run_reader import Run  # noqa: E402, F401
