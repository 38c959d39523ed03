# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Estimated errors on models, and vtkToleranceGreensFunctions: the filter, the program, the package."""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

import palpate
from palpate.arrays import as_ids, as_vtk
from support.surfaces import (PROGRAM, copy_of, cube, failure_of, lower_cap, points_of, sphere,
                              sphere_model, volume)

KIDNEY = palpate.example("kidney")


def number(model, name):
    return float(palpate.array(model, name)[0])


def chooser(tolerance, levels=4, surface=None):
    algorithm = palpate.vtkToleranceGreensFunctions()
    algorithm.SetInputData(surface if surface is not None else palpate.read(KIDNEY))
    algorithm.SetErrorTolerance(tolerance)
    algorithm.SetMaximumNumberOfLevels(levels)
    algorithm.SetSubdivision(palpate.vtkSurfaceRefinement.LOOP)  # the kidney's vertices control it
    return algorithm


class Estimates(unittest.TestCase):
    def test_are_on_every_model_by_cause(self):
        model = sphere_model(2)
        parts = [number(model, name) for name in ("DiscretizationError", "IntegrationError", "SolverError",
                                                  "StorageError")]
        self.assertAlmostEqual(number(model, "ErrorEstimate"), sum(parts), delta=1e-12)
        self.assertGreater(min(parts), 0)
        self.assertGreater(number(model, "ContactErrorEstimate"), 0)
        self.assertGreaterEqual(number(model, "MostErrorEstimate"), number(model, "ErrorEstimate"))
        self.assertGreater(number(model, "ErrorLoadLength"), 0)

    def test_can_be_left_out(self):
        surface = sphere(1)
        model = palpate.precompute(surface, 1e4, 0.3, fixed=lower_cap(surface), estimate_error=False)
        self.assertEqual(number(model, "ErrorEstimate"), -1)
        self.assertNotIn("estimate", palpate.array(model, "StageNames"))

    def test_fall_when_the_support_has_a_patch_of_its_own(self):
        surface = palpate.refine(palpate.read(KIDNEY), 2)
        shared = palpate.precompute(surface, None, None)
        own = palpate.precompute(surface, None, None, support_patch=True)
        self.assertLess(number(own, "ErrorEstimate"), 0.5 * number(shared, "ErrorEstimate"))
        patches, fixed = palpate.array(own, "SmoothPatch"), palpate.array(own, "BoundaryType")
        self.assertEqual(len(set(patches)), 2)
        self.assertEqual(own.GetNumberOfPoints(), len(fixed))
        refined = palpate.refine(own, 1)  # inherits them, as the kidney's were given
        self.assertEqual(len(set(palpate.array(refined, "SmoothPatch"))), 2)

    def test_patches_that_were_found_and_split_are_found_anew_on_finer_meshes(self):
        surface = sphere(2)
        own = palpate.precompute(surface, 1, 0.3, fixed=lower_cap(surface), support_patch=True)
        self.assertEqual(len(set(palpate.array(own, "SmoothPatch"))), 2)
        self.assertFalse(palpate.refine(own, 1).GetCellData().HasArray("SmoothPatch"))

    def test_patches_of_a_support_go_with_it(self):
        surface = cube(2)
        fixed, half = points_of(surface)[:, 2] == 0, points_of(surface)[:, 0] <= 0.5
        model = palpate.precompute(surface, 1, 0.3, fixed=fixed, support_patch=True)
        self.assertEqual(len(set(palpate.array(model, "SmoothPatch"))), 6)
        again, fresh = (palpate.precompute(start, 1, 0.3, fixed=half, support_patch=True)
                        for start in (model, surface))
        self.assertGreater(len(set(palpate.array(fresh, "SmoothPatch"))), 6)
        self.assertTrue((palpate.array(again, "SmoothPatch") == palpate.array(fresh, "SmoothPatch")).all())
        self.assertTrue((palpate.greens_functions(again) == palpate.greens_functions(fresh)).all())

    def test_go_when_the_surface_is_refined(self):
        self.assertFalse(palpate.refine(sphere_model(1)).GetFieldData().HasArray("ErrorEstimate"))


