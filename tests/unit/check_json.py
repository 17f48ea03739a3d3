"""What the JSON writer writes, as Python's reader takes it.

Usage: check_json.py WRITE_JSON_SAMPLE"""

import json
import subprocess
import sys

EXPECTED = {
    "bytes": bytes(range(256)).decode(errors="replace"),
    '"a\\key"\t': "\U0001f9f6 \ufffd\ufffd\ufffd \ufffd\ufffd",
    "reals": [0.1, 1 / 3, -0.0, 1e308, 5e-324, 1e23, 123456789012345680.0],
    "none": [None, None],
    "counts": [-(2**63), 2**64 - 1],
    "nested": [[{}], [], False],
}


def refuse(constant):
    raise ValueError(f"{constant} is no JSON")


def main():
    for n_open_levels in range(4):
        written = subprocess.run([sys.argv[1], str(n_open_levels)], capture_output=True, check=True).stdout
        found = json.loads(written.decode(), parse_constant=refuse)
        # By their repr: equality alone takes -0.0 for 0 and 1.0 for True.
        if repr(found) != repr(EXPECTED):
            sys.exit(f"check_json: found    {found}\nexpected {EXPECTED}")
        n_lines = written.count(b"\n")
        if (n_lines == 1) != (n_open_levels == 0):
            sys.exit(f"check_json: {n_lines} lines with {n_open_levels} open levels")


if __name__ == "__main__":
    main()
