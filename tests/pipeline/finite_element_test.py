# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Finite elements through the filter, files, program and package."""

import os
import tempfile
import unittest
import warnings

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import VTK_HEXAHEDRON, VTK_TRIANGLE
from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter

import palpate
from support.solids import bar, set_cells
from support.surfaces import points_of, run, triangles_of

warnings.simplefilter("ignore", palpate.ModelWarning)  # the surface's triangles are not all kept

YOUNG, POISSON = 8e3, 0.3


def named(values, name):
    array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
    array.SetName(name)
    return array


def surface_of(grid):
    surface = vtkDataSetSurfaceFilter()
    surface.SetInputData(grid)
    surface.Update()
    return surface.GetOutput()


def centres(grid):
    return np.array([np.mean([grid.GetPoint(grid.GetCell(c).GetPointId(k)) for k in range(4)], axis=0)
                     for c in range(grid.GetNumberOfCells())])


def model_of(grid, young=YOUNG, poisson=POISSON, volume=None, **settings):
    surface = surface_of(grid)
    fixed = points_of(surface)[:, 2] < 1e-9
    return palpate.precompute(surface, young, poisson, fixed=fixed, method="fem", volume=volume or grid,
                              **settings)


def stretch(model):
    """Mean rise of the top under a unit traction on it."""
    points = points_of(model)
    top = np.flatnonzero(points[:, 2] > points[:, 2].max() - 1e-9)
    corners = triangles_of(model)
    tractions = np.zeros((len(corners), 3))
    tractions[np.isin(corners, top).all(axis=1), 2] = 1
    solved = palpate.solve(model, [], np.zeros((0, 3)), face_tractions=tractions)
    return palpate.array(solved, "Displacement")[top, 2].mean()


