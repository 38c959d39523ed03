# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The pages of `identify`, `correct` and `recover`: their numbers, pictures and refusals."""

import functools
import os
import re
import tempfile
import unittest
from pathlib import Path

import numpy as np
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

import palpate
from palpate.arrays import as_vtk
from support.pages import BROWSER, decoded, parsed, pictures_in_browser, what_needs_other_files
from support.solids import bar, set_cells
from support.surfaces import lower_cap, points_of, run, sphere

FOLDER = tempfile.TemporaryDirectory()
YOUNG, POISSON = 2e4, 0.4


def place(name):
    return Path(FOLDER.name) / name


@functools.lru_cache
def files():
    """A surface, and tables of its body, as files; one more of a finer body."""
    for name, levels in (("surface", 2), ("fine", 3)):
        surface = sphere(levels)
        surface.GetPointData().AddArray(as_vtk(lower_cap(surface), "BoundaryType", 1, np.uint8))
        palpate.write(surface, place(f"{name}.vtp"))
        body = palpate.precompute(surface, young=YOUNG, poisson=POISSON, estimate_error=False)
        palpate.write(body, place(f"{name}_body.vtp"))
    for name, body, options in (("rig", "surface", ("--probes", 5, "--outliers", 0.04)),
                                ("fine", "fine", ("--probes", 5)),
                                ("press", "fine", ("--probes", 1, "--markers", 150))):
        done = run("measure", place(f"{body}_body.vtp"), place(f"{name}.csv"), "--radius", 0.4, *options)
        assert done.returncode == 0, done.stderr
    return place("surface.vtp"), place("rig.csv"), place("press.csv")


def made(name, *arguments):
    """A model, its parsed page, and what was printed."""
    out, page = place(f"{name}.vtp"), place(f"{name}.html")
    done = run(*arguments[:-1], out, *arguments[-1], "--report", page)
    assert done.returncode == 0, done.stderr
    return palpate.read(out), parsed(page), done.stdout


@functools.lru_cache
def identified():
    surface, rig, _ = files()
    return made("found", "identify", surface, ("--measurements", rig, "--next-probes", 2))


@functools.lru_cache
def field():
    grid = bar((3, 3, 6))
    points = points_of(grid)
    cells = np.array([[grid.GetCell(c).GetPointId(k) for k in range(4)] for c in range(grid.GetNumberOfCells())])
    above = points[cells].mean(axis=1)[:, 2] > 1
    set_cells(grid, YoungsModulus=np.where(above, 5 * YOUNG, YOUNG), PoissonRatio=np.full(len(cells), 0.3))
    grid.GetPointData().AddArray(as_vtk((points[:, 2] == 0).astype(np.uint8), "BoundaryType", 1, np.uint8))
    palpate.write(palpate.precompute(grid, young=YOUNG, poisson=0.3, method="fem", estimate_error=False),
                  place("layers.vtp"))
    assert run("measure", place("layers.vtp"), place("layers.csv"), "--probes", 8, "--radius", 0.5).returncode == 0
    return made("layered", "identify", place("layers.vtp"),
                ("--measurements", place("layers.csv"), "--method", "fem", "--poisson", 0.3, "--modes", 8,
                 "--field", place("layered.vtu")))


@functools.lru_cache
def corrected():
    surface, rig, _ = files()
    palpate.write(palpate.precompute(palpate.read(surface), young=YOUNG, poisson=0.1), place("prior.vtp"))
    return made("corrected", "correct", place("prior.vtp"), ("--measurements", rig))


@functools.lru_cache
def recovered():
    surface, _, press = files()
    palpate.write(palpate.precompute(palpate.read(surface), young=YOUNG, poisson=POISSON), place("model.vtp"))
    return made("recovered", "recover", place("model.vtp"), press, ())


def text_of(page):
    return " ".join("".join(page.itertext()).split())


def tables_of(page):
    """Every table as its rows of cells, the head first."""
    return [[["".join(cell.itertext()) for cell in row] for row in table.iter("tr")]
            for table in page.iter("table")]


def table_with(page, head):
    return next(table for table in tables_of(page) if head in table[0])


def marks_of(page, colour):
    """How many marks of a colour each plot has."""
    svg = "{http://www.w3.org/2000/svg}"
    return [sum(colour in (mark.get("fill"), mark.get("stroke")) for mark in plot.iter(f"{svg}circle"))
            for plot in page.iter(f"{svg}svg")]


