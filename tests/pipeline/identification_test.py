# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials from measurements through filters, files, program and package."""

import doctest
import functools
import re
import tempfile
import unittest
from pathlib import Path

import numpy as np

import palpate
from palpate.arrays import as_vtk
from palpate import identification, measurement_tables
from support.refused import Refusals
from support.surfaces import failure_of, lower_cap, points_of, run, sphere, triangles_of
from support.tables import carrier_of, write_table

YOUNG, POISSON = 2e4, 0.4


def held_sphere(levels=2):
    surface = sphere(levels)
    surface.GetPointData().AddArray(as_vtk(lower_cap(surface), "BoundaryType", 1, np.uint8))
    return surface


@functools.lru_cache(maxsize=None)
def body():
    return palpate.precompute(held_sphere(), young=YOUNG, poisson=POISSON, estimate_error=False)


@functools.lru_cache(maxsize=None)
def table(**settings):
    return palpate.simulate_measurements(body(), radius=0.4, **settings)


@functools.lru_cache(maxsize=None)
def identified():
    return palpate.identify(held_sphere(), table())


class Folder(Refusals):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)


class Package(Folder):
    def test_finds_the_material_with_deviations_that_hold(self):
        model = identified()
        self.assertEqual(palpate.array(model, "IdentifiedNames"), ["Young's modulus", "Poisson's ratio"])
        values = palpate.array(model, "IdentifiedParameters")
        self.assertLess(abs(values[0, 0] / YOUNG - 1), 0.01)
        self.assertLess(abs(values[1, 0] - POISSON), 0.02)
        for (value, deviation, low, high), truth in zip(values, (YOUNG, POISSON)):
            self.assertLess(abs(value - truth), 4 * deviation)
            self.assertLess(low, value)
            self.assertLess(value, high)
        correlations = palpate.array(model, "IdentifiedCorrelations")
        np.testing.assert_allclose(np.diag(correlations), 1, rtol=1e-12)
        np.testing.assert_allclose(correlations, correlations.T)

    def test_the_model_is_that_of_the_material(self):
        model = identified()
        young, poisson = palpate.array(model, "IdentifiedParameters")[:, 0]
        again = palpate.precompute(held_sphere(), young=young, poisson=poisson)
        np.testing.assert_array_equal(palpate.greens_functions(model), palpate.greens_functions(again))
        self.assertRegex(palpate.array(model, "GreensFunctionSource")[0],
                         r"; identified from 250 displacements under 5 probes \(a table\)")
        self.assertEqual(palpate.array(model, "ErrorEstimate"), palpate.array(again, "ErrorEstimate"))
        pressed = palpate.press(model, point=(0, 0, 1), force=(0, 0, -10), radius=0.4)
        self.assertTrue(np.isfinite(palpate.array(pressed, "Displacement")).all())

    def test_another_material_is_not_said_to_be_identified(self):
        again = palpate.precompute(identified(), young=1e3, poisson=0.1, estimate_error=False)
        for name in ("IdentifiedParameters", "YoungsModulusDeviation", "MeasurementResidual"):
            with self.assertRaises(KeyError):
                palpate.array(again, name)
        self.assertEqual(palpate.array(again, "MeasuredDisplacement").shape, (250, 3))
        self.assertNotIn("identified", palpate.array(again, "GreensFunctionSource")[0])

    def test_a_surface_that_its_filling_cuts_otherwise_is_that_of_the_filling(self):
        kidney = palpate.remesh(palpate.refine(palpate.read(palpate.example("kidney"))), 0.02,
                                keep_original=True)
        with self.assertWarnsRegex(palpate.ModelWarning, "triangles of the surface are others now"):
            filled = palpate.precompute(kidney, young=YOUNG, poisson=POISSON, method="fem",
                                        estimate_error=False)
        seen = palpate.simulate_measurements(filled)
        for identify in (palpate.identify, palpate.identify_field):
            settings = dict(method="fem") if identify is palpate.identify else dict(modes=5)
            with self.assertWarnsRegex(palpate.ModelWarning, "of the surface are others now, with 0 new"):
                found = identify(kidney, seen, folds=0, **settings)
            model = found if identify is palpate.identify else found[0]
            young, poisson = palpate.array(model, "IdentifiedParameters")[:, 0]
            self.assertLess(abs(young / YOUNG - 1), 0.05)
            np.testing.assert_array_equal(triangles_of(model), triangles_of(filled))
            self.assertEqual(palpate.on_original(model).GetNumberOfPoints(), 82)
            if model is found:  # of one material, so that the same comes from it
                again = palpate.precompute(kidney, young=young, poisson=poisson, method="fem",
                                           estimate_error=False)
                np.testing.assert_allclose(
                    palpate.greens_functions(model), palpate.greens_functions(again),
                    atol=1e-12 * np.abs(palpate.greens_functions(again)).max())

    def test_a_press_seen_at_vertices_gives_its_modulus_back(self):
        model = identified()
        force, place = (palpate.array(model, name)[1] for name in ("ProbeForce", "ProbePoint"))
        pressed = palpate.press(model, point=place, force=force, radius=0.4)
        vertices = np.arange(20, 40)
        moved = palpate.array(pressed, "Displacement")[vertices]
        noise = 1e-6 * np.sin(np.arange(moved.size)).reshape(moved.shape)
        seen = palpate.measurement_table(np.zeros(20), moved + noise, [force], marker_vertices=vertices,
                                         contacts=[place], radius=0.4)
        again = palpate.identify(held_sphere(), seen, folds=0)
        young = palpate.array(again, "YoungsModulus")[0]
        self.assertLess(abs(young / palpate.array(model, "YoungsModulus")[0] - 1), 1e-3)

    def test_outliers_are_named_and_left_out(self):
        spoilt = table(outliers=0.05)
        model = palpate.identify(held_sphere(), spoilt)
        exact = palpate.array(table(noise=0), "MeasuredDisplacement")
        wrong = np.abs(palpate.array(spoilt, "MeasuredDisplacement") - exact).max(axis=1) > 0.1 * exact.max()
        marked = palpate.array(model, "MeasurementOutlier").astype(bool)
        self.assertGreater(wrong.sum(), 5)
        self.assertTrue(marked[wrong].all())
        self.assertLess(abs(palpate.array(model, "YoungsModulus")[0] / YOUNG - 1), 0.01)
        self.assertEqual(palpate.array(model, "ProbeOutliers").sum(), marked.sum())

    def test_a_support_that_yields_is_told_from_a_soft_body(self):
        whole = palpate.precompute(held_sphere(), young=YOUNG, poisson=POISSON,
                                   columns=np.ones(162, bool), estimate_error=False)
        seen = palpate.simulate_measurements(whole, radius=0.4, yield_length=0.2)
        model = palpate.identify(held_sphere(), seen, yielding_support=True, folds=0)
        length = palpate.array(model, "SupportYieldLength")[0]
        self.assertLess(abs(length - 0.2), 0.04)
        self.assertLess(abs(palpate.array(model, "YoungsModulus")[0] / YOUNG - 1), 0.02)
        # Its Green's functions serve that foundation: a press yields as the rig's body did.
        self.assertEqual(len(palpate.greens_function_nodes(model)), 162)

    def test_a_frame_of_the_rigs_own_is_registered(self):
        kidney = palpate.refine(palpate.read(palpate.example("kidney")), levels=1)
        body = palpate.precompute(kidney, young=YOUNG, poisson=POISSON, estimate_error=False)
        turned = palpate.simulate_measurements(body, rotation=(2, -3, 4), translation=(1e-3, 0, -1e-3),
                                               markers=80)
        model = palpate.identify(kidney, turned, register=True, folds=0)
        self.assertLess(abs(palpate.array(model, "YoungsModulus")[0] / YOUNG - 1), 0.02)
        self.assertLess(palpate.array(model, "RegistrationDistance")[0], 1e-6)
        rotation = palpate.array(model, "RegistrationRotation").reshape(3, 3)
        self.assertLess(abs(np.degrees(np.arccos((np.trace(rotation) - 1) / 2)) - 29**0.5), 0.01)

    def test_units_are_told_and_mistakes_found(self):
        place = points_of(held_sphere())[[0, 5]]
        at = dict(marker_vertices=[0, 5], contact_vertices=[0], radius=0.4)
        self.refused("times the size of the body", palpate.identify, held_sphere(),
                     palpate.measurement_table([0, 0], [[0, 0, -5], [0, 1, 0]], [[0, 0, -1]], **at))
        for wrong, sentence in ((dict(marker_vertices=[1.5, 2]), "tuple 0: there is no vertex 1.5"),
                                (dict(probe=[0, 5]), "tuple 1: there is no probe 5")):
            arguments = {"probe": [0, 0], **at, **wrong}
            probe = arguments.pop("probe")
            self.refused(sentence, palpate.identify, held_sphere(), palpate.measurement_table(
                probe, [[0, 0, -1e-2], [0, 1e-3, 0]], [[0, 0, -1]], **arguments))
        at = dict(markers=1e3 * place, contacts=[1e3 * place[0]], radius=400)
        self.refused("times 0.001 it would be on it", palpate.identify, held_sphere(),
                     palpate.measurement_table([0, 0], [[0, 0, -5], [0, 1, 0]], [[0, 0, -1]], **at))

    def test_calls_that_make_no_sense_are_refused(self):
        self.refused("measurements must be a file or a vtkPolyData", palpate.identify, held_sphere(), 3)
        self.refused("has no field array ProbeForce", palpate.identify, held_sphere(), held_sphere())
        self.refused("not both", palpate.identify, held_sphere(), table(), poisson=0.3,
                     poisson_range=(0, 0.4))
        self.refused("within -1 < lower < upper < 0.5", palpate.identify, held_sphere(), table(),
                     poisson_range=(0.4, 0.3))
        self.refused("no unit of length 'miles'", palpate.identify, held_sphere(), table(),
                     length_unit="miles")
        self.refused("there is no loss 'l1'", palpate.identify, held_sphere(), table(), loss="l1")
        for name in ("no.csv", "no.vtp", "no.VTU"):
            self.refused("there is no such file", palpate.identify, held_sphere(), self.folder / name)
        self.refused("threads makes no sense for method='fem'", palpate.identify, held_sphere(), table(),
                     method="fem", threads=2)
        self.refused("give one of the two", palpate.measurement_table, [0], [[0, 0, 1]], [[0, 0, 1]],
                     contact_vertices=[0])
        self.refused("forces must be", palpate.measurement_table, [0], [[0, 0, 1]], [[0, 1]],
                     contact_vertices=[0], marker_vertices=[0])
        self.refused("noise must be at least 0", palpate.simulate_measurements, body(), noise=-1)
        self.refused("tuple 1 repeats tuple 0", palpate.identify, held_sphere(),
                     palpate.measurement_table([0, 0], [[0, 0, 1e-3]] * 2, [[0, 0, 1]],
                                               contact_vertices=[0], marker_vertices=[7, 7]))

    def test_tables_may_be_in_files_and_grids_of_vtk(self):
        young = palpate.array(palpate.identify(held_sphere(), table(), folds=0), "YoungsModulus")
        grid = carrier_of(table())
        for name in ("rig.vtp", "RIG.VTP", "rig.vtu", "Rig.Vtu"):
            path = write_table(table(), self.folder / name)
            again = palpate.identify(held_sphere(), path, folds=0, estimate_error=False)
            np.testing.assert_array_equal(palpate.array(again, "YoungsModulus"), young)
        again = palpate.identify(held_sphere(), grid, folds=0, estimate_error=False)
        np.testing.assert_array_equal(palpate.array(again, "YoungsModulus"), young)
        damaged = self.folder / "damaged.vtu"
        damaged.write_bytes((self.folder / "rig.vtu").read_bytes()[:2000])
        self.refused("damaged.vtu: ", palpate.identify, held_sphere(), damaged)

    def test_a_modulus_far_from_the_surfaces_own_is_doubted(self):
        def warnings_of(surface, **settings):
            model = palpate.identify(surface, table(), folds=0, estimate_error=False, **settings)
            fields = model.GetFieldData()
            return palpate.array(model, "Warnings") if fields.HasArray("Warnings") else []

        own = held_sphere()
        own.GetFieldData().AddArray(as_vtk([YOUNG], "YoungsModulus", 1, float))
        self.assertEqual(warnings_of(own), [])
        self.assertEqual(warnings_of(held_sphere(), force_unit="kN"), [])
        for unit, times in (("kN", "1000"), ("mN", "0.001")):
            self.assertIn(f"the identified Young's modulus is {times} times that of the input, 20000 Pa: check "
                          "the unit of force", warnings_of(own, force_unit=unit))

    def test_next_probes_make_what_is_known_better(self):
        model = palpate.identify(held_sphere(), table(), next_probes=3, folds=0)
        before = palpate.array(model, "IdentifiedParameters")[:, 1]
        after = palpate.array(model, "NextProbeDeviations")
        self.assertEqual(after.shape, (3, 2))
        self.assertTrue((after[0] < before * 1.05).all())
        self.assertTrue((np.diff(after, axis=0) <= 0).all())
        vertices = palpate.array(model, "NextProbeVertex")
        self.assertFalse(lower_cap(held_sphere())[vertices].any())
        self.assertEqual(len(set(vertices)), 3)
        np.testing.assert_allclose(
            np.linalg.norm(palpate.array(model, "NextProbeForce"), axis=1),
            np.linalg.norm(palpate.array(model, "ProbeForce"), axis=1).mean())

    def test_no_place_is_proposed_twice_before_all_are(self):
        kidney = palpate.refine(palpate.read(palpate.example("kidney")))
        body = palpate.precompute(kidney, young=YOUNG, poisson=POISSON, estimate_error=False)
        for probes in (2, 5):
            seen = palpate.simulate_measurements(body, probes=probes)
            model = palpate.identify(kidney, seen, next_probes=17, folds=0, estimate_error=False)
            vertices = palpate.array(model, "NextProbeVertex")
            self.assertEqual(len(set(vertices[:16])), 16)
            self.assertIn(vertices[16], vertices[:16])

    def test_progress_aborts(self):
        stages = set()
        palpate.identify(held_sphere(), table(), progress=lambda _, stage: stages.add(stage))
        self.assertIn("cross-validate", stages)
        with self.assertRaises(palpate.Aborted):
            palpate.identify(held_sphere(), table(), progress=lambda *_: False)

    def test_every_example_runs(self):
        for module, fewest in ((identification, 9), (measurement_tables, 8)):
            failed, attempted = doctest.testmod(module)
            self.assertEqual(failed, 0)
            self.assertGreaterEqual(attempted, fewest)


