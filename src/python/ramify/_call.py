"""Calls into the library: errors become exceptions, Ctrl-C and exceptions in callbacks cancel the call."""

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
    """Error of the library. code: "bad_input", "io", "memory", "cancelled", "internal" or "differs"; file, line and
    column are the place, None if unknown."""

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
    """The scene, a file it names or an argument is invalid."""


class _State:
    """State of a run: the exception raised and the warnings. Free of reference cycles, so that objects used by callbacks
    (a film) are freed immediately instead of by the garbage collector."""

    def __init__(self):
        self.cancelled = c.c_int(0)
        self.raised = None
        self.warned = []

    def end(self, reason):
        """Cancels the run; reason is raised when it has ended."""
        self.raised = self.raised or reason
        self.cancelled.value = 1


def _guard(state, function):
    """Wraps function as a callback: an exception in it cancels the run."""

    def call(*arguments):
        try:
            if not state.raised:
                function(*arguments)
        except BaseException as reason:  # pylint: disable=broad-except ; it must not pass through C
            state.end(reason)

    return call


def _how(state, threads, progress):
    """Execution parameters for the library; keeps the callbacks alive."""
    how = _abi.Run()
    how.threads = threads
    how.cancelled = c.pointer(state.cancelled)
    how.warn = _abi.WARN(lambda user, text: state.warned.append(text.decode(errors="replace")))
    if progress:
        guarded = _guard(state, progress)
        how.progress = _abi.PROGRESS(lambda user, stage, done: guarded(stage.decode(), done))
    return how


def _wait(function, state):
    """Calls function() on another thread, so that the main thread can handle Ctrl-C; returns its result."""
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


def run(function, threads=0, progress=None, each=None, discard=None, each_type=_abi.PASS):
    """Calls function(run, each, error) of the library. threads: 0 = all processors. progress(stage, done): done in
    0..1. each: a further callback, of each_type. If an exception is raised, the result is passed to discard."""
    state, error = _State(), _abi.Error()
    how = _how(state, threads, progress)
    show = each_type(_guard(state, each)) if each else each_type()
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
    """Returns result, or raises if it signals an error."""
    if result:
        return result
    raise (BadInput if error.code == 1 else Error)(error)


def call(name, *arguments):
    """Calls ramify_name(*arguments, &error), for functions that return quickly."""
    error = _abi.Error()
    return check(getattr(lib, "ramify_" + name)(*arguments, c.byref(error)), error)


def path(file: File) -> bytes:
    """Converts a file name (text, bytes or a path) for the library."""
    name = os.fsencode(file)
    if b"\0" in name:
        raise ValueError(f"{file!r} is no name of a file: there is a NUL in it")
    return name


class Handle:
    """A handle of the library, with references to the handles it borrows from; freed with its last reference."""

    def __init__(self, pointer, free, *owners):
        self.pointer = pointer
        self._free = getattr(lib, "ramify_" + free)
        self._owners = owners

    def __reduce_ex__(self, protocol):
        raise TypeError("what ramify made cannot be copied or pickled; copy its arrays, or make it anew from its scene")

    def __del__(self):
        self._free(self.pointer)