class Identification(unittest.TestCase):
    def test_tells_the_parameters_as_stored_and_as_printed(self):
        model, page, printed = identified()
        rows = table_with(page, "standard deviation")[1:]
        values = palpate.array(model, "IdentifiedParameters")
        self.assertEqual([row[0] for row in rows], ["Young's modulus, Pa", "Poisson's ratio"])
        for row, (value, deviation, low, high) in zip(rows, values):
            self.assertEqual(row[1:], [f"{value:.4g}", f"{deviation:.2g}", f"{low:.4g}", f"{high:.4g}"])
            self.assertRegex(printed, re.escape(row[0]) + rf" +{re.escape(row[1])} \+- {re.escape(row[2])} ")
        correlation = table_with(page, "correlation")
        self.assertEqual(correlation[1][2], f"{palpate.array(model, 'IdentifiedCorrelations')[0, 1]:.2g}")
        error = palpate.array(model, "HoldOutError")[0]
        self.assertIn(f"off by {100 * error:.3g} % of the displacements", text_of(page))

    def test_tells_every_probe_and_names_outliers_by_line(self):
        model, page, _ = identified()
        rows = table_with(page, "markers")[1:]
        self.assertEqual([row[0] for row in rows], palpate.array(model, "ProbeNames"))
        residuals = palpate.array(model, "ProbeResidual")
        self.assertEqual([row[6] for row in rows], [f"{residual:.3g}" for residual in residuals])
        self.assertEqual([int(row[5]) for row in rows], palpate.array(model, "ProbeOutliers").tolist())
        lines = palpate.array(model, "MeasurementRow")[palpate.array(model, "MeasurementOutlier") == 1]
        self.assertGreater(len(lines), 5)
        self.assertEqual([int(row[0]) for row in table_with(page, "line")[1:]], lines.tolist())

    def test_plots_every_component_and_rings_outliers(self):
        model, page, _ = identified()
        seen = np.isfinite(palpate.array(model, "MeasurementResidual"))
        wrong = palpate.array(model, "MeasurementOutlier") == 1
        for axis, colour in enumerate(("#4477aa", "#228833", "#ccbb44")):
            for count in marks_of(page, colour):  # one more in the legend
                self.assertEqual(count, seen[~wrong, axis].sum() + 1)
        self.assertEqual(marks_of(page, "#cc3311"), [seen[wrong].sum() + 1] * 2)

    def test_proposes_probes_and_says_what_it_was_made_by(self):
        model, page, _ = identified()
        after = palpate.array(model, "NextProbeDeviations")
        rows = table_with(page, "vertex")[1:]
        self.assertEqual([row[4:] for row in rows], [[f"{value:.2g}" for value in row] for row in after])
        shown = text_of(page)
        self.assertIn(str(palpate.array(model, "MeshFingerprint")[0]), shown)
        self.assertIn(palpate.array(model, "GreensFunctionSource")[0], shown)
        settings = {row[0]: row[1] for table in tables_of(page) for row in table if len(row) == 2}
        self.assertEqual((settings["--loss"], settings["--next-probes"], settings["--folds"]), ("cauchy", "2", "5"))
        self.assertNotIn("--modes", settings)  # of fields alone
        self.assertGreater(float(settings["seconds in all"]), 0)

    def test_shows_markers_and_probes_in_colours_and_outliers_in_red(self):
        _, page, _ = identified()
        picture = next(image for image in page.iter("img") if image.get("alt") == "probes and markers")
        pixels = decoded(picture.get("src")).astype(int)
        red = (pixels[:, :, 0] > 180) & (pixels[:, :, 1:].max(axis=2) < 70)
        green = (pixels[:, :, 1] - pixels[:, :, 0] > 50) & (pixels[:, :, 1] > 90)
        self.assertGreater(red.sum(), 200)
        self.assertGreater(green.sum(), 500)

    def test_of_a_number_at_its_bound_gives_an_interval_up_to_it_and_says_so(self):
        surface, _, _ = files()
        model, page, _ = made("bound", "identify", surface, ("--measurements", place("fine.csv"),
                                                             "--poisson-range", 0.1, 0.2, "--folds", 0))
        value, deviation, low, high = palpate.array(model, "IdentifiedParameters")[1]
        self.assertEqual((value, high), (0.2, 0.2))
        self.assertLess(low, high)
        self.assertEqual(table_with(page, "standard deviation")[2][2:5],
                         [f"{deviation:.2g}", f"{low:.4g}", f"{high:.4g}"])
        self.assertIn("Poisson's ratio is at the bound 0.2", text_of(page))

    def test_of_a_model_that_differs_says_that_deviations_are_too_small(self):
        surface, _, _ = files()
        model, page, printed = made("coarse", "identify", surface, ("--measurements", place("fine.csv"), "--folds", 0))
        correlation, by_chance = palpate.array(model, "NeighbourCorrelation").ravel()
        self.assertLess(by_chance, 0.001)
        said = f"correlation {correlation:.2g}, as much in {100 * by_chance:.3g} % of tables of noise"
        for text in (text_of(page), printed):
            self.assertIn(said, text)
        self.assertIn("residuals of neighbouring markers go together", text_of(page))
        self.assertIn("too small here", text_of(page))
        rows = table_with(page, "deviation by probes left out")[1:]
        for row, deviation in zip(rows, palpate.array(model, "ProbewiseDeviation")):
            self.assertEqual(row[5], f"{deviation:.2g}")
            self.assertIn(f"+- {row[5]} by probes left out", printed)
        model, page, printed = identified()
        self.assertGreater(palpate.array(model, "NeighbourCorrelation").ravel()[1], 0.001)
        for text in (text_of(page), printed):
            self.assertNotIn("by probes left out", text)
            self.assertIn("% of tables of noise", text)

    def test_of_a_known_ratio_says_what_was_looked_for_alone(self):
        surface, rig, _ = files()
        model, page, _ = made("known", "identify", surface, ("--measurements", rig, "--poisson", POISSON,
                                                             "--folds", 0, "--no-estimate"))
        self.assertEqual(len(table_with(page, "standard deviation")), 2)
        self.assertIn("There was no cross-validation", text_of(page))
        self.assertFalse(any("correlation" in table[0] for table in tables_of(page)))
        self.assertEqual(palpate.array(model, "HoldOutError")[0], -1)


