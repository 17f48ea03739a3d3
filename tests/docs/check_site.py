"""The site is made without a warning, every link in it leads somewhere, and it asks the network for nothing.

Called as check_site.py PROGRAM SOURCES PYTHON FOLDER [CHROMIUM]. Of the gallery one quick scene is run. With a browser, formulas
are looked at: KaTeX has set all of them. Ends with 77, "skipped", where Sphinx, Doxygen or KaTeX is not installed.
"""

import html.parser
import os
import pathlib
import re
import shutil
import subprocess
import sys
import urllib.parse

SCENE = "buckling_C"
SKIPPED = 77


class Page(html.parser.HTMLParser):
    """What a page links to and loads, and the places in it that can be linked to."""

    def __init__(self, path):
        super().__init__()
        self.links, self.loaded, self.places = [], [], set()
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.places |= {attributes[key] for key in ("id", "name") if attributes.get(key)}
        if tag == "a" and attributes.get("href"):
            self.links.append(attributes["href"])
        if tag in ("img", "script", "iframe", "source") and attributes.get("src"):
            self.loaded.append(attributes["src"])
        if tag == "link" and attributes.get("rel") in ("stylesheet", "icon", "prefetch"):
            self.loaded.append(attributes["href"])


def find_problems(root):
    pages = {path: None for path in root.rglob("*.html") if "cpp" not in path.relative_to(root).parts[:1] and
             "gallery" not in path.relative_to(root).parts[:1]}
    read = {}

    def page_of(path):
        if path not in read:
            read[path] = Page(path)
        return read[path]

    n_links = 0
    for path in pages:
        page = page_of(path)
        for address in page.loaded + page.links:
            where = urllib.parse.urlsplit(address)
            if where.scheme or where.netloc:
                if address in page.loaded and where.scheme != "data":
                    yield f"{path.relative_to(root)} loads {address}"
                continue
            n_links += 1
            target = (path.parent / urllib.parse.unquote(where.path)).resolve() if where.path else path
            if target.is_dir():
                target = target / "index.html"
            if not target.is_file():
                yield f"{path.relative_to(root)}: {address} leads nowhere"
            elif where.fragment and target.suffix == ".html" and \
                    urllib.parse.unquote(where.fragment) not in page_of(target).places:
                yield f"{path.relative_to(root)}: there is no place for {address}"
    print(f"{len(pages)} pages, {n_links} links")
    if len(pages) < 30 or n_links < 1000:
        yield "that is too little for a site"


def find_broken_formulas(root, chromium, folder):
    """By the browser: elements that KaTeX has not set, or in red."""
    for name in ("model", "hydrodynamics"):
        dom = subprocess.run(
            [chromium, "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={folder / 'profile'}",
             "--virtual-time-budget=20000", "--dump-dom", f"file://{root / 'docs' / (name + '.html')}"],
            capture_output=True, text=True, timeout=200, env={**os.environ, "HOME": str(folder)}).stdout
        n_set, n_formulas = len(re.findall(r'class="katex-html"', dom)), len(re.findall(r'class="math notranslate', dom))
        if n_formulas < 50 or n_set != n_formulas or "katex-error" in dom:
            yield f"docs/{name}.html: {n_set} of {n_formulas} formulas are set"


def main(program, sources, python, folder, chromium=None):
    if not (shutil.which("sphinx-build") and shutil.which("doxygen") and os.path.exists("/usr/share/javascript/katex")):
        print("Sphinx, Doxygen or KaTeX is not installed: tools/setup.sh --with-site")
        return SKIPPED
    folder = pathlib.Path(folder).resolve()
    made = subprocess.run([pathlib.Path(sources) / "tools/site.sh", "--program", program, "--python", python, "--output", folder,
                           "--scenes", SCENE], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=550)
    print(made.stdout)
    if made.returncode:
        return 1
    root = folder / "html"
    problems = list(find_problems(root))
    if not (root / f"gallery/{SCENE}.html").is_file() or not (root / f"gallery/{SCENE}_shapes.png").is_file():
        problems.append("the gallery lacks the scene that was run")
    if chromium:
        problems += find_broken_formulas(root, chromium, folder)
    print("\n".join(problems))
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
