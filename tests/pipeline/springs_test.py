# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Spring supports and elastic foundations, while the model stays as it was computed."""

import unittest

import numpy as np

import palpate
from pipeline.capacitance_solve_test import by_height, model_with_all_columns, solver, table
from support.surfaces import failure_of, points_of, triangles_of

NONE = np.zeros((0, 3))


def loads(model, force):
    """Tractions that put a force on the top vertices."""
    top = by_height(7)
    tractions = np.zeros((model.GetNumberOfPoints(), 3))
    tractions[top] = np.asarray(force) / palpate.array(model, "VertexArea")[top].sum()
    return tractions


class Foundation(unittest.TestCase):
    def test_of_next_to_nothing_lets_the_body_move_as_a_rigid_one_on_springs(self):
        model = model_with_all_columns()
        fixed = palpate.array(model, "BoundaryType") == 1
        corners = points_of(model)[triangles_of(model)[fixed[triangles_of(model)].all(axis=1)]]
        across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        area = np.linalg.norm(across, axis=1).sum() / 2  # of what rests on it all over
        soft = 1e-2  # N/m^3, a body of 1e4 Pa and 1 m
        moved = palpate.solve(model, [], NONE, free_tractions=loads(model, (0, 0, -3)), foundation=soft)
        rise = palpate.array(moved, "Displacement")[:, 2]
        # The load and the support are centred but for the mesh, hence the median; the body's own share
        # is the ratio of stiffnesses.
        self.assertAlmostEqual(np.median(rise) / (-3 / (soft * area)), 1, delta=1e-3)
        self.assertAlmostEqual(palpate.array(moved, "ContactForce")[0, 2], 3, delta=1e-3)

    def test_that_is_very_stiff_is_the_support(self):
        model = model_with_all_columns()
        tractions = loads(model, (1, 0, -3))
        held = palpate.solve(model, [], NONE, free_tractions=tractions)
        firm = palpate.solve(model, [], NONE, free_tractions=tractions, foundation=1e10)
        a, b = palpate.array(held, "Displacement"), palpate.array(firm, "Displacement")
        self.assertLess(np.abs(a - b).max(), 1e-4 * np.abs(a).max())
        middle = palpate.solve(model, [], NONE, free_tractions=tractions, foundation=1e4)
        self.assertGreater(np.abs(palpate.array(middle, "Displacement")).max(), 1.1 * np.abs(a).max())

    def test_needs_the_columns_of_what_it_releases(self):
        kidney = palpate.precompute(palpate.read(palpate.example("kidney")), 8e3, 0.45)
        with self.assertRaisesRegex(palpate.Error, "column"):
            palpate.solve(kidney, [], NONE, foundation=1e5)


class Springs(unittest.TestCase):
    def test_bear_stiffness_times_stretch(self):
        model = model_with_all_columns()
        nodes = by_height(2)
        given, stiffness = np.array([(0, 0, -0.01), (0.004, 0, 0)]), np.array([20.0, 0.0])
        pressed = palpate.solve(model, nodes, given, springs=stiffness)
        u, p = (palpate.array(pressed, name)[nodes] for name in ("Displacement", "Traction"))
        areas = palpate.array(model, "VertexArea")[nodes]
        np.testing.assert_allclose(areas[0] * p[0], 20 * (given[0] - u[0]), atol=1e-9)
        np.testing.assert_allclose(u[1], given[1], atol=1e-15)
        np.testing.assert_allclose(palpate.array(pressed, "ContactForce")[0], areas @ p, atol=1e-12)

    def test_a_fixed_vertex_follows_its_spring(self):
        model = model_with_all_columns()
        node = int(np.argmin(points_of(model)[:, 2]))
        moved = palpate.solve(model, [node], [(0.01, 0, 0)], springs=[30.0])
        force = palpate.array(model, "VertexArea")[node] * palpate.array(moved, "Traction")[node]
        np.testing.assert_allclose(force, 30 * (np.array((0.01, 0, 0))
                                                - palpate.array(moved, "Displacement")[node]), atol=1e-9)

    def test_that_make_no_sense_are_refused(self):
        model = model_with_all_columns()
        node = by_height(1)
        for stiffness in (-1.0, np.nan, np.inf):
            self.assertIn("the spring of constraint 0", failure_of(
                solver(model, table(node, Displacement=[(0, 0, 1e-3)], SpringStiffness=[stiffness]))))
        self.assertIn("goes with a displacement", failure_of(
            solver(model, table(node, Traction=[(0, 0, 1)], BoundaryType=[0], SpringStiffness=[5]))))
        with self.assertRaisesRegex(palpate.Error, "springs must be 1 stiffnesses"):
            palpate.solve(model, node, [(0, 0, 1e-3)], springs=[1, 2])


if __name__ == "__main__":
    unittest.main()
