# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""vtkElasticMeshRepair and vtkSurfaceRefinement: what they do to data on the surface."""

import unittest

import numpy as np
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkStripper

import palpate
from palpate.arrays import as_vtk
from support.surfaces import (copy_of, cube, failure_of, points_of, polydata, quad_cube, sphere, sphere_model,
                              triangles_of, volume)


def repaired(surface):
    """The mended surface and what was changed."""
    algorithm = palpate.vtkElasticMeshRepair()
    algorithm.SetInputData(surface)
    algorithm.Update()
    output = algorithm.GetOutput()
    changes = (palpate.array(output, "RepairChanges")
               if output.GetFieldData().HasArray("RepairChanges") else [])
    return output, changes


class Repair(unittest.TestCase):
    def test_leaves_a_sound_surface_and_its_greens_functions_alone(self):
        model = sphere_model(1)
        output, changes = repaired(model)
        self.assertEqual(changes, [])
        self.assertTrue((points_of(output) == points_of(model)).all())
        self.assertTrue(output.GetFieldData().HasArray("GreensFunctions"))

    def test_cuts_quadrilaterals_into_triangles(self):
        output, changes = repaired(quad_cube())
        self.assertEqual(output.GetNumberOfCells(), 12)
        self.assertAlmostEqual(volume(output), 1, delta=1e-12)
        self.assertTrue(changes)

    def test_cuts_strips_into_triangles(self):
        strips = vtkStripper()
        strips.SetInputData(sphere(1))
        strips.Update()
        self.assertGreater(strips.GetOutput().GetNumberOfStrips(), 0)
        output, _ = repaired(strips.GetOutput())
        self.assertEqual(output.GetNumberOfCells(), 80)
        self.assertAlmostEqual(volume(output), volume(sphere(1)), delta=1e-12)

    def test_welds_a_soup_of_single_triangles(self):
        corners = points_of(sphere(1))[triangles_of(sphere(1))].reshape(-1, 3)
        output, changes = repaired(polydata(corners, np.arange(240).reshape(-1, 3)))
        self.assertEqual((output.GetNumberOfPoints(), output.GetNumberOfCells()), (42, 80))
        self.assertTrue(any("198" in change for change in changes), changes)  # 240 - 42 welded

    def test_fills_a_hole(self):
        output, changes = repaired(polydata(points_of(sphere(1)), triangles_of(sphere(1))[1:]))
        self.assertAlmostEqual(volume(output), volume(sphere(1)), delta=1e-9)
        self.assertTrue(any("hole" in change for change in changes), changes)

    def test_turns_flipped_triangles(self):
        triangles = triangles_of(sphere(1)).copy()
        triangles[::7] = triangles[::7, ::-1]
        output, _ = repaired(polydata(points_of(sphere(1)), triangles))
        self.assertAlmostEqual(volume(output), volume(sphere(1)), delta=1e-12)

    def test_keeps_point_and_cell_data_of_what_it_keeps(self):
        surface = polydata(np.vstack([points_of(sphere(1)), [(9, 9, 9)]]), triangles_of(sphere(1)))
        surface.GetPointData().AddArray(as_vtk(np.arange(43), "Number", 1))
        surface.GetCellData().AddArray(as_vtk(np.arange(80), "Face", 1))
        output, changes = repaired(surface)
        self.assertEqual(output.GetNumberOfPoints(), 42)
        self.assertTrue((palpate.array(output, "Number") == np.arange(42)).all())
        self.assertTrue((palpate.array(output, "Face") == np.arange(80)).all())
        self.assertEqual(len(changes), 1)

    def test_what_cannot_be_mended_is_a_sentence(self):
        lines = vtkPolyData()
        lines.SetPoints(vtkPoints())
        lines.GetPoints().InsertNextPoint(0, 0, 0)
        lines.GetPoints().InsertNextPoint(1, 0, 0)
        cells = vtkCellArray()
        cells.InsertNextCell(2, [0, 1])
        lines.SetLines(cells)
        algorithm = palpate.vtkElasticMeshRepair()
        algorithm.SetInputData(lines)
        self.assertIn("triangle", failure_of(algorithm))

    def test_nothing_but_noise_is_a_sentence_or_a_sound_surface(self):
        random = np.random.default_rng(5)
        for count in (1, 2, 5, 30):
            algorithm = palpate.vtkElasticMeshRepair()
            algorithm.SetInputData(polydata(random.normal(size=(12, 3)),
                                            random.integers(0, 12, size=(count, 3))))
            if not failure_of(algorithm):
                self.assertEqual(repaired(algorithm.GetOutput())[1], [])


