"""What the checks of the sources have in common: which files there are, and what they include."""

import functools
import re
from pathlib import Path

SKIPPED = 77  # CTest's SKIP_RETURN_CODE
FOLDERS = ("include", "src", "kernels", "tests", "perf")
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*[<"]([^>"]+)[>"]', re.MULTILINE)


def find_sources(root, *folders, endings=(".cpp", ".hpp")):
    """All C++ files below the folders, sorted, as paths below root."""
    found = []
    for folder in folders or FOLDERS:
        found += [path.relative_to(root) for path in (root / folder).rglob("*") if path.suffix in endings]
    return sorted(found)


class IncludeGraph:
    """Follows #include lines through include/, src/ and the root, as the compiler is told to; no preprocessor is run, so
    that what stands behind an #if counts, too."""

    def __init__(self, root):
        self.root = Path(root)

    def resolve(self, header, includer):
        """The file of the project that is meant, below root, or None."""
        for folder in (self.root / "include", self.root / "src", self.root, (self.root / includer).parent):
            path = folder / header
            if path.is_file():
                return path.resolve().relative_to(self.root.resolve())
        return None

    @functools.lru_cache(maxsize=None)
    def headers(self, file):
        return tuple(INCLUDE.findall((self.root / file).read_text(encoding="utf-8")))

    def way_to(self, file, prefix):
        """The shortest chain of files from `file` to a header whose name begins with `prefix`; empty if there is none."""
        chains, seen = [(file,)], {file}
        while chains:
            chain = chains.pop(0)
            for header in self.headers(chain[-1]):
                if header.startswith(prefix):
                    return chain + (header,)
                inner = self.resolve(header, chain[-1])
                if inner is not None and inner not in seen:
                    seen.add(inner)
                    chains.append(chain + (inner,))
        return ()
