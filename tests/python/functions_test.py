# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the functions of the package compute."""

import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path

import numpy as np

import palpate
from support.surfaces import copy_of, cube, lower_cap, points_of, sphere, sphere_model, triangles_of


def columns(model):
    """First column of each node's block in the matrix of Green's functions."""
    return {int(node): 3 * i for i, node in enumerate(palpate.greens_function_nodes(model))}


class Precompute(unittest.TestCase):
    def test_has_three_rows_a_vertex_and_three_columns_a_free_vertex(self):
        model = sphere_model(1)
        free = np.flatnonzero(palpate.array(model, "BoundaryType") == 0)
        self.assertTrue((palpate.greens_function_nodes(model) == free).all())
        self.assertEqual(palpate.greens_functions(model).shape, (126, 3 * free.size))
        self.assertIsNotNone(palpate.greens_functions(model).base)  # a view, not a copy

    def test_takes_what_is_fixed_from_the_surface_by_default(self):
        surface = sphere(1)
        fixed = lower_cap(surface)
        given = palpate.precompute(surface, 1e4, 0.3, fixed=fixed)
        surface.GetPointData().AddArray(palpate.arrays.as_vtk(fixed, "BoundaryType", 1, np.uint8))
        stored = palpate.precompute(surface, 1e4, 0.3)
        self.assertTrue((palpate.greens_functions(given) == palpate.greens_functions(stored)).all())

    def test_computes_only_the_columns_asked_for(self):
        surface = sphere(1)
        whole = sphere_model(1)
        some = palpate.precompute(surface, 1e4, 0.3, fixed=lower_cap(surface), columns=[7, 3],
                                  reciprocal=False)
        raw = palpate.precompute(surface, 1e4, 0.3, fixed=lower_cap(surface), reciprocal=False)
        self.assertEqual(palpate.greens_function_nodes(some).tolist(), [3, 7])
        at = columns(raw)[3]
        expected = palpate.greens_functions(raw)[:, at:at + 3]
        difference = palpate.greens_functions(some)[:, :3] - expected
        # Two right-hand sides of one factorisation: rounding times the condition number.
        self.assertLess(np.abs(difference).max(), 1e-11 * np.abs(expected).max())
        self.assertEqual(whole.GetNumberOfPoints(), some.GetNumberOfPoints())

    def test_takes_columns_as_a_mask(self):
        surface = sphere(1)
        wanted = points_of(surface)[:, 2] > 0.9
        model = palpate.precompute(surface, 1e4, 0.3, fixed=lower_cap(surface), columns=wanted)
        self.assertEqual(palpate.greens_function_nodes(model).tolist(),
                         np.flatnonzero(wanted).tolist())

    def test_finds_smooth_patches_anew_unless_they_were_given(self):
        surface = cube(2)
        fixed = points_of(surface)[:, 2] == 0
        first = palpate.precompute(surface, 1, 0.3, fixed=fixed)
        again = palpate.precompute(first, 1, 0.3, fixed=fixed, smooth_angle=180)
        self.assertEqual(np.unique(palpate.array(first, "SmoothPatch")).size, 6)
        self.assertEqual(np.unique(palpate.array(again, "SmoothPatch")).size, 1)
        surface.GetCellData().AddArray(palpate.arrays.as_vtk(
            palpate.array(first, "SmoothPatch"), "SmoothPatch", 1, np.int32))
        given = palpate.precompute(surface, 1, 0.3, fixed=fixed, smooth_angle=180)
        self.assertEqual(np.unique(palpate.array(given, "SmoothPatch")).size, 6)

    def test_patches_given_on_a_model_count_though_it_was_computed_with_others(self):
        surface = cube(2)
        fixed = points_of(surface)[:, 2] == 0
        model = copy_of(palpate.precompute(surface, 1, 0.3, fixed=fixed))
        mine = np.arange(surface.GetNumberOfCells()) % 3
        model.GetCellData().AddArray(palpate.arrays.as_vtk(mine, "SmoothPatch", 1, np.int32))
        again = palpate.precompute(model, 1, 0.3)
        self.assertTrue((palpate.array(again, "SmoothPatch") == mine).all())
        self.assertFalse(again.GetFieldData().HasArray("SmoothAngle"))

    def test_float_and_mixed_precision_agree_with_double(self):
        surface = sphere(2)
        fixed = lower_cap(surface)
        exact = palpate.greens_functions(sphere_model(2))
        mixed = palpate.greens_functions(
            palpate.precompute(surface, 1e4, 0.3, fixed=fixed, precision="mixed"))
        single = palpate.greens_functions(
            palpate.precompute(surface, 1e4, 0.3, fixed=fixed, precision="float"))
        self.assertEqual((exact.dtype, mixed.dtype, single.dtype), (np.float64, np.float64, np.float32))
        self.assertLess(np.linalg.norm(mixed - exact), 1e-10 * np.linalg.norm(exact))
        error = np.linalg.norm(single - exact) / np.linalg.norm(exact)
        self.assertLess(error, 1e-4)   # rounding 6e-8 times a condition number of some hundreds
        self.assertGreater(error, 1e-9)  # it is indeed in float

    def test_a_finer_tolerance_integrates_more_exactly(self):
        surface = sphere(1)
        defect = [palpate.array(palpate.precompute(surface, 1e4, 0.3, fixed=lower_cap(surface),
                                                   integration_tolerance=tolerance), "RotationDefect")[0]
                  for tolerance in (1e-3, 1e-6, 1e-10)]
        self.assertGreater(defect[0], 10 * defect[1])
        self.assertGreater(defect[1], 10 * defect[2])

    def test_reciprocal_compliance_is_symmetric_and_the_raw_one_is_not(self):
        surface = sphere(2)
        fixed = lower_cap(surface)
        for reciprocal in (True, False):
            model = palpate.precompute(surface, 1e4, 0.3, fixed=fixed, reciprocal=reciprocal)
            nodes = palpate.greens_function_nodes(model)
            area = palpate.array(model, "VertexArea")[nodes]
            rows = (3 * nodes[:, None] + np.arange(3)).ravel()
            compliance = palpate.greens_functions(model)[rows] / np.repeat(area, 3)
            defect = np.linalg.norm(compliance - compliance.T) / np.linalg.norm(compliance)
            reported = palpate.array(model, "ReciprocityDefect")[0]
            if reciprocal:
                self.assertLess(defect, 1e-14)
            else:
                self.assertAlmostEqual(defect, reported, delta=1e-3 * reported)
            self.assertGreater(reported, 1e-3)

    def test_doubtful_models_warn_with_the_measured_number(self):
        surface = sphere(2)
        small = lower_cap(surface, -0.95)
        with self.assertWarnsRegex(palpate.ModelWarning, r"support is only [0-9.]+ edges wide"):
            model = palpate.precompute(surface, 1e4, 0.3, fixed=small)
        self.assertEqual(len(palpate.array(model, "Warnings")), 1)
        self.assertLess(palpate.array(model, "SupportWidth")[0], 3)

    def test_exterior_of_a_cavity_needs_no_support(self):
        # A9: u_r = p a / (4 mu) of a spherical cavity of radius a under pressure p.
        young, poisson = 2.6, 0.3
        surface = sphere(2)
        model = palpate.precompute(surface, young, poisson, domain="exterior",
                                   fixed=np.zeros(162, bool))
        outward = points_of(surface)
        solved = palpate.solve(model, [], [], free_tractions=outward)  # on the material: outwards
        radial = (palpate.array(solved, "Displacement") * outward).sum(axis=1)
        self.assertAlmostEqual(radial.mean(), 0.25, delta=0.01 * 0.25)

    def test_progress_rises_and_names_stages(self):
        reports = []
        palpate.precompute(sphere(2), 1e4, 0.3, fixed=lower_cap(sphere(2)),
                           progress=lambda fraction, stage: reports.append((fraction, stage)))
        fractions = [fraction for fraction, _ in reports]
        self.assertEqual(fractions, sorted(fractions))
        self.assertEqual(fractions[-1], 1)
        self.assertGreater(len({stage for _, stage in reports if stage}), 1)

    def test_progress_can_abort(self):
        seen = []

        def impatient(fraction, stage):
            seen.append(fraction)
            return fraction < 0.2

        with self.assertRaises(palpate.Aborted):
            palpate.precompute(sphere(3), 1e4, 0.3, fixed=lower_cap(sphere(3)), progress=impatient)
        self.assertLess(max(seen), 1)

    def test_what_a_progress_callback_raises_comes_through(self):
        def broken(fraction, stage):
            raise KeyError("mine")

        with self.assertRaises(KeyError):
            palpate.precompute(sphere(2), 1e4, 0.3, fixed=lower_cap(sphere(2)), progress=broken)


