"""Calls into the library: errors become exceptions, Ctrl-C and exceptions in callbacks end what runs."""

import ctypes as c
import threading
import warnings

from . import _abi

VERSION = "0.1.0"
lib = _abi.load(VERSION)


class Error(Exception):
    """Something went wrong. code: "bad_input", "io", "memory", "cancelled", "internal" or "differs"; file, line and
    column say where, as far as it is known (None else)."""

    CODES = ("ok", "bad_input", "io", "memory", "cancelled", "internal", "differs")

    def __init__(self, error):
        self.code = self.CODES[error.code]
        self.file = error.file.decode(errors="replace") or None
        self.line = error.line or None
        self.column = error.column or None
        self.message = error.message.decode(errors="replace")
        place = ":".join(str(part) for part in (self.file, self.line, self.column) if part)
        super().__init__(f"{place}: {self.message}" if place else self.message)


class BadInput(Error, ValueError):
    """The scene, a file it names or an argument is wrong."""


class _Callbacks:
    """What the library calls while it runs. An exception in one of them ends the run and is raised again after it."""

    def __init__(self, progress, each_pass=None):
        self.cancelled = c.c_int(0)
        self.raised = None
        self.warned = []
        self.run = _abi.Run()
        self.run.cancelled = c.pointer(self.cancelled)
        self.run.warn = self._warn = _abi.WARN(lambda user, text: self.warned.append(text.decode()))
        if progress:
            guarded = self.guard(progress)
            self.run.progress = _abi.PROGRESS(lambda user, stage, done: guarded(stage.decode(), done))
        self.each_pass = _abi.PASS() if each_pass is None else _abi.PASS(self.guard(each_pass))

    def guard(self, function):
        def call(*arguments):
            try:
                if not self.raised:
                    function(*arguments)
            except BaseException as reason:  # pylint: disable=broad-except ; it must not pass through C
                self.raised = reason
                self.cancelled.value = 1

        return call


def _wait(function, callbacks):
    """The result of function(), called on another thread while this one, the main thread, stays open to Ctrl-C."""
    outcome, done = [], threading.Event()

    def work():
        outcome.append(function())
        done.set()

    threading.Thread(target=work, name="ramify").start()
    while not done.is_set():
        try:
            done.wait()
        except BaseException as reason:  # pylint: disable=broad-except ; whatever a signal's handler raises
            callbacks.raised = callbacks.raised or reason
            callbacks.cancelled.value = 1
    return outcome[0]


def run(function, threads=0, progress=None, each_pass=None, discard=None):
    """function(run, each_pass, error) in the library. threads: 0 = all processors. progress(stage, done): done in 0..1.
    A result that nobody will see any more, because something was raised, is given to discard."""
    callbacks = _Callbacks(progress, each_pass)
    callbacks.run.threads = threads
    error = _abi.Error()
    call = lambda: function(c.byref(callbacks.run), callbacks.each_pass, c.byref(error))
    in_main = threading.current_thread() is threading.main_thread()
    result = _wait(call, callbacks) if in_main else call()
    if callbacks.raised is not None:
        if result and discard:
            discard(result)
        raise callbacks.raised
    for text in callbacks.warned:
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


class Handle:
    """A handle of the library and what it borrows from; freed with the last that needs it."""

    def __init__(self, pointer, free, *owners):
        self.pointer = pointer
        self._free = getattr(lib, "ramify_" + free)
        self._owners = owners

    def __del__(self):
        self._free(self.pointer)
