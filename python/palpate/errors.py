# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""From VTK's error events to Python's exceptions."""

import signal
import threading
from contextlib import contextmanager


class Error(ValueError):
    """What keeps a call from doing its work, in one sentence."""


class ModelWarning(UserWarning):
    """What makes a model doubtful though it was computed: a thin wall, a small support."""


class Aborted(RuntimeError):
    """A progress callback asked for an end."""


@contextmanager
def silenced(algorithm):
    """Keeps an object's error events, and those of its executive, from being printed."""
    objects = [algorithm]
    if hasattr(algorithm, "GetExecutive"):
        objects.append(algorithm.GetExecutive())
    tags = [each.AddObserver("ErrorEvent", lambda *_: None) for each in objects]
    try:
        yield
    finally:
        for each, tag in zip(objects, tags):
            each.RemoveObserver(tag)


@contextmanager
def deferred_interrupts(interrupted=lambda: None):
    """Keeps Ctrl-C from raising in the block and lets it count after it.

    VTK ends the whole process when an observer raises KeyboardInterrupt. `interrupted` is called when
    the signal is noticed, which is whenever the interpreter runs: in an observer, or at the end.
    """
    previous = signal.getsignal(signal.SIGINT)
    if threading.current_thread() is not threading.main_thread() or not callable(previous):
        yield
        return
    noticed = []

    def note(number, frame):
        noticed.append((number, frame))
        interrupted()

    signal.signal(signal.SIGINT, note)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, previous)
    if noticed:
        previous(*noticed[0])
        raise KeyboardInterrupt


def run(algorithm, progress=None):
    """Updates a filter and returns its output.

    Raises `Error` with the filter's sentence, `Aborted` if `progress` returned False, what `progress`
    raised, or KeyboardInterrupt after a Ctrl-C, which ends the filter's work at its next report.
    """
    stopped = []

    def abort():
        algorithm.SetAbortExecute(1)

    def report(*_):
        try:
            answer = progress(algorithm.GetProgress(), algorithm.GetProgressText() or "")
            if answer is not None and not answer:
                stopped.append(Aborted("aborted by the progress callback"))
        except BaseException as raised:  # carried over VTK's C++ frames
            stopped.append(raised)
        if stopped:
            abort()

    # Without a callback, too, something of Python's must run at times to notice Ctrl-C.
    tag = algorithm.AddObserver("ProgressEvent", report if progress else lambda *_: None)
    with deferred_interrupts(abort), silenced(algorithm):
        algorithm.Update()
    algorithm.RemoveObserver(tag)
    if stopped:
        raise stopped[0]
    if algorithm.GetFailureMessage():
        raise Error(algorithm.GetFailureMessage())
    return algorithm.GetOutput()
