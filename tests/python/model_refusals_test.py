# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Contacts, models and files that cannot be used: one sentence says why."""

import tempfile
import unittest
from pathlib import Path

import numpy as np

import palpate
from palpate.arrays import as_vtk
from palpate.errors import run
from support.refused import Refusals
from support.surfaces import copy_of, cube, lower_cap, points_of, sphere, sphere_model


class Contacts(Refusals):
    def test_nodes_that_do_not_exist_are_named(self):
        model = sphere_model(1)
        self.refused("vertex 42", palpate.solve, model, [42], [(0, 0, 1)])
        self.refused("vertex -1", palpate.solve, model, [-1], [(0, 0, 1)])

    def test_shapes_that_do_not_fit_are_named(self):
        model = sphere_model(1)
        self.refused("displacements must be 2 by 3", palpate.solve, model, [1, 2], [(0, 0, 1)])
        self.refused("free_tractions must be 42 by 3", palpate.solve, model, [], [],
                     free_tractions=[(0, 0, 1)])

    def test_values_that_are_not_finite_are_refused(self):
        model = sphere_model(1)
        node = int(palpate.greens_function_nodes(model)[0])
        self.refused("finite", palpate.solve, model, [node], [(0, 0, np.nan)])
        self.refused("finite", palpate.press, model, (0, 0, np.inf), force=(0, 0, 1))
        self.refused("finite", palpate.press, model, (0, 0, 1), force=(0, 0, np.nan))
        self.refused("finite", palpate.press, model, (0, 0, 1), displacement=(0, 0, np.inf))

    def test_results_that_would_not_be_finite_are_refused(self):
        model = sphere_model(1)
        node = int(palpate.greens_function_nodes(model)[0])
        self.refused("too large", palpate.solve, model, [node], [(0, 0, 1e308)])
        self.refused("too large", palpate.solve, model, [], [], free_tractions=np.full((42, 3), 1e308))
        self.refused("too large", palpate.press, model, (0, 0, 1), displacement=(0, 0, -1e308))
        self.refused("too large", palpate.press, model, (0, 0, 1), force=(0, 0, 1e308))

    def test_a_node_displaced_twice_is_refused(self):
        model = sphere_model(1)
        node = int(palpate.greens_function_nodes(model)[0])
        self.refused(f"node {node}", palpate.solve, model, [node, node], [(0, 0, 1), (0, 0, 2)])

    def test_a_fixed_node_moved_twice_is_refused(self):
        surface = sphere(1)
        model = palpate.precompute(surface, 1e4, 0.3, fixed=lower_cap(surface), columns=range(42))
        node = int(np.flatnonzero(lower_cap(surface))[0])
        self.refused(f"node {node} is constrained twice", palpate.solve, model, [node, node],
                     [(0, 0, 0.01), (0, 0, 0.01)])

    def test_columns_that_were_not_computed_are_named(self):
        surface = sphere(1)
        model = palpate.precompute(surface, 1e4, 0.3, fixed=lower_cap(surface), columns=[3])
        self.refused("node 7", palpate.solve, model, [7], [(0, 0, 1)])
        fixed = int(np.flatnonzero(lower_cap(surface))[0])
        self.refused(f"node {fixed}", palpate.solve, model, [fixed], [(0, 0, 1)])

    def test_press_takes_exactly_one_of_displacement_and_force(self):
        model = sphere_model(1)
        self.refused("either a displacement or a force", palpate.press, model, (0, 0, 1))
        self.refused("either a displacement or a force", palpate.press, model, (0, 0, 1),
                     displacement=(0, 0, 1), force=(0, 0, 1))
        self.refused("three components, not 2", palpate.press, model, (0, 0), force=(0, 0, 1))

    def test_masks_without_sense_are_named(self):
        model = sphere_model(1)
        self.refused("radius", palpate.stiffness, model, radius=-1)
        self.refused("radius", palpate.stiffness, model, radius=np.nan)
        self.refused("there is no mask 'x': choose one of linear, uniform, gaussian, hertzian, "
                     "gradient, biharmonic",
                     palpate.stiffness, model, radius=1, mask="x")
        self.refused("not both", palpate.stiffness, model, radius=1, radius_in_edges=1)
        self.refused("there is no distance 'x': choose one of euclidean, geodesic",
                     palpate.stiffness, model, radius=1, distance="x")
        self.refused("there is no measure 'x': choose one of vertex, mean",
                     palpate.stiffness, model, radius=1, measure="x")
        self.refused("a variational mask needs a radius", palpate.stiffness, model, mask="gradient")
        self.refused("torque must have three components", palpate.press, model, (0, 0, 1),
                     force=(0, 0, 1), radius=1, torque=(1, 2))
        self.refused("not a finite number", palpate.press, model, (0, 0, 1), force=(0, 0, 1), radius=1,
                     torque=(1, 2, np.inf))

    def test_masks_at_fixed_vertices_have_no_free_node(self):
        model = sphere_model(2)
        mask = palpate.vtkVertexPressureMask()
        mask.SetInputData(model)
        mask.SetVertex(int(np.argmin(points_of(model)[:, 2])))
        self.refused("free", run, mask)


