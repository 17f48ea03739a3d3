"""What the scripts have in common: notes for people on stderr, paths for programs on stdout, exit codes for both."""

import os
import sys
import unicodedata

from skein_package import Error, OutputError

INTERNAL, STOPPED = 70, 75
verb = "plot"  # of the program, whose script this is
UNSEEN = ("Cc", "Cf", "Cs", "Zl", "Zp")  # controls, marks that turn the direction, bytes of no encoding, separators


class Nothing(Exception):
    """The run holds too little for a picture: not an error."""


def printable(text):
    """No control character of a title or a name reaches a terminal."""
    return "".join(c if c in "\n\t" or unicodedata.category(c) not in UNSEEN else ascii(c)[1:-1] for c in text)


def say(text):
    print(printable(f"skein {verb}: {text}"), file=sys.stderr)


def print_path(path, to_stderr=False):
    if to_stderr or sys.stdout.isatty():
        path = printable(path)
    stream = sys.stderr if to_stderr else sys.stdout
    try:
        print(path, file=stream, flush=True)
    except OSError as error:
        # What is left in the stream would fail once more at the end of the program.
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
        raise OutputError(f"standard output cannot be written: {error.strerror}") from None


def attempt(work):
    """Does the work. @returns the exit code; whatever goes wrong is one line for people."""
    if hasattr(sys.stdout, "reconfigure"):
        sys.stdout.reconfigure(errors="surrogateescape")  # names of files need not be text
    try:
        work()
    except Error as error:
        say(error)
        return error.code
    except KeyboardInterrupt:
        say("interrupted")
        return STOPPED
    except Exception as error:  # a bug; SKEIN_DEBUG=1 shows where
        if os.environ.get("SKEIN_DEBUG"):
            raise
        say(f"internal error: {type(error).__name__}: {error}")
        return INTERNAL
    return 0
