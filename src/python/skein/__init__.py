"""Long, flexible, elastic fibers in viscous flow.

    import skein

    run = skein.run({"time": {"end": 11.0}}, "runs/first")   # as `skein run` does; skein.Run(folder) reads any run
    run.centrelines[-1]                                       # [n_sections, 3] of the last frame
    velocities, error, method = skein.mobility(positions, forces, blobs)

Lengths, times and forces are in units of yours, force = viscosity length^2 / time, as everywhere in skein. Whatever goes
wrong is a skein.Error with the program's text. Runs and velocities need the compiled part of the package; reading does not.
"""

import importlib

from .errors import (CannotCreate, DamagedData, Error, InternalError, MissingInput, NoResources, NumericalFailure,
                     OutputError, SceneError, UsageError)

# Where each name comes from: it is imported when it is asked for, as readers of runs need no compiled part.
_PLACES = {
    "Run": "run_reader", "Frame": "run_reader",
    "Scene": "simulation", "run": "simulation", "resume": "simulation", "analyze": "simulation", "plan": "simulation",
    "Plan": "simulation",
    "Mobility": "fluid", "Velocities": "fluid", "mobility": "fluid",
    "set_threads": "native", "describe_build": "native", "__version__": "native",
}

__all__ = [name for name in _PLACES if not name.startswith("_")] + [
    "CannotCreate", "DamagedData", "Error", "InternalError", "MissingInput", "NoResources", "NumericalFailure",
    "OutputError", "SceneError", "UsageError"]


def __getattr__(name):
    if name not in _PLACES:
        raise AttributeError(f"module 'skein' has no {name!r}")
    value = getattr(importlib.import_module(f".{_PLACES[name]}", __name__), name)
    globals()[name] = value
    return value


def __dir__():
    return sorted(__all__)
