# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Stiffness that varies inside, through filters, files, program and package."""

import functools
import tempfile
import unittest
from pathlib import Path

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkPolyData

import palpate
from palpate.arrays import as_vtk
from support.refused import Refusals
from support.solids import bar, set_cells
from support.surfaces import points_of, run

YOUNG, POISSON = 2e4, 0.3


def held(divisions, upper=1.0):
    """A bar held below, its upper half stiffer by a factor."""
    grid = bar(divisions)
    points = points_of(grid)
    cells = palpate_cells(grid)
    above = points[cells].mean(axis=1)[:, 2] > 1
    set_cells(grid, YoungsModulus=np.where(above, upper * YOUNG, YOUNG),
              PoissonRatio=np.full(len(cells), POISSON))
    grid.GetPointData().AddArray(as_vtk((points[:, 2] == 0).astype(np.uint8), "BoundaryType", 1, np.uint8))
    return grid


def palpate_cells(grid):
    return np.array([[grid.GetCell(c).GetPointId(k) for k in range(4)]
                     for c in range(grid.GetNumberOfCells())])


@functools.lru_cache(maxsize=None)
def truth():
    return palpate.precompute(held((4, 4, 8), 5.0), young=YOUNG, poisson=POISSON, method="fem",
                              estimate_error=False)


@functools.lru_cache(maxsize=None)
def table():
    return palpate.simulate_measurements(truth(), probes=10, radius=0.5)


@functools.lru_cache(maxsize=None)
def found():
    return palpate.identify_field(held((3, 3, 6)), table(), poisson=POISSON, modes=20, length=0.6)


def turned(measurements):
    """The same with displacements of the wrong sign."""
    copy = vtkPolyData()
    copy.ShallowCopy(measurements)
    copy.GetFieldData().AddArray(
        as_vtk(-palpate.array(measurements, "MeasuredDisplacement"), "MeasuredDisplacement", 3, float))
    return copy


