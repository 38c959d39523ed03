# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The filters as citizens of VTK's pipeline: chained with stock filters, executed when needed."""

import tempfile
import unittest
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals
from vtkmodules.vtkFiltersGeneral import vtkWarpVector
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter

import palpate
from palpate.errors import silenced
from support.surfaces import Executions, copy_of, points_of, sphere, sphere_model

FILTERS = (palpate.vtkElasticMeshRepair, palpate.vtkSurfaceRefinement,
           palpate.vtkReferenceBoundaryConditions, palpate.vtkBoundaryElementGreensFunctions,
           palpate.vtkCapacitanceSolve, palpate.vtkVertexPressureMask, palpate.vtkSurfaceStiffness,
           palpate.vtkPointContact)


def updated(make, model):
    """A filter of a kind after its work on a model, at a free vertex where it asks for one."""
    algorithm = make()
    algorithm.SetInputData(model)
    if make is palpate.vtkVertexPressureMask:
        algorithm.SetVertex(int(palpate.greens_function_nodes(model)[0]))
    algorithm.Update()
    return algorithm


class Chain:
    """Reader, Palpate's filters, stock filters."""

    def __init__(self, path):
        self.reader = vtkXMLPolyDataReader()
        self.reader.SetFileName(str(path))
        self.refinement = palpate.vtkSurfaceRefinement()
        self.refinement.SetInputConnection(self.reader.GetOutputPort())
        self.conditions = palpate.vtkReferenceBoundaryConditions()
        self.conditions.SetInputConnection(self.refinement.GetOutputPort())
        self.bem = palpate.vtkBoundaryElementGreensFunctions()
        self.bem.SetInputConnection(self.conditions.GetOutputPort())
        self.contact = palpate.vtkPointContact()
        self.contact.SetInputConnection(self.bem.GetOutputPort())
        self.contact.SetPoint(0, 0, 0.03)
        self.contact.SetDisplacement(0, 0, -0.005)
        self.contact.SetRadius(0.015)
        self.warp = vtkWarpVector()
        self.warp.SetInputConnection(self.contact.GetOutputPort())
        self.warp.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS,
                                         "Displacement")
        self.normals = vtkPolyDataNormals()
        self.normals.SetInputConnection(self.warp.GetOutputPort())
        self.normals.SplittingOff()


