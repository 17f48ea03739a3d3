"""usage: check_tidy.py ROOT BUILD CLANG_TIDY JOBS

clang-tidy with the checks of .clang-tidy over the layers that read and write, where a mistake meets what others wrote, and
over the headers that they include. The other layers would take ten minutes, most of it for the headers of Kokkos and Eigen;
they are looked at by hand with
    tests/house/check_tidy.py ROOT BUILD CLANG_TIDY JOBS --all
"""

import json
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from compile_commands import read_commands
from source_tree import SKIPPED

LAYERS = ("core", "scene", "fibers", "io")
NOT_FOR_CLANG = ("-Wno-maybe-uninitialized", "-Wno-restrict", "-Wno-stringop-overflow", "-Wno-array-bounds",
                 "-fpch-preprocess")


def main(root, build, program, jobs, all_sources):
    version = subprocess.run([program, "--version"], capture_output=True, text=True).stdout if program else ""
    if "version 14." not in version:
        print("skipped: no clang-tidy 14 (Debian's clang-tidy-14; tools/setup.sh --with-tests)")
        return SKIPPED
    entries = []
    for source, (_, options) in read_commands(build).items():
        path = Path(source)
        if not path.is_relative_to(root / "src") and not path.is_relative_to(root / "kernels"):
            continue
        if not all_sources and path.relative_to(root).parts[1] not in LAYERS:
            continue
        words = ["clang++", *[word for word in options if word not in NOT_FOR_CLANG], "-c", source]
        entries.append({"directory": str(build), "file": source, "arguments": words})
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "compile_commands.json").write_text(json.dumps(entries), encoding="utf-8")

        def look_at(entry):
            result = subprocess.run([program, "--quiet", "-p", folder, entry["file"]], capture_output=True, text=True)
            return result.returncode, result.stdout

        with ThreadPoolExecutor(jobs) as pool:
            results = list(pool.map(look_at, entries))
    problems = [text for code, text in results if code != 0 or "warning:" in text]
    print("\n".join(problems))
    print(f"{len(entries)} sources, {len(problems)} with problems")
    return 1 if problems or not entries else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), Path(sys.argv[2]), "" if sys.argv[3].endswith("NOTFOUND") else sys.argv[3],
                  int(sys.argv[4]), "--all" in sys.argv))
