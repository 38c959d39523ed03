# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`palpate accuracy` of the methods beside boundary elements."""

import csv
import functools
import math
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

import palpate
from palpate.arrays import as_vtk
from support.solids import bar, boundary_of, set_cells
from support.surfaces import PROGRAM, cube, points_of, polydata, sphere

FOLDER = tempfile.TemporaryDirectory()
MATERIAL = ("--young", 2, "--poisson", 0.3)
CLAMPED = (*MATERIAL, "--fix-box", -0.51, -0.49, -1, 1, -1, 1)


def square(divisions):
    """A flat one of side 1 about the origin, its diagonals alternating."""
    places = np.linspace(-0.5, 0.5, divisions + 1)
    x, y = (grid.ravel() for grid in np.meshgrid(places, places))
    triangles = []
    for j in range(divisions):
        for i in range(divisions):
            a = j * (divisions + 1) + i
            b, c, d = a + 1, a + divisions + 2, a + divisions + 1
            triangles += [(a, b, c), (a, c, d)] if (i + j) % 2 == 0 else [(a, b, d), (b, c, d)]
    return np.column_stack([x, y, np.zeros_like(x)]), triangles


def tapered():
    """A square with a thickness that grows along x."""
    points, triangles = square(4)
    surface = polydata(points, triangles)
    surface.GetPointData().AddArray(as_vtk(0.02 + 0.01 * points[:, 0], "Thickness", 1, float))
    return surface


def vault():
    """A fifth of a cylinder of radius 1, held along its straight sides."""
    points, triangles = square(4)
    angle = 1.2 * points[:, 0]
    return polydata(np.column_stack([np.sin(angle), points[:, 1], np.cos(angle)]), triangles)


def layers(young=(1.0, 20.0)):
    """A file of a block of 1 by 1 by 2 of two materials, the upper half of the second."""
    grid = bar((2, 2, 4))
    heights = np.array([np.mean([grid.GetPoint(grid.GetCell(c).GetPointId(k))[2] for k in range(4)])
                        for c in range(grid.GetNumberOfCells())])
    set_cells(grid, YoungsModulus=np.where(heights > 1, young[1], young[0]),
              PoissonRatio=np.full(len(heights), 0.3))
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetFileName(os.path.join(FOLDER.name, f"layers{young[0]}_{young[1]}.vtu"))
    writer.SetInputData(grid)
    writer.Write()
    return writer.GetFileName(), grid


SURFACES = {"square": lambda: polydata(*square(4)), "patch": lambda: polydata(*square(8)), "tapered": tapered,
            "vault": vault, "sphere": lambda: sphere(1), "cube": lambda: cube(2)}


def accuracy(*arguments):
    return subprocess.run([PROGRAM, "accuracy", *map(str, arguments)], capture_output=True, text=True)


@functools.lru_cache
def surface(name):
    path = Path(FOLDER.name) / f"{name}.vtp"
    palpate.write(SURFACES[name](), str(path))
    return path


@functools.lru_cache
def rows(name, *arguments):
    """The table of a run on a surface, and what it printed."""
    path = Path(FOLDER.name) / f"table{abs(hash((name, arguments)))}.csv"
    done = accuracy(surface(name), *arguments, "--repeats", 2, "--csv", path)
    if done.returncode:
        raise AssertionError(done.stderr)
    with open(path, newline="", encoding="utf-8") as table:
        return list(csv.DictReader(table)), done.stdout


def of_knob(table, knob):
    return [row for row in table if row["knob"] == knob]


def errors(table, knob):
    return np.array([float(row["error"]) for row in of_knob(table, knob)])


def knobs(table):
    return list(dict.fromkeys(row["knob"] for row in table))


