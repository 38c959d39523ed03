# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Strain and stress of pressed bodies, at their surface and inside, through filters, package and program."""

import os
import tempfile
import unittest

import numpy as np
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid

import palpate
from support.solids import bar, base_of, set_cells
from support.surfaces import points_of, polydata, run, sphere, triangles_of

YOUNG, POISSON = 8e3, 0.3


def solved_on(model, solved):
    """A contact's displacements and tractions on a model."""
    for name in ("Displacement", "Traction"):
        model.GetPointData().AddArray(solved.GetPointData().GetArray(name))
    return model


def pressed_kidney(levels=2, **settings):
    kidney = palpate.refine(palpate.read(palpate.example("kidney")), levels)
    model = palpate.precompute(kidney, YOUNG, POISSON, **settings)
    return palpate.press(model, point=(0, 0, 0.03), force=(0, 0, -0.5), radius=0.01)


def tensors(data, name):
    xx, yy, zz, xy, yz, xz = palpate.array(data, name).T
    return np.moveaxis(np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]), 2, 0)


class InteriorProbe(unittest.TestCase):
    def test_forces_through_a_cut_balance_what_lies_above(self):
        # A ball, held below, pulled up at its top: each cut through it bears the whole force.
        ball = sphere(3)
        model = palpate.precompute(ball, YOUNG, POISSON, fixed=points_of(ball)[:, 2] < -0.79)
        pulled = palpate.press(model, point=(0, 0, 1), force=(0, 0, 2.0), radius=0.5)
        for height in (-0.3, 0.0, 0.4):
            radius = np.sqrt(1 - height ** 2) * 0.995  # the polyhedron is inside the sphere
            nodes, weights = np.polynomial.legendre.leggauss(8)
            rings = radius * np.sqrt((nodes + 1) / 2)  # equal areas
            angles = np.arange(16) * np.pi / 8
            places = np.array([(r * np.cos(a), r * np.sin(a), height) for r in rings for a in angles])
            probed = palpate.probe(pulled, places)
            self.assertTrue(palpate.array(probed, "InsideMaterial").all())
            stress = tensors(probed, "Stress")[:, 2, 2].reshape(8, 16).mean(axis=1)
            force = np.pi * radius ** 2 * (weights / 2 * stress).sum()
            self.assertAlmostEqual(force / 2, 1, delta=0.03)  # a mesh of 642 vertices, and the rim

    def test_bodies_of_both_methods_bear_the_same(self):
        places = [(0, 0, 0.0), (0, 0.002, 0.005), (0.005, 0, -0.005)]
        bem, fem = (palpate.probe(pressed_kidney(method=method), places) for method in ("bem", "fem"))
        for name, tolerance in (("Displacement", 0.06), ("Stress", 0.05)):  # each within 5 % at 322 vertices
            a, b = palpate.array(bem, name), palpate.array(fem, name)
            self.assertLess(np.abs(a - b).max(), tolerance * np.abs(a).max(), name)

    def test_probes_are_kept_points_elsewhere_marked_and_grids_taken(self):
        pressed = pressed_kidney(1)
        grid = vtkUnstructuredGrid()
        points = vtkPoints()
        for place in ((0, 0, 0), (1, 0, 0), (0, 0, 0.002)):
            points.InsertNextPoint(place)
        grid.SetPoints(points)
        probed = palpate.probe(pressed, grid)
        self.assertEqual(probed.GetNumberOfVerts(), 3)
        np.testing.assert_array_equal(palpate.array(probed, "InsideMaterial"), [1, 0, 1])
        self.assertEqual(np.abs(palpate.array(probed, "Stress")[1]).max(), 0)
        stress, strain = tensors(probed, "Stress")[0], tensors(probed, "Strain")[0]
        shear = YOUNG / 2 / (1 + POISSON)
        lame = 2 * shear * POISSON / (1 - 2 * POISSON)
        np.testing.assert_allclose(stress, 2 * shear * strain + lame * np.trace(strain) * np.eye(3),
                                   atol=1e-6 * np.abs(stress).max())  # of the integrals
        np.testing.assert_allclose(palpate.array(probed, "PrincipalStress")[0],
                                   np.linalg.eigvalsh(stress)[::-1], atol=1e-9 * np.abs(stress).max())
        filter = palpate.vtkInteriorProbe()
        filter.SetInputData(pressed)
        filter.SetProbeData(grid)
        reports = []
        filter.AddObserver("ProgressEvent", lambda *_: reports.append(1))
        filter.Update()
        integrated = len(reports)
        filter.SetInputData(palpate.press(pressed, point=(0, 0, 0.03), force=(0, 0, -1.0), radius=0.01))
        filter.Update()
        self.assertLess(len(reports) - integrated, integrated)  # begin and end alone
        np.testing.assert_allclose(palpate.array(filter.GetOutput(), "Stress"),
                                   2 * palpate.array(probed, "Stress"), rtol=1e-9)


