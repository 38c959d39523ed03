# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""vtkReferenceBoundaryConditions: what fixes a vertex."""

import unittest

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonDataModel import vtkPlane, vtkSelection, vtkSelectionNode

import palpate
from palpate.arrays import as_vtk
from support.surfaces import failure_of, points_of, sphere, triangles_of


def conditions(surface=None):
    algorithm = palpate.vtkReferenceBoundaryConditions()
    algorithm.SetInputData(surface or sphere(2))
    algorithm.SetYoungsModulus(1e4)
    algorithm.SetPoissonRatio(0.3)
    return algorithm


def types_of(algorithm):
    algorithm.Update()
    return palpate.array(algorithm.GetOutput(), "BoundaryType")


def selection_of(ids, field):
    node = vtkSelectionNode()
    node.SetFieldType(field)
    node.SetContentType(vtkSelectionNode.INDICES)
    node.SetSelectionList(numpy_to_vtkIdTypeArray(np.array(ids, dtype=np.int64), deep=True))
    selection = vtkSelection()
    selection.AddNode(node)
    return selection


class Sources(unittest.TestCase):
    def setUp(self):
        self.points = points_of(sphere(2))

    def test_a_half_space_fixes_what_lies_behind_its_plane(self):
        algorithm = conditions()
        algorithm.AddFixedHalfSpace((0, 0, -0.5), (0, 0, 2))
        self.assertTrue((types_of(algorithm) == (self.points[:, 2] <= -0.5)).all())
        self.assertEqual(types_of(algorithm).dtype, np.uint8)

    def test_a_box_fixes_what_lies_inside_or_on_it(self):
        algorithm = conditions()
        algorithm.AddFixedBox((0, 1, -1, 1, -1, 1))
        self.assertTrue((types_of(algorithm) == (self.points[:, 0] >= 0)).all())

    def test_a_ball_fixes_what_lies_inside_or_on_it(self):
        algorithm = conditions()
        algorithm.AddFixedSphere((0, 0, 1), 0.7)
        inside = np.linalg.norm(self.points - (0, 0, 1), axis=1) <= 0.7
        self.assertTrue(inside.any() and (types_of(algorithm) == inside).all())

    def test_an_implicit_function_fixes_where_it_is_not_positive(self):
        plane = vtkPlane()
        plane.SetOrigin(0, 0.2, 0)
        plane.SetNormal(0, -1, 0)
        algorithm = conditions()
        algorithm.SetFixedFunction(plane)
        self.assertTrue((types_of(algorithm) == (self.points[:, 1] >= 0.2)).all())
        plane.SetOrigin(0, 0.5, 0)  # a change of the function alone executes the filter again
        self.assertTrue((types_of(algorithm) == (self.points[:, 1] >= 0.5)).all())

    def test_a_selection_of_points_fixes_them(self):
        algorithm = conditions()
        algorithm.SetFixedSelectionData(selection_of([4, 9, 77], vtkSelectionNode.POINT))
        self.assertEqual(np.flatnonzero(types_of(algorithm)).tolist(), [4, 9, 77])

    def test_a_selection_of_cells_fixes_their_points(self):
        algorithm = conditions()
        algorithm.SetFixedSelectionData(selection_of([17], vtkSelectionNode.CELL))
        self.assertEqual(np.flatnonzero(types_of(algorithm)).tolist(),
                         sorted(triangles_of(sphere(2))[17].tolist()))

    def test_an_array_fixes_where_it_is_not_zero(self):
        surface = sphere(2)
        surface.GetPointData().AddArray(as_vtk(self.points[:, 2] < 0, "Held", 1))
        algorithm = conditions(surface)
        algorithm.SetFixedArrayName("Held")
        self.assertTrue((types_of(algorithm) == (self.points[:, 2] < 0)).all())
        algorithm.SetFixedArrayName("None")
        self.assertEqual(failure_of(algorithm), "there is no point array 'None' with a number a point")

    def test_sources_add_up_and_can_be_cleared(self):
        algorithm = conditions()
        algorithm.AddFixedHalfSpace((0, 0, -0.5), (0, 0, 1))
        algorithm.AddFixedHalfSpace((0, 0, 0.5), (0, 0, -1))
        algorithm.AddFixedSphere((1, 0, 0), 0.1)
        z = self.points[:, 2]
        expected = (np.abs(z) >= 0.5) | (np.linalg.norm(self.points - (1, 0, 0), axis=1) <= 0.1)
        self.assertTrue((types_of(algorithm) == expected).all())
        algorithm.ClearFixedRegions()
        algorithm.AddFixedBox((-1, 1, -1, 1, 0.5, 1))
        self.assertTrue((types_of(algorithm) == (z >= 0.5)).all())

    def test_without_a_source_the_surface_keeps_its_own(self):
        surface = sphere(2)
        surface.GetPointData().AddArray(
            as_vtk(self.points[:, 2] < -0.9, "BoundaryType", 1, np.uint8))
        self.assertTrue((types_of(conditions(surface)) == (self.points[:, 2] < -0.9)).all())


class Material(unittest.TestCase):
    def test_is_written_as_field_data_and_kept_where_not_given(self):
        first = conditions()
        first.AddFixedHalfSpace((0, 0, -0.5), (0, 0, 1))
        first.Update()
        second = palpate.vtkReferenceBoundaryConditions()
        second.SetInputData(first.GetOutput())
        second.SetPoissonRatio(0.4)
        second.Update()
        self.assertEqual(palpate.array(second.GetOutput(), "YoungsModulus").tolist(), [1e4])
        self.assertEqual(palpate.array(second.GetOutput(), "PoissonRatio").tolist(), [0.4])

    def test_out_of_range_is_refused(self):
        algorithm = conditions()
        algorithm.SetPoissonRatio(0.6)
        self.assertIn("0.6", failure_of(algorithm))

    def test_a_material_is_required_unless_it_will_be_identified(self):
        algorithm = palpate.vtkReferenceBoundaryConditions()
        algorithm.SetInputData(sphere(2))
        algorithm.AddFixedHalfSpace((0, 0, -0.5), (0, 0, 2))
        self.assertIn("give Young's modulus and Poisson's ratio", failure_of(algorithm))
        algorithm.RequireMaterialOff()
        self.assertEqual(failure_of(algorithm), "")
        self.assertTrue(types_of(algorithm).any())
        self.assertFalse(algorithm.GetOutput().GetFieldData().HasArray("YoungsModulus"))


if __name__ == "__main__":
    unittest.main()
