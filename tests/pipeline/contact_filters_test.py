# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""vtkVertexPressureMask, vtkSurfaceStiffness and vtkPointContact."""

import unittest

import numpy as np

import palpate
from support.surfaces import (Executions, copy_of, failure_of, lower_cap, points_of, polydata,
                              sphere, sphere_model, triangles_of)

MASKS = ("Linear", "Uniform", "Gaussian", "Hertzian")


class PressureMask(unittest.TestCase):
    def mask(self, surface, vertex, radius, kind="Linear"):
        algorithm = palpate.vtkVertexPressureMask()
        algorithm.SetInputData(surface)
        algorithm.SetVertex(vertex)
        algorithm.SetRadius(radius)
        getattr(algorithm, f"SetMaskTo{kind}")()
        return algorithm

    def density(self, *arguments):
        algorithm = self.mask(*arguments)
        algorithm.Update()
        return palpate.array(algorithm.GetOutput(), "PressureMask")

    def setUp(self):
        self.model = sphere_model(2)
        self.area = palpate.array(self.model, "VertexArea")
        self.top = int(np.argmax(points_of(self.model)[:, 2]))

    def test_carries_a_unit_force_over_free_vertices_within_the_radius(self):
        for kind in MASKS:
            for radius in (0, 0.3, 0.8, 2.5):
                density = self.density(self.model, self.top, radius, kind)
                self.assertAlmostEqual(self.area @ density, 1, delta=1e-14)
                self.assertGreaterEqual(density.min(), 0)
                self.assertEqual(density[palpate.array(self.model, "BoundaryType") == 1].max(), 0)
                away = np.linalg.norm(points_of(self.model) - points_of(self.model)[self.top], axis=1)
                self.assertEqual(density[away > max(radius, 1e-9)].sum(), 0)

    def test_below_the_edge_length_is_the_single_vertex(self):
        density = self.density(self.model, self.top, 1e-3)
        self.assertEqual(np.flatnonzero(density).tolist(), [self.top])
        self.assertAlmostEqual(density[self.top], 1 / self.area[self.top], delta=1e-12)

    def test_shapes_are_the_stated_functions_of_distance(self):
        # Where no neighbour is a support, collocation leaves the functional up to one factor.
        away = np.linalg.norm(points_of(self.model) - points_of(self.model)[self.top], axis=1) / 0.6
        shapes = {"Linear": lambda t: 1 - t, "Uniform": lambda t: 1 + 0 * t,
                  "Gaussian": lambda t: np.exp(-4.5 * t * t), "Hertzian": lambda t: np.sqrt(1 - t * t)}
        inside = away < 1
        for kind, shape in shapes.items():
            density = self.density(self.model, self.top, 0.6, kind)
            ratio = density[inside] / shape(away[inside])
            self.assertLess(np.ptp(ratio), 1e-12 * ratio.max(), kind)

    def test_never_reaches_another_body(self):
        a, t = points_of(sphere(2)), triangles_of(sphere(2))
        both = polydata(np.vstack([a, a + (0, 0, 2.001)]), np.vstack([t, t + 162]))
        both.GetPointData().AddArray(palpate.arrays.as_vtk(
            np.concatenate([lower_cap(sphere(2))] * 2), "BoundaryType", 1, np.uint8))
        density = self.density(both, self.top, 1.0)
        self.assertEqual(density[162:].max(), 0)

    def test_of_appendix_a_transmits_the_unit_force_and_needs_a_radius(self):
        for kind in ("Gradient", "Biharmonic"):
            density = self.density(self.model, self.top, 0.6, kind)
            self.assertAlmostEqual(float(density @ self.area), 1, delta=1e-13)
            self.assertEqual(int(np.argmax(density)), self.top)
            self.assertIn("needs a radius", failure_of(self.mask(self.model, self.top, 0, kind)))

    def test_along_the_surface_is_narrower_than_the_straight_one(self):
        algorithm = self.mask(self.model, self.top, 1.2, "Uniform")
        algorithm.Update()
        straight = np.count_nonzero(palpate.array(algorithm.GetOutput(), "PressureMask"))
        algorithm.SetDistanceToGeodesic()
        algorithm.Update()
        self.assertEqual(algorithm.GetFailureMessage(), "")
        along = np.count_nonzero(palpate.array(algorithm.GetOutput(), "PressureMask"))
        # Caps of a unit sphere: 2 pi (1 - cos 1.2) against pi 1.2^2, of 4 pi.
        self.assertLess(along, straight)
        self.assertAlmostEqual(along / 162, (1 - np.cos(1.2)) / 2, delta=0.05)

    def test_tells_what_it_does_not_cover(self):
        algorithm = self.mask(self.model, self.top, 0.6)
        algorithm.Update()
        shares = lambda: [palpate.array(algorithm.GetOutput(), name)[0]
                          for name in ("MaskSupportShare", "MaskBeyondShare")]
        self.assertEqual(shares(), [0, 0])
        fixed = palpate.array(self.model, "BoundaryType") == 1
        heights = np.where(fixed, np.inf, points_of(self.model)[:, 2])
        algorithm.SetVertex(int(np.argmin(heights)))
        algorithm.Update()
        self.assertGreater(shares()[0], 0.1)
        self.assertEqual(shares()[1], 0)

    def test_as_a_tensor_spreads_a_torque_and_no_force(self):
        algorithm = self.mask(self.model, self.top, 0.6)
        algorithm.Update()
        self.assertFalse(algorithm.GetOutput().GetPointData().HasArray("TorqueMask"))
        algorithm.TensorOn()
        algorithm.Update()
        tensor = palpate.array(algorithm.GetOutput(), "TorqueMask").reshape(-1, 3, 3)
        torque = np.array((1, 2, -0.5))
        forces = self.area[:, None] * (tensor @ torque)
        self.assertLess(np.abs(forces.sum(axis=0)).max(), 1e-12)
        about = np.cross(points_of(self.model), forces).sum(axis=0)
        self.assertLess(np.abs(about - torque).max(), 1e-12)
        algorithm.SetRadius(0)
        self.assertIn("a torque needs", failure_of(algorithm))

    def test_at_a_fixed_vertex_is_refused_by_name(self):
        bottom = int(np.argmin(points_of(self.model)[:, 2]))
        self.assertIn(str(bottom), failure_of(self.mask(self.model, bottom, 0.0)))

    def test_at_a_vertex_that_is_not_there_is_refused_by_name(self):
        for vertex in (162, -1, 2**40):
            self.assertIn(str(vertex), failure_of(self.mask(self.model, vertex, 0.1)))


