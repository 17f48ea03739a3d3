"""usage: check_labels.py ROOT

Every label of a kernel or an array begins with "skein::", so that a profile of a program that uses the library says whose
they are; and no header, not even of tests, holds a KOKKOS_LAMBDA, which nvcc may lose in a template that several sources
instantiate.
"""

import re
import sys
from pathlib import Path

from source_tree import find_sources

# Calls that take a label among their arguments. make_vectors of the integrators puts the prefix before it by itself.
CALL = re.compile(
    r"\b(?:parallel_for|parallel_reduce|parallel_scan|fence|view_alloc|to_device|require_extent|place_lists|resize|"
    r"\w*View\s*<[^;{}()]*>(?:\s+\w+)?|(?:Host)?(?:Vectors|Scalars)(?:\s+\w+)?)\s*([({])")
LABEL = re.compile(r'^(?:std::string\s*[({]\s*)?"([^"]*)"')
COMMENT = re.compile(r'//[^\n]*|/\*.*?\*/|("(?:\\.|[^"\\])*")', re.DOTALL)


def blank_comments(text):
    """Comments become blanks of the same shape, so that line numbers stay; texts stay."""
    return COMMENT.sub(lambda match: match.group(1) or re.sub(r"[^\n]", " ", match.group(0)), text)


def split_arguments(text, start):
    """The top-level arguments of a call, `start` being behind its opening bracket."""
    depth, argument, arguments, at = 0, "", [], start
    while at < len(text):
        letter = text[at]
        if letter == '"':
            end = at + 1
            while end < len(text) and text[end] != '"':
                end += 2 if text[end] == "\\" else 1
            argument += text[at:end + 1]
            at = end + 1
            continue
        if letter in ")}]" and depth == 0:
            break
        if letter == "," and depth == 0:
            arguments.append(argument.strip())
            argument = ""
        else:
            depth += (letter in "([{") - (letter in ")]}")
            argument += letter
        at += 1
    return arguments + [argument.strip()]


def find_labels(text):
    """(position, label) of every literal label; a label that is put together is the caller's affair."""
    for call in CALL.finditer(text):
        for argument in split_arguments(text, call.end()):
            literal = LABEL.match(argument)
            if literal:
                yield call.start(), literal.group(1)


def main(root):
    n_labels, problems = 0, []
    for file in find_sources(root, "include", "src", "kernels"):
        text = blank_comments((root / file).read_text(encoding="utf-8"))
        for position, label in find_labels(text):
            n_labels += 1
            if not label.startswith("skein::"):
                line = text.count("\n", 0, position) + 1
                problems.append(f'{file}:{line}: the label "{label}" does not begin with "skein::"')
    for file in find_sources(root, endings=(".hpp",)):
        text = blank_comments((root / file).read_text(encoding="utf-8"))
        if re.search(r"\bKOKKOS_(CLASS_)?LAMBDA\b", text):
            problems.append(f"{file}: a kernel's lambda in a header: write a functor")
    for problem in problems:
        print(problem)
    print(f"{n_labels} labels, {len(problems)} problems")
    return 1 if problems or n_labels == 0 else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
