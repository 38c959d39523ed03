# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""From VTK's error events to Python's exceptions."""

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


def run(algorithm, progress=None):
    """Updates a filter and returns its output.

    Raises `Error` with the filter's sentence, `Aborted` if `progress` returned False, or what
    `progress` raised.
    """
    stopped = []

    def report(*_):
        try:
            answer = progress(algorithm.GetProgress(), algorithm.GetProgressText() or "")
            if answer is not None and not answer:
                stopped.append(Aborted("aborted by the progress callback"))
        except BaseException as raised:  # carried over VTK's C++ frames
            stopped.append(raised)
        if stopped:
            algorithm.SetAbortExecute(1)

    tag = algorithm.AddObserver("ProgressEvent", report) if progress else None
    with silenced(algorithm):
        algorithm.Update()
    if tag is not None:
        algorithm.RemoveObserver(tag)
    if stopped:
        raise stopped[0]
    if algorithm.GetFailureMessage():
        raise Error(algorithm.GetFailureMessage())
    return algorithm.GetOutput()
