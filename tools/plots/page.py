"""The viewer's page: one file with its style, its scripts, three.js and the run."""

import html
import json
import os

import matplotlib
import numpy as np

from report import make_report
from skein_package import MissingInput
from viewer_data import pack

PARTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "viewer")
SCRIPTS = ("numbers.js", "tubes.js", "arrows.js", "panels.js", "stage.js", "player.js")
THREE = "/usr/share/javascript/three"  # of Debian's libjs-three
THREE_SCRIPTS = ("build/three.min.js", "examples/js/controls/OrbitControls.js")
COST_BEGINS = ("done: ", "stopped at ", "the last good state")


def read_part(name):
    with open(os.path.join(PARTS, name), encoding="utf-8") as file:
        return file.read()


def read_three(name):
    try:
        with open(os.path.join(THREE, name), encoding="utf-8") as file:
            return file.read()
    except OSError:
        raise MissingInput(f"the page needs three.js, and {THREE}/{name} is not there: tools/setup.sh --with-viewer, or "
                           "Debian's libjs-three, brings it") from None


def make_script(text):
    """Nothing in a script ends it but its end."""
    return "<script>\n" + text.replace("</script", "<\\/script") + "\n</script>"


def make_json(value):
    """No text of a run, which may be somebody else's, ends the element that holds it."""
    return json.dumps(value, separators=(",", ":")).replace("<", "\\u003c")


def palettes():
    """Colours of 256 steps and of kinds, as bytes."""
    steps = np.linspace(0.0, 1.0, 256)

    def of(name, values):
        return pack(np.round(255.0 * matplotlib.colormaps[name](values)[:, :3]).astype("u1"))

    return {"rising": of("viridis", steps), "diverging": of("coolwarm", steps), "distinct": of("tab10", np.arange(10))}


def read_cost(run):
    """The last lines of run.log from the run's end on: its cost card. Empty where it has not ended."""
    try:
        with open(os.path.join(run.folder, "run.log"), encoding="utf-8", errors="replace") as file:
            lines = [line.rstrip("\n").split(" s  ", 1)[-1] for line in file]
    except OSError:
        return ""
    ends = [number for number, line in enumerate(lines) if line.startswith(COST_BEGINS)]
    return "\n".join(lines[ends[-1]:]) if ends else ""


def make_section(title, text):
    return f"<details><summary>{html.escape(title)}</summary><pre>{html.escape(text)}</pre></details>" if text else ""


def make_page(run, view, report):
    """@param view    see viewer_data
    @param report  file of the report's texts; None: no report"""
    view["palettes"] = palettes()
    about = f"{run.n_fibers} fiber{'s' if run.n_fibers > 1 else ''}, {len(run.frame_times)} frames to t = " \
            f"{run.frame_times[-1]:g}, {view['status']}; {view['flow_words'] or 'no flow'}"
    sections = [make_section("Cost", read_cost(run)), make_section("Scene", run.scene_text)]
    if report:
        sections.insert(0, make_report(run, report))
    scripts = [read_three(name) for name in THREE_SCRIPTS] + [read_part(name) for name in SCRIPTS]
    fillings = {"title": html.escape(view["title"] or "a run of skein"), "about": html.escape(about),
                "style": read_part("viewer.css"), "sections": "\n".join(filter(None, sections)),
                "view": make_json(view), "scripts": "\n".join(map(make_script, scripts))}
    # One pass over the template: what is filled in is not looked through for places to fill.
    pieces = read_part("viewer.html").split("@")
    return "".join(fillings[piece] if number % 2 else piece for number, piece in enumerate(pieces))
