#!/usr/bin/env python3
# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Make methods.png, a body of each method under a contact, and methods_agree.png, stiffness by two methods.

Needs the package under PYTHONPATH=build/python; draws with the program, so no display.
"""

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkCellArray, vtkPolyData, vtkUnstructuredGrid
from vtkmodules.vtkFiltersCore import vtkImageAppend
from vtkmodules.vtkImagingCore import vtkExtractVOI, vtkImageResize
from vtkmodules.vtkIOImage import vtkPNGReader, vtkPNGWriter

import palpate

HERE = Path(__file__).resolve().parent
BUILT = HERE.parent / "build" / "bin" / "palpate"
# A cube's six tetrahedra round the diagonal from corner 0 to corner 7 (corners count x, then y, then z).
KUHN = ((0, 1, 3, 7), (0, 3, 2, 7), (0, 2, 6, 7), (0, 6, 4, 7), (0, 4, 5, 7), (0, 5, 1, 7))


def surface_of(points, triangles):
    surface, coordinates, cells = vtkPolyData(), vtkPoints(), vtkCellArray()
    coordinates.SetDataTypeToDouble()
    for point in points:
        coordinates.InsertNextPoint(point)
    for triangle in triangles:
        cells.InsertNextCell(3, [int(i) for i in triangle])
    surface.SetPoints(coordinates)
    surface.SetPolys(cells)
    return surface


def sheet(n, shape):
    """A square of n by n squares, cut along alternating diagonals, in space."""
    points = [shape(i / n, j / n) for j in range(n + 1) for i in range(n + 1)]
    triangles = []
    for j in range(n):
        for i in range(n):
            a = i + (n + 1) * j
            b, c, d = a + 1, a + n + 1, a + n + 2
            triangles += [(a, b, d), (a, d, c)] if (i + j) % 2 else [(a, b, c), (b, d, c)]
    return surface_of(points, triangles)


def layered_block(n=8, layers=6):
    """A soft block with a hard plate inside: tetrahedra with a Young's modulus each."""
    grid, points = vtkUnstructuredGrid(), vtkPoints()
    points.SetDataTypeToDouble()
    for k in range(layers + 1):
        for j in range(n + 1):
            for i in range(n + 1):
                points.InsertNextPoint(0.1 * i / n, 0.1 * j / n, 0.06 * k / layers)
    grid.SetPoints(points)
    young = []
    for k in range(layers):
        for j in range(n):
            for i in range(n):
                corner = [(i + (c & 1)) + (n + 1) * ((j + (c >> 1 & 1)) + (n + 1) * (k + (c >> 2)))
                          for c in range(8)]
                for tetrahedron in KUHN:
                    grid.InsertNextCell(VTK_TETRA, 4, [corner[c] for c in tetrahedron])
                    young.append(1e6 if k == layers - 2 and i < n / 2 else 1e4)
    for name, values in (("YoungsModulus", young), ("PoissonRatio", np.full(len(young), 0.4))):
        grid.GetCellData().AddArray(palpate.arrays.as_vtk(values, name, 1))
    return grid


def points_of(surface):
    return np.array([surface.GetPoint(i) for i in range(surface.GetNumberOfPoints())])


def kidney(**options):
    surface = palpate.refine(palpate.read(palpate.example("kidney")), levels=2)
    return palpate.precompute(surface, 8e3, 0.45, **options)


def solid():
    grid = layered_block()
    boundary = palpate.vtkSolidBoundary()
    boundary.SetInputData(grid)
    boundary.Update()
    held = points_of(boundary.GetOutput())[:, 2] < 1e-9
    return palpate.precompute(grid, 1e4, 0.4, fixed=held, method="fem", estimate_error=False)


def shell():
    bonnet = sheet(20, lambda a, b: (0.2 * a, 0.2 * b, 0.05 * np.sin(np.pi * a)))
    return palpate.precompute(bonnet, 70e9, 0.33, fixed=points_of(bonnet)[:, 0] < 1e-9, method="shell",
                              thickness=0.0008)


