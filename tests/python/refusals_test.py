# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every call that cannot be answered ends in one sentence that says why."""

import tempfile
import unittest
from pathlib import Path

import numpy as np

import palpate
from palpate.arrays import as_vtk
from palpate.errors import run
from support.surfaces import (copy_of, cube, lower_cap, points_of, polydata, quad_cube, sphere,
                              sphere_model, triangles_of)


class Refusals(unittest.TestCase):
    def refused(self, sentence, call, *arguments, **options):
        """The call raises palpate.Error with a sentence of one line that holds `sentence`."""
        with self.assertRaises(palpate.Error) as caught:
            call(*arguments, **options)
        said = str(caught.exception)
        self.assertIn(sentence, said)
        self.assertNotIn("\n", said.strip())

    def precompute_refused(self, sentence, surface, **options):
        options = {"young": 1e4, "poisson": 0.3, "fixed": lower_cap(surface), **options}
        self.refused(sentence, palpate.precompute, surface, **options)


class Surfaces(Refusals):
    def changed(self, change_points=None, change_triangles=None):
        points, triangles = points_of(sphere(1)).copy(), triangles_of(sphere(1)).copy()
        if change_points:
            points = change_points(points)
        if change_triangles:
            triangles = change_triangles(triangles)
        return polydata(points, triangles)

    def test_non_finite_coordinates_are_named(self):
        def spoil(points):
            points[7, 1] = np.nan
            return points
        self.precompute_refused("non-finite coordinate: vertex 7", self.changed(spoil))

    def test_degenerate_faces_are_named(self):
        def spoil(triangles):
            triangles[5, 1] = triangles[5, 0]
            return triangles
        self.precompute_refused("degenerate triangle: triangle 5", self.changed(None, spoil))

    def test_open_boundaries_are_named(self):
        self.precompute_refused("open boundary: edge (", self.changed(None, lambda t: t[1:]))

    def test_inconsistent_orientation_is_named(self):
        def spoil(triangles):
            triangles[3] = triangles[3, ::-1].copy()
            return triangles
        self.precompute_refused("inconsistent orientation: ", self.changed(None, spoil))

    def test_inward_orientation_is_named(self):
        self.precompute_refused("inward orientation: ", self.changed(None, lambda t: t[:, ::-1].copy()))

    def test_duplicate_vertices_are_named(self):
        other = points_of(sphere(1))
        points = np.vstack([other, other])
        triangles = triangles_of(sphere(1))
        self.precompute_refused("duplicate vertex: vertex 42 lies on vertex 0", polydata(points, np.vstack([triangles,
                                                                             triangles + 42])))

    def test_unused_vertices_are_named(self):
        self.precompute_refused("unused vertex: vertex 42", self.changed(
            lambda points: np.vstack([points, [(0, 0, 3.0)]])))

    def test_non_manifold_edges_are_named(self):
        def spoil(triangles):
            fins = [(triangles[0, 0], triangles[0, 1], other) for other in (30, 31)]
            return np.vstack([triangles, fins])
        self.precompute_refused("non-manifold edge: edge (", self.changed(None, spoil))

    def test_vertices_where_two_fans_meet_are_named(self):
        points, triangles = points_of(sphere(1)), triangles_of(sphere(1))
        second = points + (0, 0, 2.0)
        top, bottom = int(np.argmax(points[:, 2])), int(np.argmin(points[:, 2]))
        joined = triangles + 42
        points = np.vstack([points, second])
        # The sphere has a vertex or an edge at each pole; join one vertex to one.
        points[42:] += points[top] - points[42 + bottom]
        joined = np.where(joined == 42 + bottom, top, joined)
        keep = np.delete(np.arange(84), 42 + bottom)
        number = np.zeros(84, int)
        number[keep] = np.arange(83)
        self.precompute_refused("non-manifold vertex: at vertex %d" % top,
                                polydata(points[keep], number[np.vstack([triangles, joined])]))

    def test_self_intersections_are_named(self):
        a, b = points_of(sphere(1)), points_of(sphere(1)) + (1.5, 0, 0)
        t = triangles_of(sphere(1))
        self.precompute_refused("self-intersection: triangles ", polydata(np.vstack([a, b]), np.vstack([t, t + 42])))

    def test_quadrilaterals_are_refused_with_the_cure(self):
        surface = quad_cube()
        self.precompute_refused("cell 0 has 4 corners: only triangles are allowed", surface,
                                fixed=points_of(surface)[:, 2] == 0)

    def test_an_empty_surface_is_refused(self):
        from vtkmodules.vtkCommonDataModel import vtkPolyData
        self.refused("no ", palpate.precompute, vtkPolyData(), 1e4, 0.3, fixed=[])

    def test_refinement_of_an_open_surface_is_refused(self):
        self.refused("open boundary", palpate.refine, self.changed(None, lambda t: t[1:]))
        self.refused("levels must be 0 to 8, not 9", palpate.refine, sphere(0), 9)
        self.refused("levels must be 0 to 8, not -1", palpate.refine, sphere(0), -1)