class Tolerance(unittest.TestCase):
    def test_refines_until_the_estimate_meets_it(self):
        algorithm = chooser(0.1)
        algorithm.Update()
        model = algorithm.GetOutput()
        self.assertEqual(model.GetNumberOfPoints(), 322)
        self.assertLessEqual(number(model, "MostErrorEstimate"), 0.1)
        steps = palpate.array(model, "ToleranceSteps")
        self.assertEqual(len(steps), 3)
        self.assertIn("level 2, 322 vertices", steps[-1])
        self.assertIn("by a fifth within 10 %", steps[-1])
        self.assertFalse(np.isnan(palpate.array(palpate.stiffness(model, radius=0.016),
                                                "StiffnessNorm")).all())

    def test_is_the_same_surface_as_by_hand(self):
        surface = palpate.refine(palpate.read(KIDNEY), 2, limit_share=0.5)
        algorithm = chooser(0.1)
        algorithm.Update()
        self.assertTrue((points_of(algorithm.GetOutput()) == points_of(surface)).all())
        byhand = palpate.precompute(surface, None, None, precision="float", integration_tolerance=1e-3,
                                    support_patch=True)
        self.assertTrue((palpate.greens_functions(algorithm.GetOutput())
                         == palpate.greens_functions(byhand)).all())

    def test_takes_layers_along_the_rim_of_the_support_as_refined_by_hand(self):
        algorithm = chooser(0.05)
        algorithm.Update()
        model = algorithm.GetOutput()
        self.assertIn("with 1 layer along the rim of the support", palpate.array(model, "ToleranceSteps")[-1])
        surface = palpate.refine(palpate.read(KIDNEY), 2, support_layers=1, limit_share=0.5)
        self.assertTrue((points_of(model) == points_of(surface)).all())
        byhand = palpate.precompute(surface, None, None, precision="float", integration_tolerance=5e-4,
                                    support_patch=True)
        self.assertTrue((palpate.greens_functions(model) == palpate.greens_functions(byhand)).all())
        without = palpate.precompute(palpate.read(KIDNEY), None, None, tolerance=0.05, max_layers=0,
                                     subdivision="loop")
        self.assertNotIn("layer", " ".join(palpate.array(without, "ToleranceSteps")))

    def test_layers_carry_data_and_keep_the_surface(self):
        surface = cube(2)
        fixed = points_of(surface)[:, 2] == 0
        surface.GetPointData().AddArray(as_vtk(fixed, "BoundaryType", 1, np.uint8))
        surface.GetPointData().AddArray(as_vtk(points_of(surface), "Place", 3))
        layered = palpate.refine(surface, 0, "flat", support_layers=2)
        self.assertGreater(layered.GetNumberOfPoints(), surface.GetNumberOfPoints())
        self.assertAlmostEqual(volume(layered), volume(surface), delta=1e-12)
        self.assertLess(abs(palpate.array(layered, "Place") - points_of(layered)).max(), 1e-12)
        self.assertTrue((palpate.array(layered, "BoundaryType") == (points_of(layered)[:, 2] == 0)).all())
        with self.assertRaisesRegex(palpate.Error, "BoundaryType"):
            palpate.refine(cube(2), 0, "flat", support_layers=1)

    def test_keeps_data_on_the_surface(self):
        surface = copy_of(palpate.read(KIDNEY))
        tag = np.arange(surface.GetNumberOfPoints(), dtype=float)
        surface.GetPointData().AddArray(as_vtk(tag, "Tag", 1))
        model = palpate.precompute(surface, None, None, tolerance=0.1, subdivision="loop")
        self.assertTrue((palpate.array(model, "Tag")[:len(tag)] == tag).all())

    def test_keeps_a_surface_that_is_fine_enough(self):
        surface = sphere(2)
        surface.GetPointData().AddArray(as_vtk(lower_cap(surface), "BoundaryType", 1, np.uint8))
        model = palpate.precompute(surface, 1e4, 0.3, tolerance=0.4)
        self.assertEqual(model.GetNumberOfPoints(), 162)

    def test_keeps_a_control_mesh_that_may_not_be_refined(self):
        algorithm = chooser(0.9, levels=0)
        algorithm.Update()
        self.assertTrue((points_of(algorithm.GetOutput()) == points_of(palpate.read(KIDNEY))).all())

    def test_of_another_youngs_modulus_searches_no_more(self):
        surface = palpate.read(KIDNEY)
        conditions = palpate.vtkReferenceBoundaryConditions()
        conditions.SetInputData(surface)
        algorithm = chooser(0.1)
        algorithm.SetInputConnection(conditions.GetOutputPort())
        searched = []
        algorithm.AddObserver("ProgressEvent", lambda *_: searched.append(algorithm.GetProgressText()))
        compliances = []
        for young in (8e3, 16e3):
            searched.clear()
            conditions.SetYoungsModulus(young)
            algorithm.Update()
            model = algorithm.GetOutput()
            self.assertEqual("assemble" in searched, young == 8e3, searched)
            self.assertEqual(palpate.array(model, "YoungsModulus")[0], young)
            stiff = palpate.stiffness(model, radius=0.016)
            compliances.append(1 / np.nanmean(palpate.array(stiff, "StiffnessNorm")))
        self.assertAlmostEqual(compliances[0] / compliances[1], 2, delta=1e-9)

    def test_keeps_the_shape_of_a_cube(self):
        surface = cube(2)
        fixed = points_of(surface)[:, 2] == 0
        for subdivision in (None, "curved"):
            model = palpate.precompute(surface, 1e4, 0.3, fixed=fixed, tolerance=0.15,
                                       subdivision=subdivision)
            self.assertGreater(model.GetNumberOfPoints(), surface.GetNumberOfPoints())
            self.assertAlmostEqual(volume(model), volume(surface), delta=1e-12)
            self.assertFalse(model.GetFieldData().HasArray("Warnings"))

    def test_says_where_refinement_has_changed_the_shape(self):
        surface = cube(2)
        with self.assertWarnsRegex(palpate.ModelWarning, "changed the volume by -[0-9]+ %.*the curved or "
                                                         "the flat subdivision"):
            palpate.precompute(surface, 1e4, 0.3, fixed=points_of(surface)[:, 2] == 0, tolerance=0.15,
                               subdivision="loop")

    def test_limits_without_a_tolerance_are_refused(self):
        for settings in ({"max_levels": 1}, {"max_layers": 1}, {"max_vertices": 100},
                         {"subdivision": "flat"}):
            with self.assertRaisesRegex(palpate.Error, "go with a tolerance"):
                palpate.precompute(palpate.read(KIDNEY), None, None, **settings)

    def test_out_of_reach_is_refused_with_the_error_that_is(self):
        sentence = failure_of(chooser(0.01, levels=0))
        self.assertIn("a tolerance of 1 % is out of reach: level 0 with its 22 vertices has an estimated "
                      "error of", sentence)
        self.assertIn("out of reach", failure_of(chooser(1e-5)))

    def test_settings_that_it_chooses_are_refused(self):
        algorithm = chooser(0.1)
        algorithm.SetColumnNodes(as_ids(np.array([1]), "columns"))
        self.assertIn("columns cannot be chosen together with a tolerance", failure_of(algorithm))
        for settings in ({"precision": "float"}, {"columns": [1]}, {"integration_tolerance": 1e-3}):
            with self.assertRaisesRegex(palpate.Error, "a tolerance chooses"):
                palpate.precompute(palpate.read(KIDNEY), None, None, tolerance=0.1, **settings)

    def test_impossible_tolerances_are_refused(self):
        for tolerance in (0, -1, 1, float("nan")):
            self.assertIn("the tolerance must be above 0 and below 1", failure_of(chooser(tolerance)))

    def test_can_be_aborted(self):
        with self.assertRaises(palpate.Aborted):
            palpate.precompute(palpate.read(KIDNEY), None, None, tolerance=0.05, subdivision="loop",
                               progress=lambda fraction, stage: fraction < 0.5)