class StockFilters(unittest.TestCase):
    def test_warp_and_normals_show_the_pressed_surface(self):
        chain = Chain(palpate.example("kidney"))
        chain.normals.Update()
        shown, pressed = chain.normals.GetOutput(), chain.contact.GetOutput()
        moved = points_of(pressed) + palpate.array(pressed, "Displacement")
        # vtkWarpVector keeps the precision of the points.
        self.assertLess(np.abs(points_of(shown) - moved).max(), 1e-15)
        self.assertTrue(shown.GetPointData().HasArray("Normals"))

    def test_only_what_depends_on_a_change_executes_again(self):
        chain = Chain(palpate.example("kidney"))
        counts = {name: Executions(getattr(chain, name))
                  for name in ("refinement", "conditions", "bem", "contact")}
        chain.normals.Update()
        chain.normals.Update()
        self.assertEqual([c.count for c in counts.values()], [1, 1, 1, 1])
        chain.contact.SetDisplacement(0, 0, -0.004)
        chain.normals.Update()
        self.assertEqual([c.count for c in counts.values()], [1, 1, 1, 2])
        chain.contact.SetDisplacement(0, 0, -0.004)
        chain.normals.Update()
        self.assertEqual(counts["contact"].count, 2)
        chain.conditions.SetPoissonRatio(0.4)
        chain.normals.Update()
        self.assertEqual([c.count for c in counts.values()], [1, 2, 2, 3])
        chain.bem.SetTolerance(1e-5)
        chain.normals.Update()
        self.assertEqual([c.count for c in counts.values()], [1, 2, 3, 4])

    def test_another_youngs_modulus_alone_scales_the_same_greens_functions(self):
        chain = Chain(palpate.example("kidney"))
        matrix = lambda: chain.bem.GetOutput().GetFieldData().GetArray("GreensFunctions")
        results = []
        for young in (8e3, 24e3):
            chain.conditions.SetYoungsModulus(young)
            chain.contact.Update()
            results.append((matrix(), *(palpate.array(chain.contact.GetOutput(), name)[0].copy() for
                            name in ("ContactForce", "RockingCompliance", "YoungsModulus"))))
        (first, force, rocking, _), (second, other_force, other_rocking, young) = results
        self.assertIs(first, second)
        self.assertEqual(young, 24e3)
        # The same products in another order: rounding.
        self.assertLess(np.abs(other_force - 3 * force).max(), 1e-14 * np.abs(other_force).max())
        self.assertAlmostEqual(other_rocking, rocking / 3, delta=1e-14 * rocking)
        fresh = palpate.precompute(chain.refinement.GetOutput(), 24e3, 0.45)
        pressed = palpate.press(fresh, (0, 0, 0.03), displacement=(0, 0, -0.005), radius=0.015)
        # Another factorisation: rounding times the condition number of about 1e3.
        self.assertLess(np.abs(palpate.array(pressed, "ContactForce")[0] - other_force).max(),
                        1e-11 * np.abs(force).max())

    def test_anything_but_youngs_modulus_computes_the_greens_functions_again(self):
        chain = Chain(palpate.example("kidney"))
        columns = palpate.arrays.as_ids([3], "columns")
        seen = []
        for change in (lambda: None, lambda: chain.conditions.SetPoissonRatio(0.4),
                       lambda: chain.conditions.AddFixedHalfSpace((0, 0, 0), (0, 0, 1)),
                       chain.bem.SetDomainToExterior,
                       lambda: chain.bem.SetTolerance(1e-5), lambda: chain.bem.SetSmoothAngle(5),
                       lambda: chain.bem.SetColumnNodes(columns),
                       lambda: (columns.SetValue(0, 7), columns.Modified()),
                       lambda: chain.refinement.SetNumberOfLevels(2)):
            change()
            chain.bem.Update()
            seen.append(chain.bem.GetOutput().GetFieldData().GetArray("GreensFunctions"))
            self.assertIsNot(seen[-1], None)
        self.assertEqual(len(set(seen)), len(seen))

    def test_a_name_set_again_executes_nothing_again(self):
        for make, name in ((palpate.vtkReferenceBoundaryConditions, "FixedArrayName"),
                           (palpate.vtkCapacitanceSolve, "TriangleTractionArrayName")):
            algorithm = make()
            getattr(algorithm, "Set" + name)("Mine")
            before = algorithm.GetMTime()
            getattr(algorithm, "Set" + name)("Mine")
            self.assertEqual(algorithm.GetMTime(), before)
            getattr(algorithm, "Set" + name)(None)
            self.assertGreater(algorithm.GetMTime(), before)

    def test_stock_writer_and_reader_keep_every_bit(self):
        model = sphere_model(1)
        with tempfile.TemporaryDirectory() as folder:
            path = str(Path(folder) / "model.vtp")
            writer = vtkXMLPolyDataWriter()
            writer.SetFileName(path)
            writer.SetInputData(model)
            self.assertTrue(writer.Write())
            reader = vtkXMLPolyDataReader()
            reader.SetFileName(path)
            reader.Update()
            back = reader.GetOutput()
        self.assertTrue((points_of(back) == points_of(model)).all())
        self.assertTrue((palpate.greens_functions(back) == palpate.greens_functions(model)).all())
        same = palpate.array(palpate.stiffness(back), "Stiffness")
        self.assertTrue((same == palpate.array(palpate.stiffness(model), "Stiffness")).all())

    def test_kept_greens_functions_after_a_warp_are_refused_as_stale(self):
        chain = Chain(palpate.example("kidney"))
        stiffness = palpate.vtkSurfaceStiffness()
        stiffness.SetInputConnection(chain.warp.GetOutputPort())
        with silenced(stiffness):
            stiffness.Update()
        self.assertIn("stale", stiffness.GetFailureMessage())
        self.assertEqual(stiffness.GetOutput().GetNumberOfPoints(), 0)