class Problems(Refusals):
    def test_materials_out_of_range_are_named(self):
        for young in (0, -1, np.inf):
            self.precompute_refused("Young's modulus", sphere(1), young=young)
        for poisson in (-1, 0.51, np.inf):
            self.precompute_refused("Poisson's ratio", sphere(1), poisson=poisson)

    def test_a_missing_material_is_said(self):
        self.precompute_refused("'YoungsModulus'", sphere(1), young=None)
        self.precompute_refused("'PoissonRatio'", sphere(1), poisson=None)

    def test_a_free_body_is_refused(self):
        self.precompute_refused("no fixed node", sphere(1), fixed=np.zeros(42, bool))

    def test_a_support_on_a_line_leaves_a_rotation_free(self):
        surface = cube(2)
        points = points_of(surface)
        edge = (points[:, 0] == 0) & (points[:, 2] == 0)
        self.precompute_refused("leave a rigid motion free (rotation about the axis", surface, fixed=edge)

    def test_every_body_needs_its_own_support(self):
        a, b = points_of(sphere(1)), points_of(sphere(1)) + (5, 0, 0)
        t = triangles_of(sphere(1))
        both = polydata(np.vstack([a, b]), np.vstack([t, t + 42]))
        fixed = np.concatenate([lower_cap(sphere(1)), np.zeros(42, bool)])
        self.precompute_refused("the body of vertex 42", both, fixed=fixed)

    def test_a_body_with_no_free_node_is_refused(self):
        self.precompute_refused("no free node", sphere(1), fixed=np.ones(42, bool))

    def test_boundary_types_other_than_0_and_1_are_named(self):
        surface = sphere(1)
        types = lower_cap(surface).astype(float)
        types[11] = 2
        surface.GetPointData().AddArray(as_vtk(types, "BoundaryType", 1))
        self.precompute_refused("node 11 must be 0 (free) or 1 (fixed)", surface, fixed=None)

    def test_missing_boundary_types_are_said(self):
        self.precompute_refused("no point array 'BoundaryType'", sphere(1), fixed=None)

    def test_fixed_of_another_size_is_refused(self):
        self.precompute_refused("fixed must hold 42 values", sphere(1), fixed=[True])

    def test_options_that_do_not_exist_list_those_that_do(self):
        for option, known in (("method", "bem"), ("precision", "double, mixed, float"),
                              ("domain", "interior, exterior"), ("collocation", "averaged, vertex")):
            self.precompute_refused(f"there is no {option} 'x': choose", sphere(1), **{option: "x"})
            self.precompute_refused(known, sphere(1), **{option: "x"})

    def test_tolerances_out_of_range_are_named(self):
        for tolerance in (-1e-3, 1, np.nan):
            self.precompute_refused("tolerance", sphere(1), tolerance=tolerance)
            self.precompute_refused("tolerance", sphere(1), integration_tolerance=tolerance)

    def test_smooth_angles_out_of_range_are_named(self):
        for angle in (-1, 181, np.nan):
            self.precompute_refused("angle", sphere(1), smooth_angle=angle)

    def test_smooth_patches_that_are_no_integers_are_named(self):
        for value in (np.nan, 0.5, 2.0**31, -np.inf):
            surface = sphere(1)
            patches = np.zeros(80)
            patches[7] = value
            surface.GetCellData().AddArray(as_vtk(patches, "SmoothPatch", 1))
            self.precompute_refused("the smooth patch of triangle 7 must be a whole number", surface)

    def test_values_that_are_no_numbers_are_refused(self):
        self.precompute_refused("Young's modulus must be a number, not NaN", sphere(1), young=np.nan)
        self.precompute_refused("Poisson's ratio must be a number, not NaN", sphere(1), poisson=np.nan)
        self.precompute_refused("Young's modulus must be a number", sphere(1), young="soft")
        self.precompute_refused("fixed must hold booleans", sphere(1), fixed=np.full(42, np.nan))
        self.refused("levels must be a whole number", palpate.refine, sphere(1), 1.5)

    def test_what_is_no_surface_is_refused(self):
        for call in (palpate.refine, palpate.repair, palpate.stiffness):
            self.refused("a surface must be a vtkPolyData, not NoneType", call, None)
        self.refused("vtkPolyData", palpate.precompute, None, 1, 0.3)
        self.refused("vtkPolyData", palpate.solve, "model", [], [])
        self.refused("vtkPolyData", palpate.press, None, (0, 0, 0), force=(0, 0, 1))

    def test_columns_that_are_no_vertices_are_refused(self):
        self.precompute_refused("whole numbers", sphere(1), columns=[3.7])
        self.precompute_refused("one a vertex", sphere(1), columns=[True, False])
        self.precompute_refused("columns to compute is empty", sphere(1), columns=[])
        self.precompute_refused(str(2**40), sphere(1), columns=[2**40])

    def test_columns_out_of_range_are_named(self):
        self.precompute_refused("42", sphere(1), columns=[42])
        self.precompute_refused("-1", sphere(1), columns=[-1])


