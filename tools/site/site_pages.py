"""What the site adds to the pages of the repository: the tree of contents from the lists of docs/index.md, what the program
says of its verbs, docstrings, the gallery; and where links lead that are no pages here."""

import os
import posixpath
import re
import subprocess
import xml.etree.ElementTree

from docutils import nodes
from sphinx import addnodes

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PARTS = os.environ["SKEIN_SITE_PARTS"]
PROGRAM = os.environ["SKEIN_SITE_PROGRAM"]
# Folders that a page links to, and what shows them here; the others stay words.
FOLDERS = {"configs": "docs/gallery.html", "configs/sweeps": "docs/sweeps.html",
           "include/skein": "cpp/files.html", "examples": "examples/README.html",
           "examples/notebooks": "docs/python.html", "tests/reference": "tests/reference/README.html"}
PYTHON_CLASSES = ("Run", "Frame", "Scene", "Plan", "Mobility", "Velocities")
PYTHON_FUNCTIONS = ("run", "resume", "analyze", "plan", "mobility", "set_threads", "describe_build")


def call(*words):
    return subprocess.run([PROGRAM, *words], check=True, capture_output=True, text=True, timeout=60).stdout


def make_contents(text):
    """A hidden toctree for each chapter of docs/index.md that lists pages, in its order."""
    trees = []
    for chapter in re.split(r"^## ", text, flags=re.MULTILINE)[1:]:
        heading, _, body = chapter.partition("\n")
        pages = re.findall(r"^\|? ?-? ?\[[^\]]+\]\(([^)#\s]+)\.md\)", body, re.MULTILINE)
        if pages:
            listed = "\n".join(posixpath.normpath(posixpath.join("/docs", page)) for page in pages)
            trees.append(f"```{{toctree}}\n:hidden:\n:caption: {heading}\n\n{listed}\n```\n")
    return "\n" + "\n".join(trees)


def make_verbs(_):
    listed = call("help").split("Subcommands:")[1].split("\n\n")[0]
    verbs = re.findall(r"^  (\w+) ", listed, re.MULTILINE)
    return "\n" + "\n".join(f"## skein {verb}\n\n```text\n{call('help', verb).strip()}\n```\n" for verb in verbs)


def make_python(_):
    lines = ["", "## Everything in `skein`", "", "```{eval-rst}"]
    for name in PYTHON_FUNCTIONS:
        lines += [f".. autofunction:: skein.{name}", ""]
    for name in PYTHON_CLASSES:
        lines += [f".. autoclass:: skein.{name}", "   :members:", "   :special-members: __call__", ""]
    return "\n".join(lines + ["```", ""])


def make_gallery(_):
    with open(os.path.join(PARTS, "gallery.md"), encoding="utf-8") as file:
        return "\n" + file.read()


ADDED = {"docs/index": make_contents, "docs/verbs": make_verbs, "docs/python": make_python, "docs/gallery": make_gallery}


def add_to_page(app, name, source):
    if name in ADDED:
        source[0] += ADDED[name](source[0])


def refer(app, from_page, target, content, shown=None):
    """A link from a page to a file of the site."""
    here = posixpath.dirname(app.builder.get_target_uri(from_page))
    node = nodes.reference("", "", internal=True, refuri=posixpath.relpath(target, here or "."))
    node += content
    return node


def resolve_folder(app, env, node, content):
    """Folders of the sources are linked to on the pages of the repository."""
    target = posixpath.normpath(posixpath.join(posixpath.dirname(node["refdoc"]), node["reftarget"]))
    if not os.path.isdir(os.path.join(ROOT, target)):
        return None
    return refer(app, node["refdoc"], FOLDERS[target], content) if target in FOLDERS else content


def read_header_pages():
    """{header: page of C++} by the tags of Doxygen."""
    tags = os.path.join(PARTS, "cpp.tag")
    if not os.path.exists(tags):
        return {}
    pages = {}
    for compound in xml.etree.ElementTree.parse(tags).getroot().iter("compound"):
        if compound.get("kind") == "file":
            path, name, page = (compound.findtext(part) or "" for part in ("path", "name", "filename"))
            pages[os.path.relpath(os.path.join(path, name), ROOT)] = f"cpp/{page if page.endswith('.html') else page + '.html'}"
    return pages


def link_headers(app, tree, name):
    """Public headers have pages; other files of the sources are for download."""
    pages = app.env.skein_header_pages
    for node in list(tree.findall(addnodes.download_reference)):
        target = posixpath.normpath(posixpath.join(posixpath.dirname(name), node["reftarget"]))
        if target in pages:
            node.replace_self(refer(app, name, pages[target], node.children))


def begin(app):
    app.env.skein_header_pages = read_header_pages()


def setup(app):
    app.connect("builder-inited", begin)
    app.connect("source-read", add_to_page)
    app.connect("missing-reference", resolve_folder)
    app.connect("doctree-resolved", link_headers)
    return {"parallel_read_safe": True}
