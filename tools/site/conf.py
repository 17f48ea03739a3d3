"""The site of the pages: Sphinx with MyST reads them where they are, from the repository's root. tools/site.sh runs it."""

import os
import re
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
BUILT = os.environ["SKEIN_SITE_PARTS"]  # what was made for it: gallery, pages of C++, KaTeX
sys.path.insert(0, HERE)
sys.path.insert(0, os.environ["SKEIN_SITE_PYTHON"])  # the package, for its docstrings

with open(os.path.join(ROOT, "CMakeLists.txt"), encoding="utf-8") as file:
    version = release = re.search(r"project\(skein VERSION ([0-9.]+)", file.read())[1]

project = "skein"
copyright = "the skein developers"  # noqa: A001, Sphinx's name for it
extensions = ["myst_parser", "sphinx.ext.autodoc", "site_pages", "site_math", "site_python"]
root_doc = "docs/index"
include_patterns = ["*.md", "docs/**.md", "examples/README.md", "perf/GPU.md", "tests/reference/README.md"]
exclude_patterns = ["build*", "runs"]
source_suffix = {".md": "markdown"}
nitpicky = True

myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4

autodoc_typehints = "none"
add_module_names = False

html_theme = "furo"
html_title = f"skein {version}"
html_static_path = [os.path.join(HERE, "static"), os.path.join(BUILT, "static")]
html_extra_path = [os.path.join(BUILT, "extra")]
html_css_files = ["site.css"]
html_show_sourcelink = False
html_copy_source = False
pygments_style = "tango"
pygments_dark_style = "monokai"
highlight_language = "none"