class Package(unittest.TestCase):
    def test_a_bar_without_contraction_stretches_as_a_rod(self):
        # nu = 0: a fixed base does not hinder it, u = p L / E exactly.
        self.assertAlmostEqual(stretch(model_of(bar(), poisson=0.0, patch_columns=True, reciprocal=False)), 2 / YOUNG,
                               delta=1e-9 * 2 / YOUNG)

    def test_two_layers_of_different_stiffness_stretch_as_springs_in_series(self):
        grid = bar()
        soft = centres(grid)[:, 2] > 1
        set_cells(grid, YoungsModulus=np.where(soft, 1e3, 1e6), PoissonRatio=np.zeros(len(soft)))
        model = model_of(grid, poisson=0.0, patch_columns=True, reciprocal=False)
        self.assertAlmostEqual(stretch(model) / (1 / 1e3 + 1 / 1e6), 1, delta=1e-9)
        self.assertIn("2 materials", palpate.array(model, "GreensFunctionSource")[0])

    def test_fibres_along_the_bar_stiffen_it(self):
        grid = bar()
        cells = grid.GetNumberOfCells()
        set_cells(grid, TransverselyIsotropicModuli=[[9e4, 0, 1e4, 0, 5e3]] * cells,
                  FibreDirection=[[0, 0, 3]] * cells)
        self.assertAlmostEqual(stretch(model_of(grid, patch_columns=True, reciprocal=False)) * 9e4 / 2, 1, delta=1e-9)

    def test_planes_of_symmetry_hold_what_guides_hold(self):
        # A bar that cannot get wider: u = p L / M, M = lambda + 2 G, though nu is not 0.
        grid = bar((3, 3, 6))
        surface = surface_of(grid)
        points = points_of(surface)
        fixed = points[:, 2] < 1e-9
        held = np.zeros((len(points), 3), dtype=np.uint8)
        for k in range(2):
            held[:, k] = ((points[:, k] < 1e-9) | (points[:, k] > 1 - 1e-9)) & ~fixed
        surface.GetPointData().AddArray(named(held, "HeldComponents"))
        pose = {"fixed": fixed, "volume": grid, "patch_columns": True, "reciprocal": False}
        model = palpate.precompute(surface, YOUNG, POISSON, method="fem", **pose)
        modulus = YOUNG * (1 - POISSON) / (1 + POISSON) / (1 - 2 * POISSON)
        self.assertAlmostEqual(stretch(model) * modulus / 2, 1, delta=1e-6)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "model.vtp")
            palpate.write(model, path)
            self.assertAlmostEqual(stretch(palpate.read(path)) / stretch(model), 1, delta=1e-12)
        surface.GetPointData().AddArray(named(0 * held, "HeldComponents"))
        free = palpate.precompute(surface, YOUNG, POISSON, method="fem", **pose)
        self.assertGreater(stretch(free), 1.1 * stretch(model))
        changed = model.NewInstance()
        changed.DeepCopy(model)
        changed.GetPointData().GetArray("HeldComponents").SetTuple(points[:, 2].argmax(), (1, 0, 1))
        for what, sentence in (
                (lambda: palpate.press(changed, (0.5, 0.5, 2), force=(0, 0, 1)), "stale"),
                (lambda: palpate.precompute(model, YOUNG, POISSON), "choose finite elements"),
                (lambda: palpate.surface_stress(palpate.press(model, (0.5, 0.5, 2), force=(0, 0, 1))),
                 "without HeldComponents")):
            with self.assertRaises(palpate.Error) as raised:
                what()
            self.assertIn(sentence, str(raised.exception))
        for wrong, sentence in ((np.full((len(points), 3), 2), "must be 0 or 1, not 2"),
                                (held[:, :2], "3 components, or 6"),
                                (np.ones((len(points), 3)), "but all of it is held: fix it")):
            surface.GetPointData().AddArray(named(wrong, "HeldComponents"))
            with self.assertRaises(palpate.Error) as raised:
                palpate.precompute(surface, YOUNG, POISSON, method="fem", **pose)
            self.assertIn(sentence, str(raised.exception))

    def test_a_grid_tells_its_material_and_its_points_what_is_fixed(self):
        grid = bar((2, 2, 4))
        soft = centres(grid)[:, 2] > 1
        arrays = {"YoungsModulus": np.where(soft, 1e3, 3e3), "PoissonRatio": np.where(soft, 0.1, 0.2)}
        set_cells(grid, **arrays)
        fixed = np.array([grid.GetPoint(i)[2] < 1e-9 for i in range(grid.GetNumberOfPoints())])
        self.assertNotEqual(len(fixed), surface_of(grid).GetNumberOfPoints())
        model = palpate.precompute(grid, fixed=fixed, method="fem", estimate_error=False)
        self.assertAlmostEqual(palpate.array(model, "YoungsModulus")[0], 2e3)
        self.assertAlmostEqual(palpate.array(model, "PoissonRatio")[0], 0.15)
        given = palpate.precompute(grid, 5e3, 0.3, fixed=fixed, method="fem", estimate_error=False)
        np.testing.assert_allclose(palpate.greens_functions(model), palpate.greens_functions(given), rtol=1e-8,
                                   atol=1e-12)  # the unit says nothing
        shear, lame = YOUNG / 2 / (1 + POISSON), YOUNG * POISSON / (1 + POISSON) / (1 - 2 * POISSON)
        full = np.diag([2 * shear] * 3 + [shear] * 3)
        full[:3, :3] += lame
        tensors = set_cells(bar((2, 2, 2)), ElasticityTensor=[full[np.triu_indices(6)]] * 48)
        boundary = palpate.vtkSolidBoundary()
        boundary.SetInputData(tensors)
        boundary.Update()
        self.assertAlmostEqual(palpate.array(boundary.GetOutput(), "YoungsModulus")[0] / YOUNG, 1)
        self.assertAlmostEqual(palpate.array(boundary.GetOutput(), "PoissonRatio")[0], POISSON)

    def test_an_isotropic_tensor_is_the_isotropic_material(self):
        grid, with_tensor = bar((2, 2, 4)), bar((2, 2, 4))
        shear, lame = YOUNG / 2 / (1 + POISSON), YOUNG * POISSON / (1 + POISSON) / (1 - 2 * POISSON)
        full = np.diag([2 * shear] * 3 + [shear] * 3)
        full[:3, :3] += lame
        set_cells(with_tensor, ElasticityTensor=[full[np.triu_indices(6)]] * with_tensor.GetNumberOfCells())
        self.assertLess(np.abs(palpate.greens_functions(model_of(with_tensor))
                               / palpate.greens_functions(model_of(grid)) - 1).max(), 1e-6)

    def test_a_surface_is_filled_and_keeps_its_data(self):
        surface = palpate.refine(palpate.read(palpate.example("nodule")))
        bem = palpate.precompute(surface, YOUNG, POISSON)
        fem = palpate.precompute(surface, YOUNG, POISSON, method="fem")
        self.assertEqual(fem.GetNumberOfPoints(), surface.GetNumberOfPoints())
        np.testing.assert_array_equal(palpate.array(fem, "BoundaryType"),
                                      palpate.array(bem, "BoundaryType"))
        self.assertLess(palpate.array(fem, "ReciprocityDefect")[0], 1e-12)
        place = points_of(surface)[points_of(surface)[:, 2].argmax()]
        both = [palpate.array(palpate.press(model, place, force=(0, 0, -1), radius=0.02),
                              "Displacement")[:, 2].min() for model in (bem, fem)]
        self.assertAlmostEqual(both[0] / both[1], 1, delta=0.15)  # what meshes of 130 vertices err by

    def test_refusals_name_their_cause(self):
        grid = bar((2, 2, 2))
        cells = grid.GetNumberOfCells()
        hexahedron = bar((1, 1, 1))
        hexahedron.InsertNextCell(VTK_HEXAHEDRON, 8, [0, 1, 3, 2, 4, 5, 7, 6])
        other = bar((2, 2, 3))
        for what, sentence in (
                (lambda: model_of(set_cells(bar((2, 2, 2)), YoungsModulus=[1.0] * cells)), "PoissonRatio"),
                (lambda: model_of(set_cells(bar((2, 2, 2)), YoungsModulus=[-1.0] * cells,
                                            PoissonRatio=[0.3] * cells)), "cell 0"),
                (lambda: model_of(set_cells(bar((2, 2, 2)), ElasticityTensor=[[1.0] * 6] * cells)), "21"),
                (lambda: model_of(bar((1, 1, 1)), volume=hexahedron), "no tetrahedron"),
                (lambda: model_of(grid, poisson=0.47, element="linear"), "lock"),
                (lambda: model_of(grid, volume=other), "vertex"),
                (lambda: model_of(grid, precision="float"), "precision makes no sense"),
                (lambda: model_of(grid, volume=surface_of(grid)), "vtkUnstructuredGrid"),
                (lambda: palpate.precompute(surface_of(grid), YOUNG, POISSON, element="linear"),
                 "element makes no sense")):
            with self.subTest(sentence), self.assertRaisesRegex(palpate.Error, sentence):
                what()

    def test_cells_of_lower_dimension_are_left_out(self):
        grid = bar((2, 2, 2))
        plain = palpate.greens_functions(model_of(grid))
        with_triangle = bar((2, 2, 2))
        with_triangle.InsertNextCell(VTK_TRIANGLE, 3, [0, 1, 3])
        np.testing.assert_array_equal(palpate.greens_functions(model_of(grid, volume=with_triangle)), plain)


