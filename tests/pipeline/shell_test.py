# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Plates and shells through filters, files, program and package."""

import os
import tempfile
import unittest
import warnings

import numpy as np

import palpate
from palpate.arrays import as_vtk
from support.commands import require_all_commands
from support.surfaces import failure_of, points_of, polydata, run, sphere

YOUNG, POISSON, THICKNESS, SIDE = 2e9, 0.3, 1e-3, 0.2
BENDING = YOUNG * THICKNESS**3 / 12 / (1 - POISSON**2)


def plate(divisions=12, side=SIDE):
    """A square about the origin, its normal z."""
    n = divisions
    points = [(side * (i / n - 0.5), side * (j / n - 0.5), 0) for j in range(n + 1) for i in range(n + 1)]
    triangles = []
    for j in range(n):
        for i in range(n):
            a, b, c, d = (j * (n + 1) + i + k for k in (0, 1, n + 1, n + 2))
            triangles += [(a, b, d), (a, d, c)] if (i + j) % 2 == 0 else [(a, b, c), (b, d, c)]
    return polydata(points, triangles)


def rim(surface):
    return abs(points_of(surface)[:, :2]).max(axis=1) > 0.499 * SIDE


def left(surface):
    return points_of(surface)[:, 0] < -0.499 * SIDE


def shell(surface=None, fixed=rim, **settings):
    surface = plate() if surface is None else surface
    settings = {"thickness": THICKNESS, **settings}
    return palpate.precompute(surface, YOUNG, POISSON, fixed=fixed(surface), method="shell", **settings)


def with_array(surface, values, name, kind="point"):
    """The surface with one more array, of its points or cells."""
    values = np.asarray(values, float)
    data = surface.GetPointData() if kind == "point" else surface.GetCellData()
    data.AddArray(as_vtk(values, name, 1 if values.ndim == 1 else values.shape[1]))
    return surface


class Sheets(unittest.TestCase):
    def test_that_meet_by_three_are_refused_with_what_to_do(self):
        points = [(0, 0, 0), (1, 0, 0), (0.5, 1, 0), (0.5, -1, 0), (0.5, 0, 1)]
        sheets = polydata(points, [(0, 1, 2), (1, 0, 3), (0, 1, 4)])
        with self.assertRaisesRegex(palpate.Error, r"edge \(0, 1\) belongs to 3 triangles .*leave two of the sheets"):
            palpate.precompute(sheets, YOUNG, POISSON, fixed=np.arange(5) < 3, method="shell", thickness=0.01)


class Unsupported(unittest.TestCase):
    def test_a_sheet_bends_between_loads_that_balance(self):
        # Its middle pushed and two sides pulled: a beam of b wide between lines l apart that bears F in the
        # middle sags by F l^3 / 48 E I there, less what a plate is stiffer by.
        sheet = plate(16)
        points = points_of(sheet)
        with tempfile.TemporaryDirectory() as folder:
            surface, made = os.path.join(folder, "sheet.vtp"), os.path.join(folder, "model.vtp")
            palpate.write(sheet, surface)
            told = run("precompute", surface, made, "--method", "shell", "--thickness", THICKNESS, "--young",
                       YOUNG, "--poisson", 0.0, "--domain", "unsupported")
            self.assertEqual(told.returncode, 0, told.stderr)
            model = palpate.read(made)
        middle, sides = np.abs(points[:, 0]) < 1e-9, np.abs(points[:, 0]) > 0.499 * SIDE
        areas = palpate.array(model, "VertexArea")
        share = np.where(np.abs(points[:, 1]) > 0.499 * SIDE, 0.5, 1.0)  # of a line's ends
        lines = share * (middle - sides / 2)
        forces = np.outer(lines / (share * middle).sum(), (0, 0, -1.0))
        pushed = palpate.solve(model, [], np.zeros((0, 3)), free_tractions=forces / areas[:, None])
        u = palpate.array(pushed, "Displacement")[:, 2]
        beam = SIDE**3 / 48 / (YOUNG * SIDE * THICKNESS**3 / 12)
        self.assertAlmostEqual((u[sides].mean() - u[middle].mean()) / beam, 1, delta=0.02)
        np.testing.assert_allclose(areas @ palpate.array(pushed, "Displacement"), 0, atol=1e-9 * beam)

    def test_springs_bear_its_weight_and_it_is_refused_what_it_has_not(self):
        model = palpate.precompute(plate(4), YOUNG, POISSON, method="shell", thickness=THICKNESS,
                                   domain="unsupported")
        springs = np.where(np.abs(points_of(model)[:, :2]).min(axis=1) > 0.499 * SIDE, 50.0, 0.0)
        hung = palpate.gravity(palpate.foundation(model, springs=springs), density=1000)
        np.testing.assert_allclose(springs @ palpate.array(hung, "Displacement"),
                                   (0, 0, -1000 * SIDE**2 * THICKNESS * 9.81), rtol=1e-6, atol=1e-9)
        with self.assertRaisesRegex(palpate.Error, "falls freely"):
            palpate.gravity(model, density=1000)
        with self.assertRaisesRegex(palpate.Error, "or make the shell unsupported"):
            palpate.precompute(plate(4), YOUNG, POISSON, method="shell", thickness=THICKNESS)
        with self.assertRaisesRegex(palpate.Error, "domain='exterior' makes no sense for method='shell'"):
            palpate.precompute(plate(4), YOUNG, POISSON, method="shell", thickness=THICKNESS, domain="exterior")