class EveryFilter(unittest.TestCase):
    def test_passes_on_arrays_that_it_does_not_know(self):
        for make in FILTERS:
            model = copy_of(sphere_model(1))
            model.GetPointData().AddArray(palpate.arrays.as_vtk(np.arange(42), "Mine", 1))
            algorithm = updated(make, model)
            mine = palpate.array(algorithm.GetOutput(), "Mine")
            self.assertTrue((mine[:42] == np.arange(42)).all(), make.__name__)

    def test_leaves_its_input_alone(self):
        for make in FILTERS:
            model = copy_of(sphere_model(1))
            before = [model.GetPointData().GetArrayName(i)
                      for i in range(model.GetPointData().GetNumberOfArrays())]
            points, fields = points_of(model).copy(), model.GetFieldData().GetNumberOfArrays()
            algorithm = updated(make, model)
            after = [model.GetPointData().GetArrayName(i)
                     for i in range(model.GetPointData().GetNumberOfArrays())]
            self.assertEqual(before, after, make.__name__)
            self.assertEqual(fields, model.GetFieldData().GetNumberOfArrays(), make.__name__)
            self.assertTrue((points == points_of(model)).all(), make.__name__)

    def test_drops_results_that_hold_no_longer(self):
        model = palpate.stiffness(palpate.press(sphere_model(1), (0, 0, 1), force=(0, 0, -1)))
        model = palpate.solve(model, [], [])
        stiff = ("Stiffness", "StiffnessNorm", "StiffnessAsymmetry", "StiffnessLimited",
                 "HapticRatio")
        pressed = ("ContactPoint", "ElasticContactPoint", "HapticContactPoint")
        solved = ("Displacement", "Traction", "ContactForce", "ContactTorque", "ContactCondition")

        def names(surface):
            return {data.GetArrayName(i) for data in (surface.GetPointData(), surface.GetFieldData())
                    for i in range(data.GetNumberOfArrays())}

        self.assertTrue(names(model).issuperset(stiff + solved))
        self.assertTrue(names(model).isdisjoint(pressed))
        again = palpate.press(model, (0, 0, 1), force=(0, 0, -1))
        self.assertTrue(names(again).issuperset(stiff + pressed))
        self.assertTrue(names(again).isdisjoint(("ContactTorque", "ContactCondition")))
        for make in FILTERS[1:4]:
            left = names(updated(make, again).GetOutput())
            self.assertTrue(left.isdisjoint(stiff + pressed + solved), make.__name__)

    def test_fails_with_one_error_event_and_an_empty_output(self):
        surface = sphere(1)
        surface.GetPolys().GetConnectivityArray().SetValue(0, 5)  # no longer closed
        for make in FILTERS[1:]:
            algorithm = make()
            algorithm.SetInputData(surface)
            errors = []
            algorithm.AddObserver("ErrorEvent", lambda *_: errors.append(1))
            with silenced(algorithm):
                algorithm.Update()
            if make is palpate.vtkReferenceBoundaryConditions:
                self.assertIn("YoungsModulus", algorithm.GetFailureMessage())
            self.assertEqual(len(errors), 1, make.__name__)
            self.assertTrue(algorithm.GetFailureMessage(), make.__name__)
            self.assertEqual(algorithm.GetOutput().GetNumberOfPoints(), 0, make.__name__)

    def test_recovers_when_its_input_is_mended(self):
        algorithm = palpate.vtkSurfaceStiffness()
        algorithm.SetInputData(sphere(1))
        with silenced(algorithm):
            algorithm.Update()
        self.assertTrue(algorithm.GetFailureMessage())
        algorithm.SetInputData(sphere_model(1))
        algorithm.Update()
        self.assertEqual(algorithm.GetFailureMessage(), "")
        self.assertEqual(algorithm.GetOutput().GetNumberOfPoints(), 42)

    def test_prints_its_parameters(self):
        for make in FILTERS:
            self.assertIn("FailureMessage", str(make()), make.__name__)

    def test_says_without_input_that_one_is_missing(self):
        for make in FILTERS:
            algorithm = make()
            errors = []
            algorithm.GetExecutive().AddObserver("ErrorEvent", lambda *_: errors.append(1))
            algorithm.Update()
            self.assertTrue(errors, make.__name__)


class Abort(unittest.TestCase):
    def test_leaves_an_empty_output_and_the_next_update_computes(self):
        conditions = palpate.vtkReferenceBoundaryConditions()
        conditions.SetInputData(sphere(3))
        conditions.SetYoungsModulus(1)
        conditions.SetPoissonRatio(0.3)
        conditions.AddFixedHalfSpace((0, 0, -0.7), (0, 0, 1))
        bem = palpate.vtkBoundaryElementGreensFunctions()
        bem.SetInputConnection(conditions.GetOutputPort())
        tag = bem.AddObserver("ProgressEvent", lambda *_: bem.SetAbortExecute(1))
        bem.Update()
        self.assertEqual(bem.GetOutput().GetNumberOfPoints(), 0)
        bem.RemoveObserver(tag)
        bem.Modified()
        bem.Update()
        self.assertEqual(bem.GetOutput().GetNumberOfPoints(), 642)


class Memory(unittest.TestCase):
    def test_the_matrix_is_shared_down_the_pipeline_not_copied(self):
        model = sphere_model(1)
        pressed = palpate.press(model, (0, 0, 1), force=(0, 0, -1))
        self.assertIs(pressed.GetFieldData().GetArray("GreensFunctions"),
                      model.GetFieldData().GetArray("GreensFunctions"))
        view = palpate.greens_functions(model)
        matrix = vtk_to_numpy(model.GetFieldData().GetArray("GreensFunctions"))
        self.assertTrue(np.shares_memory(view, matrix))

    def test_results_outlive_the_filters_that_made_them(self):
        def pressed():
            surface = sphere(1)
            model = palpate.precompute(surface, 1e4, 0.3, fixed=points_of(surface)[:, 2] < -0.7)
            return palpate.press(model, (0, 0, 1), force=(0, 0, -1))
        result = pressed()
        again = palpate.press(result, (0, 0, 1), force=(0, 0, -1))
        self.assertTrue((palpate.array(again, "Displacement")
                         == palpate.array(result, "Displacement")).all())


if __name__ == "__main__":
    unittest.main()
