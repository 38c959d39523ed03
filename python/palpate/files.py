# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces and models from and to files."""

import os
from pathlib import Path

from .arguments import shown, surface_of
from .errors import Error, deferred_interrupts, silenced
from .PalpateIO import vtkElasticSurfaceReader, vtkElasticSurfaceWriter


def path_of(value):
    """A path as the filters take it."""
    try:
        path = os.fsencode(value)
    except TypeError:
        raise Error(f"a path must be a string or path-like, not {type(value).__name__}") from None
    if b"\0" in path:
        raise Error(f"a path cannot hold a null character: {shown(os.fsdecode(path))}")
    return path


def read(path):
    """Read a surface, with its Green's functions if it has them.

    Parameters
    ----------
    path : str or path-like
        A .vtp, .stl, .obj, .ply or .off file.

    Returns
    -------
    vtkPolyData

    Raises
    ------
    Error
        If the file is missing, damaged or of another kind.

    Examples
    --------
    >>> import palpate
    >>> palpate.read(palpate.example("nodule")).GetNumberOfPoints()
    34
    """
    reader = vtkElasticSurfaceReader()
    reader.SetFileName(path_of(path))
    with deferred_interrupts(), silenced(reader):
        reader.Update()
    if reader.GetFailureMessage():
        raise Error(reader.GetFailureMessage())
    return reader.GetOutput()


def write(model, path):
    """Write a surface with all its arrays, whole or not at all.

    Parameters
    ----------
    model : vtkPolyData
    path : str or path-like
        Ends in .vtp. What is read back is the same bit by bit.

    Raises
    ------
    Error
        If the file cannot be written. An older file then stays as it was.

    Examples
    --------
    >>> import palpate, tempfile, os
    >>> kidney = palpate.read(palpate.example("kidney"))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     palpate.write(kidney, os.path.join(folder, "kidney.vtp"))
    ...     palpate.read(os.path.join(folder, "kidney.vtp")).GetNumberOfPoints()
    22
    """
    writer = vtkElasticSurfaceWriter()
    with deferred_interrupts(), silenced(writer):
        if not writer.Write(surface_of(model), path_of(path)):
            raise Error(writer.GetFailureMessage())


def example(name):
    """Path of one of the models that come with Palpate.

    Parameters
    ----------
    name : {"nodule", "kidney", "spatula", "banana_seat"}

    Returns
    -------
    str

    Raises
    ------
    Error
        If there is no such model.

    Examples
    --------
    >>> import palpate
    >>> palpate.example("spatula").endswith("spatula.vtp")
    True
    """
    path = Path(__file__).parent / "data" / f"{name}.vtp"
    if not path.is_file():
        known = ", ".join(sorted(p.stem for p in path.parent.glob("*.vtp")))
        raise Error(f"there is no example '{name}': choose one of {known}")
    return str(path)
