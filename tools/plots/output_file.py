"""Files that the pictures are written into: whole or not at all, and never through a link that somebody left there."""

import contextlib
import errno
import os

from skein_package import CannotCreate, OutputError


def open_new(path):
    """A new file for writing bytes; what stood at the path loses its name and is not opened."""
    with contextlib.suppress(FileNotFoundError):
        os.unlink(path)
    return os.fdopen(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW | os.O_CLOEXEC, 0o666), "wb")


@contextlib.contextmanager
def replacing(path):
    """A path beside this one, of an empty file; when all went well, what was written there takes this one's place."""
    partial = f"{path}.partial"
    open_new(partial).close()
    try:
        yield partial
        os.replace(partial, path)
    except BaseException:
        with contextlib.suppress(OSError):
            os.unlink(partial)
        raise


def write_whole(path, content):
    with replacing(path) as partial, open(partial, "r+b") as file:
        file.write(content)


def write_error(path, error):
    """What to raise for an OSError, from a write to that path."""
    full = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO)
    kind = OutputError if error.errno in full else CannotCreate
    return kind(f"{path} cannot be written: {error.strerror or error}")