class Arguments(Refusals):
    def test_of_any_kind_are_refused_with_one_sentence(self):
        array, ragged = np.random.default_rng(1).normal(size=(40, 40)), [[1], [2, 3]]
        for wrong in (["double"], array, None, 5, {}):
            for option in ("precision", "domain", "collocation", "method"):
                self.precompute_refused(f"there is no {option} ", sphere(1), **{option: wrong})
            self.refused("there is no mask ", palpate.stiffness, sphere_model(1), mask=wrong)
        for wrong in (-1, 1025, 2**31, np.inf, 10**400, array, "many"):
            self.precompute_refused("threads must be ", sphere(1), threads=wrong)
            self.refused("levels must be ", palpate.refine, sphere(1), wrong)
        for option in ("fixed", "columns"):
            self.precompute_refused(f"{option} must ", sphere(1), **{option: ragged})
        self.refused("nodes must be ", palpate.solve, sphere_model(1), ragged, [(0, 0, 1)] * 2)
        self.refused("displacements must be ", palpate.solve, sphere_model(1), [1, 2], ragged)
        for wrong in (5, "bar", array):
            self.precompute_refused("progress must be ", sphere(1), progress=wrong)
            self.refused("progress must be ", palpate.stiffness, sphere_model(1), progress=wrong)
        self.precompute_refused("reciprocal must be ", sphere(1), reciprocal=array)
        for wrong in (array, 10**400, [1, 2]):
            self.precompute_refused("tolerance must be a number", sphere(1), tolerance=wrong)
            self.precompute_refused("integration_tolerance must be a number", sphere(1),
                                    integration_tolerance=wrong)
            self.refused("rigid_stiffness must be a number", palpate.stiffness, sphere_model(1),
                         rigid_stiffness=wrong)

    def test_of_files_are_refused_with_one_sentence(self):
        for wrong in (None, 5, ["a"]):
            self.refused("a path must be a string", palpate.read, wrong)
            self.refused("a path must be a string", palpate.write, sphere(1), wrong)
        self.refused("null character", palpate.read, "a\0b.vtp")
        self.refused("null character", palpate.write, sphere(1), "a\0b.vtp")
        self.refused("a surface must be a vtkPolyData, not str", palpate.write, "x", "x.vtp")

    def test_that_carry_no_greens_functions_are_told_how_to_get_them(self):
        for ask in (palpate.greens_functions, palpate.greens_function_nodes):
            self.refused("compute them with palpate.precompute", ask, sphere(1))
            self.refused("a surface must be a vtkPolyData, not NoneType", ask, None)
        self.refused("not of NoneType", palpate.array, None, "Displacement")


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