class Program(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.model = Path(folder.name) / "model.vtp"

    def run_program(self, *arguments):
        return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)

    def test_prints_what_it_tried_and_what_it_estimates(self):
        done = self.run_program("precompute", KIDNEY, self.model, "--tolerance", 0.1, "--subdivision", "loop")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout.count("tried"), 3)
        self.assertIn("estimated error", done.stdout)
        info = self.run_program("info", self.model).stdout
        for word in ("estimated error", "of contact compliances", "loads spread over", "by mesh"):
            self.assertIn(word, info)

    def test_refuses_in_one_line_and_writes_nothing(self):
        for arguments, sentence in ((("--tolerance", 1e-4), "out of reach"),
                                    (("--tolerance", 0.01, "--max-levels", 0), "out of reach"),
                                    (("--tolerance", 0.1, "--columns", 1), "--columns"),
                                    (("--tolerance", 2), "--tolerance"),
                                    (("--tolerance", 0.1, "--subdivision", "cubic"), "--subdivision"),
                                    (("--subdivision", "flat"), "--tolerance"),
                                    (("--max-levels", 1), "--tolerance")):
            done = self.run_program("precompute", KIDNEY, self.model, *arguments)
            self.assertGreater(done.returncode, 0, arguments)
            self.assertIn(sentence, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            self.assertFalse(os.path.exists(self.model))


if __name__ == "__main__":
    unittest.main()
