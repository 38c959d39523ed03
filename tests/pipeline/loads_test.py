# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Weights, foundations and bodies that nothing holds, through filters, files, program and package."""

import functools
import json
import os
import tempfile
import unittest

import numpy as np

import palpate
from support.refused import Refusals
from support.solids import bar, base_of, boundary_of, set_cells
from support.surfaces import copy_of, cube, failure_of, lower_cap, points_of, run, sphere, sphere_model

YOUNG = 1e4
LAYERS = (900.0, 1500.0)  # kg/m^3, of the lower and the upper half of a bar of height 2


@functools.lru_cache(maxsize=None)
def layered_bar():
    """Of finite elements, with all columns; nu = 0."""
    grid = bar((2, 2, 4))
    heights = np.array([np.mean([grid.GetPoint(grid.GetCell(c).GetPointId(k))[2] for k in range(4)])
                        for c in range(grid.GetNumberOfCells())])
    set_cells(grid, Density=np.where(heights > 1, LAYERS[1], LAYERS[0]))
    count = boundary_of(grid).GetNumberOfPoints()
    return palpate.precompute(grid, YOUNG, 0.0, fixed=base_of(grid), method="fem", estimate_error=False,
                              reciprocal=False, columns=np.arange(count))


class Gravity(Refusals):
    def test_shortens_a_bar_of_two_layers_by_what_each_bears(self):
        hung = palpate.gravity(layered_bar())
        g = 9.81
        below = -(LAYERS[1] * g + LAYERS[0] * g / 2) / YOUNG
        above = -LAYERS[1] * g / 2 / YOUNG
        top = points_of(hung)[:, 2] > 2 - 1e-9
        middle = top & (np.abs(points_of(hung)[:, :2] - 0.5).max(axis=1) < 0.1)
        self.assertAlmostEqual(palpate.array(hung, "Displacement")[middle, 2].mean() / (below + above), 1,
                               delta=0.01)
        areas, fixed = palpate.array(hung, "VertexArea"), palpate.array(hung, "BoundaryType") == 1
        reaction = areas[fixed] @ palpate.array(hung, "Traction")[fixed]
        np.testing.assert_allclose(reaction, (0, 0, sum(LAYERS) * g), rtol=1e-8, atol=1e-6)

    def test_turns_with_its_direction_and_grows_with_density(self):
        model = sphere_model()
        down = palpate.array(palpate.gravity(model, 1000), "Displacement")
        both = palpate.array(palpate.gravity(model, 2000, (1, 0, -9.81)), "Displacement")
        aside = palpate.array(palpate.gravity(model, 1000, (1, 0, 0)), "Displacement")
        np.testing.assert_allclose(both, 2 * (down + aside), atol=1e-12 * np.abs(both).max())
        self.assertEqual(np.abs(down[palpate.array(model, "BoundaryType") == 1]).max(), 0)

    def test_is_computed_once_for_all_directions(self):
        filter = palpate.vtkBodyForce()
        filter.SetInputData(sphere_model())
        filter.SetDensity(1000)
        first = palpate.array(palpate.gravity(sphere_model(), 1000, (0, 3, 0)), "Displacement")
        for direction in ((0, 0, -9.81), (0, 3, 0)):
            filter.SetAcceleration(direction)
            filter.Update()
        np.testing.assert_array_equal(palpate.array(filter.GetOutput(), "Displacement"), first)
        self.assertGreater(palpate.array(filter.GetOutput(), "LargestDisplacementGradient")[0], 0)

    def test_that_makes_no_sense_is_refused(self):
        self.refused("does not know its density", palpate.gravity, sphere_model())
        self.refused("density must be above 0", palpate.gravity, sphere_model(), -3)
        self.refused("acceleration", palpate.gravity, sphere_model(), 1000, (0, 0))
        self.refused("not a finite", palpate.gravity, sphere_model(), 1000, (0, 0, np.inf))
        surface = sphere()
        some = palpate.precompute(surface, YOUNG, 0.3, fixed=lower_cap(surface), columns=[3])
        self.refused("were not computed", palpate.gravity, some, 1000)
        edged = cube()
        sharp = palpate.precompute(edged, YOUNG, 0.3, fixed=points_of(edged)[:, 2] == 0)
        self.refused("--patch-columns", palpate.gravity, sharp, 1000)
        around = palpate.precompute(surface, YOUNG, 0.3, domain="exterior")
        self.refused("has no weight", palpate.gravity, around, 1000)
        filter = palpate.vtkBodyForce()
        filter.SetInputData(sphere_model())
        filter.SetDensity(-5)
        self.assertIn("must be a positive number", failure_of(filter))

    def test_that_a_file_carries_wrongly_is_refused(self):
        model = copy_of(layered_bar())
        array = model.GetFieldData().GetArray("WeightResponse")
        array.SetTuple(1, np.full(array.GetNumberOfComponents(), np.nan))
        self.refused("not finite", palpate.gravity, model)
        array.SetNumberOfTuples(2)
        self.refused("'WeightResponse' must hold", palpate.gravity, model)