class SurfaceStress(unittest.TestCase):
    def test_a_stretched_bar_bears_its_load(self):
        grid = bar((4, 4, 8))
        model = palpate.precompute(grid, YOUNG, 0.0, method="fem", patch_columns=True, reciprocal=False,
                                   fixed=base_of(grid))
        points, corners = points_of(model), triangles_of(model)
        tractions = np.zeros((len(corners), 3))
        tractions[(points[corners][:, :, 2] > 2 - 1e-9).all(axis=1), 2] = 7
        solved = palpate.surface_stress(palpate.solve(model, [], np.zeros((0, 3)), face_tractions=tractions))
        sides = (np.abs(points[corners][:, :, 2] - 1) < 0.7).all(axis=1)
        self.assertGreater(sides.sum(), 100)
        np.testing.assert_allclose(tensors(solved, "Stress")[sides, 2, 2], 7, rtol=1e-9)
        np.testing.assert_allclose(palpate.array(solved, "VonMisesStress")[sides], 7, rtol=1e-9)
        self.assertAlmostEqual(palpate.array(solved, "LargestDisplacementGradient")[0], 7 / YOUNG,
                               delta=1e-9)

    def test_layers_bear_the_same_and_strain_as_they_are_stiff(self):
        grid = bar((4, 4, 8))
        heights = np.array([np.mean([grid.GetPoint(grid.GetCell(c).GetPointId(k))[2] for k in range(4)])
                            for c in range(grid.GetNumberOfCells())])
        set_cells(grid, YoungsModulus=np.where(heights > 1, 5e4, 1e4), PoissonRatio=np.zeros(len(heights)))
        model = palpate.precompute(grid, 1.0, 0.0, method="fem", patch_columns=True, reciprocal=False,
                                   fixed=base_of(grid))
        points, corners = points_of(model), triangles_of(model)
        tractions = np.zeros((len(corners), 3))
        tractions[(points[corners][:, :, 2] > 2 - 1e-9).all(axis=1), 2] = 7
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "model.vtp")
            palpate.write(model, path)
            model = palpate.read(path)
        heights = points[corners][:, :, 2]
        sides = ((heights > 0.2) & (heights < 1.8)).all(axis=1)
        expected = np.where(heights.mean(axis=1) > 1, 5e4, 1e4)[sides]
        for unit in (1.0, 2.0):  # twice as stiff all over
            model.GetFieldData().GetArray("YoungsModulus").SetValue(0, unit)
            solved = palpate.surface_stress(palpate.solve(model, [], np.zeros((0, 3)),
                                                          face_tractions=tractions))
            np.testing.assert_allclose(tensors(solved, "Stress")[sides, 2, 2], 7, rtol=1e-8)
            np.testing.assert_allclose(palpate.array(solved, "Strain")[sides, 2] * unit * expected, 7, rtol=1e-8)
        model.GetFieldData().GetArray("SurfaceElasticity").SetTuple(0, np.full(22, -1.0))
        with self.assertRaisesRegex(palpate.Error, "positive definite"):
            palpate.surface_stress(solved_on(model, solved))

    def test_what_nothing_holds_bears_what_balances(self):
        grid = bar((4, 4, 8))
        model = palpate.precompute(grid, YOUNG, 0.0, method="fem", domain="unsupported", estimate_error=False,
                                   reciprocal=False)
        points, areas = points_of(model), palpate.array(model, "VertexArea")
        pull = np.zeros((len(points), 3))
        pull[:, 2] = (np.where(points[:, 2] > 2 - 1e-9, 1.0, 0.0) - np.where(points[:, 2] < 1e-9, 1.0, 0.0))
        force = areas[points[:, 2] > 2 - 1e-9].sum()
        solved = palpate.solve(model, [], np.zeros((0, 3)), free_tractions=pull)
        middle = (np.abs(points[triangles_of(model)][:, :, 2] - 1) < 0.3).all(axis=1)
        surface = tensors(palpate.surface_stress(solved), "Stress")[middle, 2, 2]
        inside = tensors(palpate.probe(solved, [(0.5, 0.5, 1.0)]), "Stress")[0]
        # Loads of the ends' edges act on the sides, too: Saint-Venant leaves little of that here.
        self.assertAlmostEqual(surface.mean() / force, 1, delta=0.05)
        self.assertAlmostEqual(inside[2, 2] / force, 1, delta=0.05)

    def test_a_half_space_bears_what_loves_solution_says(self):
        # Under the middle of an even pressure p on a disc: -p across, -p (1 + 2 nu) / 2 along.
        n = 24
        side = np.linspace(-1, 1, n + 1)
        points = np.array([(x, y, 0) for y in side for x in side])
        corners = [(i + (n + 1) * j, i + 1 + (n + 1) * j, i + 1 + (n + 1) * (j + 1), i + (n + 1) * (j + 1))
                   for j in range(n) for i in range(n)]
        triangles = np.array([t for a, b, c, d in corners for t in ((a, b, c), (a, c, d))])
        model = palpate.precompute(polydata(points, triangles), YOUNG, POISSON, method="halfspace",
                                   reciprocal=False)
        loaded = np.hypot(points[:, 0], points[:, 1]) < 0.52
        solved = palpate.solve(model, [], np.zeros((0, 3)), free_tractions=np.outer(loaded, (0, 0, -7.0)))
        stressed = palpate.surface_stress(solved)
        middle = (np.abs(points[triangles]) < 0.1).all(axis=(1, 2))
        stress = tensors(stressed, "Stress")[middle].mean(axis=0)
        np.testing.assert_allclose(np.diag(stress), -7 * np.array((0.5 + POISSON, 0.5 + POISSON, 1)), rtol=0.03)
        self.assertLess(abs(stress[0, 1]), 0.02 * 7)

    def test_another_contact_takes_the_stresses_away(self):
        stressed = palpate.surface_stress(pressed_kidney(1))
        again = palpate.press(stressed, point=(0, 0, 0.03), force=(0, 0, -0.1), radius=0.01)
        self.assertFalse(again.GetCellData().HasArray("Stress"))
        self.assertTrue(again.GetCellData().HasArray("SmoothPatch"))

    def test_bodies_without_one_material_or_contact_are_refused(self):
        kidney = palpate.precompute(palpate.read(palpate.example("kidney")), YOUNG, POISSON)
        with self.assertRaisesRegex(palpate.Error, "no point array 'Displacement'.*press the model first"):
            palpate.surface_stress(kidney)
        grid = bar((2, 2, 4))
        cells = grid.GetNumberOfCells()
        set_cells(grid, YoungsModulus=np.linspace(1, 2, cells), PoissonRatio=np.full(cells, 0.3))
        model = palpate.precompute(grid, YOUNG, 0.3, method="fem", fixed=base_of(grid))
        pressed = palpate.press(model, point=(0.5, 0.5, 2), force=(0, 0, -1), radius=0.5)
        with self.assertRaisesRegex(palpate.Error, "bodies of one isotropic material.*--method fem --probe"):
            palpate.probe(pressed, [(0.5, 0.5, 1)])
        springs = np.where(base_of(grid), 0.0, 1.0)
        with self.assertRaisesRegex(palpate.Error, "on springs"):
            palpate.surface_stress(palpate.press(palpate.foundation(model, springs=springs), point=(0.5, 0.5, 2),
                                                 force=(0, 0, -1), radius=0.5))


