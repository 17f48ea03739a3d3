#!/usr/bin/env python3
"""Writes a run as one page for a browser, which needs nothing else: fibers in three dimensions, played, with curves. The
page's path goes to stdout, its size and notes to stderr."""

import argparse
import os
import sys

sys.dont_write_bytecode = True  # the sources, or the installed program, are no place for caches
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))  # which Python's isolated mode leaves out

try:
    import isolation  # noqa: F401, first

    import script
    from output_file import write_error, write_whole
    from page import make_page
    from script import Nothing, attempt, print_path, say
    from skein_package import DamagedData, Error, MissingInput, Run
    from viewer_data import read_view
    from viewer_flow import read_flow
except ImportError as missing:
    sys.exit(f"skein view: {missing}: install python3-matplotlib and python3-h5py")


def parse_arguments():
    parser = argparse.ArgumentParser(prog="view_run.py", description=__doc__, allow_abbrev=False)
    parser.add_argument("folder", metavar="DIR", help="run folder")
    parser.add_argument("--output", required=True, metavar="FILE", help="page to write")
    parser.add_argument("--tables", metavar="FOLDER", help="what `skein analyze` wrote (default: DIR/analysis)")
    parser.add_argument("--flow", metavar="FILE", help="the background flow at points, as `skein view` computes it")
    parser.add_argument("--report", metavar="FILE", help="make a report, with these texts: each behind a line '# heading'")
    return parser.parse_args()


def write_page(options):
    run = Run(options.folder, options.tables)
    try:
        view = read_view(run)
    except Nothing as reason:
        raise MissingInput(f"{options.folder} cannot be shown: {reason}") from None
    except Error:
        raise
    except OSError as error:
        raise DamagedData(f"{run.path} cannot be read: {error}") from None
    if options.flow:
        view["flow"] = read_flow(options.flow)
    content = make_page(run, view, options.report).encode(errors="replace")
    try:
        write_whole(options.output, content)
    except OSError as error:
        raise write_error(options.output, error) from None
    shown = len(view["times"])
    say(f"{1e-6 * len(content):.1f} MB, {shown} of {view['all_frames']} frames, {sum(view['points'])} of "
        f"{run.n_sections} sections")
    print_path(options.output)


if __name__ == "__main__":
    arguments = parse_arguments()
    script.verb = "report" if arguments.report else "view"
    sys.exit(attempt(lambda: write_page(arguments)))
