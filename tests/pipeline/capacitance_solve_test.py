# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""vtkCapacitanceSolve: constraints from a table or from points."""

import functools
import unittest

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkTable

import palpate
from palpate.arrays import as_ids, as_vtk
from support.surfaces import (Executions, failure_of, lower_cap, points_of, polydata, sphere,
                              sphere_model)


def table(nodes, **columns):
    """Constraints; columns by array name, as n by components."""
    result = vtkTable()
    result.GetRowData().AddArray(as_ids(nodes, "Node"))
    for name, values in columns.items():
        values = np.asarray(values, dtype=float).reshape(len(nodes), -1)
        result.GetRowData().AddArray(as_vtk(values, name, values.shape[1]))
    return result


def solver(model, constraints):
    algorithm = palpate.vtkCapacitanceSolve()
    algorithm.SetInputData(model)
    algorithm.SetConstraintsData(constraints)
    return algorithm


def solved(model, constraints):
    algorithm = solver(model, constraints)
    algorithm.Update()
    return algorithm.GetOutput()


@functools.lru_cache(maxsize=None)
def model_with_all_columns(fixed_below=-0.7, reciprocal=False):
    surface = sphere(2)
    return palpate.precompute(surface, 1e4, 0.3, fixed=lower_cap(surface, fixed_below),
                              columns=range(162), reciprocal=reciprocal)


def by_height(count):
    """The highest vertices."""
    return np.argsort(points_of(sphere(2))[:, 2], kind="stable")[-count:].tolist()


class Constraints(unittest.TestCase):
    def test_from_a_table_and_from_points_are_the_same(self):
        nodes, values = by_height(3), [(0, 0, 1e-2), (0, 1e-3, 0), (1e-3, 0, 0)]
        points = polydata(np.zeros((3, 3)), [(0, 1, 2)])
        points.GetPointData().AddArray(as_ids(nodes, "Node"))
        points.GetPointData().AddArray(as_vtk(values, "Displacement", 3))
        a = solved(sphere_model(2), table(nodes, Displacement=values))
        b = solved(sphere_model(2), points)
        self.assertTrue((palpate.array(a, "Displacement") == palpate.array(b, "Displacement")).all())

    def test_along_a_direction_leave_the_other_components_without_traction(self):
        node = by_height(1)[0]
        direction = np.array((1.0, 2.0, 2.0))
        result = solved(sphere_model(2), table([node], Displacement=[(0, 0, 3e-2)],
                                               Direction=[direction]))
        moved = palpate.array(result, "Displacement")[node]
        traction = palpate.array(result, "Traction")[node]
        unit = direction / 3
        self.assertAlmostEqual(moved @ unit, unit @ (0, 0, 3e-2), delta=1e-14)
        self.assertLess(np.linalg.norm(traction - unit * (traction @ unit)),
                        1e-13 * np.linalg.norm(traction))
        self.assertGreater(np.linalg.norm(moved - unit * (moved @ unit)), 1e-4)

    def test_three_directions_are_the_whole_vector(self):
        node, value = by_height(1)[0], (1e-2, -2e-2, 3e-2)
        whole = solved(sphere_model(2), table([node], Displacement=[value]))
        parts = solved(sphere_model(2), table([node] * 3, Displacement=[value] * 3,
                                              Direction=np.eye(3)))
        a, b = (palpate.array(r, "Displacement") for r in (whole, parts))
        self.assertLess(np.abs(a - b).max(), 1e-13 * np.abs(a).max())

    def test_along_a_direction_load_only_that_component(self):
        node = by_height(1)[0]
        one = solved(sphere_model(2), table([node], Traction=[(1, 1, 1)], BoundaryType=[0],
                                            Direction=[(0, 0, 2)]))
        whole = solved(sphere_model(2), table([node], Traction=[(0, 0, 1)], BoundaryType=[0]))
        a, b = (palpate.array(r, "Displacement") for r in (one, whole))
        self.assertLess(np.abs(a - b).max(), 1e-15 * np.abs(b).max())

    def test_by_zone_give_a_force_and_a_torque_each(self):
        points = points_of(sphere(2))
        nodes = by_height(3) + np.argsort(points[:, 0])[-2:].tolist()
        values = np.random.default_rng(3).normal(size=(5, 3)) * 1e-2
        zones = [0, 0, 0, 7, 7]
        result = solved(sphere_model(2), table(nodes, Displacement=values, Zone=zones))
        force, torque = (palpate.array(result, name) for name in ("ContactForce", "ContactTorque"))
        self.assertEqual((force.shape, torque.shape), ((2, 3), (2, 3)))
        each = palpate.array(result, "VertexArea")[:, None] * palpate.array(result, "Traction")
        for row, members in enumerate((nodes[:3], nodes[3:])):
            arms = points[members] - points[members].mean(axis=0)
            self.assertLess(np.abs(force[row] - each[members].sum(axis=0)).max(), 1e-12)
            self.assertLess(np.abs(torque[row] - np.cross(arms, each[members]).sum(axis=0)).max(),
                            1e-12)

    def test_released_and_fixed_again_elsewhere_is_another_models_answer(self):
        # Moving the support by releases and contacts must be what a model with that support says.
        surface = sphere(2)
        low, lower = lower_cap(surface, -0.7), lower_cap(surface, -0.8)
        released = np.flatnonzero(low & ~lower)
        top = by_height(4)
        held = palpate.precompute(surface, 1e4, 0.3, fixed=lower, columns=range(162),
                                  reciprocal=False)
        self.assertGreater(released.size, 2)
        direct = solved(held, table(top, Displacement=np.tile((0, 0, -1e-2), (4, 1))))
        switched = solved(model_with_all_columns(), table(
            top + released.tolist(), BoundaryType=[1] * 4 + [0] * released.size,
            Displacement=[(0, 0, -1e-2)] * 4 + [(0, 0, 0)] * released.size,
            Traction=np.zeros((4 + released.size, 3))))
        a, b = (palpate.array(r, "Displacement") for r in (direct, switched))
        # One traction vector a vertex stands for its patches, of which a smooth sphere has one.
        self.assertLess(np.abs(a - b).max(), 1e-9 * np.abs(a).max())

    def test_loads_on_free_vertices_superpose(self):
        nodes, loads = by_height(2), np.array([(0, 0, 50.0), (30.0, 0, 0)])
        together = solved(sphere_model(2), table(nodes, Traction=loads, BoundaryType=[0, 0]))
        one, other = (solved(sphere_model(2), table([n], Traction=[t], BoundaryType=[0]))
                      for n, t in zip(nodes, loads))
        a = palpate.array(together, "Displacement")
        b = palpate.array(one, "Displacement") + palpate.array(other, "Displacement")
        self.assertLess(np.abs(a - b).max(), 1e-14 * np.abs(a).max())

    def test_without_a_table_the_reference_problem_is_solved(self):
        algorithm = palpate.vtkCapacitanceSolve()
        algorithm.SetInputData(sphere_model(1))
        algorithm.Update()
        self.assertEqual(np.abs(palpate.array(algorithm.GetOutput(), "Displacement")).max(), 0)


