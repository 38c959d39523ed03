# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Bodies of tetrahedra for the tests of filters, package and program."""

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkUnstructuredGrid

import palpate
from support.surfaces import points_of

# A cube's six tetrahedra round the diagonal from corner 0 to corner 7 (corners count x, then y, then z).
KUHN = ((0, 1, 3, 7), (0, 3, 2, 7), (0, 2, 6, 7), (0, 6, 4, 7), (0, 4, 5, 7), (0, 5, 1, 7))


def bar(divisions=(4, 4, 8), size=(1.0, 1.0, 2.0)):
    """A box of tetrahedra."""
    counts = [n + 1 for n in divisions]
    grid = vtkUnstructuredGrid()
    points = vtkPoints()
    points.SetDataTypeToDouble()
    for k in range(counts[2]):
        for j in range(counts[1]):
            for i in range(counts[0]):
                points.InsertNextPoint(*(s * n / d for s, n, d in zip(size, (i, j, k), divisions)))
    grid.SetPoints(points)
    for k in range(divisions[2]):
        for j in range(divisions[1]):
            for i in range(divisions[0]):
                corners = [(i + (c & 1)) + counts[0] * ((j + (c >> 1 & 1)) + counts[1] * (k + (c >> 2)))
                           for c in range(8)]
                for tetrahedron in KUHN:
                    grid.InsertNextCell(VTK_TETRA, 4, [corners[c] for c in tetrahedron])
    return grid


def set_cells(grid, **arrays):
    for name, values in arrays.items():
        array = numpy_to_vtk(np.array(values, dtype=float), deep=True)
        array.SetName(name)
        grid.GetCellData().AddArray(array)
    return grid


def boundary_of(grid):
    filter = palpate.vtkSolidBoundary()
    filter.SetInputData(grid)
    filter.Update()
    return filter.GetOutput()


def base_of(grid):
    """Where its boundary's vertices are at the bottom."""
    return points_of(boundary_of(grid))[:, 2] < 1e-9
