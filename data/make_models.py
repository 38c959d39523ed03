#!/usr/bin/env python3
# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Make the control meshes of Palpate's four models and write them next to this script.

They are after the objects of fig. 10 and tables 1 and 2 of James and Pai 2001, "A unified treatment of
elastostatic contact simulation for real time haptics", and meet the vertex, face and free vertex counts
printed there. The shapes are Palpate's own. README.md describes the files.

A model is built from bands: two chains of vertices that run side by side, with triangles zipped in between.
Coordinates below are in centimetres, those of the files in metres.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import VTK_INT, VTK_UNSIGNED_CHAR, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

from model_checks import Expectation, check, volume


@dataclass
class ControlMesh:
    """A closed surface with what an elastic body needs to be solved for.

    points : n by 3, metres.   faces : m by 3 vertex numbers, counterclockwise seen from outside.
    fixed : n booleans, displacement given.   youngs_modulus : Pa.   poisson_ratio : below 1/2.
    """

    points: np.ndarray
    faces: np.ndarray
    fixed: np.ndarray
    youngs_modulus: float
    poisson_ratio: float

    @classmethod
    def from_design(cls, centimetres, triangles, fixed_vertices, youngs_modulus, poisson_ratio):
        """A mesh from points in centimetres and triangles wound either way."""
        points = np.round(np.array(centimetres) / 100, 5)
        fixed = np.isin(np.arange(len(points)), fixed_vertices)
        return cls(points, wound_outward(points, triangles), fixed, youngs_modulus, poisson_ratio)


def band(a, b):
    """Triangles between the chains of vertex numbers a and b, which both step at an even pace.

    Where the pace ties, a steps first: equally long chains get the diagonals a[1] b[0], a[2] b[1], ...
    A chain of one vertex makes a fan.
    """
    triangles, i, j = [], 0, 0
    while (i, j) != (len(a) - 1, len(b) - 1):
        if (2 * i + 1) * (len(b) - 1) <= (2 * j + 1) * (len(a) - 1):
            triangles.append((a[i], a[i + 1], b[j]))
            i += 1
        else:
            triangles.append((a[i], b[j + 1], b[j]))
            j += 1
    return triangles


def wound_outward(points, triangles):
    """The same triangles, all wound counterclockwise seen from outside."""

    def sides(face):
        return {(face[0], face[1]), (face[1], face[2]), (face[2], face[0])}

    waiting = list(triangles)
    wound = [waiting.pop(0)]
    taken = sides(wound[0])
    while waiting:
        face = next(f for f in waiting if taken & (sides(f) | sides(f[::-1])))
        waiting.remove(face)
        wound.append(face[::-1] if taken & sides(face) else face)
        taken |= sides(wound[-1])
    faces = np.array(wound)
    return faces if volume(points, faces) > 0 else faces[:, ::-1]


def tube(rings):
    """Points, triangles and the rings' vertex numbers of a tube of rings; one of a single point closes an end."""
    points = [point for ring in rings for point in ring]
    ends = np.cumsum([len(ring) for ring in rings])
    numbers = [list(range(end - len(ring), end)) for ring, end in zip(rings, ends)]
    closed = [ring + ring[:1] if len(ring) > 1 else ring for ring in numbers]
    triangles = [triangle for a, b in zip(closed, closed[1:]) for triangle in band(a, b)]
    return points, triangles, numbers


def nodule():
    """A rounded knob on a flattish base. The base is fixed; the last vertex is the top centre."""

    def circle(count, turn, radius, z):
        angles = 2 * np.pi * (np.arange(count) + turn) / count
        return [(radius * np.cos(angle), radius * np.sin(angle), z) for angle in angles]

    base = [[(0, 0, 0)], circle(4, 0, 1.45, 0), circle(8, 0, 2.8, 0.1)]
    bulb = [circle(8, 0.5, 3.4, 1.65), circle(8, 1, 2.9, 3.5), circle(4, 0.5, 1.65, 4.85), [(0, 0, 5.15)]]
    points, triangles, rings = tube(base + bulb)
    return ControlMesh.from_design(points, triangles, sum(rings[:3], []), 20e3, 0.45)


