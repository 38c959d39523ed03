#!/usr/bin/env python3
# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Make methods.png, a body of each method under a contact, methods_agree.png, stiffness by two methods, and
identification_accuracy.png, what a better identification of a block with a hidden soft ball costs (minutes).

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
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

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


def block(n, layers, young):
    """Tetrahedra, of a Young's modulus that depends on their middles, on n by n squares and in layers."""
    grid, points = vtkUnstructuredGrid(), vtkPoints()
    points.SetDataTypeToDouble()
    for k in range(layers + 1):
        for j in range(n + 1):
            for i in range(n + 1):
                points.InsertNextPoint(0.1 * i / n, 0.1 * j / n, 0.06 * k / layers)
    grid.SetPoints(points)
    moduli = []
    for k in range(layers):
        for j in range(n):
            for i in range(n):
                corner = [(i + (c & 1)) + (n + 1) * ((j + (c >> 1 & 1)) + (n + 1) * (k + (c >> 2)))
                          for c in range(8)]
                for tetrahedron in KUHN:
                    ids = [corner[c] for c in tetrahedron]
                    grid.InsertNextCell(VTK_TETRA, 4, ids)
                    moduli.append(young(np.mean([grid.GetPoint(i) for i in ids], axis=0)))
    for name, values in (("YoungsModulus", moduli), ("PoissonRatio", np.full(len(moduli), 0.4))):
        grid.GetCellData().AddArray(palpate.arrays.as_vtk(values, name, 1))
    return grid


def layered_block(n=8, layers=6):
    """A soft block with a hard plate inside."""
    return block(n, layers,
                 lambda at: 1e6 if int(layers * at[2] / 0.06) == layers - 2 and at[0] < 0.05 else 1e4)


def lumpy_block(n, layers, lump):
    """A soft block with a ball of another Young's modulus inside."""
    return block(n, layers,
                 lambda at: lump if np.linalg.norm(at - (0.06, 0.05, 0.036)) < 0.022 else 1e4)


def points_of(surface):
    return np.array([surface.GetPoint(i) for i in range(surface.GetNumberOfPoints())])


def kidney(**options):
    surface = palpate.refine(palpate.read(palpate.example("kidney")), levels=2)
    return palpate.precompute(surface, 8e3, 0.45, **options)


def held_below(grid):
    """A model of a solid that stands on a firm support."""
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


def write_volume(grid, path):
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetInputData(grid)
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
        body = held_below(layered_block())
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

        truth, guess = aside / "truth.vtp", aside / "block.vtu"
        palpate.write(held_below(lumpy_block(10, 6, lump=1e3)), str(truth))
        write_volume(lumpy_block(6, 4, lump=1e4), guess)
        run("accuracy", guess, "--query", "identification", "--method", "fem", "--rig", truth, "--radius", 0.03,
            "--probes", 20, "--fix-half-space", 0, 0, 1e-4, 0, 0, 1, "--threads", 1, "--clock", "cpu", "--repeats", 2,
            "--image", options.folder / "identification_accuracy.png")


if __name__ == "__main__":
    sys.exit(main())