class Regions(unittest.TestCase):
    def test_tell_what_the_mesh_makes_of_each(self):
        def block(divisions):
            grid = bar(divisions)
            points = points_of(grid)
            cells = np.array([[grid.GetCell(c).GetPointId(k) for k in range(4)]
                              for c in range(grid.GetNumberOfCells())])
            grid.GetPointData().AddArray(as_vtk((points[:, 2] == 0).astype(np.uint8), "BoundaryType", 1, np.uint8))
            return grid, points[cells].mean(axis=1)[:, 2] > 1

        grid, above = block((6, 6, 12))
        set_cells(grid, YoungsModulus=np.where(above, 3 * YOUNG, YOUNG), PoissonRatio=np.full(len(above), 0.3))
        palpate.write(palpate.precompute(grid, young=YOUNG, poisson=0.3, method="fem", estimate_error=False),
                      place("two.vtp"))
        self.assertEqual(run("measure", place("two.vtp"), place("two.csv"), "--probes", 8, "--radius", 0.7,
                             "--noise", 0.002).returncode, 0)
        grid, above = block((3, 3, 6))
        grid.GetCellData().AddArray(as_vtk(above.astype(np.int32), "MaterialRegion", 1, np.int32))
        writer = vtkXMLUnstructuredGridWriter()
        writer.SetFileName(str(place("two.vtu")))
        writer.SetInputData(grid)
        writer.Write()
        model, page, printed = made("two_found", "identify", place("two.vtu"),
                                    ("--measurements", place("two.csv"), "--method", "fem", "--poisson", 0.3,
                                     "--folds", 0))
        found = palpate.array(model, "IdentifiedParameters")[:, 0]
        off = palpate.array(model, "ParametersOffByMesh").ravel()
        truth = np.array([YOUNG, 3 * YOUNG])
        errors = found / truth - 1
        self.assertGreater(np.abs(errors).max(), 0.05)
        # The body of half as long edges that was measured is off itself: errors go with their power of 5/4.
        left = errors - (1 - 2**-1.25) * off / truth
        self.assertLess(np.abs(left).max(), 0.4 * np.abs(errors).max())
        self.assertGreater(palpate.array(model, "ErrorEstimate")[0], 0)
        said = (f"Young's modulus of region 0 by {off[0]:.2g} Pa, Young's modulus of region 1 by {off[1]:.2g} Pa")
        for text in (text_of(page), printed):
            self.assertIn(said, text)


