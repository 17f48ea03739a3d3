"""Scenes as text: dictionaries of Python and numpy written as TOML."""

import json
import math
import numbers
import re

from .errors import UsageError

BARE_KEY = re.compile(r"[A-Za-z0-9_-]+")


def write_toml(tables):
    """The TOML of nested dictionaries; a list of dictionaries is an array of tables."""
    lines = []
    _write_table("", tables, lines)
    return "\n".join(lines) + "\n"


def write_value(place, value):
    """One value. @param place  what to call it in messages"""
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, bool) or type(value).__name__ == "bool_":
        return "true" if value else "false"
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        return repr(float(value)) if math.isfinite(value) else str(float(value))
    if hasattr(value, "tolist") or isinstance(value, (list, tuple)):
        parts = value.tolist() if hasattr(value, "tolist") else value
        if not isinstance(parts, (list, tuple)):
            return write_value(place, parts)
        return "[" + ", ".join(write_value(place, part) for part in parts) + "]"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{write_key(place, k)} = {write_value(f'{place}.{k}', v)}" for k, v in value.items()) + "}"
    raise UsageError(f"{place}: a scene holds numbers, texts, lists and tables, and no {type(value).__name__}")


def write_key(place, key):
    if not isinstance(key, str):
        raise UsageError(f"{place}: a key of a scene is a text, and not {key!r}")
    return key if BARE_KEY.fullmatch(key) else json.dumps(key)


def _is_table_list(value):
    return isinstance(value, (list, tuple)) and len(value) > 0 and all(isinstance(part, dict) for part in value)


def _write_table(name, table, lines):
    inner = []
    for key, value in table.items():
        place = f"{name}.{write_key(name or 'scene', key)}".lstrip(".")
        if isinstance(value, dict) or _is_table_list(value):
            inner.append((place, value))
        else:
            lines.append(f"{write_key(name, key)} = {write_value(place, value)}")
    for place, value in inner:
        for part in [value] if isinstance(value, dict) else value:
            lines.append(f"[{place}]" if isinstance(value, dict) else f"[[{place}]]")
            _write_table(place, part, lines)
