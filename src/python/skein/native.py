"""The compiled part of the package."""

import atexit
import logging
import os

from .errors import Error

_messages = logging.getLogger("skein")


def _load():
    """Threads that wait for each other spin for a while, as the program has them do (see its sources): the OpenMP library
    reads how long when it is loaded, and other programs are not to read it."""
    name = "GOMP_SPINCOUNT"
    is_ours = name not in os.environ and "OMP_WAIT_POLICY" not in os.environ
    if is_ours:
        os.environ[name] = "10000"
    try:
        from . import _native
    except ImportError as error:
        raise Error(f"this skein only reads runs: its compiled part cannot be loaded ({error}). Build it where pybind11 is "
                    "installed (Debian: pybind11-dev, python3-dev).") from None
    finally:
        if is_ours:
            del os.environ[name]
    return _native


_native = _load()
_native.set_messages(_messages.info, _messages.warning)
atexit.register(_native.finish)

__version__ = _native.version


def set_threads(n):
    """Host threads of all that skein computes in this process, before it has computed anything; without a call
    OMP_NUM_THREADS or the machine decides. Results do not depend on it."""
    _native.set_threads(n)


def describe_build():
    """Version, commit, compiler, Kokkos and its backends, as `skein --version` has them."""
    return _native.describe_build()