class Refusals(unittest.TestCase):
    def test_release_of_the_whole_support_is_refused(self):
        fixed = np.flatnonzero(lower_cap(sphere(2)))
        sentence = failure_of(solver(model_with_all_columns(), table(
            fixed, BoundaryType=[0] * fixed.size, Traction=np.zeros((fixed.size, 3)))))
        self.assertIn("rigid motion", sentence)

    def test_nodes_constrained_twice_are_named(self):
        free, fixed = by_height(1)[0], int(np.argmin(points_of(sphere(2))[:, 2]))
        model = model_with_all_columns()
        for node, kind in ((free, 1), (free, 0), (fixed, 1), (fixed, 0)):
            for directions in ([(0, 0, 0)] * 2, [(0, 0, 1)] * 2):
                sentence = failure_of(solver(model, table(
                    [node] * 2, Displacement=[(0, 0, 1e-2)] * 2, Traction=[(0, 0, 1)] * 2,
                    BoundaryType=[kind] * 2, Direction=directions)))
                self.assertEqual(sentence,
                                 f"node {node} is constrained twice along the same direction")
        for node, kind in ((free, 0), (fixed, 1)):
            sentence = failure_of(solver(model, table(
                [node] * 2, Displacement=[(0, 0, 1e-2)] * 2, Traction=[(0, 0, 1)] * 2,
                BoundaryType=[kind] * 2, Direction=[(0, 0, 1), (0, 1, 1)])))
            self.assertIn(f"node {node} is constrained along directions that are not", sentence)

    def test_arrays_of_other_shapes_are_named(self):
        self.assertIn("'Displacement' must have 3 components, not 2",
                      failure_of(solver(sphere_model(1), table([0], Displacement=[(0, 0)]))))
        nameless = table([0])
        nameless.GetRowData().RemoveArray("Node")
        nameless.GetRowData().AddArray(as_vtk([(0, 0, 0)], "Displacement", 3))
        self.assertIn("'Node'", failure_of(solver(sphere_model(1), nameless)))

    def test_tables_whose_columns_differ_in_length_are_refused(self):
        constraints = table([0, 1, 2], Displacement=np.zeros((3, 3)))
        constraints.GetRowData().GetArray("Displacement").SetNumberOfTuples(1)
        self.assertIn("'Displacement' must have 3 tuples", failure_of(
            solver(sphere_model(1), constraints)))

    def test_boundary_types_other_than_0_and_1_are_named(self):
        for kind in (7, np.nan):
            self.assertIn("boundary type of constraint 0", failure_of(
                solver(sphere_model(1), table([0], BoundaryType=[kind]))))

    def test_nodes_out_of_range_are_named(self):
        for node in (42, -1, 2**40):
            self.assertIn(f"vertex {node}", failure_of(
                solver(sphere_model(1), table([node], Displacement=[(0, 0, 0)]))))

    def test_missing_triangle_tractions_are_named(self):
        algorithm = solver(sphere_model(1), table([]))
        algorithm.SetTriangleTractionArrayName("Load")
        self.assertEqual(failure_of(algorithm), "there is no cell array 'Load' of three components")


class Execution(unittest.TestCase):
    def test_follows_the_constraints(self):
        node = by_height(1)[0]
        constraints = table([node], Displacement=[(0, 0, 1e-2)])
        algorithm = solver(sphere_model(2), constraints)
        runs = Executions(algorithm)
        for height in (1e-2, 1e-2, 2e-2):
            array = constraints.GetRowData().GetArray("Displacement")
            if array.GetComponent(0, 2) != height:
                array.SetComponent(0, 2, height)
                array.Modified()
                constraints.Modified()
            algorithm.Update()
            moved = palpate.array(algorithm.GetOutput(), "Displacement")[node, 2]
            self.assertAlmostEqual(moved, height, delta=1e-15)
        self.assertEqual(runs.count, 2)


if __name__ == "__main__":
    unittest.main()