INTERRUPTED = """
import signal, palpate
def mine(*arguments):
    signal.default_int_handler(*arguments)
signal.signal(signal.SIGINT, mine)
surface = palpate.refine(palpate.read(palpate.example("kidney")), 4)
print("begin", flush=True)
try:
    palpate.precompute(surface, None, None, progress={progress})
except KeyboardInterrupt:
    print("caught", signal.getsignal(signal.SIGINT) is mine, flush=True)
"""


class Interruption(unittest.TestCase):
    def test_ctrl_c_stops_the_work_and_raises_keyboard_interrupt(self):
        for progress in ("None", "lambda fraction, stage: None"):
            process = subprocess.Popen([sys.executable, "-c", INTERRUPTED.format(progress=progress)],
                                       stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            self.addCleanup(process.kill)
            self.assertEqual(process.stdout.readline(), "begin\n")
            time.sleep(0.5)
            process.send_signal(signal.SIGINT)
            sent = time.monotonic()
            printed, errors = process.communicate(timeout=120)
            self.assertEqual((process.returncode, printed), (0, "caught True\n"), errors)
            self.assertEqual(errors, "")
            self.assertLess(time.monotonic() - sent, 60)  # the whole work takes minutes

    def test_handlers_are_left_alone_in_other_threads(self):
        before, models = signal.getsignal(signal.SIGINT), []
        thread = threading.Thread(target=lambda: models.append(sphere_model(1)))
        thread.start()
        thread.join()
        self.assertEqual(len(models), 1)
        self.assertIs(signal.getsignal(signal.SIGINT), before)


class Solve(unittest.TestCase):
    def test_prescribed_displacements_are_met_and_forces_balance(self):
        model = sphere_model(2)
        nodes = np.argsort(points_of(model)[:, 2])[-5:]
        given = np.random.default_rng(1).normal(size=(5, 3)) * 1e-2
        solved = palpate.solve(model, nodes, given)
        displacement, traction = (palpate.array(solved, name) for name in ("Displacement", "Traction"))
        fixed = palpate.array(model, "BoundaryType") == 1
        # The capacitance solve's rounding: 1e-16 times its condition number of about 1e2.
        self.assertLess(np.abs(displacement[nodes] - given).max(), 1e-13)
        self.assertEqual(np.abs(displacement[fixed]).max(), 0)
        free = ~fixed
        free[nodes] = False
        self.assertEqual(np.abs(traction[free]).max(), 0)
        force = palpate.array(model, "VertexArea")[:, None] * traction
        self.assertLess(np.abs(force.sum(axis=0)).max(), 1e-11 * np.abs(force).sum())
        contact = palpate.array(solved, "ContactForce")
        self.assertEqual(contact.shape, (1, 3))
        self.assertLess(np.abs(contact[0] - force[nodes].sum(axis=0)).max(), 1e-12)

    def test_free_tractions_act_where_nodes_are_not_displaced(self):
        model = sphere_model(2)
        node = int(np.argmax(points_of(model)[:, 2]))
        loads = np.tile((0.0, 0.0, 30.0), (162, 1))
        loaded = palpate.solve(model, [], [], free_tractions=loads)
        held = palpate.solve(model, [node], [(0, 0, 0)], free_tractions=loads)
        self.assertGreater(palpate.array(loaded, "Displacement")[node, 2], 1e-4)
        self.assertLess(np.abs(palpate.array(held, "Displacement")[node]).max(), 1e-15)
        self.assertLess(palpate.array(held, "ContactForce")[0, 2], 0)
        traction = palpate.array(held, "Traction")
        self.assertTrue((traction[palpate.array(model, "BoundaryType") == 0].sum(axis=0)[2] > 0))

    def test_without_any_constraint_nothing_moves(self):
        solved = palpate.solve(sphere_model(1), [], [])
        self.assertEqual(np.abs(palpate.array(solved, "Displacement")).max(), 0)
        self.assertEqual(palpate.array(solved, "ContactForce").tolist(), [[0, 0, 0]])

    def test_moving_the_whole_support_moves_the_body(self):
        surface = sphere(1)
        fixed = lower_cap(surface, -0.5)
        model = palpate.precompute(surface, 1e4, 0.3, fixed=fixed, columns=range(42))
        nodes = np.flatnonzero(fixed)
        solved = palpate.solve(model, nodes, np.tile((1e-3, 2e-3, 3e-3), (nodes.size, 1)))
        difference = palpate.array(solved, "Displacement") - (1e-3, 2e-3, 3e-3)
        self.assertLess(np.abs(difference).max(), 1e-9)
        self.assertLess(np.abs(palpate.array(solved, "ContactForce")).max(), 1e-8)

    def test_tractions_on_faces_pull_a_cube_by_their_exact_resultant(self):
        surface = cube(4)
        model = palpate.precompute(surface, 1.0, 0.3, fixed=points_of(surface)[:, 2] == 0,
                                   patch_columns=True)
        top = points_of(surface)[triangles_of(surface), 2].min(axis=1) == 1
        loads = np.where(top[:, None], (0.0, 0.0, 1.0), (0.0, 0.0, 0.0))
        solved = palpate.solve(model, [], [], face_tractions=loads)
        force = palpate.array(model, "VertexArea")[:, None] * palpate.array(solved, "Traction")
        fixed = palpate.array(model, "BoundaryType") == 1
        self.assertLess(np.abs(force[~fixed].sum(axis=0) - (0, 0, 1)).max(), 1e-12)
        self.assertLess(np.abs(force[fixed].sum(axis=0) + (0, 0, 1)).max(), 1e-12)


class Press(unittest.TestCase):
    def test_displacement_and_force_are_inverse_to_each_other(self):
        model = sphere_model(2)
        at, radius = (0.1, -0.2, 1.0), 0.5
        by_displacement = palpate.press(model, at, displacement=(1e-3, 0, -2e-2), radius=radius)
        force = palpate.array(by_displacement, "ContactForce")[0]
        by_force = palpate.press(model, at, force=force, radius=radius)
        a, b = (palpate.array(p, "Displacement") for p in (by_displacement, by_force))
        self.assertLess(np.abs(a - b).max(), 1e-12 * np.abs(a).max())

    def test_contact_points_are_those_of_the_figure(self):
        model = sphere_model(2)
        displacement = np.array((0, 1e-3, -2e-2))
        pressed = palpate.press(model, (0, 0, 1), displacement=displacement, radius=0.4)
        start, elastic, haptic = (palpate.array(pressed, name)[0] for name in
                                  ("ContactPoint", "ElasticContactPoint", "HapticContactPoint"))
        self.assertLess(np.abs(haptic - start - displacement).max(), 1e-15)
        top = int(np.argmax(points_of(model)[:, 2]))
        moved = points_of(model)[top] + palpate.array(pressed, "Displacement")[top]
        self.assertLess(np.abs(elastic - moved).max(), 1e-12)

    def test_the_mask_normalises_the_force(self):
        model = sphere_model(2)
        for mask in ("linear", "uniform", "gaussian", "hertzian"):
            pressed = palpate.press(model, (0, 0, 1), force=(1, 2, -3), radius=0.6, mask=mask)
            force = palpate.array(model, "VertexArea")[:, None] * palpate.array(pressed, "Traction")
            free = palpate.array(model, "BoundaryType") == 0
            self.assertLess(np.abs(force[free].sum(axis=0) - (1, 2, -3)).max(), 1e-13, mask)

    def test_force_grows_in_proportion(self):
        model = sphere_model(2)
        one, two = (palpate.array(palpate.press(model, (1, 0, 0.3), displacement=(-d, 0, 0),
                                                radius_in_edges=2), "ContactForce")[0]
                    for d in (1e-3, 2e-3))
        self.assertLess(np.abs(two - 2 * one).max(), 1e-13 * np.abs(one).max())


class Stiffness(unittest.TestCase):
    def test_is_symmetric_positive_definite_everywhere(self):
        for radius in (None, 0.5):
            field = palpate.stiffness(sphere_model(2), radius=radius)
            k = palpate.array(field, "Stiffness").reshape(-1, 3, 3)
            self.assertEqual(k.shape[0], 162)
            self.assertLess(np.abs(k - k.transpose(0, 2, 1)).max(), 1e-12 * np.abs(k).max())
            self.assertGreater(np.linalg.eigvalsh(k).min(), 0)
            norm = palpate.array(field, "StiffnessNorm")
            self.assertLess(np.abs(norm - np.linalg.norm(k, axis=(1, 2))).max(), 1e-12 * norm.max())

    def test_is_the_force_of_a_press_at_a_vertex(self):
        model = sphere_model(2)
        k = palpate.array(palpate.stiffness(model, radius=0.5), "Stiffness").reshape(-1, 3, 3)
        vertex = int(np.argmax(points_of(model)[:, 2]))
        pressed = palpate.press(model, points_of(model)[vertex], displacement=(1, 2, 3), radius=0.5)
        force = palpate.array(pressed, "ContactForce")[0]
        self.assertLess(np.abs(force - k[vertex] @ (1, 2, 3)).max(), 1e-12 * np.abs(force).max())

    def test_fixed_vertices_show_the_rigid_stiffness(self):
        model = sphere_model(1)
        norm = palpate.array(palpate.stiffness(model, rigid_stiffness=1e6), "StiffnessNorm")
        fixed = palpate.array(model, "BoundaryType") == 1
        self.assertLess(np.abs(norm[fixed] - 1e6 * 3**0.5).max(), 1e-6)

    def test_scales_exactly_with_youngs_modulus_without_computing_again(self):
        model = sphere_model(1)
        stiffer = model.NewInstance()
        stiffer.ShallowCopy(model)
        stiffer.GetFieldData().AddArray(palpate.arrays.as_vtk([4e4], "YoungsModulus", 1))
        a, b = (palpate.array(palpate.stiffness(m, radius=0.5), "Stiffness") for m in (model, stiffer))
        self.assertLess(np.abs(b - 4 * a).max(), 1e-15 * np.abs(b).max())


class RefineAndRepair(unittest.TestCase):
    def test_refinement_quadruples_the_triangles_and_keeps_vertex_numbers(self):
        coarse = palpate.read(palpate.example("nodule"))
        fine = palpate.refine(coarse, 2)
        self.assertEqual(fine.GetNumberOfCells(), 16 * coarse.GetNumberOfCells())
        types = palpate.array(coarse, "BoundaryType")
        self.assertTrue((palpate.array(fine, "BoundaryType")[:types.size] == types).all())

    def test_zero_levels_change_nothing(self):
        coarse = palpate.read(palpate.example("nodule"))
        same = palpate.refine(coarse, 0)
        self.assertTrue((points_of(same) == points_of(coarse)).all())

    def test_repair_turns_an_inside_out_sphere_and_says_so(self):
        surface = sphere(1)
        triangles_of(surface)[:] = triangles_of(surface)[:, ::-1].copy()
        mended = palpate.repair(surface)
        self.assertTrue(palpate.array(mended, "RepairChanges"))
        palpate.precompute(mended, 1, 0.3, fixed=lower_cap(mended))


class Files(unittest.TestCase):
    def test_a_model_comes_back_bit_by_bit(self):
        model = sphere_model(1)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "model.vtp"
            palpate.write(model, path)
            self.assertEqual([p.name for p in Path(folder).iterdir()], ["model.vtp"])
            back = palpate.read(path)
        self.assertTrue((points_of(back) == points_of(model)).all())
        for attributes in ("GetPointData", "GetCellData", "GetFieldData"):
            theirs, ours = getattr(back, attributes)(), getattr(model, attributes)()
            self.assertEqual(theirs.GetNumberOfArrays(), ours.GetNumberOfArrays())
            for i in range(ours.GetNumberOfArrays()):
                name = ours.GetArrayName(i)
                a, b = palpate.array(back, name), palpate.array(model, name)
                self.assertTrue(a == b if isinstance(a, list) else (a == b).all(), name)
        field = palpate.stiffness(back, radius=0.5)
        expected = palpate.stiffness(model, radius=0.5)
        self.assertTrue((palpate.array(field, "Stiffness") == palpate.array(expected, "Stiffness")).all())


if __name__ == "__main__":
    unittest.main()
