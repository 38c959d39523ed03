# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`palpate accuracy --query identification`: what a better identification costs."""

import csv
import functools
import tempfile
import unittest
from pathlib import Path

import numpy as np

import palpate
from palpate.arrays import as_vtk
from support.pages import parsed, what_needs_other_files
from support.surfaces import lower_cap, run, sphere

FOLDER = tempfile.TemporaryDirectory()


def place(name):
    return Path(FOLDER.name) / name


@functools.lru_cache
def files():
    """A coarse sphere to be identified, and finer ones, held alike, as they are: of Poisson's ratio 0.1."""
    coarse = sphere(1)
    coarse.GetPointData().AddArray(as_vtk(lower_cap(coarse), "BoundaryType", 1, np.uint8))
    for name, levels in (("coarse", 0), ("middle", 1), ("fine", 2)):
        surface = palpate.refine(coarse, levels=levels, subdivision="curved")
        palpate.write(surface, place(f"{name}.vtp"))
        body = palpate.precompute(surface, young=1e4, poisson=0.1, estimate_error=False)
        palpate.write(body, place(f"{name}_truth.vtp"))
    return place("coarse.vtp"), place("fine_truth.vtp")


def study(surface, rig, *options):
    return run("accuracy", surface, "--query", "identification", "--rig", rig, "--radius", 0.5, "--subdivision",
               "curved", "--repeats", 2, *options)


@functools.lru_cache
def table():
    surface, truth = files()
    done = study(surface, truth, "--levels", 1, 2, "--base-level", 1, "--knobs", "level", "loss", "interpolation",
                 "correction", "--report", place("study.html"))
    assert done.returncode == 0, done.stderr
    with open(place("study.csv"), newline="", encoding="utf-8") as rows:
        return list(csv.DictReader(rows)), done.stdout


def errors(rows, knob):
    return {row["value"]: float(row["error"]) for row in rows if row["knob"] == knob}


class Study(unittest.TestCase):
    def test_of_finer_surfaces_is_nearer_to_the_truth(self):
        rows, _ = table()
        found = errors(rows, "level")
        self.assertLess(found["2"], 0.6 * found["1"])
        self.assertLess(found["2"], 0.1)

    def test_of_more_modes_a_correction_is_no_worse(self):
        rows, _ = table()
        found = errors(rows, "correction")
        self.assertEqual(list(found), ["10", "20", "40", "80", "all"])
        best = min(found.values())
        self.assertLess(found["all"], 1.1 * best)  # what is left is the mesh's under the probes
        self.assertLess(best, errors(rows, "level")["1"])

    def test_of_a_tighter_interpolation_comes_to_rest(self):
        rows, _ = table()
        found = errors(rows, "interpolation")
        self.assertLess(abs(found["0.0001"] / found["1e-06"] - 1), 1e-2)
        seconds = {row["value"]: float(row["precompute_s"]) for row in rows if row["knob"] == "interpolation"}
        self.assertEqual(len(seconds), 6)

    def test_tells_time_and_memory_with_their_spread(self):
        rows, printed = table()
        self.assertIn("known truth, fine_truth.vtp", printed)
        for row in rows:
            self.assertEqual((row["stage"], row["failure"], row["runs"]), ("identify", "", "2"))
            for name in ("precompute_s", "peak_bytes"):
                low, middle, high = (float(row[name + end]) for end in ("_lower_quartile", "", "_upper_quartile"))
                self.assertTrue(0 <= low <= middle <= high, row)
            self.assertGreater(float(row["precompute_s"]), 0)
            self.assertEqual(row["query_s"], "")
            self.assertEqual(int(row["stored_bytes"]), 72 * int(row["vertices"]) * int(row["columns"]))

    def test_marks_what_nothing_beats(self):
        rows, _ = table()
        cost = [(float(row["precompute_s"]), float(f"{float(row['error']):.3g}")) for row in rows]
        for row, (seconds, error) in zip(rows, cost):
            beaten = any(s <= seconds and e <= error and (s, e) != (seconds, error) for s, e in cost)
            self.assertEqual(row["pareto_front"], str(int(not beaten)), row)

    def test_is_a_page_with_its_table_and_plot(self):
        rows, _ = table()
        page = parsed(place("study.html"))
        self.assertEqual(what_needs_other_files(place("study.html")), [])
        shown = "".join(page.itertext())
        self.assertIn("seconds to identify", shown)
        self.assertNotIn("seconds a query", shown)
        for row in rows:
            self.assertIn(f"{100 * float(row['error']):.3g} %", shown)


class Losses(unittest.TestCase):
    def test_that_find_outliers_beat_the_sum_of_squares(self):
        files()
        # On the truth's own mesh, so that noise and outliers alone make errors.
        done = study(place("middle.vtp"), place("middle_truth.vtp"), "--levels", 1, "--knobs", "loss",
                     "--outliers", 0.1, "--csv", place("loss.csv"))
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(place("loss.csv"), newline="", encoding="utf-8") as rows:
            found = errors(list(csv.DictReader(rows)), "loss")
        for loss in ("huber", "cauchy", "tukey"):
            self.assertLess(found[loss], 0.5 * found["none"], found)
            self.assertLess(found[loss], 0.01)


class Refusals(unittest.TestCase):
    def refused(self, sentence, *options):
        surface, truth = files()
        done = run("accuracy", surface, *(truth if option is files else option for option in options),
                   "--csv", place("no.csv"))
        self.assertNotEqual(done.returncode, 0)
        self.assertIn(sentence, done.stderr)
        self.assertFalse(place("no.csv").exists())

    def test_name_what_does_not_go_together(self):
        query = ("--query", "identification")
        self.refused("say by --rig what is measured", *query)
        self.refused("--rig is one of --query identification", "--rig", files)
        self.refused("takes the methods bem and fem", *query, "--rig", files, "--method", "shell")
        self.refused("leave --reference", *query, "--rig", files, "--reference", "kelvin")
        self.refused("make no sense with --query identification", *query, "--rig", files, "--depth", 1)
        self.refused("there is no knob 'rows'", *query, "--rig", files, "--knobs", "rows")
        self.refused("--base-level is one of --levels", *query, "--rig", files, "--levels", 1, "--base-level", 2)


if __name__ == "__main__":
    unittest.main()