class Filter(unittest.TestCase):
    def test_needs_one_table(self):
        filter = palpate.vtkGreensFunctionIdentification()
        filter.SetInputData(body())
        self.assertIn("from a file or from the input of their table", failure_of(filter))
        filter.SetInputData(2, table())
        filter.SetPatchColumns(True)
        self.assertIn("leave columns and patch columns out", failure_of(filter))


class Program(Folder):
    def made(self, *options):
        """A body, its table, and the surface to be identified, as files."""
        model, data, surface = (self.folder / name for name in ("body.vtp", "rig.csv", "sphere.vtp"))
        palpate.write(body(), model)
        palpate.write(held_sphere(), surface)
        done = run("measure", model, data, "--radius", 0.4, *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return surface, data

    def test_measures_and_identifies(self):
        surface, data = self.made()
        self.assertEqual(len(data.read_text().splitlines()), 251)
        out = self.folder / "model.vtp"
        done = run("identify", surface, out, "--measurements", data, "--next-probes", 2)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"identified from 250 displacements under 5 probes ({data})", done.stdout)
        young = float(re.search(r"Young's modulus, Pa +(\S+) \+- ", done.stdout)[1])
        self.assertLess(abs(young / YOUNG - 1), 0.01)
        self.assertRegex(done.stdout, r"probe 3 +residual \S+ %, \S+ m, \d+ outliers")
        self.assertRegex(done.stdout, r"error at probes left out +\S+ %")
        self.assertRegex(done.stdout, r"correlation +\S+ of Poisson's ratio with Young's modulus")
        self.assertRegex(done.stdout, r"next probe 2 +at vertex \d+ \(.*\), force .*: Young's modulus \+- \S+, P")
        info = run("info", out)
        self.assertEqual(info.returncode, 0, info.stderr)
        pressed = run("press", out, self.folder / "p.vtp", "--at", 0, 0, 1, "--force", 0, 0, -1,
                      "--radius", 0.4)
        self.assertEqual(pressed.returncode, 0, pressed.stderr)
        np.testing.assert_array_equal(
            palpate.array(palpate.read(out), "MeasuredDisplacement"),
            palpate.array(identified(), "MeasuredDisplacement"))

    def test_prints_how_a_frame_was_moved(self):
        kidney = palpate.refine(palpate.read(palpate.example("kidney")), levels=1)
        body = palpate.precompute(kidney, young=YOUNG, poisson=POISSON, estimate_error=False)
        surface, data = self.folder / "kidney.vtp", self.folder / "rig.vtp"
        palpate.write(kidney, surface)
        palpate.write(palpate.simulate_measurements(body, rotation=(2, -3, 4), translation=(1e-3, 0, 0),
                                                    markers=80), data)
        done = run("identify", surface, self.folder / "model.vtp", "--measurements", data, "--register",
                   "--folds", 0, "--no-estimate")
        self.assertEqual(done.returncode, 0, done.stderr)
        vectors = r"\((.*?)\) \+- \((.*?)\)"
        turn, _ = re.search(r"turn of the table's frame +" + vectors, done.stdout).groups()
        self.assertAlmostEqual(np.linalg.norm([float(x) for x in turn.split(",")]), 29**0.5, delta=0.01)
        _, deviation = re.search(r"its shift +" + vectors + " m", done.stdout).groups()
        self.assertLess(max(float(x) for x in deviation.split(",")), 1e-6)
        model = palpate.read(self.folder / "model.vtp")
        share = palpate.array(model, "ParameterDeviationByRegistration")
        self.assertLess(share[0], 1e-4 * palpate.array(model, "IdentifiedParameters")[0, 1])
        self.assertIn(f"what it leaves open is in the intervals: Young's modulus +- {share[0]:.2g} Pa", done.stdout)
        self.assertIn("95 % by noise and registration: ", done.stdout)

    def test_what_a_registration_leaves_open_widens_intervals(self):
        kidney = palpate.refine(palpate.read(palpate.example("kidney")), levels=1)
        body = palpate.precompute(kidney, young=YOUNG, poisson=POISSON, estimate_error=False)
        table = palpate.simulate_measurements(body, markers=80, place_noise=5e-4, rotation=(2, -3, 4))
        model = palpate.identify(kidney, table, register=True, folds=0, estimate_error=False)
        for (value, deviation, low, high), share, truth in zip(
                palpate.array(model, "IdentifiedParameters"),
                palpate.array(model, "ParameterDeviationByRegistration"), (YOUNG, POISSON)):
            self.assertGreater(share, 0.3 * deviation)
            self.assertLess(share, deviation)
            self.assertLess(abs(value - truth), 3.5 * deviation)
            self.assertGreater(high - low, 3.5 * share)

    def test_names_outliers_by_line(self):
        surface, data = self.made()
        lines = data.read_text().splitlines()
        row = lines[99].split(",")
        row[-1] = repr(float(row[-1]) + 0.02)
        lines[99] = ",".join(row)
        data.write_text("\n".join(lines))
        done = run("identify", surface, self.folder / "model.vtp", "--measurements", data, "--no-estimate")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"outliers +\d+ of 250: lines .*\b100\b")
        self.assertNotIn("check the unit", done.stderr)

    def test_a_wrong_unit_of_force_is_doubted(self):
        surface, data = self.made("--markers", 10)
        surface_with_material = self.folder / "body.vtp"
        for given, doubts in ((surface, 0), (surface_with_material, 1)):
            done = run("identify", given, self.folder / "model.vtp", "--measurements", data, "--force-unit",
                       "kN", "--folds", 0, "--no-estimate")
            self.assertEqual(done.returncode, 0, done.stderr)
            said = re.findall(r"warning: the identified Young's modulus is (\d+) times that of the input, "
                              r"20000 Pa: check the unit of force", done.stderr)
            self.assertEqual(len(said), doubts)
            self.assertTrue(all(970 < float(times) < 1030 for times in said))

    def test_tables_may_be_polydata_in_other_units(self):
        surface, data = self.made()
        rows = [line.split(",") for line in data.read_text().splitlines()]
        lengths = [i for i, name in enumerate(rows[0])
                   if name in ("radius", "x", "y", "z") or name[:2] in ("u_", "co")]
        for row in rows[1:]:
            for i in lengths:
                row[i] = repr(1e3 * float(row[i])) if row[i] else ""
        (self.folder / "mm.csv").write_text("\n".join(map(",".join, rows)))
        out = self.folder / "model.vtp"
        in_mm = run("identify", surface, out, "--measurements", self.folder / "mm.csv",
                    "--length-unit", "mm", "--folds", 0, "--no-estimate")
        self.assertEqual(in_mm.returncode, 0, in_mm.stderr)
        young = palpate.array(palpate.read(out), "YoungsModulus")[0]
        self.assertAlmostEqual(young / palpate.array(identified(), "YoungsModulus")[0], 1, places=6)
        model, polydata = self.folder / "body.vtp", self.folder / "rig.vtp"
        self.assertEqual(run("measure", model, polydata, "--radius", 0.4).returncode, 0)
        done = run("identify", surface, out, "--measurements", polydata, "--folds", 0, "--no-estimate")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertAlmostEqual(
            palpate.array(palpate.read(out), "YoungsModulus")[0] / young, 1, places=6)
        for name in ("rig.vtu", "RIG.VTP"):
            other = write_table(table(outliers=0.05), self.folder / name)
            done = run("identify", surface, out, "--measurements", other, "--folds", 0, "--no-estimate")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertRegex(done.stdout, r"outliers +\d+ of 250: tuples \d+, ")
            self.assertLess(abs(palpate.array(palpate.read(out), "YoungsModulus")[0] / young - 1), 0.01)

    def test_help_names_the_support_alone(self):
        said = run("identify", "--help").stdout
        self.assertIn("Support (by default the file's):", said)
        self.assertNotIn("Support and material", said)
        self.assertIn("Support and material", run("precompute", "--help").stdout)

    def test_refuses_in_one_line_and_leaves_no_file(self):
        surface, data = self.made("--markers", 4, "--probes", 2)
        out = self.folder / "model.vtp"
        lines = data.read_text().splitlines()
        broken = self.folder / "broken.csv"
        for text, sentence in (
                ("\n".join(lines[:3] + [lines[1]]), "broken.csv, line 4 repeats line 2"),
                ("\n".join(lines).replace("u_z", "w"), "line 1: there is no column 'w'"),
                (lines[0] + "\n", "there is no measured displacement")):
            broken.write_text(text)
            done = run("identify", surface, out, "--measurements", broken)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(sentence, done.stderr)
            self.assertEqual(len(done.stderr.strip().splitlines()), 1)
            self.assertFalse(out.exists())
        done = run("measure", self.folder / "body.vtp", out, "--tilt", 100)
        self.assertIn("0 to 90 degrees, not 100", done.stderr)
        model = self.folder / "body.vtp"
        before = model.read_bytes()
        (self.folder / "other_name.vtp").symlink_to(model)
        for same in (model, self.folder / "other_name.vtp"):
            done = run("measure", model, same)
            self.assertIn("is the model itself", done.stderr)
            self.assertEqual(len(done.stderr.strip().splitlines()), 1)
            self.assertEqual(model.read_bytes(), before)
        for extra, option in ((("--method", "fem", "--threads", 1), "--threads"),
                              (("--largest-ratio", 3), "--largest-ratio")):
            done = run("identify", surface, out, "--measurements", data, *extra)
            self.assertIn(option + " makes no sense with --method", done.stderr)
            self.assertFalse(out.exists())
        other = self.folder / "rig.vtu"
        done = run("measure", self.folder / "body.vtp", other)
        self.assertIn("written as .csv or .vtp", done.stderr)
        self.assertFalse(other.exists())


if __name__ == "__main__":
    unittest.main()
