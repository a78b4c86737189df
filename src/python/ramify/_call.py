"""Calls into the library: errors become exceptions, Ctrl-C and exceptions in callbacks end what runs."""

import ctypes as c
import os
import threading
import warnings
from typing import Callable, Optional, Union

from . import _abi

VERSION = "0.1.0"
lib = _abi.load(VERSION)

# How functions that take long tell how far they are: (stage, done), done in 0..1.
Progress = Optional[Callable[[str, float], object]]
# How files are named.
File = Union[str, bytes, os.PathLike]


class Error(Exception):
    """Something went wrong. code: "bad_input", "io", "memory", "cancelled", "internal" or "differs"; file, line and
    column say where, as far as it is known (None else)."""

    CODES = ("ok", "bad_input", "io", "memory", "cancelled", "internal", "differs")

    def __init__(self, error):
        self.code: str = self.CODES[error.code]
        self.file: Optional[str] = error.file.decode(errors="replace") or None
        self.line: Optional[int] = error.line or None
        self.column: Optional[int] = error.column or None
        self.message: str = error.message.decode(errors="replace")
        place = ":".join(str(part) for part in (self.file, self.line, self.column) if part)
        super().__init__(f"{place}: {self.message}" if place else self.message)


class BadInput(Error, ValueError):
    """The scene, a file it names or an argument is wrong."""


class _State:
    """Of a run: what was raised and what was warned of. Holds nothing that holds it, so that what callbacks know (a film)
    is freed with the last that needs it and need not wait for the garbage collector."""

    def __init__(self):
        self.cancelled = c.c_int(0)
        self.raised = None
        self.warned = []

    def end(self, reason):
        """Ends the run; reason is raised after it."""
        self.raised = self.raised or reason
        self.cancelled.value = 1


def _guard(state, function):
    """function as the library may call it: an exception in it ends the run."""

    def call(*arguments):
        try:
            if not state.raised:
                function(*arguments)
        except BaseException as reason:  # pylint: disable=broad-except ; it must not pass through C
            state.end(reason)

    return call


def _how(state, threads, progress):
    """How to run, for the library. It keeps the callbacks."""
    how = _abi.Run()
    how.threads = threads
    how.cancelled = c.pointer(state.cancelled)
    how.warn = _abi.WARN(lambda user, text: state.warned.append(text.decode(errors="replace")))
    if progress:
        guarded = _guard(state, progress)
        how.progress = _abi.PROGRESS(lambda user, stage, done: guarded(stage.decode(), done))
    return how


def _wait(function, state):
    """The result of function(), called on another thread while this one, the main thread, stays open to Ctrl-C."""
    outcome, done = [None], threading.Event()

    def work():
        try:
            outcome[0] = function()
        except BaseException as reason:  # pylint: disable=broad-except ; an argument that C cannot take
            state.end(reason)
        finally:
            done.set()

    threading.Thread(target=work, name="ramify").start()
    while not done.is_set():
        try:
            done.wait()
        except BaseException as reason:  # pylint: disable=broad-except ; whatever a signal's handler raises
            state.end(reason)
    return outcome[0]


def run(function, threads=0, progress=None, each_pass=None, discard=None):
    """function(run, each_pass, error) in the library. threads: 0 = all processors. progress(stage, done): done in 0..1.
    A result that nobody will see any more, because something was raised, is given to discard."""
    state, error = _State(), _abi.Error()
    how = _how(state, threads, progress)
    show = _abi.PASS(_guard(state, each_pass)) if each_pass else _abi.PASS()
    call = lambda: function(c.byref(how), show, c.byref(error))
    in_main = threading.current_thread() is threading.main_thread()
    result = _wait(call, state) if in_main else call()
    if state.raised is not None:
        if result and discard:
            discard(result)
        raise state.raised
    for text in state.warned:
        warnings.warn(text, RuntimeWarning, stacklevel=4)
    return check(result, error)


def check(result, error):
    """result, unless it says that there is an error."""
    if result:
        return result
    raise (BadInput if error.code == 1 else Error)(error)


def call(name, *arguments):
    """ramify_name(*arguments, &error), of those that are quick."""
    error = _abi.Error()
    return check(getattr(lib, "ramify_" + name)(*arguments, c.byref(error)), error)


def path(file: File) -> bytes:
    """The name of a file (text, bytes or a path) as the library takes it."""
    name = os.fsencode(file)
    if b"\0" in name:
        raise ValueError(f"{file!r} is no name of a file: there is a NUL in it")
    return name


class Handle:
    """A handle of the library and what it borrows from; freed with the last that needs it."""

    def __init__(self, pointer, free, *owners):
        self.pointer = pointer
        self._free = getattr(lib, "ramify_" + free)
        self._owners = owners

    def __reduce_ex__(self, protocol):
        raise TypeError("what ramify made cannot be copied or pickled; copy its arrays, or make it anew from its scene")

    def __del__(self):
        self._free(self.pointer)
