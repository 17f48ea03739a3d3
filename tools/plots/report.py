"""What a report adds to the viewer's page: pictures, what was measured, and the certificate."""

import argparse
import base64
import html
import tempfile

import style
from pictures import draw_pictures
from skein_package import MissingInput

CAPTIONS = {
    "shapes": "Shapes over time", "angle": "How the fibers turn", "curvature": "Curvature over arclength and time",
    "energy": "Elastic energy", "extrema": "Extrema of curvature", "power": "Powers and their balance",
    "defects": "Departures from symmetry and from the plane"}


def make_report(run, path):
    """HTML. @param path  file of texts, each behind a line "# heading" """
    try:
        with open(path, encoding="utf-8", errors="replace") as file:
            text = file.read()
    except OSError as error:
        raise MissingInput(f"{path} cannot be read: {error.strerror}") from None
    parts = []
    for chapter in ("\n" + text).split("\n# ")[1:]:
        heading, _, body = chapter.partition("\n")
        parts.append(f"<h2>{html.escape(heading)}</h2><pre>{html.escape(body.strip())}</pre>")
    return "\n".join(parts + ["<h2>Pictures</h2>"] + embed_pictures(run))


def embed_pictures(run):
    options = argparse.Namespace(times=None, notes=[])
    embedded = []
    with tempfile.TemporaryDirectory(prefix="skein-report-") as folder:
        for name, figure in draw_pictures(run, options):
            with open(style.save(figure, folder, name, "png"), "rb") as file:
                picture = base64.b64encode(file.read()).decode()
            caption = html.escape(CAPTIONS.get(name, name))
            embedded.append(f'<figure><img src="data:image/png;base64,{picture}" alt="{caption}">'
                            f"<figcaption>{caption}</figcaption></figure>")
    return embedded