def kidney():
    """A bean, hilum towards -y. The back (-z) is fixed, from pole to pole."""
    points, triangles, rings = tube([
        [(-5.8, -1.4, -0.3)],
        # back: convex side, hilum side; front: hilum side, convex side
        [(-5.6, 1.2, -1.4), (-4.0, -3.1, -1.6), (-3.6, -3.2, 1.6), (-5.4, 1.2, 1.8)],
        [(-3.6, 3.2, -2.1), (-2.1, -2.5, -2.3), (-1.7, -2.3, 2.2), (-3.0, 3.3, 2.2)],
        [(-0.4, 3.9, -2.4), (0.1, -1.3, -1.9), (-0.1, -1.2, 1.9), (0.3, 4.0, 2.4)],
        [(2.9, 3.6, -2.3), (1.7, -2.1, -2.3), (2.1, -2.4, 2.3), (3.5, 3.4, 2.3)],
        [(5.7, 1.5, -1.6), (3.9, -3.1, -1.9), (4.2, -3.2, 1.7), (6.0, 1.3, 1.7)],
        [(6.1, -1.4, -0.2)]])
    back = [vertex for ring in rings for vertex in ring[:2]]
    return ControlMesh.from_design(points, triangles, back, 8e3, 0.45)


def spatula():
    """A blade with three slots, and a handle towards -x whose end is fixed.

    The blade is a top (+) and a bottom (-) sheet. They share the rim; at the corners of the slots they are
    joined by columns of two vertices. Slots are numbered from the left (+y), and each has a corner at the
    back (b), and two in front, left (l) and right (r).
    """
    half_thickness = 1.2
    columns = {
        "b0": (2.2, 3.15), "l0": (9.6, 5.1), "r0": (9.6, 3.2),
        "b1": (1.8, 0.0), "l1": (9.8, 1.0), "r1": (9.8, -1.0),
        "b2": (2.2, -3.15), "l2": (9.6, -3.2), "r2": (9.6, -5.1)}
    points = {
        "rim back left": (1.2, 6.6, 0), "rim back right": (1.2, -6.6, 0),
        "rim left": (12.7, 7.9, 0), "rim front": (13.2, 0, 0), "rim right": (12.7, -7.9, 0),
        "neck left": (-2, 1.8, 1.5), "neck right": (-2, -1.8, 1.5), "neck under": (-2, 0, -1),
        "grip left": (-9.4, 2.1, 2.3), "grip right": (-9.4, -2.1, 2.3),
        "grip top": (-9.4, 0, 3.9), "grip under": (-9.4, 0, 0.7),
        "end 0": (-16.2, 1.7, 4.8), "end 1": (-16.2, -1.7, 4.8),
        "end 2": (-16.2, -1.7, 2.4), "end 3": (-16.2, 1.7, 2.4), "tip": (-19, 0, 3.9)}
    for name, (x, y) in columns.items():
        points |= {name + "+": (x, y, half_thickness), name + "-": (x, y, -half_thickness)}
    number = {name: n for n, name in enumerate(points)}
    triangles = []

    def join(a, b, sheet=""):
        chains = [[number[name.strip().replace("*", sheet)] for name in chain.split(",")] for chain in (a, b)]
        triangles.extend(band(*chains))

    for sheet in "+-":
        join("b0*, l0*", "rim back left, rim left", sheet)
        join("b1*, l1*", "b0*, r0*", sheet)
        join("b1*, r1*", "b2*, l2*", sheet)
        join("b2*, r2*", "rim back right, rim right", sheet)
        join("l0*, r0*, l1*, r1*, l2*, r2*", "rim left, rim front, rim right", sheet)
    # The walls of the left and the right slot run in opposite senses, for mirrored diagonals.
    join("b0+, r0+, l0+, b0+", "b0-, r0-, l0-, b0-")
    join("b1+, r1+, l1+, b1+", "b1-, r1-, l1-, b1-")
    join("b2+, l2+, r2+, b2+", "b2-, l2-, r2-, b2-")
    back = "rim back left, b0*, b1*, b2*, rim back right"
    join(back.replace("*", "+"), "neck left, neck right")
    join(back.replace("*", "-"), "neck left, neck under, neck right")
    grip = "grip left, grip top, grip right, grip under, grip left"
    join("neck left, neck right, neck under, neck left", grip)
    join(grip, "end 0, end 1, end 2, end 3, end 0")
    join("end 0, end 1, end 2, end 3, end 0", "tip")

    held = [number[name] for name in ("tip", "end 0", "end 1", "end 2", "end 3", "grip left", "grip right")]
    return ControlMesh.from_design(list(points.values()), triangles, held, 1.5e9, 0.4)


