# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces, problems and arguments that cannot be used: one sentence says why."""

import unittest

import numpy as np

import palpate
from palpate.arrays import as_vtk
from support.refused import Refusals
from support.surfaces import (cube, lower_cap, points_of, polydata, quad_cube, sphere, sphere_model,
                              triangles_of)


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


if __name__ == "__main__":
    unittest.main()
