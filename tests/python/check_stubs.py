"""The stubs name what the package has, with its arguments: check_stubs.py, with the package on PYTHONPATH."""

import ast
import inspect
import pathlib
import sys

import skein
from skein import native


def arguments_of(function):
    return [argument.arg for argument in function.args.posonlyargs + function.args.args + function.args.kwonlyargs]


def compare(where, node, found):
    """@returns what is wrong"""
    if isinstance(node, ast.ClassDef):
        inner = [part for part in node.body if isinstance(part, ast.FunctionDef)]
        return [fault for part in inner for fault in compare(f"{where}.{part.name}", part, getattr(found, part.name, None))]
    if found is None:
        return [f"{where} is not there"]
    if not inspect.isroutine(found) or not hasattr(found, "__code__"):
        return []
    parameters = list(inspect.signature(found).parameters)
    told = arguments_of(node)
    if inspect.ismethod(found):
        told = told[1:]
    return [] if parameters == told else [f"{where} takes {parameters}, and not {told}"]


def check(module, stub):
    tree = ast.parse(pathlib.Path(skein.__file__).with_name(stub).read_text())
    nodes = [node for node in tree.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))]
    private = {"Series", "Diagnostics"}  # of Run, without a name in the package
    return [fault for node in nodes if node.name not in private
            for fault in compare(f"{stub}: {node.name}", node, getattr(module, node.name, None))]


faults = check(skein, "__init__.pyi") + check(native._native, "_native.pyi")
faults += [f"{name} is not in __init__.pyi" for name in skein.__all__ if
           name not in pathlib.Path(skein.__file__).with_name("__init__.pyi").read_text()]
faults += [f"{name} has no docstring" for name in skein.__all__ if callable(getattr(skein, name)) and
           not inspect.getdoc(getattr(skein, name))]
sys.exit("\n".join(faults) or 0)