class SeveralMaterials(unittest.TestCase):
    ON_TOP = ("--method", "fem", "--fix-half-space", 0, 0, 0.001, 0, 0, 1, "--at", 0.5, 0.5, 2, "--radius", 0.6,
              "--repeats", 2)

    def studied(self, path, *arguments):
        table = Path(FOLDER.name) / "layers.csv"
        done = accuracy(path, *self.ON_TOP, *arguments, "--csv", table)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(table, newline="", encoding="utf-8") as lines:
            return list(csv.DictReader(lines)), done.stdout

    def test_are_studied_on_their_tetrahedra_level_by_level(self):
        path, _ = layers()
        table, printed = self.studied(path, "--levels", 1, 2, 3, "--knobs", "level", "element")
        self.assertIn("quadratic tetrahedra", printed)
        self.assertEqual([row["vertices"] for row in of_knob(table, "level")], ["42", "162", "642"])
        found = errors(table, "level")
        self.assertTrue((found[1:] < 0.7 * found[:-1]).all(), found)
        self.assertTrue((errors(table, "element") > found).all())

    def test_are_those_of_the_cells_on_every_level(self):
        # As the package has them on level 1; a column of springs in series on the finer, too.
        path, grid = layers()
        fixed = points_of(boundary_of(grid))[:, 2] < 0.001
        model = palpate.precompute(grid, fixed=fixed, method="fem", estimate_error=False)
        top = int(np.flatnonzero((np.abs(points_of(model) - (0.5, 0.5, 2)) < 1e-9).all(axis=1))[0])
        known = np.column_stack([
            palpate.array(palpate.press(model, (0.5, 0.5, 2), force=axis, radius=0.6), "Displacement")[top]
            for axis in np.eye(3)])
        reference = Path(FOLDER.name) / "known.csv"
        reference.write_text(",".join(map(repr, map(float, (0.5, 0.5, 2, *known.ravel())))) + "\n")
        options = ("--method", "fem", "--fix-half-space", 0, 0, 0.001, 0, 0, 1, "--radius", 0.6, "--repeats", 2,
                   "--reference", reference, "--knobs", "level", "--levels", 1, 2)
        table = Path(FOLDER.name) / "series.csv"
        for young, low, high in (((1.0, 20.0), 0, 0.2), ((20.0, 1.0), 0.3, 10)):
            done = accuracy(layers(young)[0], *options, "--csv", table)
            self.assertEqual(done.returncode, 0, done.stderr)
            with open(table, newline="", encoding="utf-8") as lines:
                found = [float(row["error"]) for row in csv.DictReader(lines)]
            self.assertTrue(all(low <= error < high for error in found), found)
            if low == 0:
                self.assertLess(found[0], 1e-9)

    def test_that_cannot_be_studied_are_refused(self):
        path, _ = layers()
        held = ("--fix-half-space", 0, 0, 0.001, 0, 0, 1)
        guided = cube(2)
        components = np.zeros((guided.GetNumberOfPoints(), 3))
        guided.GetPointData().AddArray(as_vtk(components, "HeldComponents", 3, np.uint8))
        surface = str(Path(FOLDER.name) / "guided.vtp")
        palpate.write(guided, surface)
        refused = accuracy(surface, "--method", "fem", *MATERIAL, *held)
        self.assertNotEqual(refused.returncode, 0)
        self.assertIn("'HeldComponents', which levels of solids do not keep", refused.stderr)
        for arguments, sentence in (((), "add --method fem"),
                                    (("--method", "fem", "--subdivision", "loop"), "off its tetrahedra")):
            refused = accuracy(path, *held, *arguments)
            self.assertNotEqual(refused.returncode, 0)
            self.assertIn(sentence, refused.stderr)


