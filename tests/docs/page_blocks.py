"""The code blocks of a page, with what the page says of each in a comment before it.

A block is fenced and names its language. Comments for readers of the source, each on a line of its own before the fence:

    <!-- not run: REASON -->      it cannot run where tests do
    <!-- file: NAME -->           TOML that is written to this file; `file: +NAME` adds to it
    <!-- from: PATH -->           C++ that stands so in this file of the repository, which has a test of its own
    <!-- before: COMMAND -->      what the page takes for granted, run before the block
"""

import re
from typing import NamedTuple

FENCE = re.compile(r"^```(\w*)\s*$")
REMARK = re.compile(r"^<!-- (not run|file|from|before): (\S.*?) -->$")
LANGUAGES = ("sh", "python", "toml", "cpp", "text")


class Block(NamedTuple):
    line: int  #: of the opening fence, from 1
    language: str
    text: str
    remarks: dict  #: kind: words


def read_blocks(page):
    """@returns the blocks of a page, and what is wrong with how they are written, as (line, words)"""
    lines = page.splitlines()
    blocks, problems = [], []
    remarks, at = {}, 0
    while at < len(lines):
        line = lines[at]
        opening = FENCE.match(line)
        if opening:
            end = at + 1
            while end < len(lines) and lines[end] != "```":
                end += 1
            block = Block(at + 1, opening[1], "\n".join(lines[at + 1:end]) + "\n", remarks)
            blocks.append(block)
            if end == len(lines):
                problems.append((at + 1, "the block has no end"))
            if block.language not in LANGUAGES:
                problems.append((at + 1, f"the block's language is one of {', '.join(LANGUAGES)}"))
            remarks, at = {}, end + 1
            continue
        if line.startswith("```") or re.match(r"^\s+```", line):
            problems.append((at + 1, "a fence is ``` and a language, at the line's beginning"))
        if re.match(r"^ {4,}\S", line) and at > 0 and not lines[at - 1].strip() and not in_list(lines, at):
            problems.append((at + 1, "a block of code is fenced, and names its language"))
        if REMARK.match(line):
            kind, words = REMARK.match(line).groups()
            remarks[kind] = words
        elif line.strip():
            if remarks:
                problems.append((at + 1, f"the comment '{next(iter(remarks))}' stands before no block"))
            if re.match(r"^<!-- ?(not run|file|from|before)\b", line):
                problems.append((at + 1, "a comment on a block is '<!-- not run: REASON -->', or 'file', 'from', 'before'"))
            remarks = {}
        at += 1
    return blocks, problems


def in_list(lines, at):
    """Does the paragraph before begin with an item of a list? What is indented behind it belongs to it."""
    while at > 0 and (not lines[at].strip() or lines[at].startswith(" ")):
        at -= 1
    return bool(re.match(r"^([-*]|\d+\.) ", lines[at]))