class Program(unittest.TestCase):
    def test_press_prints_probes_stress_and_validity(self):
        with tempfile.TemporaryDirectory() as folder:
            model, out = os.path.join(folder, "m.vtp"), os.path.join(folder, "p.vtp")
            palpate.write(palpate.precompute(palpate.refine(palpate.read(palpate.example("kidney"))), YOUNG,
                                             POISSON), model)

            def press(force, *more):
                return run("press", model, out, "--at", 0, 0, 0.03, "--force", 0, 0, force, "--radius", 0.01,
                           *more)

            told = press(-0.01, "--stress", "--probe", "0", "0", "0", "0", "0", "0.002")
            self.assertEqual(told.returncode, 0, told.stderr)
            self.assertEqual(told.stdout.count("von Mises stress, Pa"), 2, told.stdout)
            self.assertIn("largest displacement gradient", told.stdout)
            self.assertNotIn("linear theory", told.stderr)
            self.assertTrue(palpate.read(out).GetCellData().HasArray("Stress"))
            self.assertIn("linear theory is off", press(-5).stderr)
            os.remove(out)
            for wrong, sentence in ((("--probe", "0", "0"), "three coordinates"),
                                    (("--probe", "1", "0", "0"), "not inside the body")):
                refused = press(-0.1, *wrong)
                self.assertNotEqual(refused.returncode, 0)
                self.assertIn(sentence, refused.stderr)
                self.assertFalse(os.path.exists(out))


if __name__ == "__main__":
    unittest.main()
