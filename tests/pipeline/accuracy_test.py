# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`palpate accuracy`: its table, its page read by a strict HTML5 parser, its plots, its refusals."""

import csv
import functools
import math
import signal
import subprocess
import tempfile
import time
import unittest
import xml.etree.ElementTree
from pathlib import Path

import html5lib
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

import palpate
from support.surfaces import PROGRAM, cube, sphere

FOLDER = tempfile.TemporaryDirectory()
MATERIAL = ("--young", 1, "--poisson", 0.3)
HELD_SPHERE = (*MATERIAL, "--fix-half-space", 0, 0, -0.3, 0, 0, 1)
HELD_CUBE = (*MATERIAL, "--fix-half-space", 0, 0, 0, 0, 0, 1, "--subdivision", "flat")


def accuracy(*arguments):
    return subprocess.run([PROGRAM, "accuracy", *map(str, arguments)], capture_output=True, text=True)


@functools.lru_cache
def surface(name):
    path = Path(FOLDER.name) / f"{name}.vtp"
    made = {"sphere": lambda: sphere(1), "cube": lambda: cube(2), "fine": lambda: sphere(3)}[name]()
    palpate.write(made, str(path))
    return path


def table_of(path):
    with open(path, newline="", encoding="utf-8") as table:
        return list(csv.DictReader(table))


@functools.lru_cache
def rows(name, *arguments):
    """The table of a run on a surface, and what it printed."""
    path = Path(FOLDER.name) / f"table{abs(hash((name, arguments)))}.csv"
    done = accuracy(surface(name), *arguments, "--repeats", 2, "--csv", path)
    if done.returncode:
        raise AssertionError(done.stderr)
    return table_of(path), done.stdout


def of_knob(table, knob):
    return [row for row in table if row["knob"] == knob]


def errors(table, knob, value=None):
    return np.array([float(row["error"]) for row in of_knob(table, knob) if value in (None, row["value"])])


def compliances():
    return rows("sphere", *HELD_SPHERE, "--subdivision", "flat", "--at", 0, 0, 1, "--radius", 0.6,
                "--levels", 1, 2, 3, "--base-level", 2)


class Compliance(unittest.TestCase):
    def test_of_finer_levels_is_nearer_to_the_extrapolation(self):
        table, _ = compliances()
        found = errors(table, "level")
        self.assertEqual([row["vertices"] for row in of_knob(table, "level")], ["42", "162", "642"])
        self.assertTrue((found[1:] < 0.75 * found[:-1]).all(), found)  # the clamp line costs an order

    def test_names_its_reference_with_its_parameters_and_uncertainty(self):
        table, printed = compliances()
        self.assertRegex(table[0]["reference"], "Richardson .*levels 1, 2 and 3 .*642 vertices.*order")
        self.assertIn(table[0]["reference"], printed)
        for row in table:
            below = float(row["error"]) < float(row["reference_uncertainty"])
            self.assertEqual(row["below_certainty"], str(int(below)))

    def test_varies_every_knob_with_times_and_memory(self):
        table, _ = compliances()
        self.assertEqual(list(dict.fromkeys(row["knob"] for row in table)),
                         ["level", "tolerance", "solver", "collocation", "combined", "reciprocity",
                          "support", "storage", "columns", "method", "rows", "mask"])  # a sphere has no sharp edges
        for row in table:
            self.assertEqual(row["failure"], "")
            self.assertGreaterEqual(int(row["runs"]), 2)
            self.assertGreater(float(row["precompute_s_lower_quartile"]), 0)
            self.assertLessEqual(float(row["precompute_s_lower_quartile"]), float(row["precompute_s"]))
            self.assertLessEqual(float(row["query_s"]), float(row["query_s_upper_quartile"]))
            self.assertGreaterEqual(int(row["peak_bytes"]), int(row["columns"]) * 9 * 4 * int(row["vertices"]))

    def test_tells_a_knobs_own_error_apart(self):
        table, _ = compliances()
        own = {(row["knob"], row["value"], row["level"]): float(row["knob_error"])
               for row in table if row["knob_error"]}
        self.assertEqual(own["solver", "double", "2"], 0)
        self.assertLess(own["solver", "mixed", "2"], 1e-9)
        self.assertTrue(1e-9 < own["solver", "float", "2"] < 1e-4)
        self.assertTrue(1e-9 < own["storage", "float", "2"] < 1e-6)  # rounding, 6e-8 an entry
        self.assertGreater(own["tolerance", "0.1", "2"], 100 * own["tolerance", "1e-06", "2"])
        self.assertLess(own["columns", "needed", "2"], 1e-3)  # what is symmetrised differs

    def test_of_floats_takes_half_the_bytes(self):
        table, _ = compliances()
        double, single = (int(row["stored_bytes"]) for row in of_knob(table, "storage"))
        self.assertEqual(double, 2 * single)
        needed, every = (int(row["stored_bytes"]) for row in of_knob(table, "columns"))
        self.assertLess(needed, every)

    def test_of_a_single_vertex_is_far_off_and_of_masks_is_not(self):
        table, _ = compliances()
        found = errors(table, "mask")
        self.assertGreater(found[0], 2 * found[1:4].max())

    def test_marks_what_nothing_beats(self):
        table, _ = compliances()
        for stage in ("precompute", "query"):
            ways = [row for row in table if row["stage"] == stage]
            cost = [(float(row[f"{stage}_s"]), float(f"{max(float(row['error']), float(row['reference_uncertainty'])):.3g}"))
                    for row in ways]
            for row, (seconds, error) in zip(ways, cost):
                beaten = any(s <= seconds and e <= error and (s, e) != (seconds, error) for s, e in cost)
                self.assertEqual(row["pareto_front"], str(int(not beaten)), row)


