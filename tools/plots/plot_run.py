#!/usr/bin/env python3
"""Draws a run: shapes, end-to-end angle, curvature, energy, and what `skein analyze` measured. The paths of the pictures go to stdout, notes to stderr."""

import argparse
import os
import sys

sys.dont_write_bytecode = True  # the sources, or the installed program, are no place for caches
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))  # which Python's isolated mode leaves out

try:
    import isolation  # noqa: F401, first

    import movie
    import style
    from output_file import write_error
    from pictures import draw_pictures
    from script import attempt, print_path
    from skein_package import Run
except ImportError as missing:
    sys.exit(f"skein plot: {missing}: install python3-matplotlib and python3-h5py")

USAGE = 64


class Parser(argparse.ArgumentParser):
    def error(self, message):
        self.exit(USAGE, f"skein plot: {message}\n{self.format_usage()}")


def parse_times(text):
    times = [float(word) for word in text.split(",") if word.strip()]
    if not all(abs(time) < float("inf") for time in times):
        raise ValueError(text)
    return times


def parse_arguments():
    parser = Parser(prog="plot_run.py", description=__doc__, allow_abbrev=False)
    parser.add_argument("folder", metavar="DIR", help="run folder")
    parser.add_argument("--times", type=parse_times, metavar="T1,T2,...", help="draw the frames nearest to these times")
    parser.add_argument("-o", "--output", metavar="FOLDER", help="folder for the pictures (default: DIR/plots)")
    parser.add_argument("--tables", metavar="FOLDER", help="what `skein analyze` wrote (default: DIR/analysis)")
    parser.add_argument("--format", choices=["png", "pdf", "svg"], default="png")
    parser.add_argument("--movie", action="store_true", help="also movie.mp4; needs ffmpeg")
    options = parser.parse_args()
    options.output = options.output or os.path.join(options.folder, "plots")
    options.notes = []
    return options


def draw_all(options):
    run = Run(options.folder, options.tables)
    try:
        os.makedirs(options.output, exist_ok=True)
    except OSError as error:
        raise write_error(options.output, error) from None
    for name, figure in draw_pictures(run, options):
        print_path(style.save(figure, options.output, name, options.format))
    if options.movie:
        print_path(movie.save(run, options.output))


def main():
    options = parse_arguments()
    return attempt(lambda: draw_all(options))


if __name__ == "__main__":
    sys.exit(main())
