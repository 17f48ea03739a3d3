"""usage: check_format.py ROOT CLANG_FORMAT

Every C++ file is formatted as .clang-format says. Only version 14 decides: others format otherwise.
"""

import subprocess
import sys
from pathlib import Path

from source_tree import SKIPPED, find_sources


def main(root, program):
    version = subprocess.run([program, "--version"], capture_output=True, text=True).stdout if program else ""
    if "version 14." not in version:
        print("skipped: no clang-format 14 (Debian's clang-format-14; tools/setup.sh --with-tests)")
        return SKIPPED
    files = [str(root / file) for file in find_sources(root)]
    result = subprocess.run([program, "--dry-run", "-Werror", *files], stderr=subprocess.PIPE, text=True)
    print(result.stderr)
    print(f"{len(files)} files")
    return result.returncode


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), "" if sys.argv[2].endswith("NOTFOUND") else sys.argv[2]))
