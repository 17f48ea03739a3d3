"""What can go wrong, by the exit code with which the program would end; the texts are the program's own."""


class Error(Exception):
    """Any of the errors below. `code` is the program's exit code for it."""

    code = 70


class UsageError(Error, ValueError):
    """What was asked for makes no sense: a wrong argument, arrays that do not fit each other."""

    code = 64


class DamagedData(Error):
    """A file of a run is damaged, and nothing older can serve."""

    code = 65


class MissingInput(Error, FileNotFoundError):
    """A file or folder that was named is not there."""

    code = 66


class InternalError(Error, RuntimeError):
    """A bug of skein."""

    code = 70


class NoResources(Error, MemoryError):
    """The system has not the memory, or does not start the threads, that are needed."""

    code = 71


class CannotCreate(Error, FileExistsError):
    """An output cannot be made, or would overwrite something."""

    code = 73


class OutputError(Error, OSError):
    """Reading or writing failed: a full disk, an input/output error."""

    code = 74


class NumericalFailure(Error, ArithmeticError):
    """A run blew up, or a method missed its tolerance. The last good state of a run is in its folder."""

    code = 76


class SceneError(Error, ValueError):
    """A scene is wrong. The message lists all problems at once, each as scene:line:column."""

    code = 78


OF_CODE = {kind.code: kind for kind in (UsageError, DamagedData, MissingInput, InternalError, NoResources, CannotCreate,
                                        OutputError, NumericalFailure, SceneError)}
