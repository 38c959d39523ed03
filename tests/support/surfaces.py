# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces and models for the tests of filters, package and program."""

import functools
import os
import subprocess

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

import palpate
from palpate.errors import silenced

PROGRAM = os.environ.get("PALPATE_PROGRAM", "palpate")


def run(*arguments):
    """What the program did with some arguments."""
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=300)


def polydata(points, triangles):
    """A surface of n by 3 points and m by k polygons."""
    surface = vtkPolyData()
    coordinates = vtkPoints()
    coordinates.SetData(numpy_to_vtk(np.array(points, dtype=float).reshape(-1, 3), deep=True))
    polygons = np.asarray(triangles, dtype=np.int64)
    cells = vtkCellArray()
    offsets = np.arange(0, polygons.size + 1, polygons.shape[1], dtype=np.int64)
    cells.SetData(numpy_to_vtkIdTypeArray(offsets, deep=True),
                  numpy_to_vtkIdTypeArray(polygons.ravel(), deep=True))
    surface.SetPoints(coordinates)
    surface.SetPolys(cells)
    return surface


def points_of(surface):
    """n by 3, a view."""
    return vtk_to_numpy(surface.GetPoints().GetData())


def triangles_of(surface):
    """m by 3, a view."""
    return vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def volume(surface):
    a, b, c = (points_of(surface)[triangles_of(surface)[:, k]] for k in range(3))
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6


def icosahedron():
    g = (1 + 5**0.5) / 2
    points = np.array([(-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g),
                       (0, -1, -g), (0, 1, -g), (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1)])
    triangles = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4),
                 (11, 10, 2), (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8),
                 (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)]
    return points / np.linalg.norm(points[0]), np.array(triangles)


def sphere(levels=2, radius=1.0, centre=(0, 0, 0)):
    """An icosahedron whose edges are halved: 12, 42, 162, 642 vertices."""
    points, triangles = icosahedron()
    for _ in range(levels):
        points, midpoint, finer = list(points), {}, []

        def middle(a, b):
            key = (min(a, b), max(a, b))
            if key not in midpoint:
                point = points[a] + points[b]
                midpoint[key] = len(points)
                points.append(point / np.linalg.norm(point))
            return midpoint[key]

        for a, b, c in triangles:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            finer += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        points, triangles = np.array(points), np.array(finer)
    return polydata(points * radius + np.asarray(centre), triangles)


def cube(divisions=4, size=1.0):
    """[0, size]^3, each side a grid of squares cut in two."""
    n = divisions
    numbers, points, triangles = {}, [], []

    def number(key):
        if key not in numbers:
            numbers[key] = len(points)
            points.append(np.array(key) * size / n)
        return numbers[key]

    for axis in range(3):
        for side in (0, n):
            for i in range(n):
                for j in range(n):
                    corners = []
                    for a, b in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)):
                        key = [0, 0, 0]
                        key[axis], key[(axis + 1) % 3], key[(axis + 2) % 3] = side, a, b
                        corners.append(number(tuple(key)))
                    if side == 0:
                        corners.reverse()
                    triangles += [corners[:3], [corners[0], corners[2], corners[3]]]
    return polydata(points, triangles)


def quad_cube():
    """The unit cube as six quadrilaterals: eight points, six cells of four corners."""
    corners = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return polydata(corners, quads)


def lower_cap(surface, below=-0.7):
    """True where z is below a height."""
    return points_of(surface)[:, 2] < below


@functools.lru_cache(maxsize=None)
def sphere_model(levels=2):
    """A unit sphere held at its lower cap, E = 1e4 Pa, nu = 0.3. Shared: do not change it."""
    surface = sphere(levels)
    return palpate.precompute(surface, 1e4, 0.3, fixed=lower_cap(surface))


def copy_of(data):
    copied = data.NewInstance()
    copied.DeepCopy(data)
    return copied


def failure_of(algorithm):
    """Updates a filter quietly and returns the sentence of its failure, or an empty string."""
    with silenced(algorithm):
        algorithm.Update()
    return algorithm.GetFailureMessage() or ""


class Executions:
    """Counts how often an algorithm executes."""

    def __init__(self, algorithm):
        self.count = 0
        algorithm.AddObserver("StartEvent", self._note)

    def _note(self, *_):
        self.count += 1