class Foundation(Refusals):
    def test_bears_what_presses_on_it(self):
        # Without contraction each slice of a bar that is pressed evenly moves alike: p / k, p L / E.
        model = palpate.foundation(layered_bar(), normal=5e3)
        hung = palpate.gravity(model)
        base = points_of(hung)[:, 2] < 1e-9
        sunk = palpate.array(hung, "Displacement")[:, 2]
        self.assertAlmostEqual(sunk[base].mean() / (-sum(LAYERS) * 9.81 / 5e3), 1, delta=0.02)
        self.assertTrue((palpate.array(model, "BoundaryType") == 0).all())

    def test_gives_way_in_presses_stiffnesses_and_touch(self):
        surface = sphere()
        firm = palpate.precompute(surface, YOUNG, 0.3, fixed=lower_cap(surface),
                                  columns=np.arange(surface.GetNumberOfPoints()))
        soft = palpate.foundation(firm, normal=1e4, shear=3e3)
        pushes = [palpate.press(m, (0, 0, 1), force=(0, 0, -100), radius=0.5) for m in (firm, soft)]
        sunk = [palpate.array(p, "Displacement")[:, 2].min() for p in pushes]
        self.assertLess(sunk[1], 1.1 * sunk[0])
        norms = [np.nanmin(palpate.array(palpate.stiffness(m, radius=0.5), "StiffnessNorm"))
                 for m in (firm, soft)]
        self.assertLess(norms[1], norms[0])
        # The same springs at run time, as constraints that give way.
        solved = palpate.solve(firm, [], np.zeros((0, 3)),
                               free_tractions=palpate.array(pushes[0], "Traction")
                               * (palpate.array(firm, "BoundaryType") == 0)[:, None], foundation=1e4)
        even = palpate.press(palpate.foundation(firm, normal=1e4), (0, 0, 1), force=(0, 0, -100), radius=0.5)
        a, b = palpate.array(solved, "Displacement"), palpate.array(even, "Displacement")
        # But that a model's compliance is made reciprocal after the support is released.
        self.assertLess(np.abs(a - b).max(), 0.02 * np.abs(b).max())

    def test_of_springs_holds_a_body_that_nothing_else_does(self):
        surface = sphere()
        loose = palpate.precompute(surface, YOUNG, 0.3, domain="unsupported")
        springs = np.where(lower_cap(surface), 50.0, 0.0)
        held = palpate.foundation(loose, springs=springs)
        blocks = palpate.foundation(loose, springs=springs[:, None, None] * np.eye(3))
        pushed = [palpate.array(palpate.press(m, (0, 0, 1), force=(0, 0, -3), radius=0.5), "Displacement")
                  for m in (held, blocks)]
        np.testing.assert_allclose(*pushed, atol=1e-12)
        np.testing.assert_allclose(springs @ pushed[0], (0, 0, -3), atol=1e-9)

    def test_of_springs_bears_the_weight_of_what_nothing_else_holds(self):
        surface = sphere()
        springs = np.where(lower_cap(surface), 50.0, 0.0)
        grid = bar((2, 2, 4))
        set_cells(grid, Density=np.linspace(800, 1600, grid.GetNumberOfCells()))
        corners = np.where(base_of(grid), 900.0, 0.0)
        with tempfile.TemporaryDirectory() as folder:
            for body, stiffness, settings, volume in (
                    (surface, springs, {}, None), (grid, corners, {"method": "fem"}, 2)):
                loose = palpate.precompute(body, YOUNG, 0.3, domain="unsupported", estimate_error=False,
                                           **settings)
                path = os.path.join(folder, "loose.vtp")
                palpate.write(loose, path)
                density = 1000 if volume is None else None
                self.refused("falls freely", palpate.gravity, loose, density)
                hung = palpate.gravity(palpate.foundation(palpate.read(path), springs=stiffness), density)
                weight = (1000 * 4 / 3 * np.pi if volume is None
                          else volume * palpate.array(loose, "Density")[0]) * 9.81
                borne = stiffness @ palpate.array(hung, "Displacement")
                # The sphere's is that of its triangles, which cut some of it off.
                np.testing.assert_allclose(borne, (0, 0, -weight), rtol=0.05 if volume is None else 1e-9,
                                           atol=1e-6 * weight)

    def test_that_makes_no_sense_is_refused(self):
        surface = sphere()
        firm = sphere_model()
        self.refused("precompute with --support-columns", palpate.foundation, firm, 1e4)
        self.refused("no spring of any stiffness", palpate.foundation, firm)
        self.refused("at least 0", palpate.foundation, firm, -1)
        self.refused("shear must be at least 0", palpate.foundation, firm, 1, -1)
        self.refused("springs must be 162 values", palpate.foundation, firm, springs=[1, 2])
        self.refused("negative stiffness", palpate.foundation, firm, springs=-np.ones(162))
        self.refused("springs must be numbers", palpate.foundation, firm, springs="soft")
        loose = palpate.precompute(surface, YOUNG, 0.3, domain="unsupported")
        self.refused("a foundation lies under what is fixed", palpate.foundation, loose, 1e4)
        one = np.zeros(162)
        one[5] = 1
        self.refused("leave a motion of the body free", palpate.foundation, loose, springs=one)