class Staleness(Refusals):
    def test_surfaces_without_greens_functions_are_told_how_to_get_them(self):
        self.refused("palpate precompute", palpate.stiffness, sphere(1))
        self.refused("palpate precompute", palpate.solve, sphere(1), [], [])
        self.refused("palpate precompute", palpate.press, sphere(1), (0, 0, 1), force=(0, 0, 1))

    def test_vertices_taken_away_make_greens_functions_stale(self):
        model = copy_of(sphere_model(1))
        fewer = sphere(0)
        model.SetPoints(fewer.GetPoints())
        model.SetPolys(fewer.GetPolys())
        self.refused("the surface has changed since its Green's functions were computed; compute them "
                     "again", palpate.stiffness, model)

    def test_moved_points_make_greens_functions_stale(self):
        model = copy_of(sphere_model(1))
        points_of(model)[3] *= 1.0001
        self.refused("stale", palpate.stiffness, model)

    def test_another_support_makes_greens_functions_stale(self):
        model = copy_of(sphere_model(1))
        palpate.array(model, "BoundaryType")[0] ^= 1
        self.refused("stale", palpate.stiffness, model)

    def test_another_poisson_ratio_makes_greens_functions_stale(self):
        model = copy_of(sphere_model(1))
        palpate.array(model, "PoissonRatio")[0] = 0.4
        self.refused("stale", palpate.stiffness, model)

    def test_other_patches_make_greens_functions_stale(self):
        model = copy_of(sphere_model(1))
        palpate.array(model, "SmoothPatch")[0] += 1
        self.refused("stale", palpate.stiffness, model)

    def test_refinement_by_a_stock_filter_makes_greens_functions_stale(self):
        from vtkmodules.vtkFiltersModeling import vtkLinearSubdivisionFilter
        finer = vtkLinearSubdivisionFilter()
        finer.SetInputData(sphere_model(1))
        finer.Update()
        self.refused("compute them again", palpate.stiffness, finer.GetOutput())

    def test_models_without_their_matrix_are_refused(self):
        model = copy_of(sphere_model(1))
        model.GetFieldData().RemoveArray("GreensFunctions")
        self.refused("'GreensFunctions'", palpate.stiffness, model)
        model.GetFieldData().GetArray("GreensFunctionNodes").SetNumberOfTuples(0)
        self.refused("is empty", palpate.press, model, (0, 0, 1), force=(0, 0, 1))

    def test_matrices_of_two_precisions_are_refused(self):
        surface = cube(2)
        model = palpate.precompute(surface, 1, 0.3, fixed=points_of(surface)[:, 2] == 0,
                                   patch_columns=True)
        patches = palpate.array(model, "PatchGreensFunctions").astype(np.float32)
        model.GetFieldData().AddArray(as_vtk(patches, "PatchGreensFunctions", patches.shape[1],
                                             np.float32))
        self.refused("both hold doubles or both floats", palpate.solve, model, [], [])

    def test_damaged_matrices_are_refused(self):
        model = copy_of(sphere_model(1))
        palpate.greens_functions(model)[5, 2] = np.nan
        self.refused("not finite", palpate.stiffness, model)
        model = copy_of(sphere_model(1))
        palpate.greens_function_nodes(model)[0] = 10**6
        self.refused("column 0 names vertex 1000000", palpate.stiffness, model)


class Files(Refusals):
    def test_files_that_cannot_be_read_are_named(self):
        with tempfile.TemporaryDirectory() as folder:
            missing = Path(folder) / "none.vtp"
            self.refused("none.vtp: there is no such file", palpate.read, missing)
            odd = Path(folder) / "model.step"
            odd.write_text("solid")
            self.refused("choose .vtp, .stl, .obj, .ply or .off", palpate.read, odd)
            for kind in ("vtp", "stl", "obj", "ply", "off"):
                damaged = Path(folder) / f"damaged.{kind}"
                damaged.write_bytes(bytes(range(256)) * 4)
                self.refused(f"damaged.{kind}: ", palpate.read, damaged)
                empty = Path(folder) / f"empty.{kind}"
                empty.write_bytes(b"")
                self.refused(f"empty.{kind}: ", palpate.read, empty)

    def test_files_that_cannot_be_written_are_named_and_nothing_is_left(self):
        with tempfile.TemporaryDirectory() as folder:
            self.refused("models are written as .vtp", palpate.write, sphere(0),
                         Path(folder) / "a.stl")
            self.refused("cannot be written", palpate.write, sphere(0),
                         Path(folder) / "no" / "a.vtp")
            self.assertEqual(list(Path(folder).iterdir()), [])

    def test_examples_that_do_not_exist_list_those_that_do(self):
        self.refused("banana_seat, kidney, nodule, spatula", palpate.example, "heart")


if __name__ == "__main__":
    unittest.main()