class Filter(unittest.TestCase):
    def test_computes_once_for_one_body_and_again_for_another(self):
        grid = bar((2, 2, 2))
        conditions = palpate.vtkReferenceBoundaryConditions()
        conditions.SetInputData(surface_of(grid))
        conditions.AddFixedHalfSpace((0, 0, 1e-6), (0, 0, 1))
        conditions.SetYoungsModulus(1)
        conditions.SetPoissonRatio(0.3)
        fem = palpate.vtkFiniteElementGreensFunctions()
        fem.SetInputConnection(conditions.GetOutputPort())
        fem.SetInputData(1, grid)

        def matrix():
            fem.Update()
            return fem.GetOutput().GetFieldData().GetArray("GreensFunctions")

        first = matrix()
        conditions.SetYoungsModulus(2)
        self.assertIs(matrix(), first)
        conditions.SetPoissonRatio(0.2)
        self.assertIsNot(matrix(), first)


class Program(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = lambda name: os.path.join(folder.name, name)

    def test_a_model_is_computed_read_and_pressed(self):
        made = run("precompute", palpate.example("nodule"), self.path("m.vtp"), "--young", 1e4, "--poisson",
                   0.49, "--method", "fem")
        self.assertEqual(made.returncode, 0, made.stderr)
        told = run("info", self.path("m.vtp")).stdout
        self.assertIn("finite elements (quadratic tetrahedra", told)
        pressed = run("press", self.path("m.vtp"), self.path("p.vtp"), "--at", 0, 0, 1, "--force", 0, 0, -1,
                      "--radius-edges", 2)
        self.assertEqual(pressed.returncode, 0, pressed.stderr)

    def test_options_of_other_methods_are_refused(self):
        for method, option in (("fem", "--collocation=vertex"), ("bem", "--cell-size=1")):
            made = run("precompute", palpate.example("nodule"), self.path("m.vtp"), "--young", 1, "--poisson",
                       0.3, "--method", method, option)
            self.assertNotEqual(made.returncode, 0)
            self.assertIn("makes no sense with --method " + method, made.stderr)
            self.assertFalse(os.path.exists(self.path("m.vtp")))


if __name__ == "__main__":
    unittest.main()