class Others(unittest.TestCase):
    def test_of_a_field_shows_slices_and_where_the_data_see_least(self):
        model, page, printed = field()
        volume = palpate.read_volume(place("layered.vtu"))
        moduli, deviations = (palpate.array(volume, name) for name in ("YoungsModulus", "LogModulusDeviation"))
        shown = text_of(page)
        self.assertIn(f"from {moduli.min():.3g} to {moduli.max():.3g} Pa", shown)
        self.assertIn(f"(deviation {deviations.max():.2g})", shown)
        self.assertIn(f"determine {palpate.array(model, 'DeterminedUnknowns')[0]:.3g} of", shown)
        slices = {image.get("alt"): decoded(image.get("src")).astype(int) for image in page.iter("img")}
        pixels = slices["YoungsModulus in three slices"][:, :900]
        colours = [np.array(colour) for colour in ((68, 1, 84), (253, 231, 37))]  # the ends of viridis
        for colour in colours:
            self.assertGreater((np.abs(pixels - colour).max(axis=2) < 70).sum(), 500)
        self.assertIn("LogModulusDeviation in three slices", slices)

    def test_of_a_correction_compares_with_the_prior(self):
        model, page, printed = corrected()
        shown = text_of(page)
        for name in ("HoldOutError", "PriorHoldOutError"):
            self.assertIn(f"{100 * palpate.array(model, name)[0]:.3g} %", shown)
        factor = palpate.array(model, "IdentifiedParameters")[0, 0]
        self.assertEqual(table_with(page, "standard deviation")[1][1], f"{factor:.4g}")
        self.assertIn(f"{factor:.4g}", printed)

    def test_of_contacts_tells_forces_as_stored(self):
        model, page, printed = recovered()
        rows = table_with(page, "its components, N")
        forces = palpate.array(model, "ContactForce")
        self.assertEqual(len(rows), len(forces) + 2)
        for row, force in zip(rows[1:], forces):
            self.assertEqual(row[1], f"{np.linalg.norm(force):.4g}")
            self.assertEqual(row[2], "(" + ", ".join(f"{value:.4g}" for value in force) + ")")
            self.assertIn(f"{row[1]} N at", printed)
        self.assertEqual(len(list(page.iter("img"))), 2)

    def test_all_need_no_other_file(self):
        for name, make in (("found", identified), ("layered", field), ("corrected", corrected),
                           ("recovered", recovered)):
            make()
            self.assertEqual(what_needs_other_files(place(f"{name}.html")), [], name)

    @unittest.skipUnless(BROWSER, "no Chromium is installed")
    def test_all_open_in_a_browser_with_all_pictures(self):
        for name, make in (("found", identified), ("layered", field), ("corrected", corrected),
                           ("recovered", recovered)):
            _, page, _ = make()
            count = len(list(page.iter("img")))
            self.assertGreater(count, 0)
            self.assertEqual(pictures_in_browser(place(f"{name}.html"), FOLDER.name), count)


class Refusals(unittest.TestCase):
    def refused(self, sentence, report):
        surface, rig, press = files()
        recovered()
        corrected()
        for command in (("identify", surface, place("no.vtp"), "--measurements", rig),
                        ("correct", place("prior.vtp"), place("no.vtp"), "--measurements", rig),
                        ("recover", place("model.vtp"), press, place("no.vtp"))):
            done = run(*command, "--report", report)
            self.assertNotEqual(done.returncode, 0)
            self.assertRegex(done.stderr, sentence)
            self.assertFalse(place("no.vtp").exists() or Path(report).is_file())

    def test_come_before_anything_is_computed(self):
        self.refused("reports are written as .html", place("page.txt"))
        self.refused("there is no folder", place("nowhere") / "page.html")

    def test_of_data_that_say_nothing_leave_no_page(self):
        surface, rig, _ = files()
        lines = rig.read_text().splitlines()
        place("few.csv").write_text("\n".join(lines[:1]))
        done = run("identify", surface, place("no.vtp"), "--measurements", place("few.csv"), "--report",
                   place("no.html"))
        self.assertIn("there is no measured displacement", done.stderr)
        self.assertFalse(place("no.html").exists())

    def test_a_page_that_was_there_stays_whole(self):
        surface, rig, _ = files()
        place("old.html").write_text("old")
        done = run("identify", surface, place("no.vtp"), "--measurements", place("missing.csv"), "--report",
                   place("old.html"))
        self.assertNotEqual(done.returncode, 0)
        self.assertEqual(place("old.html").read_text(), "old")
        self.assertEqual([name for name in os.listdir(FOLDER.name) if "old" in name], ["old.html"])


if __name__ == "__main__":
    unittest.main()