def half_space():
    flat = sheet(24, lambda a, b: (0.1 * a - 0.05, 0.1 * b - 0.05, 0))
    return palpate.precompute(flat, 1e4, 0.4, method="halfspace")


def imported(model):
    """The top of a solid, from its compliance alone."""
    points = points_of(model)
    top = np.flatnonzero(points[:, 2] > 0.06 - 1e-9)
    columns = {int(node): c for c, node in enumerate(palpate.greens_function_nodes(model))}
    areas, xi = palpate.array(model, "VertexArea"), palpate.greens_functions(model)
    rows = (3 * top[:, None] + np.arange(3)).ravel()
    picked = np.array([3 * columns[int(v)] + c for v in top for c in range(3)])
    compliance = xi[np.ix_(rows, picked)] / np.repeat(areas[top], 3)
    number = {int(v): i for i, v in enumerate(top)}
    triangles = []
    for cell in range(model.GetNumberOfCells()):
        ids = [model.GetCell(cell).GetPointId(k) for k in range(3)]
        if all(i in number for i in ids):
            triangles.append([number[i] for i in ids])
    return palpate.import_compliance(surface_of(points[top], triangles), compliance)


def picture(path):
    reader = vtkPNGReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def right_half(image, width):
    """The view of the deformed surface, made so wide."""
    left, right, bottom, top = image.GetExtent()[:4]
    cut = vtkExtractVOI()
    cut.SetInputData(image)
    cut.SetVOI((left + right) // 2, right, bottom, top, 0, 0)
    cut.Update()
    size = cut.GetOutput().GetDimensions()
    return resized(cut.GetOutput(), width, round(width * size[1] / size[0]))


def resized(image, width, height):
    resize = vtkImageResize()
    resize.SetInputData(image)
    resize.SetOutputDimensions(width, height, 1)
    resize.Update()
    return resize.GetOutput()


def write_side_by_side(images, path):
    append = vtkImageAppend()
    for image in images:
        append.AddInputData(image)
    writer = vtkPNGWriter()
    writer.SetInputConnection(append.GetOutputPort())
    writer.SetFileName(str(path))
    writer.Write()


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--program", default=BUILT)
    arguments.add_argument("--folder", type=Path, default=HERE)
    options = arguments.parse_args()

    def run(*command):
        subprocess.run([options.program, *map(str, command)], check=True, stdout=subprocess.DEVNULL)

    with tempfile.TemporaryDirectory() as name:
        aside = Path(name)
        body = solid()
        presses = {
            "bem": (kidney(), (0, 0, 0.03), (0, 0, -1.2), 0.015, (0.4, -0.9, 0.5)),
            "fem": (body, (0.07, 0.05, 0.06), (0, 0, -4), 0.02, (0.5, -1, 0.8)),
            "shell": (shell(), (0.19, 0.1, 0), (0, 0, -10), 0.03, (0.5, -1, 0.6)),
            "halfspace": (half_space(), (0, 0, 0), (0, 0, -4), 0.02, (0.5, -1, 0.8)),
            "imported": (imported(body), (0.07, 0.05, 0.06), (0, 0, -4), 0.02, (0.5, -1, 0.8))}
        views = []
        for method, (model, at, force, radius, view) in presses.items():
            file, image = aside / f"{method}.vtp", aside / f"{method}.png"
            palpate.write(model, str(file))
            run("press", file, "--at", *at, "--force", *force, "--radius", radius, "--image", image, "--view",
                *view)
            views.append(right_half(picture(image), 300))
        write_side_by_side(views, options.folder / "methods.png")

        views = []
        for method in ("bem", "fem"):
            file, image = aside / f"kidney_{method}.vtp", aside / f"kidney_{method}.png"
            palpate.write(kidney(method=method), str(file))
            run("stiffness", file, "--radius", 0.016, "--image", image, "--range", 150, 450, "--view", 0.4, -0.9,
                0.5)
            views.append(resized(picture(image), 600, 450))
        write_side_by_side(views, options.folder / "methods_agree.png")


if __name__ == "__main__":
    sys.exit(main())