def banana_seat():
    """A padded saddle, nose towards +x, both ends rising. All but the top of the padding is fixed."""
    points, rim_and_below = [], []

    def beside(x, half_width, height, fixed):
        """Left and right vertex (one and the same in the middle) at a height over the curve of the rim."""
        bend = 0.018 if x < 0 else 0.013
        normal = np.array((-2 * bend * x, 1)) / np.hypot(2 * bend * x, 1)
        first = len(points)
        for y in (half_width, -half_width) if half_width else (0,):
            points.append((x + height * normal[0], y, bend * x**2 + height * normal[1]))
        rim_and_below.extend(range(first, len(points)) if fixed else ())
        return first, len(points) - 1

    stations = [  # x and half width of the rim, half widths of the top and of the underside
        (-18.8, 7.2, 3.8, 3.3), (-12.2, 9.0, 4.8, 3.9), (-5.2, 8.4, 4.5, 3.7),
        (2.2, 6.2, 3.2, 2.8), (9.6, 4.8, 2.6, 2.4), (16.8, 5.0, 0, 0)]
    sections = [[beside(-22.8, 0, 1.0, True)]]
    for x, rim, top, under in stations:
        # The top lags behind the rim and the underside leads it, so that the triangles come out near isosceles.
        sections.append([
            beside(x - 1.5, top, 4.3, False), beside(x, rim, 0, True), beside(x + 1.5, under, -1.3, True)])
    sections.append([beside(21.5, 0, 0.3, True)])

    triangles = []
    for a, b in zip(sections, sections[1:]):
        for side in (0, 1):
            triangles += band([pair[side] for pair in a], [pair[side] for pair in b])
        for level in (0, -1):
            triangles += band(sorted(set(a[level])), sorted(set(b[level])))
    return ControlMesh.from_design(points, triangles, rim_and_below, 45e3, 0.49)


def write(mesh, path):
    """Write an XML file that VTK and ParaView read; the same mesh always gives the same bytes."""

    def array(name, values, vtk_type=None):
        result = numpy_to_vtk(np.ascontiguousarray(values), deep=True, array_type=vtk_type)
        result.SetName(name)
        return result

    points, polygons, surface = vtkPoints(), vtkCellArray(), vtkPolyData()
    points.SetData(array("Points", mesh.points))
    for face in mesh.faces.tolist():
        polygons.InsertNextCell(3, face)
    surface.SetPoints(points)
    surface.SetPolys(polygons)
    surface.GetPointData().AddArray(array("BoundaryType", mesh.fixed.astype(np.uint8), VTK_UNSIGNED_CHAR))
    surface.GetCellData().AddArray(array("SmoothPatch", np.zeros(len(mesh.faces), np.int32), VTK_INT))
    surface.GetFieldData().AddArray(array("YoungsModulus", np.array([mesh.youngs_modulus])))
    surface.GetFieldData().AddArray(array("PoissonRatio", np.array([mesh.poisson_ratio])))

    writer = vtkXMLPolyDataWriter()
    writer.SetInputData(surface)
    writer.SetFileName(str(path))
    writer.SetDataModeToAscii()
    writer.SetCompressorTypeToNone()
    if not writer.Write():
        raise OSError(f"cannot write {path}")


# Vertices by level, the level and number of the paper's free vertices, and the smallest angle (degrees) to
# accept at level 3. Level 1 is the control mesh.
MODELS = {
    nodule: Expectation(0, (34, 130, 514), 2, 89, 20),
    kidney: Expectation(0, (22, 82, 322), 3, 217, 20),
    spatula: Expectation(3, (35, 152, 620), 3, 559, 12),
    banana_seat: Expectation(0, (36, 138, 546), 3, 245, 20),
}


def main():
    for model, expectation in MODELS.items():
        mesh = model()
        check(model.__name__, mesh, expectation)
        write(mesh, Path(__file__).resolve().parent / f"{model.__name__}.vtp")


if __name__ == "__main__":
    main()
