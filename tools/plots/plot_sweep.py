#!/usr/bin/env python3
"""Draws the table of a sweep: values over one parameter, or maps of them over two."""

import argparse
import os
import re
import sys

sys.dont_write_bytecode = True  # the sources, or the installed program, are no place for caches
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))  # which Python's isolated mode leaves out

import isolation  # noqa: F401, first

import style
from script import attempt, print_path, say
from skein_package import CannotCreate
from sweep_curves import draw_curves
from sweep_map import draw_map
from sweep_table import SweepTable


def parse_picture(text):
    """ "VALUE over X", "VALUE over X by Z" or "VALUE over X and Y", as the program has checked them."""
    match = re.fullmatch(r"(\S+) over (\S+)(?: (and|by) (\S+))?", text)
    if not match:
        raise argparse.ArgumentTypeError(f"{text!r} is no picture")
    value, x, kind, other = match.groups()
    return value, x, other if kind == "and" else None, other if kind == "by" else None


def draw_picture(table, picture, drawn):
    value, x, y, by = (table.column(name) if name else None for name in picture)
    return draw_map(table, value, x, y) if y else draw_curves(table, value, x, by, drawn)


def main():
    parser = argparse.ArgumentParser(description=__doc__, allow_abbrev=False)
    parser.add_argument("folder", help="of the sweep; pictures go into its folder 'pictures'")
    parser.add_argument("--picture", action="append", type=parse_picture, required=True)
    parser.add_argument("--drawn", action="append", default=[], help="a parameter whose values are random: no lines")
    parser.add_argument("--format", choices=["png", "pdf", "svg"], default="png")
    parser.add_argument("--to-stderr", action="store_true", help="the pictures' paths go to stderr")
    options = parser.parse_args()

    def draw_all():
        table = SweepTable(options.folder)
        if not table.is_done.any():
            say("no run is done: there is nothing to draw")
            return
        folder = os.path.join(options.folder, "pictures")
        try:
            os.makedirs(folder, exist_ok=True)
        except OSError as error:
            raise CannotCreate(f"cannot create {folder}: {error.strerror}") from None
        for picture in options.picture:
            value, x, y, by = picture
            words = f"{value} over {x}" + (f" and {y}" if y else f" by {by}" if by else "")
            figure = draw_picture(table, picture, options.drawn)
            path = style.save(figure, folder, re.sub(r"[^A-Za-z0-9]+", "_", words), options.format)
            print_path(path, options.to_stderr)

    return attempt(draw_all)


if __name__ == "__main__":
    sys.exit(main())