class Package(unittest.TestCase):
    def test_a_pressed_plate_goes_down_as_timoshenkos(self):
        # w = 0.0056 (clamped) and 0.0116 (hinged) F L^2 / D under a force in the middle of a square, which
        # 12 by 12 squares exceed by 1 %. The mask is the middle vertex alone.
        for clamped, factor in ((True, 0.0056), (False, 0.0116)):
            pressed = palpate.press(shell(clamped=clamped), (0, 0, 0), force=(0, 0, -1), radius=0.016)
            moved = palpate.array(pressed, "Displacement")[13 * 13 // 2]
            self.assertAlmostEqual(-moved[2] * BENDING / SIDE**2 / factor, 1, delta=0.025)
            self.assertLess(abs(moved[:2]).max(), 1e-9 * abs(moved[2]))

    def test_thickness_is_a_number_or_an_array_of_points_or_cells(self):
        one = palpate.greens_functions(shell())
        surface = plate()
        count = surface.GetNumberOfPoints()
        for given in (shell(thickness=np.full(count, THICKNESS)),
                      shell(with_array(plate(), np.full(count, THICKNESS), "Thickness"), thickness=None),
                      shell(with_array(plate(), np.full(288, THICKNESS), "Thickness", "cell"),
                            thickness=None),
                      # a number counts before arrays
                      shell(with_array(plate(), np.full(288, 5e-3), "Thickness", "cell"))):
            np.testing.assert_allclose(palpate.greens_functions(given), one, atol=1e-12 * abs(one).max())
            palpate.stiffness(given, radius_in_edges=2)  # is not stale
        thicker = palpate.greens_functions(shell(thickness=np.linspace(1, 1.5, count) * THICKNESS))
        middle = 3 * (count // 2) + 2
        column = 3 * list(palpate.greens_function_nodes(shell())).index(count // 2) + 2
        self.assertLess(thicker[middle, column] / one[middle, column], 0.7)
        self.assertGreater(thicker[middle, column] / one[middle, column], 1.5**-3)

    def test_an_open_and_a_closed_shell_have_a_stiffness_everywhere(self):
        ball = sphere(2, 0.1)
        for model in (shell(fixed=left),
                      palpate.precompute(ball, YOUNG, POISSON, fixed=points_of(ball)[:, 2] < -0.07,
                                         method="shell", thickness=2e-3)):
            stiffness = palpate.array(palpate.stiffness(model, radius_in_edges=2), "Stiffness")
            free = palpate.array(model, "BoundaryType") == 0
            matrices = stiffness[free].reshape(-1, 3, 3)
            self.assertTrue(np.isfinite(matrices).all())
            self.assertGreater(np.linalg.eigvalsh(matrices).min(), 0)

    def test_a_thin_bowl_has_a_stiffness_everywhere_by_the_mean_under_a_mask(self):
        # It gives way across itself 1e5 times as easily as along itself.
        bowl = plate()
        points = points_of(bowl)
        points[:, 2] = 1.5 * (points[:, 0]**2 + points[:, 1]**2)
        model = shell(bowl, fixed=left, thickness=1e-3 * SIDE)
        stiffness = palpate.array(palpate.stiffness(model, radius_in_edges=4, measure="mean"), "Stiffness")
        matrices = stiffness[palpate.array(model, "BoundaryType") == 0].reshape(-1, 3, 3)
        self.assertGreater(np.linalg.eigvalsh(matrices).min(), 0)

    def test_reciprocal_as_it_is(self):
        defect = palpate.array(shell(reciprocal=False), "ReciprocityDefect")[0]
        self.assertLess(defect, 1e-12)

    def test_symmetry_holds_by_components(self):
        # A quarter of the plate, between planes of symmetry, is as soft under a quarter of the force.
        quarter = plate(6, SIDE / 2)
        points = points_of(quarter)
        points += (SIDE / 4, SIDE / 4, 0)
        held = np.zeros((len(points), 6))
        held[points[:, 0] < 1e-9] += (1, 0, 0, 0, 1, 1)
        held[points[:, 1] < 1e-9] += (0, 1, 0, 1, 0, 1)
        whole, part = shell(), shell(with_array(quarter, np.minimum(held, 1), "HeldComponents"),
                                     fixed=lambda s: points_of(s)[:, :2].max(axis=1) > 0.499 * SIDE)

        def softness(model, vertex):
            column = list(palpate.greens_function_nodes(model)).index(vertex)
            area = palpate.array(model, "VertexArea")[vertex]
            return palpate.greens_functions(model)[3 * vertex + 2, 3 * column + 2] / area

        # The diagonals run otherwise in half of the quarters.
        self.assertAlmostEqual(softness(part, 0) / 4 / softness(whole, 13 * 13 // 2), 1, delta=0.02)
        palpate.press(part, (0.05, 0.05, 0), force=(0, 0, 1), radius=0.03)

    def test_survives_a_file_and_another_youngs_modulus(self):
        model = shell()
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "model.vtp")
            palpate.write(model, path)
            read = palpate.read(path)
        first, second = (palpate.array(palpate.stiffness(m, radius_in_edges=2), "Stiffness")
                         for m in (model, read))
        np.testing.assert_array_equal(first, second)
        palpate.array(read, "YoungsModulus")[0] *= 3
        third = palpate.array(palpate.stiffness(read, radius_in_edges=2), "Stiffness")
        np.testing.assert_allclose(third, 3 * first, rtol=1e-9, atol=1e-9 * np.nanmax(abs(first)))

    def test_what_has_changed_is_stale(self):
        def spoiled(change):
            model = shell()
            change(model)
            with self.assertRaises(palpate.Error) as refused:
                palpate.stiffness(model)
            return str(refused.exception)

        self.assertIn("stale", spoiled(lambda m: m.GetPointData().GetArray("Thickness").SetTuple1(3, 2e-3)))
        self.assertIn("stale", spoiled(lambda m: m.GetFieldData().GetArray("Clamped").SetTuple1(0, 0)))
        self.assertIn("stale", spoiled(lambda m: m.GetPoints().SetPoint(80, 0, 0, 1e-3)))
        self.assertIn("stale", spoiled(
            lambda m: with_array(m, np.eye(169, 6, -84), "HeldComponents")))
        self.assertIn("no thickness", spoiled(lambda m: m.GetPointData().RemoveArray("Thickness")))
        self.assertIn("must be a positive number, not -1", spoiled(
            lambda m: m.GetPointData().GetArray("Thickness").SetTuple1(3, -1)))
        self.assertIn("open", spoiled(lambda m: m.GetFieldData().RemoveArray("GreensFunctionDomain")))

    def test_what_is_no_shell_is_refused(self):
        def refused(sentence, surface=None, **settings):
            with self.assertRaises(palpate.Error) as caught:
                shell(surface, **settings)
            self.assertIn(sentence, str(caught.exception))
            self.assertNotIn("\n", str(caught.exception).strip())

        refused("the shell has no thickness: give one number", thickness=None)
        refused("thickness must be a positive number, not 0", thickness=0)
        refused("thickness must be a positive number, not -0.1", thickness=-0.1)
        refused("thickness must be numbers", thickness="thin")
        refused("thickness must be one number or 169, one a vertex, not 3", thickness=[1, 2, 3])
        wrong = np.full(169, 1e-3)
        wrong[7] = np.nan
        refused("the thickness at vertex 7 must be a positive number, not nan", thickness=wrong)
        refused("is more than the whole surface is wide", thickness=0.3)
        refused("the piece of the shell with vertex 0 is not held anywhere",
                fixed=lambda s: np.zeros(s.GetNumberOfPoints(), bool))
        refused("leaves a rigid motion free (rotation about the axis (0, 1, 0)",
                fixed=left, clamped=False)
        both = with_array(with_array(plate(), np.ones(169), "Thickness"), np.ones(288), "Thickness", "cell")
        refused("a thickness of its points and another of its cells", both, thickness=None)
        refused("the array 'HeldComponents' must hold 169 by 6 numbers",
                with_array(plate(), np.ones((169, 3)), "HeldComponents"))
        refused("held component 1 of vertex 0 must be 0 or 1, not 0.5",
                with_array(plate(), np.full((169, 6), [0, 0.5, 0, 0, 0, 0]), "HeldComponents"))
        tee = polydata([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1)],
                       [(0, 1, 2), (1, 0, 3), (0, 1, 4)])
        refused("non-manifold", tee)
        refused("the model has no free node", fixed=lambda s: np.ones(s.GetNumberOfPoints(), bool))

    def test_settings_of_other_methods_are_refused(self):
        for setting in ({"precision": "float"}, {"tolerance": 0.1}, {"domain": "exterior"},
                        {"patch_columns": True}, {"smooth_angle": 20}, {"element": "linear"},
                        {"threads": 2}):
            with self.assertRaisesRegex(palpate.Error, "makes no sense for method='shell'"):
                shell(**setting)
        for setting in ({"thickness": 1}, {"thickness": np.ones(42)}, {"clamped": False}):
            with self.assertRaisesRegex(palpate.Error, "makes no sense for method='bem'"):
                palpate.precompute(sphere(1), YOUNG, POISSON, **setting)

    def test_warns_of_what_is_too_thick_for_a_shell(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            model = shell(thickness=0.06)
        self.assertTrue(any("is thick (thickness over width 0.3)" in str(w.message) for w in caught))
        self.assertIn("is thick", str(palpate.array(model, "Warnings")[0]))


class Filter(unittest.TestCase):
    def setUp(self):
        self.conditions = palpate.vtkReferenceBoundaryConditions()
        self.surface = with_array(plate(), np.full(169, THICKNESS), "Thickness")
        self.conditions.SetInputData(self.surface)
        self.conditions.SetYoungsModulus(YOUNG)
        self.conditions.SetPoissonRatio(POISSON)
        self.conditions.AddFixedHalfSpace((-0.499 * SIDE, 0, 0), (1, 0, 0))
        self.filter = palpate.vtkShellGreensFunctions()
        self.filter.SetInputConnection(self.conditions.GetOutputPort())

    def greens(self):
        self.filter.Update()
        return self.filter.GetOutput().GetFieldData().GetArray("GreensFunctions")

    def test_keeps_what_it_has_until_thickness_or_support_change(self):
        first = self.greens()
        self.conditions.SetYoungsModulus(2 * YOUNG)
        self.assertIs(self.greens(), first)
        self.surface.GetPointData().GetArray("Thickness").SetTuple1(168, 2 * THICKNESS)
        self.surface.GetPointData().GetArray("Thickness").Modified()
        self.surface.Modified()
        second = self.greens()
        self.assertIsNot(second, first)
        self.filter.SetThickness(THICKNESS)
        third = self.greens()
        self.assertIsNot(third, second)
        np.testing.assert_array_equal(palpate.array(self.filter.GetOutput(), "Thickness"), THICKNESS)

    def test_hinges_at_one_edge_do_not_hold(self):
        self.filter.ClampedOff()
        self.assertIn("leaves a rigid motion free", failure_of(self.filter))
        self.assertEqual(self.filter.GetOutput().GetNumberOfPoints(), 0)

    def test_patch_columns_are_refused(self):
        self.filter.PatchColumnsOn()
        self.assertIn("a shell takes one traction a vertex", failure_of(self.filter))

    def test_a_thickness_that_is_none_is_refused(self):
        for wrong in (-1, float("nan")):
            self.filter.SetThickness(wrong)
            self.assertIn("the thickness of a shell must be a positive number, not ",
                          failure_of(self.filter))

    def test_a_folded_shell_bears_tractions_on_its_triangles(self):
        # On folds, too, without patch columns: their sum is the force that the support bears.
        points = points_of(self.surface)
        points[:] = [(min(x, 0), y, max(x, 0)) for x, y, _ in points]
        self.filter.Update()
        model = self.filter.GetOutput()
        solved = palpate.solve(model, [], np.zeros((0, 3)), face_tractions=np.tile((0.0, 0.0, -1.0), (288, 1)))
        reaction = (palpate.array(solved, "Traction") * palpate.array(model, "VertexArea")[:, None])[
            palpate.array(model, "BoundaryType") == 1].sum(axis=0)
        loaded = palpate.array(model, "VertexArea")[palpate.array(model, "BoundaryType") == 0].sum()
        np.testing.assert_allclose(reaction, (0, 0, loaded), atol=1e-9 * loaded)


class Estimate(unittest.TestCase):
    def test_is_made_where_it_is_asked_for(self):
        self.assertEqual(palpate.array(shell(plate(4)), "ErrorEstimate")[0], -1)
        coarse, fine = (palpate.array(shell(plate(n), estimate_error=True), "ErrorEstimate")[0] for n in (6, 12))
        self.assertTrue(0 < fine < 0.6 * coarse < 0.2, (coarse, fine))

    def test_is_an_option_of_the_filter_that_is_off(self):
        greens = palpate.vtkShellGreensFunctions()
        surface = palpate.precompute(plate(4), YOUNG, POISSON, fixed=left(plate(4)), method="shell",
                                     thickness=THICKNESS)
        greens.SetInputData(surface)
        self.assertFalse(greens.GetEstimateError())
        greens.EstimateErrorOn()
        greens.Update()
        self.assertGreater(palpate.array(greens.GetOutput(), "ErrorEstimate")[0], 0)


class Program(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.surface, self.model, self.out = (
            os.path.join(folder.name, name) for name in ("plate.vtp", "model.vtp", "out.vtp"))
        palpate.write(plate(), self.surface)

    def precompute(self, output, *options):
        return run("precompute", self.surface, output, "--method", "shell", "--young", YOUNG, "--poisson",
                   POISSON, "--fix-half-space", -0.499 * SIDE, 0, 0, 1, 0, 0, *options)

    def test_makes_models_that_all_commands_take(self):
        made = self.precompute(self.model, "--thickness", THICKNESS)
        self.assertEqual(made.returncode, 0, made.stderr)
        require_all_commands(self, self.model, self.out, made_by="thin shell (DKT and OPT triangles, 288 of them, thickness 0.001, clamped)",
                             radius=0.03, tool_radius=0.03)

    def test_estimates_its_error(self):
        made = self.precompute(self.model, "--thickness", THICKNESS, "--estimate")
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertRegex(made.stdout, r"estimated error +\d")
        self.assertRegex(run("info", self.model).stdout, r"estimated error +\d")

    def test_refuses_in_a_sentence(self):
        for options, sentence in (
                ((), "the shell has no thickness"),
                (("--thickness", 0), "--thickness: must be a positive number, not 0"),
                (("--thickness", "nan"), "--thickness: must be a positive number, not nan"),
                (("--thickness", THICKNESS, "--hinged"), "leaves a rigid motion free"),
                (("--thickness", THICKNESS, "--precision", "float"),
                 "--precision makes no sense with --method shell"),
                (("--thickness", THICKNESS, "--patch-columns"),
                 "--patch-columns makes no sense with --method shell")):
            refused = self.precompute(self.out, *options)
            self.assertNotEqual(refused.returncode, 0)
            self.assertIn(sentence, refused.stderr)
            self.assertFalse(os.path.exists(self.out))
        for option in (("--thickness", THICKNESS), ("--hinged",), ("--estimate",)):
            refused = run("precompute", self.surface, self.out, "--young", YOUNG, "--poisson", POISSON,
                          *option)
            self.assertIn(f"{option[0]} makes no sense with --method bem", refused.stderr)


if __name__ == "__main__":
    unittest.main()
