# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces and models from and to files."""

import contextlib
import io
import os
from pathlib import Path

import numpy as np
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkCellArray, vtkUnstructuredGrid

from .arguments import shown, surface_of
from .arrays import as_ids, as_vtk
from .errors import Error, deferred_interrupts, silenced
from .PalpateIO import vtkElasticSurfaceReader, vtkElasticSurfaceWriter, vtkElasticVolumeReader


def is_path(value):
    return isinstance(value, (str, bytes, os.PathLike))


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
    return read_with(vtkElasticSurfaceReader(), path)


def read_volume(path):
    """Read a volume mesh.

    Parameters
    ----------
    path : str or path-like
        A .vtu or legacy .vtk file; with meshio installed also what that reads, Gmsh's .msh above all.

    Returns
    -------
    vtkUnstructuredGrid
        With its point and cell arrays.

    Raises
    ------
    Error
        If the file is missing, damaged or of another kind.

    Examples
    --------
    >>> import palpate
    >>> palpate.read_volume("bar.msh")
    Traceback (most recent call last):
    ...
    palpate.errors.Error: bar.msh: there is no such file
    """
    if os.fsdecode(path_of(path)).lower().endswith((".vtu", ".vtk")):
        return read_with(vtkElasticVolumeReader(), path)
    return read_with_meshio(os.fsdecode(path))


def read_with(reader, path):
    reader.SetFileName(path_of(path))
    with deferred_interrupts(), silenced(reader):
        reader.Update()
    if reader.GetFailureMessage():
        raise Error(reader.GetFailureMessage())
    return reader.GetOutput()


def read_with_meshio(path):
    """A grid of the tetrahedra of a file, with their arrays."""
    if not os.path.exists(path):
        raise Error(f"{path}: there is no such file")
    try:
        import meshio
    except ImportError:
        raise Error(f"{path}: files of this kind are read by meshio, which is not installed") from None
    try:
        with deferred_interrupts(), contextlib.redirect_stdout(io.StringIO()):
            mesh = meshio.read(path)
    except (Exception, SystemExit) as failure:  # whatever a damaged file brings its reader to
        said = " ".join(str(failure).split()) or type(failure).__name__
        raise Error(f"{path}: meshio cannot read the file: {said}") from None
    blocks = [k for k, block in enumerate(mesh.cells) if block.type in ("tetra", "tetra10")]
    corners = [np.asarray(mesh.cells[k].data)[:, :4] for k in blocks]
    if not any(map(len, corners)):
        raise Error(f"{path}: the file holds no tetrahedra")
    corners = np.concatenate(corners)
    if np.shape(mesh.points)[1] != 3 or corners.min() < 0 or corners.max() >= len(mesh.points):
        raise Error(f"{path}: a tetrahedron refers to a point in space that is not there")
    return grid_of(mesh, blocks, corners)


def grid_of(mesh, blocks, corners):
    """meshio's blocks of tetrahedra, by their corners, with all arrays of numbers."""
    grid = vtkUnstructuredGrid()
    points = vtkPoints()
    points.SetData(as_vtk(mesh.points, "Points", 3))
    grid.SetPoints(points)
    cells = vtkCellArray()
    cells.SetData(4, as_ids(corners, "Corners"))
    grid.SetCells(VTK_TETRA, cells)
    of_cells = {name: np.concatenate([values[k] for k in blocks]) for name, values in mesh.cell_data.items()}
    for arrays, data in ((mesh.point_data, grid.GetPointData()), (of_cells, grid.GetCellData())):
        for name, values in arrays.items():
            if np.asarray(values).dtype.kind in "biuf":
                data.AddArray(as_vtk(values, name, np.asarray(values)[0].size))
    return grid


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
