"""What tests of the Python package have in common: those of the command line's, and the package."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "cli"))

from cli_case import DONE, SMALL_SCENE, InFreshFolder, main  # noqa: F401
import skein  # noqa: F401, of PYTHONPATH