class Probes(Refusals):
    """Inside bodies of several materials."""

    @staticmethod
    def model(**options):
        grid = bar((2, 2, 4))
        heights = np.array([np.mean([grid.GetPoint(grid.GetCell(c).GetPointId(k))[2] for k in range(4)])
                            for c in range(grid.GetNumberOfCells())])
        set_cells(grid, YoungsModulus=np.where(heights > 1, 5e4, 1e4), PoissonRatio=np.zeros(len(heights)))
        return palpate.precompute(grid, YOUNG, 0.0, fixed=base_of(grid), method="fem", estimate_error=False,
                                  **options)

    def test_read_what_a_slice_bears(self):
        places = [(0.45, 0.5, 0.6), (0.5, 0.55, 1.3)]
        model = self.model(probes=places)
        pushed = palpate.solve(model, [], np.zeros((0, 3)), free_tractions=np.where(
            points_of(model)[:, 2:] > 2 - 1e-9, (0, 0, -100.0), 0.0))
        top = points_of(model)[:, 2] > 2 - 1e-9
        force = 100 * palpate.array(model, "VertexArea")[top].sum()
        inside = palpate.probe(pushed, places)
        # The edges of the top bear more than their part, and a bar of two widths does not forget that.
        np.testing.assert_allclose(palpate.array(inside, "Stress")[:, 2], -force, rtol=0.25)
        ratio = palpate.array(inside, "Strain")[:, 2] / palpate.array(inside, "Stress")[:, 2]
        np.testing.assert_allclose(ratio, (1e-4, 2e-5), rtol=1e-6)
        self.assertTrue((palpate.array(inside, "InsideMaterial") == 1).all())
        self.refused("no probe at (0.5, 0.5, 0.5)", palpate.probe, pushed, [(0.5, 0.5, 0.5)])

    def test_stay_on_springs_and_follow_a_support_that_is_moved(self):
        place = (0.45, 0.5, 0.6)
        count = len(base_of(bar((2, 2, 4))))
        model = self.model(probes=[place, (0.5, 0.55, 1.3)], columns=np.arange(count))
        force = {"force": (0, 0, -50), "radius": 2}
        firm, soft = (palpate.probe(palpate.press(m, (0.5, 0.5, 2), **force), [place])
                      for m in (model, palpate.foundation(model, normal=1e3)))
        np.testing.assert_allclose(palpate.array(soft, "Stress")[0, 2], palpate.array(firm, "Stress")[0, 2],
                                   rtol=0.05)
        sunk = (palpate.array(soft, "Displacement") - palpate.array(firm, "Displacement"))[0, 2]
        self.assertAlmostEqual(sunk / (-50 / 1e3), 1, delta=0.05)
        fixed = np.flatnonzero(palpate.array(model, "BoundaryType"))
        lifted = palpate.solve(model, fixed, np.tile((0, 0.1, 0.2), (len(fixed), 1)))
        inside = palpate.probe(lifted, [place])
        np.testing.assert_allclose(palpate.array(inside, "Displacement"), [(0, 0.1, 0.2)], atol=1e-8)
        self.assertLess(np.abs(palpate.array(inside, "Strain")).max(), 1e-8)

    def test_are_chosen_where_one_material_is_put_on_springs(self):
        place = (0.1, 0.0, 0.3)
        surface = sphere()
        firm = palpate.precompute(surface, YOUNG, 0.3, fixed=lower_cap(surface),
                                  columns=np.arange(surface.GetNumberOfPoints()))
        stiff = palpate.foundation(firm, normal=1e9, probes=[place])
        soft = palpate.foundation(firm, normal=1e4)
        pushes = [palpate.press(m, (0, 0, 1), force=(0, 0, -100), radius=0.5) for m in (firm, stiff, soft)]
        stresses = [palpate.array(palpate.probe(p, [place]), "Stress") for p in pushes[:2]]
        np.testing.assert_allclose(*stresses, rtol=1e-3, atol=1e-3 * np.abs(stresses[0]).max())
        self.refused("foundation --probe", palpate.probe, pushes[2], [place])
        self.refused("is not inside the material", palpate.foundation, firm, 1e4, probes=[(0, 0, 2)])
        self.refused("no probe at (0.1, 0, 0.2)", palpate.foundation, self.model(probes=[(0.5, 0.5, 1)]),
                     springs=np.ones(len(base_of(bar((2, 2, 4))))), probes=[(0.1, 0, 0.2)])

    def test_that_make_no_sense_are_refused(self):
        self.refused("is not inside the body", self.model, probes=[(0.5, 0.5, 3)])
        self.refused("probes", self.model, probes=[(0.5, 0.5)])
        surface = sphere()
        self.refused("probes makes no sense", palpate.precompute, surface, YOUNG, 0.3,
                     fixed=lower_cap(surface), probes=[(0, 0, 0)])
        plain = self.model()
        pushed = palpate.press(plain, (0.5, 0.5, 2), force=(0, 0, -1), radius=0.5)
        self.refused("one isotropic material", palpate.probe, pushed, [(0.5, 0.5, 1)])
        damaged = copy_of(self.model(probes=[(0.5, 0.5, 1)]))
        damaged.GetFieldData().RemoveArray("ProbeStiffness")
        self.refused("'ProbeStiffness' must hold 36 by 1", palpate.press, damaged, (0.5, 0.5, 2), force=(0, 0, -1))


