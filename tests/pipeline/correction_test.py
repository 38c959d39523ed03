# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Green's functions corrected by measurements, through filters, files, program and package."""

import doctest
import functools
import re
import tempfile
import unittest
from pathlib import Path

import palpate
from palpate import correction
from palpate.arrays import as_vtk
from support.refused import Refusals
from support.surfaces import failure_of, lower_cap, run, sphere
from support.tables import write_table


def held_sphere():
    surface = sphere(2)
    surface.GetPointData().AddArray(as_vtk(lower_cap(surface), "BoundaryType", 1, "uint8"))
    return surface


@functools.lru_cache(maxsize=None)
def body(poisson=0.45):
    return palpate.precompute(held_sphere(), young=2e4, poisson=poisson, estimate_error=False)


@functools.lru_cache(maxsize=None)
def table():
    return palpate.simulate_measurements(body(), probes=20, radius=0.4)


class Correction(Refusals):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_predicts_probes_better_than_the_prior(self):
        model = palpate.correct(body(0.1), table())
        self.assertLess(palpate.array(model, "HoldOutError")[0],
                        0.9 * palpate.array(model, "PriorHoldOutError")[0])
        pressed = palpate.press(model, point=(0, 0, 1), force=(0, 0, -1), radius=0.3)
        self.assertLess(palpate.array(pressed, "Displacement")[:, 2].min(), 0)

    def test_by_the_program_as_by_the_package(self):
        prior, rig, out = (self.folder / name for name in ("prior.vtp", "rig.vtp", "out.vtp"))
        palpate.write(body(0.1), prior)
        palpate.write(table(), rig)
        done = run("correct", prior, out, "--measurements", rig, "--modes", 30, "--smoothing", 0.1)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"error at probes left out +\d")
        text = self.folder / "rig.csv"
        self.assertEqual(run("measure", prior, text, "--radius", 0.4).returncode, 0)
        told = run("correct", prior, self.folder / "told.vtp", "--measurements", text, "--smoothing", 0.1)
        self.assertRegex(told.stdout, rf"corrected by 250 displacements under 5 probes \({re.escape(str(text))}\)")
        found = palpate.correct(body(0.1), table(), modes=30, smoothing=0.1)
        self.assertEqual(palpate.array(palpate.read(out), "IdentifiedParameters").tolist(),
                         palpate.array(found, "IdentifiedParameters").tolist())
        out.unlink()
        for extra, sentence in ((("--smoothing", 0), "not in range"), (("--folds", 0), "must be given"),
                                (("--length-unit", "mm"), "off the surface")):
            done = run("correct", prior, out, "--measurements", rig, *extra)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(sentence, done.stderr.lower())
            self.assertFalse(out.exists())

    def test_names_outliers_in_tables_of_any_kind(self):
        prior, out = self.folder / "prior.vtp", self.folder / "out.vtp"
        palpate.write(body(0.1), prior)
        spoilt = palpate.simulate_measurements(body(), probes=20, radius=0.4, outliers=0.05)
        found = palpate.correct(body(0.1), spoilt, smoothing=0.1)
        self.assertRegex(palpate.array(found, "GreensFunctionSource")[0],
                         r"; corrected by 1000 displacements under 20 probes \(a table\)$")
        expected = palpate.array(found, "MeasurementOutlier")
        self.assertGreater(expected.sum(), 20)
        for name in ("rig.vtu", "Rig.VTP"):
            rig = write_table(spoilt, self.folder / name)
            done = run("correct", prior, out, "--measurements", rig, "--smoothing", 0.1)
            self.assertEqual(done.returncode, 0, done.stderr)
            said = re.search(r"outliers +(\d+) of 1000: tuples (.*) and (\d+) more", done.stdout)
            self.assertEqual(int(said[1]), expected.sum())
            self.assertEqual(int(said[3]), expected.sum() - 12)
            self.assertEqual([int(i) for i in said[2].split(", ")], list(expected.nonzero()[0][:12]))

    def test_refuses_what_cannot_be(self):
        self.refused("no Green's functions", palpate.correct, held_sphere(), table())
        self.refused("smoothing must be above 0", palpate.correct, body(), table(), smoothing=0)
        self.refused("modes, not 100000", palpate.correct, body(), table(), modes=100000)
        self.refused("not list", palpate.correct, body(), [1])
        filter = palpate.vtkComplianceCorrection()
        filter.SetInputData(body())
        self.assertIn("from a file or from the input of their table", failure_of(filter))
        with self.assertRaises(palpate.Aborted):
            palpate.correct(body(), table(), progress=lambda *_: False)

    def test_every_example_runs(self):
        failed, attempted = doctest.testmod(correction)
        self.assertEqual(failed, 0)
        self.assertGreater(attempted, 4)


if __name__ == "__main__":
    unittest.main()