class Field(Refusals):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_says_where_the_body_is_stiffer(self):
        model, volume = found()
        self.assertEqual(palpate.array(model, "IdentifiedNames"), ["mean Young's modulus"])
        moduli = palpate.array(volume, "YoungsModulus")
        middles = points_of(volume)[palpate_cells(volume)].mean(axis=1)
        upper, lower = moduli[middles[:, 2] > 1.3], moduli[middles[:, 2] < 0.7]
        self.assertLess(abs(np.log(np.median(upper) / np.median(lower) / 5)), np.log(1.6))
        deviations = palpate.array(volume, "LogModulusDeviation")
        self.assertTrue(((deviations > 0) & (deviations < 1)).all())
        self.assertGreater(palpate.array(model, "DeterminedUnknowns")[0], 3)

    def test_is_taken_where_it_predicts_probes_left_out_better(self):
        options = dict(method="fem", poisson=POISSON, modes=20, length=0.6, estimate_error=False)
        model, volume = palpate.identify_best(held((3, 3, 6)), table(), **options)
        names = palpate.array(model, "TriedModels")
        errors = palpate.array(model, "TriedHoldOutErrors")
        self.assertEqual(names, ["material", "field", "correction"])
        self.assertLess(errors[1], 0.8 * errors[0])
        self.assertEqual(palpate.array(model, "IdentifiedNames"), ["mean Young's modulus"])
        self.assertGreater(volume.GetNumberOfCells(), 0)
        # The errors are those of the displacements that not all three take for outliers.
        held_out = palpate.array(model, "MeasurementHeldOutResidual")
        self.assertEqual(held_out.shape, palpate.array(model, "MeasurementResidual").shape)
        of_all = np.sqrt((held_out ** 2).sum() / (palpate.array(model, "MeasuredDisplacement") ** 2).sum())
        self.assertAlmostEqual(of_all / errors[1], 1, delta=0.05)
        uniform = palpate.simulate_measurements(
            palpate.precompute(held((4, 4, 8)), YOUNG, POISSON, method="fem", estimate_error=False),
            probes=10, radius=0.5)
        model, volume = palpate.identify_best(held((3, 3, 6)), uniform, **options)
        self.assertEqual(palpate.array(model, "IdentifiedNames"), ["Young's modulus"])
        self.assertEqual(volume.GetNumberOfCells(), 0)

    def test_what_cannot_be_chosen_is_said(self):
        for words, arguments in (("at least two folds, not 1", dict(folds=1)),
                                 ("against the forces", dict(force_unit="N", turned=True))):
            measurements = turned(table()) if arguments.pop("turned", False) else table()
            self.refused(words, palpate.identify_best, held((3, 3, 6)), measurements, method="fem",
                         poisson=POISSON, modes=5, length=0.6, estimate_error=False, **arguments)

    def test_the_volume_is_what_the_model_is_of(self):
        model, volume = found()
        again = palpate.precompute(volume, method="fem")
        self.assert_same(model, again)
        force = dict(point=(0.5, 0.5, 2), force=(0, 0, -1), radius=0.5)
        np.testing.assert_allclose(*(palpate.array(palpate.press(m, **force), "Displacement")
                                     for m in (model, again)), atol=1e-12)

    def assert_same(self, *models):
        """Green's functions to rounding, support and material to the bit."""
        first, second = (palpate.greens_functions(model) for model in models)
        np.testing.assert_allclose(first, second, rtol=0, atol=1e-12 * np.abs(first).max())
        for name in ("BoundaryType", "GreensFunctionNodes", "YoungsModulus", "PoissonRatio"):
            np.testing.assert_array_equal(*(palpate.array(model, name) for model in models))

    def test_a_filling_with_other_triangles_comes_back_from_its_file(self):
        kidney, rig, out, field, again = (
            self.folder / name for name in ("kidney.vtp", "rig.csv", "out.vtp", "field.vtu", "again.vtp"))
        surface = palpate.refine(palpate.read(palpate.example("kidney")))
        palpate.write(surface, kidney)
        palpate.write(palpate.precompute(surface, estimate_error=False), out)
        self.assertEqual(run("measure", out, rig).returncode, 0)
        done = run("identify", kidney, out, "--measurements", rig, "--method", "fem", "--field", field,
                   "--modes", 5, "--folds", 0)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("triangles of the surface are others now", done.stderr)
        done = run("precompute", field, again, "--method", "fem", "--no-estimate")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assert_same(*map(palpate.read, (out, again)))

    def test_from_files_by_the_program(self):
        surface, out, field = (self.folder / name for name in ("body.vtp", "found.vtp", "field.vtu"))
        palpate.write(palpate.precompute(held((2, 2, 4)), young=1, poisson=0.3, method="fem",
                                         estimate_error=False), surface)
        rig = self.folder / "rig.csv"
        model = self.folder / "truth.vtp"
        palpate.write(truth(), model)
        self.assertEqual(run("measure", model, rig, "--radius", 0.5).returncode, 0)
        common = ("identify", surface, out, "--measurements", rig, "--poisson", POISSON, "--modes", 8)
        done = run(*common, "--method", "fem", "--field", field)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"mean Young's modulus, Pa +\d")
        self.assertRegex(done.stdout, r"unknowns that are determined +\d")
        self.assertIn(f"a field of 8 modes identified from 250 displacements under 5 probes ({rig})", done.stdout)
        self.assertRegex(done.stderr, r"the identified Young's modulus is \d+ times that of the input, 1 Pa")
        volume = palpate.read_volume(field)
        self.assertEqual(palpate.array(volume, "YoungsModulus").size, volume.GetNumberOfCells())
        out.unlink()
        field.unlink()
        for extra, sentence in (((), "--modes requires --field"), (("--field", field), "add --method fem"),
                                *((("--method", "fem", "--field", field, name, value),
                                   f"{name} makes no sense with --field: leave it out")
                                  for name, value in (("--largest-ratio", 10), ("--threads", 0),
                                                      ("--interpolation-tolerance", 1e-3))),
                                (("--method", "fem", "--field", self.folder / "field.txt"), ".vtu")):
            done = run(*common, *extra)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(sentence, (done.stdout + done.stderr).lower())
            self.assertFalse(out.exists() or field.exists())

    def test_what_cannot_be_is_refused(self):
        def refused(words, **settings):
            self.refused(words, palpate.identify_field, held((2, 2, 4)), table(),
                         **{"poisson": POISSON, **settings})

        refused("at least one mode", modes=0)
        refused("length must be above 0", length=0)
        refused("deviation must be above 0", deviation=0)
        refused("deviation of ln E", deviation=11)
        refused("without volume", volume="body")

    def test_aborts_without_a_result(self):
        with self.assertRaises(palpate.Aborted):
            palpate.identify_field(held((2, 2, 4)), table(), poisson=POISSON,
                                   progress=lambda fraction, stage: stage != "fit")


if __name__ == "__main__":
    unittest.main()