class References(unittest.TestCase):
    def test_a_point_source_is_met_to_second_order(self):
        table, printed = rows("sphere", *HELD_SPHERE, "--query", "greens", "--reference", "kelvin",
                              "--levels", 1, 2, "--knobs", "level", "collocation")
        coarse, fine = errors(table, "level")
        self.assertAlmostEqual(math.log2(coarse / fine), 2, delta=0.3)
        self.assertLess(fine, 0.01)
        self.assertIn("point force", printed)

    def test_on_a_cube_patches_are_nearer_than_the_papers_one_traction(self):
        table, _ = rows("cube", *HELD_CUBE, "--query", "greens", "--reference", "kelvin", "--levels", 2, 3,
                        "--knobs", "edges")
        patches, paper = errors(table, "edges", "patches"), errors(table, "edges", "one traction a vertex")
        self.assertEqual(len(patches), 2)
        self.assertTrue((patches < 0.85 * paper).all(), (patches, paper))
        self.assertAlmostEqual(math.log2(patches[0] / patches[1]), 2, delta=0.4)
        self.assertLess(math.log2(paper[0] / paper[1]), 1.85)

    def test_the_surface_under_forces_settles(self):
        table, _ = rows("sphere", *HELD_SPHERE, "--query", "greens", "--levels", 1, 2, 3, "--knobs", "level")
        found = errors(table, "level")
        self.assertTrue((found[1:] < 0.75 * found[:-1]).all(), found)

    def test_a_file_of_finite_elements_serves(self):
        # hp finite elements, error <= 1e-5: clamped sphere, linear mask of radius 0.3 at the pole.
        path = Path(FOLDER.name) / "pole.csv"
        path.write_text("x,y,z,cxx,cxy,cxz,cyx,cyy,cyz,czx,czy,czz\n# E = 1\n"
                        "0,0,1,15.631981,0,0,0,15.631981,0,0,0,3.137999\n")
        table, printed = rows("fine", *MATERIAL, "--fix-half-space", 0, 0, -0.8, 0, 0, 1, "--levels", 1,
                              "--reference", path, "--radius", 0.3, "--knobs", "level")
        self.assertLess(errors(table, "level")[0], 0.2)  # the clamp line runs through triangles
        self.assertIn("pole.csv", printed)


class Force(unittest.TestCase):
    def test_of_a_ball_depends_on_the_level_and_hardly_on_the_solvers_tolerance(self):
        table, _ = rows("sphere", *HELD_SPHERE, "--query", "force", "--ball-radius", 0.5, "--depth", 0.1,
                        "--levels", 1, 2, 3, "--base-level", 2, "--knobs", "level", "contact")
        found = errors(table, "level")
        self.assertLess(found[2], 0.5 * found[0])
        own = [float(row["knob_error"]) for row in of_knob(table, "contact")]
        self.assertGreaterEqual(own[0], own[-1])
        self.assertEqual(own[-1], 0)
        self.assertLess(own[8], 1e-6)


class Files(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(FOLDER.name) / "report"
        cls.folder.mkdir()
        done = accuracy(surface("sphere"), *HELD_SPHERE, "--levels", 1, 2, "--repeats", 2, "--knobs", "level",
                        "collocation", "storage", "--report", cls.folder / "page.html", "--image",
                        cls.folder / "plot.png")
        if done.returncode:
            raise AssertionError(done.stderr)

    def test_are_page_table_and_plots(self):
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()),
                         ["page.csv", "page.html", "page.svg", "plot.png"])

    def test_page_is_valid_and_needs_no_other_file(self):
        text = (self.folder / "page.html").read_text(encoding="utf-8")
        page = html5lib.HTMLParser(strict=True, namespaceHTMLElements=False).parse(text)
        for forbidden in ("http", "src=", "href=", "url(", "<script", "@import"):
            self.assertNotIn(forbidden, text)
        self.assertEqual(len(list(page.iter("{http://www.w3.org/2000/svg}svg"))), 1)
        shown = "".join(page.itertext())
        for row in table_of(self.folder / "page.csv"):
            self.assertIn(f"{100 * float(row['error']):.3g} %", shown)
        self.assertIn("Richardson", shown)

    def test_plot_has_a_mark_for_every_setting(self):
        root = xml.etree.ElementTree.parse(self.folder / "page.svg").getroot()
        circles = list(root.iter("{http://www.w3.org/2000/svg}circle"))
        self.assertGreaterEqual(len(circles), len(table_of(self.folder / "page.csv")))
        for circle in circles:
            self.assertTrue(0 < float(circle.get("cx")) < 1400)
            self.assertTrue(0 < float(circle.get("cy")) < 470)

    def test_picture_shows_coloured_marks_on_white(self):
        reader = vtkPNGReader()
        reader.SetFileName(str(self.folder / "plot.png"))
        reader.Update()
        width, height, _ = reader.GetOutput().GetDimensions()
        pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).reshape(height, width, -1)
        self.assertEqual((width, height), (2800, 940))
        coloured = np.ptp(pixels[:, :, :3].astype(int), axis=2) > 60
        self.assertTrue(1e-4 < coloured.mean() < 0.05, coloured.mean())
        self.assertGreater((pixels[:, :, :3] == 255).all(axis=2).mean(), 0.8)