class Unsupported(Refusals):
    def test_bodies_shrink_under_pressure_and_stay_where_they_are(self):
        poisson, pressure = 0.3, 10.0
        expected = -(1 - 2 * poisson) / YOUNG * pressure  # of a ball's radius
        for method in ("bem", "fem"):
            model = palpate.precompute(sphere(2), YOUNG, poisson, domain="unsupported", method=method,
                                       estimate_error=False)
            squeezed = palpate.solve(model, [], np.zeros((0, 3)),
                                     free_tractions=-pressure * points_of(model))
            u = palpate.array(squeezed, "Displacement")
            radial = np.einsum("ij,ij->i", u, points_of(model))
            np.testing.assert_allclose(radial, expected, rtol=0.06)
            self.assertLess(np.abs(palpate.array(model, "VertexArea") @ u).max(), 1e-10)
            self.assertTrue((palpate.array(model, "BoundaryType") == 0).all())

    def test_a_surface_needs_no_support_array_even_if_its_filling_has_other_triangles(self):
        model = palpate.precompute(cube(4), YOUNG, 0.3, domain="unsupported", method="fem",
                                   estimate_error=False)
        self.assertTrue((palpate.array(model, "BoundaryType") == 0).all())

    def test_a_support_that_the_surface_has_is_not_read(self):
        surface = sphere_model()
        free = palpate.precompute(surface, YOUNG, 0.3, domain="unsupported")
        plain = palpate.precompute(sphere(), YOUNG, 0.3, domain="unsupported")
        np.testing.assert_allclose(palpate.greens_functions(free), palpate.greens_functions(plain))

    def test_what_makes_no_sense_is_refused(self):
        surface = sphere()
        self.refused("leave fixed out", palpate.precompute, surface, YOUNG, 0.3,
                     fixed=lower_cap(surface), domain="unsupported")
        self.refused("leave the columns out", palpate.precompute, surface, YOUNG, 0.3, columns=[1],
                     domain="unsupported")
        self.refused("domain='exterior' makes no sense", palpate.precompute, surface, YOUNG, 0.3,
                     domain="exterior", method="fem")
        self.refused("domain makes no sense", palpate.precompute, surface, YOUNG, 0.3,
                     domain="unsupported", method="halfspace")
        loose = palpate.precompute(surface, YOUNG, 0.3, domain="unsupported")
        self.refused("falls freely", palpate.gravity, loose, 1000)
        edged = palpate.precompute(cube(), YOUNG, 0.3, domain="unsupported")
        self.refused("without sharp edges", palpate.gravity,
                     palpate.foundation(edged, springs=np.ones(edged.GetNumberOfPoints())), 1000)