class Refinement(unittest.TestCase):
    def refined(self, surface, levels=1):
        algorithm = palpate.vtkSurfaceRefinement()
        algorithm.SetInputData(surface)
        algorithm.SetNumberOfLevels(levels)
        algorithm.Update()
        return algorithm.GetOutput()

    def test_levels_compose(self):
        surface = palpate.read(palpate.example("spatula"))
        once_and_again = self.refined(self.refined(surface))
        twice = self.refined(surface, 2)
        self.assertTrue((triangles_of(twice) == triangles_of(once_and_again)).all())
        self.assertLess(np.abs(points_of(twice) - points_of(once_and_again)).max(), 1e-15)

    def test_limit_positions_are_those_of_any_level(self):
        surface = palpate.read(palpate.example("spatula"))
        limit = palpate.refine(surface, 0, limit_share=1)
        self.assertLess(np.abs(points_of(palpate.refine(surface, 2, limit_share=1))[:len(points_of(limit))]
                               - points_of(limit)).max(), 1e-15)
        half = palpate.refine(surface, 0, limit_share=0.5)
        self.assertLess(np.abs(2 * points_of(half) - points_of(limit) - points_of(surface)).max(), 1e-15)
        for subdivision in ("flat", "curved"):
            kept = palpate.refine(surface, 0, subdivision, limit_share=1)
            self.assertTrue((points_of(kept) == points_of(surface)).all())

    def test_a_share_beyond_the_limit_is_refused(self):
        for share in (-0.1, 1.1, float("nan")):
            with self.assertRaisesRegex(palpate.Error, "limit_share must be"):
                palpate.refine(cube(2), 1, limit_share=share)

    def test_flat_subdivision_keeps_the_body_and_curved_keeps_edges_and_rounds_the_rest(self):
        for surface, subdivision, expected in ((cube(2), "flat", 1), (cube(2), "curved", 1),
                                               (sphere(1), "flat", volume(sphere(1)))):
            fine = palpate.refine(surface, 2, subdivision)
            self.assertEqual(fine.GetNumberOfCells(), 16 * surface.GetNumberOfCells())
            self.assertAlmostEqual(volume(fine), expected, delta=1e-12)
        ball = palpate.refine(sphere(2), 1, "curved")
        self.assertLess(np.abs(np.linalg.norm(points_of(ball), axis=1) - 1).max(), 2e-3)
        self.assertGreater(volume(ball), volume(sphere(2)))

    def test_curved_subdivision_keeps_patches_through_all_levels(self):
        fine = palpate.refine(cube(2), 2, "curved")
        self.assertEqual(np.bincount(palpate.array(fine, "SmoothPatch")).tolist(), 6 * [8 * 16])
        self.assertFalse(fine.GetFieldData().HasArray("SmoothAngle"))
        with self.assertRaisesRegex(palpate.Error, "subdivision"):
            palpate.refine(cube(2), 1, "cubic")

    def test_an_edge_between_fixed_vertices_is_fixed(self):
        surface = palpate.read(palpate.example("kidney"))
        fine = self.refined(surface)
        types, before = palpate.array(fine, "BoundaryType"), palpate.array(surface, "BoundaryType")
        self.assertTrue((types[:22] == before).all())
        edges = {tuple(sorted((t[k], t[(k + 1) % 3]))) for t in triangles_of(surface) for k in range(3)}
        self.assertEqual(types.sum(), before.sum() + sum(before[a] and before[b] for a, b in edges))

    def test_point_data_are_the_mean_of_an_edges_ends_and_cell_data_are_inherited(self):
        surface = sphere(1)
        surface.GetPointData().AddArray(as_vtk(points_of(surface), "Coordinate", 3))
        surface.GetCellData().AddArray(as_vtk(np.arange(80), "Face", 1))
        fine = self.refined(surface)
        coordinate = palpate.array(fine, "Coordinate")
        self.assertTrue((coordinate[:42] == points_of(surface)).all())
        for child, parent in ((triangles_of(fine)[f], int(p)) for f, p in
                              enumerate(palpate.array(fine, "Face"))):
            corners = points_of(surface)[triangles_of(surface)[parent]]
            middles = (corners + np.roll(corners, -1, axis=0)) / 2
            allowed = np.vstack([corners, middles])
            for vertex in child:
                self.assertLess(np.abs(allowed - coordinate[vertex]).sum(axis=1).min(), 1e-14)

    def test_greens_functions_of_the_coarse_mesh_are_dropped(self):
        fine = self.refined(copy_of(sphere_model(1)))
        self.assertFalse(fine.GetFieldData().HasArray("GreensFunctions"))
        self.assertFalse(fine.GetFieldData().HasArray("MeshFingerprint"))
        self.assertFalse(fine.GetPointData().HasArray("VertexArea"))
        self.assertTrue(fine.GetFieldData().HasArray("YoungsModulus"))

    def test_patches_are_inherited_if_they_were_given_and_found_anew_if_not(self):
        surface = cube(2)
        model = palpate.precompute(surface, 1, 0.3, fixed=points_of(surface)[:, 2] == 0)
        fine = self.refined(model)
        self.assertFalse(fine.GetCellData().HasArray("SmoothPatch"))
        self.assertFalse(fine.GetFieldData().HasArray("SmoothAngle"))
        mine = np.arange(surface.GetNumberOfCells()) % 3
        given = copy_of(model)
        given.GetCellData().AddArray(as_vtk(mine, "SmoothPatch", 1, np.int32))
        self.assertEqual(np.bincount(palpate.array(self.refined(given), "SmoothPatch")).tolist(),
                         (4 * np.bincount(mine)).tolist())

    def test_the_limit_is_smooth(self):
        # Angles between neighbouring triangles halve with each level.
        surface = palpate.read(palpate.example("kidney"))
        angles = []
        for levels in (2, 3):
            fine = self.refined(surface, levels)
            a, b, c = (points_of(fine)[triangles_of(fine)[:, k]] for k in range(3))
            normals = np.cross(b - a, c - a)
            normals /= np.linalg.norm(normals, axis=1)[:, None]
            sides = {}
            for f, t in enumerate(triangles_of(fine)):
                for k in range(3):
                    sides.setdefault(tuple(sorted((t[k], t[(k + 1) % 3]))), []).append(f)
            cosines = np.array([normals[f] @ normals[g] for f, g in sides.values()])
            angles.append(np.sqrt(np.mean(np.arccos(np.clip(cosines, -1, 1))**2)))
        self.assertLess(angles[1], 0.6 * angles[0])


if __name__ == "__main__":
    unittest.main()