class Refusals(unittest.TestCase):
    def refused(self, sentence, *arguments):
        with tempfile.TemporaryDirectory() as folder:
            done = accuracy(*arguments, "--report", Path(folder) / "page.html")
            self.assertGreater(done.returncode, 0, arguments)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
            self.assertRegex(done.stderr, sentence)
            self.assertEqual(list(Path(folder).iterdir()), [])

    def test_name_what_is_wrong_and_write_nothing(self):
        held = (surface("sphere"), *HELD_SPHERE)
        self.refused("no knob 'speed'.*choose some of level, tolerance", *held, "--knobs", "speed")
        self.refused("no knob 'contact' of the query compliance", *held, "--knobs", "contact")
        self.refused("no sharp edge", *held, "--knobs", "edges")
        self.refused("off the surface", *held, "--at", 0, 0, 9)
        self.refused("two levels or more", *held, "--levels", 1)
        self.refused("have no level 3", *held, "--levels", 1, 2, "--base-level", 3)
        self.refused("is coarser than the last of --levels, 2", *held, "--levels", 1, 2,
                     "--reference-level", 1)
        self.refused("one of the reference finest", *held, "--query", "greens", "--reference", "kelvin",
                     "--reference-level", 3)
        self.refused("query greens", *held, "--reference", "kelvin")
        self.refused("levels", *held, "--levels", 0)
        self.refused("missing.vtp", "missing.vtp")
        self.refused("Young", surface("sphere"), "--fix-half-space", 0, 0, 0, 0, 0, 1)

    def test_of_files_that_cannot_be_written_come_before_the_work(self):
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "page.svg").mkdir()
            done = accuracy(surface("sphere"), *HELD_SPHERE, "--levels", 1, 2, "--report",
                            Path(folder) / "page.html")
            self.assertGreater(done.returncode, 0)
            self.assertRegex(done.stderr, "page.svg cannot be written: it is a folder")
            self.assertEqual(done.stdout, "")

    def test_of_a_reference_file_name_its_line(self):
        held = (surface("sphere"), *HELD_SPHERE, "--radius", 0.5)
        path = Path(FOLDER.name) / "bad.csv"
        self.refused("absent.csv cannot be read", *held, "--reference", "absent.csv")
        path.write_text("x,y,z,c\n0,0,1,1,0,0,0,1,0,0,0,1\n0,0,1,1,0,0,0,1,0,0,0\n")
        self.refused("bad.csv, line 3: .*twelve", *held, "--reference", path)
        path.write_text("0,0,1,1,0,0,0,nan,0,0,0,1\n")
        self.refused("bad.csv, line 1: ", *held, "--reference", path)
        path.write_text("0,0,1" + 9 * ",0" + "\n")
        self.refused("bad.csv, line 1: a compliance of zero", *held, "--reference", path)
        path.write_text("x,y,z\nx,y,z\n0,0,1,1,0,0,0,1,0,0,0,1\n")
        self.refused("bad.csv, line 2: ", *held, "--reference", path)
        path.write_text("x,y,z\n")
        self.refused("no compliance", *held, "--reference", path)
        path.write_text("0,0,1,1,0,0,0,1,0,0,0,1\n")
        self.refused("leave --at out", *held, "--reference", path, "--at", 0, 0, 1)
        self.refused("--radius", surface("sphere"), *HELD_SPHERE, "--reference", path)
        self.refused("query compliance", *held, "--reference", path, "--query", "force")

    def test_an_interrupted_run_leaves_no_file(self):
        with tempfile.TemporaryDirectory() as folder:
            running = subprocess.Popen([PROGRAM, "accuracy", *map(str, (
                surface("fine"), *HELD_SPHERE, "--levels", 1, 2, "--report", Path(folder) / "page.html",
                "--image", Path(folder) / "plot.png"))], stderr=subprocess.PIPE, text=True)
            time.sleep(1)
            running.send_signal(signal.SIGINT)
            _, failure = running.communicate(timeout=300)
            self.assertEqual(running.returncode, 1)
            self.assertIn("interrupted", failure)
            self.assertEqual(list(Path(folder).iterdir()), [])


if __name__ == "__main__":
    unittest.main()