class Stiffness(unittest.TestCase):
    def test_of_single_vertices_is_the_inverse_of_the_compliance_block(self):
        model = sphere_model(2)
        k = palpate.array(palpate.stiffness(model), "Stiffness").reshape(-1, 3, 3)
        xi, area = palpate.greens_functions(model), palpate.array(model, "VertexArea")
        for column, node in enumerate(palpate.greens_function_nodes(model)):
            compliance = xi[3 * node:3 * node + 3, 3 * column:3 * column + 3] / area[node]
            self.assertLess(np.abs(k[node] @ compliance - np.eye(3)).max(), 1e-11)

    def test_of_some_columns_is_that_of_all_where_it_can_be_and_no_number_elsewhere(self):
        surface, whole = sphere(2), sphere_model(2)
        top = int(np.argmax(points_of(surface)[:, 2]))
        near = np.flatnonzero(np.linalg.norm(points_of(surface) - points_of(surface)[top], axis=1) < 0.8)
        some = palpate.precompute(surface, 1e4, 0.3, fixed=lower_cap(surface), columns=near)
        a, b = (palpate.array(palpate.stiffness(m, radius=0.5, rigid_stiffness=1e5), "StiffnessNorm")
                for m in (some, whole))
        served = np.isfinite(a)
        self.assertTrue(served[top])
        self.assertTrue(0 < (~served).sum() < 162 - near.size / 2)
        self.assertLess(np.abs(a[served] / b[served] - 1).max(), 1e-10)
        forces = [palpate.array(palpate.press(model, points_of(surface)[top], radius=0.5,
                                              displacement=(1e-3, 0, -1e-2)), "ContactForce")[0]
                  for model in (some, whole)]
        self.assertLess(np.abs(forces[0] - forces[1]).max(), 1e-9 * np.abs(forces[1]).max())
        with self.assertRaisesRegex(palpate.Error, "were not computed"):
            palpate.press(some, (1, 0, 0), force=(1, 0, 0), radius=0.5)

    def test_reports_asymmetry_and_haptic_ratio(self):
        field = palpate.stiffness(sphere_model(2))
        asymmetry, ratio = (palpate.array(field, n) for n in ("StiffnessAsymmetry", "HapticRatio"))
        free = palpate.array(field, "BoundaryType") == 0
        self.assertLess(asymmetry.max(), 1e-12)  # the compliance is reciprocal already
        self.assertTrue((ratio[free] > 0).all() and (ratio[free] <= 1 + 1e-12).all())
        surface = sphere(2)
        raw = palpate.precompute(surface, 1e4, 0.3, fixed=lower_cap(surface), reciprocal=False)
        self.assertGreater(palpate.array(palpate.stiffness(raw), "StiffnessAsymmetry").max(), 1e-6)


    def test_by_the_mean_displacement_is_symmetric_as_it_stands(self):
        field = palpate.stiffness(sphere_model(2), radius=0.6, measure="mean")
        self.assertLess(palpate.array(field, "StiffnessAsymmetry").max(), 1e-12)
        by_vertex = palpate.stiffness(sphere_model(2), radius=0.6)
        free = palpate.array(field, "BoundaryType") == 0
        ratio = (palpate.array(field, "StiffnessNorm") / palpate.array(by_vertex, "StiffnessNorm"))[free]
        self.assertGreater(ratio.min(), 1)  # the mean yields less than the middle
        self.assertLess(ratio.max(), 1.6)

    def test_under_every_mask_and_distance_is_positive_definite(self):
        for mask in palpate.arguments.MASKS:
            for distance in palpate.arguments.DISTANCES:
                field = palpate.stiffness(sphere_model(2), radius=0.6, mask=mask, distance=distance)
                k = palpate.array(field, "Stiffness").reshape(-1, 3, 3)
                self.assertGreater(np.linalg.eigvalsh(k).min(), 0, (mask, distance))

    def test_against_torques_is_there_when_asked_for(self):
        field = palpate.stiffness(sphere_model(2), radius=0.6, rotational=True)
        free = palpate.array(field, "BoundaryType") == 0
        k = palpate.array(field, "RotationalStiffness").reshape(-1, 3, 3)
        self.assertTrue(np.isnan(k[~free]).all())
        self.assertGreater(np.linalg.eigvalsh(k[free]).min(), 0)
        plain = palpate.stiffness(field, radius=0.6)
        self.assertFalse(plain.GetPointData().HasArray("RotationalStiffness"))