class Shell(unittest.TestCase):
    def test_is_studied_level_by_level(self):
        table, printed = rows("square", "--method", "shell", *CLAMPED, "--thickness", 0.02, "--radius", 0.25,
                              "--levels", 1, 2, 3)
        self.assertEqual(knobs(table), ["level", "storage", "columns", "rows", "mask"])
        self.assertIn("thin shell triangles", printed)
        self.assertRegex(table[0]["reference"], "Richardson .*levels 1, 2 and 3 .*289 vertices")
        self.assertEqual([row["vertices"] for row in of_knob(table, "level")], ["25", "81", "289"])
        found = errors(table, "level")
        self.assertTrue((found[1:] < 0.5 * found[:-1]).all(), found)
        self.assertLess(found[-1], 0.01)
        for row in table:
            self.assertEqual(row["failure"], "")
        double, single = (int(row["stored_bytes"]) for row in of_knob(table, "storage"))
        self.assertEqual(double, 2 * single)

    def test_goes_by_how_its_vertices_are_held_and_by_its_thickness_between_them(self):
        # The same plate by a number and by an array of it; hinged vertices let it yield more.
        def compliance(*arguments):
            table = Path(FOLDER.name) / "compliance.csv"
            done = accuracy(surface("tapered"), "--method", "shell", *CLAMPED, "--radius", 0.25,
                            "--levels", 1, 2, "--knobs", "level", *arguments, "--repeats", 2, "--csv", table)
            self.assertEqual(done.returncode, 0, done.stderr)
            with open(table, newline="", encoding="utf-8") as lines:
                return [float(row["error"]) for row in csv.DictReader(lines)]

        own = self.known_compliance(None)
        self.assertLess(compliance("--reference", own)[0], 1e-9)
        self.assertGreater(compliance("--reference", own, "--thickness", 0.02)[0], 0.05)
        thick = self.known_compliance(0.02)
        self.assertLess(compliance("--reference", thick, "--thickness", 0.02)[0], 1e-9)

    def known_compliance(self, thickness):
        """A file of what the package's shell yields at a vertex, on the surface as it is."""
        plate = tapered()
        points, _ = square(4)
        model = palpate.precompute(plate, 2, 0.3, fixed=points[:, 0] < -0.49, method="shell",
                                   thickness=thickness)
        node = int(np.flatnonzero((np.abs(points - (0.25, 0, 0)) < 1e-9).all(axis=1))[0])
        columns = []
        for axis in np.eye(3):
            pressed = palpate.press(model, points[node], force=axis, radius=0.25)
            columns.append(palpate.array(pressed, "Displacement")[node])
        path = Path(FOLDER.name) / f"known{thickness}.csv"
        path.write_text(",".join(map(repr, map(float, (*points[node], *np.column_stack(columns).ravel())))) + "\n")
        return path

    def test_of_a_curved_one_settles_by_its_curved_levels(self):
        table, _ = rows("vault", "--method", "shell", *MATERIAL, "--fix-box", -1, 1, -1, 1, 0, 0.83, "--hinged",
                        "--thickness", 0.02, "--query", "greens", "--radius", 0.3, "--levels", 1, 2, 3,
                        "--reference-level", 4, "--knobs", "level")
        found = errors(table, "level")
        self.assertTrue((found[1:] < 0.6 * found[:-1]).all(), found)

    def test_bears_a_ball(self):
        table, _ = rows("square", "--method", "shell", *CLAMPED, "--thickness", 0.02, "--query", "force",
                        "--ball-radius", 0.3, "--depth", 0.01, "--at", 0, 0, 0, "--levels", 1, 2, 3,
                        "--knobs", "level", "contact")
        found = errors(table, "level")
        self.assertLess(found[2], 0.7 * found[0])  # as the ball's contact spreads over a few vertices


