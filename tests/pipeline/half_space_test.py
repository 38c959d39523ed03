# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Half-spaces through filters, files, program and package."""

import os
import tempfile
import unittest

import numpy as np

import palpate
from support.commands import require_all_commands
from support.surfaces import polydata, run, sphere

YOUNG, POISSON = 1e4, 0.4
MODULUS = YOUNG / (1 - POISSON**2)


def disc(radius=0.05, rings=12):
    """Rings of 6 k points round the origin, in the plane z = 0."""
    points, triangles = [(0, 0, 0)], []

    def number(ring, i):
        return 0 if ring == 0 else 1 + 3 * ring * (ring - 1) + i % (6 * ring)

    for ring in range(1, rings + 1):
        angles = 2 * np.pi * np.arange(6 * ring) / (6 * ring)
        points += [(radius * ring / rings * np.cos(a), radius * ring / rings * np.sin(a), 0)
                   for a in angles]
        for sector in range(6):
            for i in range(ring):
                outer, inner = sector * ring + i, sector * (ring - 1) + i
                triangles.append((number(ring, outer), number(ring, outer + 1),
                                  number(ring - 1, inner)))
                if i < ring - 1:
                    triangles.append((number(ring - 1, inner), number(ring, outer + 1),
                                      number(ring - 1, inner + 1)))
    return polydata(points, triangles)


def half_space(**settings):
    return palpate.precompute(disc(), YOUNG, POISSON, method="halfspace", **settings)


class Package(unittest.TestCase):
    def test_a_cone_of_pressure_is_as_stiff_as_its_closed_form(self):
        # A12: u = (3 / pi) (1 - nu^2) F / (E a); across it is softer by 2 (1 - nu) / (2 - nu), A14.
        radius = 0.02
        for direction, ratio in (((0, 0, -1), 1), ((1, 0, 0), 2 * (1 - POISSON) / (2 - POISSON))):
            pressed = palpate.press(half_space(), (0, 0, 0), force=direction, radius=radius)
            moved = np.linalg.norm(palpate.array(pressed, "Displacement")[0])
            self.assertAlmostEqual(moved * np.pi * MODULUS * radius / 3 * ratio, 1, delta=0.03)

    def test_carries_no_matrix(self):
        model = half_space()
        self.assertFalse(model.GetFieldData().HasArray("GreensFunctions"))
        self.assertEqual(len(palpate.greens_function_nodes(model)), model.GetNumberOfPoints())
        self.assertEqual(str(palpate.array(model, "GreensFunctionDomain")[0]), "halfspace")
        with self.assertRaisesRegex(palpate.Error, "there is no matrix"):
            palpate.greens_functions(model)

    def test_survives_a_file_and_another_youngs_modulus(self):
        model = half_space()
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "model.vtp")
            palpate.write(model, path)
            self.assertLess(os.path.getsize(path), 200e3)
            read = palpate.read(path)
        first, second = (palpate.array(palpate.stiffness(m, radius_in_edges=2), "Stiffness")
                         for m in (model, read))
        np.testing.assert_array_equal(first, second)
        palpate.array(read, "YoungsModulus")[0] *= 3
        third = palpate.array(palpate.stiffness(read, radius_in_edges=2), "Stiffness")
        np.testing.assert_allclose(third, 3 * first, rtol=1e-10, atol=1e-9 * abs(first).max())

    def test_settings_of_boundary_elements_are_refused(self):
        for setting in ({"precision": "float"}, {"tolerance": 0.1}, {"domain": "exterior"},
                        {"patch_columns": True}, {"smooth_angle": 20}, {"estimate_error": False}):
            with self.assertRaisesRegex(palpate.Error, "makes no sense for method='halfspace'"):
                half_space(**setting)

    def test_what_is_no_half_space_is_refused(self):
        with self.assertRaisesRegex(palpate.Error, "off the plane of the surface"):
            palpate.precompute(sphere(1), YOUNG, POISSON, method="halfspace")
        fixed = np.zeros(disc().GetNumberOfPoints(), bool)
        fixed[5] = True
        with self.assertRaisesRegex(palpate.Error, "vertex 5 is fixed: a half-space needs no support"):
            half_space(fixed=fixed)
        with self.assertRaisesRegex(palpate.Error, "open boundary"):
            palpate.precompute(disc(), YOUNG, POISSON, fixed)

    def test_hostile_arrays_are_refused(self):
        def spoiled(change):
            model = half_space()
            change(model)
            with self.assertRaises(palpate.Error) as refused:
                palpate.stiffness(model)
            return str(refused.exception)

        self.assertIn("stale", spoiled(lambda m: m.GetPoints().SetPoint(3, -0.002, 0.0037, 0)))
        self.assertIn("stale", spoiled(lambda m: m.GetPoints().SetPoint(3, 0, 0, 0.01)))
        self.assertIn("stale", spoiled(lambda m: m.GetPointData().GetArray("BoundaryType").SetTuple1(0, 1)))
        self.assertIn("stale", spoiled(lambda m: m.GetFieldData().GetArray("PoissonRatio").SetTuple1(0, 0.2)))
        self.assertIn("open", spoiled(lambda m: m.GetFieldData().RemoveArray("GreensFunctionDomain")))
        self.assertIn("column", spoiled(
            lambda m: m.GetFieldData().GetArray("GreensFunctionNodes").SetTuple1(0, 10**9)))

    def test_the_filter_keeps_what_it_has(self):
        conditions = palpate.vtkReferenceBoundaryConditions()
        conditions.SetInputData(disc())
        conditions.SetYoungsModulus(YOUNG)
        conditions.SetPoissonRatio(POISSON)
        filter = palpate.vtkHalfSpaceGreensFunctions()
        filter.SetInputConnection(conditions.GetOutputPort())
        filter.Update()
        first = filter.GetOutput().GetFieldData().GetArray("GreensFunctionNodes")
        conditions.SetYoungsModulus(2 * YOUNG)
        filter.Update()
        self.assertIs(filter.GetOutput().GetFieldData().GetArray("GreensFunctionNodes"), first)


class Program(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.surface, self.model, self.out = (
            os.path.join(folder.name, name) for name in ("patch.vtp", "model.vtp", "out.vtp"))
        palpate.write(disc(), self.surface)
        self.made = run("precompute", self.surface, self.model, "--method", "halfspace", "--young", YOUNG,
                        "--poisson", POISSON)

    def test_makes_models_that_all_commands_take(self):
        self.assertEqual(self.made.returncode, 0, self.made.stderr)
        self.assertIn("reciprocity defect", self.made.stdout)
        require_all_commands(self, self.model, self.out, made_by="half-space (Boussinesq and Cerruti",
                             radius=0.01, tool_radius=0.02)

    def test_refuses_options_of_boundary_elements(self):
        for option in (("--precision", "float"), ("--tolerance", 0.1), ("--support-patch",),
                       ("--domain", "exterior"), ("--patch-columns",)):
            refused = run("precompute", self.surface, self.out, "--method", "halfspace", "--young", YOUNG,
                          "--poisson", POISSON, *option)
            self.assertNotEqual(refused.returncode, 0)
            self.assertIn(f"{option[0]} makes no sense with --method halfspace", refused.stderr)
            self.assertFalse(os.path.exists(self.out))


if __name__ == "__main__":
    unittest.main()
