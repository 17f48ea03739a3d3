"""usage: check_docs.py ROOT

What the pages say of files is true: links between pages, to their headings and to files lead somewhere, and every path of a
file in backticks that begins with a folder of the sources, or with a room of src, is there; and docs/index.md, of which the
site's contents are made, lists every page of docs.
"""

import re
import sys
from pathlib import Path

FILE = re.compile(r"`([\w.-]+(?:/[\w.-]+)+\.(?:cpp|hpp|py|sh|toml|md|cmake|csv|txt|js))`")
LINK = re.compile(r"\]\(([^)\s]+)\)")
FENCE = re.compile(r"^```.*?^```", re.DOTALL | re.MULTILINE)


FOLDERS = ("cmake", "configs", "docs", "examples", "include", "kernels", "perf", "src", "tests", "tools")


def list_files(root):
    """Of the sources: what was built or run beside them is no part of it."""
    found = [path for path in root.iterdir() if path.is_file()]
    for folder in FOLDERS:
        found += [path for path in (root / folder).rglob("*") if path.is_file() and "__pycache__" not in path.parts]
    return {str(path.relative_to(root)) for path in found}


def make_anchor(heading):
    """As pages of repositories name their headings."""
    words = re.sub(r"[`*$]", "", heading.strip().lower())
    return re.sub(r"[^\w\- ]", "", words).replace(" ", "-")


def list_anchors(page):
    return {make_anchor(line.lstrip("#")) for line in FENCE.sub("", page.read_text(encoding="utf-8")).splitlines()
            if re.match(r"#+ ", line)}


def find_problems(root, name, files):
    page = root / name
    text = FENCE.sub(lambda match: "\n" * match[0].count("\n"), page.read_text(encoding="utf-8"))
    folders = {file.split("/")[0] for file in files if "/" in file}
    rooms = {file.split("/")[1] for file in files if file.startswith("src/") and file.count("/") > 1}

    def place(match):
        return f"{name}:{text[:match.start()].count(chr(10)) + 1}"

    for match in LINK.finditer(text):
        target, _, anchor = match[1].partition("#")
        if re.match(r"[a-z]+:", target):
            continue
        file = (page.parent / target).resolve() if target else page
        if not file.exists():
            yield f"{place(match)}: the link to {match[1]} leads nowhere"
        elif anchor and file.suffix == ".md" and anchor not in list_anchors(file):
            yield f"{place(match)}: {file.name} has no heading for #{anchor}"
    for match in FILE.finditer(text):
        first = match[1].split("/")[0]
        if first in folders and match[1] not in files:
            yield f"{place(match)}: there is no {match[1]}"
        elif first in rooms - folders and not {f"src/{match[1]}", f"include/skein/{match[1]}"} & files:
            yield f"{place(match)}: there is no {match[1]} in src or include/skein"


def main(root):
    files = list_files(root)
    pages = sorted(name for name in files if name.endswith(".md"))
    problems = [problem for name in pages for problem in find_problems(root, name, files)]
    for problem in problems:
        print(problem)
    problems += [f"docs/index.md: {name} is not in its lists" for name in pages if name.startswith("docs/") and
                 name != "docs/index.md" and f"({name.removeprefix('docs/')})" not in (root / "docs/index.md").read_text()]
    print(f"{len(pages)} pages, {len(problems)} problems")
    return 1 if problems or len(pages) < 10 else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]).resolve()))