class HalfSpace(unittest.TestCase):
    def test_of_raw_integrals_meets_the_closed_form_ever_better(self):
        table, printed = rows("patch", "--method", "halfspace", *MATERIAL, "--radius", 0.25, "--levels", 1, 2, 3,
                              "--knobs", "level", "reciprocity")
        raw = errors(table, "reciprocity")
        self.assertIn("closed form (Boussinesq, Cerruti)", table[0]["reference"])
        self.assertIn("a half-space's integrals", printed)
        self.assertTrue((raw[1:] < 0.5 * raw[:-1]).all(), raw)
        self.assertLess(raw[-1], 0.005)  # measured 0.32 %
        self.assertLess(errors(table, "level")[-1], 0.008)  # 0.45 %
        for row in table:
            self.assertEqual(float(row["reference_uncertainty"]), 0)

    def test_varies_what_it_has(self):
        table, _ = rows("patch", "--method", "halfspace", *MATERIAL, "--radius", 0.25, "--levels", 1, 2)
        self.assertEqual(knobs(table), ["level", "reciprocity", "rows", "mask"])
        masks = of_knob(table, "mask")  # the rim would cut off wider ones than a quarter of the side
        self.assertEqual([row["value"] for row in masks], ["0.5 edges (one vertex)", "1 edges", "1.5 edges"])
        self.assertGreater(errors(table, "mask")[0], 2 * errors(table, "mask")[1])

    def test_of_the_whole_patch_settles(self):
        table, _ = rows("square", "--method", "halfspace", *MATERIAL, "--query", "greens", "--radius", 0.25,
                        "--levels", 1, 2, 3, "--knobs", "level")
        self.assertIn("Richardson", table[0]["reference"])
        found = errors(table, "level")
        self.assertLess(found[2], 0.5 * found[0])


class FiniteElements(unittest.TestCase):
    def test_are_a_method_of_their_own(self):
        table, printed = rows("sphere", "--method", "fem", *MATERIAL, "--fix-half-space", 0, 0, -0.3, 0, 0, 1,
                              "--subdivision", "flat", "--at", 0, 0, 1, "--radius", 0.6, "--levels", 1, 2, 3)
        self.assertIn("quadratic tetrahedra", printed)
        self.assertEqual(knobs(table), ["level", "element", "reciprocity", "storage", "columns", "rows", "mask"])
        found = errors(table, "level")
        self.assertTrue((found[1:] < 0.8 * found[:-1]).all(), found)  # the clamp line costs an order
        linear = errors(table, "element")
        self.assertGreater(linear[0], found[0])


class Hostile(unittest.TestCase):
    def refused(self, sentence, name, *arguments):
        with tempfile.TemporaryDirectory() as folder:
            done = accuracy(surface(name), *arguments, "--levels", 1, 2, "--report", Path(folder) / "page.html")
            self.assertGreater(done.returncode, 0, arguments)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
            self.assertRegex(done.stderr, sentence)
            self.assertEqual(list(Path(folder).iterdir()), [])

    def test_methods_are_refused_what_they_have_not(self):
        shell = ("square", "--method", "shell", *CLAMPED)
        self.refused("the shell has no thickness", *shell)
        self.refused("more than the whole surface is wide", *shell, "--thickness", 9)
        self.refused("no knob 'solver'.* method shell .*choose some of level, storage", *shell, "--thickness",
                     0.02, "--knobs", "solver")
        self.refused("loop is one of closed surfaces", *shell, "--thickness", 0.02, "--subdivision", "loop")
        self.refused("reference kelvin is one of --method bem", *shell, "--thickness", 0.02, "--query",
                     "greens", "--reference", "kelvin")
        self.refused("reference boussinesq is one of --method halfspace", *shell, "--thickness", 0.02,
                     "--reference", "boussinesq")
        self.refused("leaves a rigid motion", "square", "--method", "shell", *MATERIAL, "--thickness", 0.02)
        half = ("square", "--method", "halfspace", *MATERIAL)
        self.refused("needs no support", "square", "--method", "halfspace", *CLAMPED)
        self.refused("--thickness and --hinged make no sense", *half, "--thickness", 0.02)
        self.refused("as far from the rims as masks of 0.6 reach", *half, "--radius", 0.6)
        self.refused("a point is 0.25 from the rim, which cuts off its mask of 0.3", *half, "--radius", 0.3,
                     "--at", 0.25, 0, 0)
        self.refused("off its plane|flat", "sphere", "--method", "halfspace", *MATERIAL)
        self.refused("--method", "square", "--method", "import", *MATERIAL)
        self.refused("lock from a Poisson's ratio of 0.45 on", "cube", "--method", "fem", "--young", 1,
                     "--poisson", 0.49, "--fix-half-space", 0, 0, 0, 0, 0, 1, "--subdivision", "flat",
                     "--knobs", "element")


if __name__ == "__main__":
    unittest.main()