class PointContact(unittest.TestCase):
    def test_turns_under_a_torque_as_the_rotational_stiffness_says(self):
        model = sphere_model(2)
        top = int(np.argmax(points_of(model)[:, 2]))
        torque = np.array((1.0, -2.0, 3.0))
        turned = palpate.press(model, points_of(model)[top], force=(0, 0, 0), radius=0.6, torque=torque)
        self.assertTrue((palpate.array(turned, "ContactTorque")[0] == torque).all())
        field = palpate.stiffness(model, radius=0.6, rotational=True)
        k = palpate.array(field, "RotationalStiffness")[top].reshape(3, 3)
        self.assertLess(np.abs(k @ palpate.array(turned, "ContactRotation")[0] - torque).max(), 1e-10)
        moved = palpate.array(turned, "Displacement")[top]
        elastic, static = (palpate.array(turned, n)[0] for n in ("ElasticContactPoint", "ContactPoint"))
        self.assertLess(np.abs(elastic - static - moved).max(), 1e-13)
        again = palpate.press(turned, points_of(model)[top], force=(0, 0, -1), radius=0.6)
        self.assertFalse(again.GetFieldData().HasArray("ContactRotation"))
        with self.assertRaisesRegex(palpate.Error, "a torque needs"):
            palpate.press(model, (0, 0, 1), force=(0, 0, 0), torque=torque)

    def test_by_the_mean_displacement_moves_the_mask_as_asked(self):
        model = sphere_model(2)
        top = int(np.argmax(points_of(model)[:, 2]))
        asked = np.array((1e-3, -2e-3, 3e-3))
        pressed = palpate.press(model, points_of(model)[top], displacement=asked, radius=0.6,
                                measure="mean")
        mask = palpate.vtkVertexPressureMask()
        mask.SetInputData(model)
        mask.SetVertex(top)
        mask.SetRadius(0.6)
        mask.Update()
        weights = palpate.array(mask.GetOutput(), "PressureMask") * palpate.array(model, "VertexArea")
        mean = weights @ palpate.array(pressed, "Displacement")
        self.assertLess(np.abs(mean - asked).max(), 1e-12)

    def contact(self, model=None):
        algorithm = palpate.vtkPointContact()
        algorithm.SetInputData(model or sphere_model(2))
        algorithm.SetRadius(0.5)
        algorithm.SetPoint(0, 0.1, 1)
        algorithm.SetForce(0, 0, -1)
        return algorithm

    def test_touches_the_nearest_point_of_the_surface(self):
        algorithm = self.contact()
        model = sphere_model(2)
        corners = points_of(model)[triangles_of(model)[33]]
        inside = 0.5 * corners[0] + 0.3 * corners[1] + 0.2 * corners[2]
        normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
        algorithm.SetPoint(*(inside + 0.01 * normal / np.linalg.norm(normal)))
        algorithm.Update()
        touched = palpate.array(algorithm.GetOutput(), "ContactPoint")[0]
        self.assertLess(np.abs(touched - inside).max(), 1e-14)

    def test_stiffness_varies_continuously_across_faces(self):
        model = sphere_model(2)
        forces = []
        for angle in np.linspace(0, 0.6, 200):
            pressed = palpate.press(model, (np.sin(angle), 0.05, np.cos(angle)),
                                    displacement=(0, 0, -1e-2), radius=0.5)
            forces.append(palpate.array(pressed, "ContactForce")[0])
        steps = np.linalg.norm(np.diff(forces, axis=0), axis=1)
        # 200 steps over about two edges: no step is more than a few times the mean.
        self.assertLess(steps.max(), 5 * steps.mean())

    def test_work_round_a_closed_displacement_loop_is_zero(self):
        # For linear forces f = K u the trapezoidal rule is exact: the loop's work is K's asymmetry.
        algorithm = self.contact()
        for point in ((0, 0.1, 1), (0.7, -0.7, 0.1), (0.2, 0.2, -0.64)):
            algorithm.SetPoint(*point)
            loop = [np.array((np.cos(a), np.sin(a), 0.3 * np.sin(2 * a))) * 1e-2
                    for a in np.linspace(0, 2 * np.pi, 41)]
            forces = []
            for displacement in loop:
                algorithm.SetDisplacement(*displacement)
                algorithm.Update()
                forces.append(palpate.array(algorithm.GetOutput(), "ContactForce")[0].copy())
            work = sum((f + g) @ (v - u) / 2 for f, g, u, v in
                       zip(forces, forces[1:], loop, loop[1:]))
            scale = np.linalg.norm(forces, axis=1).max() * 1e-2
            self.assertLess(abs(work), 1e-12 * scale)

    def test_the_support_pushes_back_rigidly(self):
        pressed = palpate.press(sphere_model(2), (0, 0, -1), displacement=(0, 0, 1e-3),
                                rigid_stiffness=50)
        self.assertAlmostEqual(palpate.array(pressed, "ContactForce")[0, 2], 0.05, delta=1e-12)
        self.assertEqual(np.abs(palpate.array(pressed, "Displacement")).max(), 0)

    def test_executes_once_a_change(self):
        algorithm = self.contact()
        runs = Executions(algorithm)
        for force in (-1, -1, -2):
            algorithm.SetForce(0, 0, force)
            algorithm.Update()
            algorithm.Update()
        self.assertEqual(runs.count, 2)

    def test_a_stale_model_is_refused_even_after_it_was_good(self):
        model = copy_of(sphere_model(2))
        algorithm = self.contact(model)
        algorithm.Update()
        self.assertEqual(algorithm.GetFailureMessage(), "")
        points_of(model)[0] *= 1.01
        model.GetPoints().Modified()
        model.Modified()
        self.assertIn("stale", failure_of(algorithm))


if __name__ == "__main__":
    unittest.main()
