"""Scripts that draw one table of numbers."""

import argparse
import csv
import os

import numpy as np

import style
from script import attempt, print_path
from skein_package import MissingInput


def read_table(path):
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.reader(file))
    except OSError as error:
        raise MissingInput(f"{path} cannot be read: {error.strerror}") from None
    values = np.array([[float(cell) for cell in row] for row in rows[1:]])
    return {name.split(" [")[0]: values[:, i] for i, name in enumerate(rows[0])}


def draw_table_of(name, description, draw):
    """What the command line asks for: FOLDER/name.csv drawn into FOLDER/name.png. @returns the exit code"""
    parser = argparse.ArgumentParser(description=description, allow_abbrev=False)
    parser.add_argument("folder", help="with the table")
    parser.add_argument("--format", choices=["png", "pdf", "svg"], default="png")
    parser.add_argument("--to-stderr", action="store_true", help="the picture's path goes to stderr")
    options = parser.parse_args()

    def draw_it():
        figure = draw(read_table(os.path.join(options.folder, f"{name}.csv")))
        print_path(style.save(figure, options.folder, name, options.format), options.to_stderr)

    return attempt(draw_it)
