"""Matplotlib as it comes, whatever the environment, the user's settings and the current folder say.

Settings may name programs, and one that lies in the current folder, which may be somebody else's, would be read first.
To be imported before anything that imports matplotlib.
"""

import atexit
import os
import shutil
import tempfile

SCRIPTS = os.path.dirname(os.path.abspath(__file__))


def import_matplotlib():
    caches = tempfile.mkdtemp(prefix="skein-plots-")
    atexit.register(shutil.rmtree, caches, ignore_errors=True)
    os.environ.update(MPLCONFIGDIR=caches, MATPLOTLIBRC=os.path.join(SCRIPTS, "matplotlibrc"), MPLBACKEND="agg")
    try:
        start = os.open(".", os.O_RDONLY)
    except OSError:  # removed or closed to us; paths that matter are absolute
        start = None
    os.chdir(SCRIPTS)
    try:
        import matplotlib  # noqa: F401, reads its settings now
    finally:
        if start is not None:
            os.fchdir(start)
            os.close(start)


import_matplotlib()
