"""Docstrings of the Python package as Sphinx reads them: `@param name  text` becomes a field, and indented lines code."""

import re

FIELD = re.compile(r"^@(param \w+|returns|throws)\s+(.*)$")


def rewrite(lines):
    out, in_field, in_code = [], False, False
    for line in "\n".join(lines).replace(" @returns", "\n@returns").split("\n"):
        field = FIELD.match(line.strip())
        is_code = line.startswith("    ") and not in_field
        if field:
            kind, text = field.groups()
            out += ([] if in_field else [""]) + [f":{kind.replace('throws', 'raises')}: {text}"]
        elif in_field and line.strip():
            out.append("    " + line.strip())
        else:
            if is_code and not in_code:
                out += [".. code-block:: python", ""]
            out.append(line)
        in_field = bool(field) or in_field and bool(line.strip())
        in_code = is_code or in_code and not line.strip()
    return out


def process(app, what, name, obj, options, lines):
    lines[:] = rewrite(lines)


def setup(app):
    app.connect("autodoc-process-docstring", process)
    return {"parallel_read_safe": True}