class Program(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.file = staticmethod(lambda name: os.path.join(folder.name, name))
        surface = sphere()
        palpate.write(surface, cls.file("ball.vtp"))
        cls.made = run("precompute", cls.file("ball.vtp"), cls.file("firm.vtp"), "--young", YOUNG, "--poisson",
                       0.3, "--fix-half-space", 0, 0, -0.7, 0, 0, 1, "--support-columns")

    def well(self, *arguments):
        done = run(*arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def badly(self, sentence, *arguments):
        done = run(*arguments)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn(sentence, done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1)

    def test_hangs_models_and_draws_them(self):
        self.assertEqual(self.made.returncode, 0, self.made.stderr)
        picture = self.file("hung.png")
        told = self.well("gravity", self.file("firm.vtp"), self.file("hung.vtp"), "--density", 1000, "--image",
                         picture)
        self.assertIn("sags most at", told)
        self.assertTrue(palpate.read(self.file("hung.vtp")).GetPointData().HasArray("Displacement"))
        with open(picture, "rb") as file:
            self.assertEqual(file.read(4), b"\x89PNG")
        self.badly("does not know its density", "gravity", self.file("firm.vtp"))
        self.badly("--density must be a positive", "gravity", self.file("firm.vtp"), "--density", 0)

    def test_puts_models_on_springs_that_all_commands_take(self):
        soft = self.file("soft.vtp")
        self.assertIn("on springs at", self.well("foundation", self.file("firm.vtp"), soft, "--stiffness", 1e4,
                                                 "--shear", 1e3, "--spring", 0, 0, 1, 5))
        self.well("press", soft, "--at", 0, 0, 1, "--force", 0, 0, -1, "--radius", 0.4)
        self.well("stiffness", soft, "--radius-edges", 2)
        self.well("touch", soft, "--tool-radius", 0.3, "--device", "simulated", "--headless", "--seconds", 0.2)
        self.assertIn("on springs at", self.well("info", soft))
        self.well("foundation", self.file("firm.vtp"), soft, "--stiffness", 1e4, "--probe", 0.1, 0, 0.2)
        told = self.well("press", soft, "--at", 0, 0, 1, "--force", 0, 0, -1, "--radius", 0.4, "--probe", 0.1, 0,
                         0.2)
        self.assertIn("von Mises stress, Pa", told)
        scene = self.file("scene.json")
        with open(scene, "w", encoding="utf-8") as file:
            file.write(json.dumps({
                "models": [{"file": "soft.vtp"}], "devices": [{"name": "hand", "type": "simulated"}],
                "tools": [{"shape": "sphere", "radius": 0.4, "device": "hand"}],
                "effects": {"probes": [{"name": "p", "inside": [0.1, 0, 0.2], "von_mises_limit": 1e-3}]}}))
        seen = run("touch", "--scene", scene, "--headless", "--seconds", 1.2)
        self.assertIn("a limit of the probe p was first exceeded", seen.stdout + seen.stderr)
        for sentence, arguments in (("no spring of any", ()), ("--shear goes with", ("--shear", 1)),
                                    ("three coordinates a place", ("--stiffness", 1, "--probe", 1, 2)),
                                    ("three coordinates and a stiffness", ("--spring", 1, 2, 3)),
                                    ("negative stiffness", ("--spring", 0, 0, 1, -3)),
                                    ("must be above 0 Pa/m", ("--stiffness", -1)),
                                    ("lets the body slide away", ("--stiffness", 1e4, "--shear", 0)),
                                    ("are its coordinates in metres?", ("--spring", 0, 0, 1000, 5))):
            self.badly(sentence, "foundation", self.file("firm.vtp"), self.file("none.vtp"), *arguments)
        self.assertFalse(os.path.exists(self.file("none.vtp")))

    def test_computes_bodies_that_nothing_holds(self):
        loose = self.file("loose.vtp")
        for method in ("bem", "fem"):
            self.well("precompute", self.file("ball.vtp"), loose, "--young", YOUNG, "--poisson", 0.3, "--domain",
                      "unsupported", "--method", method)
            self.well("press", loose, "--at", 0, 0, 1, "--force", 0, 0, -1, "--radius", 0.4)
            self.well("touch", loose, "--tool-radius", 0.3, "--device", "simulated", "--headless", "--seconds",
                      0.2)
        firm = self.file("without_columns.vtp")
        self.well("precompute", self.file("ball.vtp"), firm, "--young", YOUNG, "--poisson", 0.3, "--fix-half-space",
                  0, 0, -0.7, 0, 0, 1, "--no-estimate")
        self.badly("precompute with --support-columns", "foundation", firm, loose, "--stiffness", 1)
        self.badly("leave out what fixes them", "precompute", self.file("ball.vtp"), loose, "--domain",
                   "unsupported", "--fix-half-space", 0, 0, 0, 0, 0, 1)


if __name__ == "__main__":
    unittest.main()
