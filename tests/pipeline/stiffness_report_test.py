# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of `palpate artifacts`, read by a strict HTML5 parser, its pictures decoded."""

import csv
import functools
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

import palpate
from support.pages import BROWSER, decoded, parsed, pictures_in_browser, what_needs_other_files
from support.surfaces import PROGRAM

KIDNEY, NODULE = palpate.example("kidney"), palpate.example("nodule")
FOLDER = tempfile.TemporaryDirectory()


def artifacts(*arguments):
    return subprocess.run([PROGRAM, "artifacts", *map(str, arguments)], capture_output=True, text=True)


@functools.lru_cache
def report(name, surface, *arguments):
    """Path, parsed page and table of a report."""
    path = Path(FOLDER.name) / f"{name}.html"
    done = artifacts(surface, *arguments, "--report", path)
    if done.returncode:
        raise AssertionError(done.stderr)
    with open(path.with_suffix(".csv"), newline="", encoding="utf-8") as table:
        rows = list(csv.DictReader(table))
    return path, parsed(path), rows


def kidney():
    return report("kidney", KIDNEY, "--levels", 2, 3, "--edge-lengths", 0.009, "--radius", 0.016)


def nodule():
    return report("nodule", NODULE, "--levels", 1, 2, 3, "--table-levels", 4, "--radius-edges", 1,
                  "--precision", "float")


class Page(unittest.TestCase):
    def test_is_valid_and_needs_no_other_file(self):
        path, page, _ = kidney()
        self.assertEqual(what_needs_other_files(path), [])
        self.assertIn("kidney", "".join(page.find("head/title").itertext()))

    def test_shows_every_mesh_by_pictures_with_colours(self):
        _, page, rows = kidney()
        images = list(page.iter("img"))
        self.assertEqual(len(rows), 3)
        self.assertEqual(len(images), 3 * len(rows) + 3)
        for image in images:
            self.assertTrue(image.get("alt"))
            pixels = decoded(image.get("src")).astype(int)
            coloured = np.ptp(pixels[:, :, :3], axis=2) > 40
            self.assertGreater(coloured.mean(), 0.03, image.get("alt"))
            self.assertLess(coloured.mean(), 0.9)

    def test_tells_the_same_numbers_as_its_table(self):
        _, page, rows = kidney()
        shown = "".join(page.itertext())
        for row in rows:
            for name in ("area_correlation_single", "single_norm_N_per_m", "masked_norm_N_per_m"):
                self.assertIn(f"{float(row[name]):.3g}", shown)
            self.assertIn(row["mesh"], shown)

    def test_of_meshes_of_one_object_finds_single_vertices_apart_and_masks_together(self):
        _, _, rows = kidney()
        for row in rows[1:]:  # level 2 has 49 free vertices
            single = float(row["area_correlation_single"])
            self.assertGreater(single, 0.6)
            self.assertLess(abs(float(row["area_correlation_masked"])), 0.5 * single)
        for row in rows[:-1]:
            self.assertLess(float(row["change_95th_masked"]), 0.2)
        self.assertGreater(float(rows[0]["change_median_single"]), 0.7)

    @unittest.skipUnless(BROWSER, "no Chromium is installed")
    def test_opens_in_a_browser_with_all_pictures(self):
        path, page, _ = kidney()
        self.assertEqual(pictures_in_browser(path, FOLDER.name), len(list(page.iter("img"))))


class PointLoad(unittest.TestCase):
    def test_makes_single_vertices_softer_without_bound_and_masks_settle(self):
        _, page, rows = nodule()  # table 1
        self.assertEqual([row["level"] for row in rows], ["1", "2", "3", "4"])
        self.assertEqual([row["vertices"] for row in rows], ["34", "130", "514", "2050"])
        single = np.array([float(row["single_norm_N_per_m"]) for row in rows])
        masked = np.array([float(row["masked_norm_N_per_m"]) for row in rows])
        self.assertTrue((single[1:] < 0.7 * single[:-1]).all(), single)
        self.assertLess(abs(masked[2:] / masked[1] - 1).max(), 0.02)

    def test_follows_the_law_of_one_over_the_size(self):
        _, page, rows = nodule()
        size = np.array([float(row["vertex_size_m"]) for row in rows])
        compliance = np.array([float(row["single_compliance_m_per_N"]) for row in rows])
        slope = np.diff(np.log(compliance)) / np.diff(np.log(size))
        # Below 1 by what the body yields beside the point, which fades.
        self.assertAlmostEqual(-slope[-1], 1, delta=0.15)
        self.assertEqual(len(list(page.iter("{http://www.w3.org/2000/svg}svg"))), 1)


class Refusals(unittest.TestCase):
    def refused(self, sentence, *arguments):
        with tempfile.TemporaryDirectory() as folder:
            done = artifacts(*arguments, "--report", Path(folder) / "page.html")
            self.assertGreater(done.returncode, 0, arguments)
            lines = [line for line in done.stderr.splitlines() if "warning" not in line]
            self.assertEqual(len(lines), 1, done.stderr)
            self.assertRegex(lines[0], sentence)
            self.assertEqual(list(Path(folder).iterdir()), [])

    def test_name_what_is_wrong_and_write_nothing(self):
        self.refused("one surface", KIDNEY, NODULE, "--levels", 2)
        self.refused("levels", KIDNEY, "--levels", 0)
        self.refused("edge", KIDNEY, "--edge-lengths", 9)
        self.refused("smoothing length", KIDNEY, "--levels", 2, "--smoothing", 9)
        self.refused("missing.vtp", "missing.vtp")
        other = [Path(FOLDER.name) / f"{name}_3.vtp" for name in ("kidney", "nodule")]
        for surface, path in zip((KIDNEY, NODULE), other):
            palpate.write(palpate.refine(palpate.read(surface), 2), str(path))
        self.refused("same body", *other, "--radius", 0.01)
        done = artifacts(KIDNEY, "--report", "page.txt")
        self.assertRegex(done.stderr, "written as .html")

    def test_of_levels_of_a_model_names_the_cure(self):
        with tempfile.TemporaryDirectory() as folder:
            model = Path(folder) / "model.vtp"
            subprocess.run([PROGRAM, "precompute", NODULE, model], check=True, capture_output=True)
            self.refused("takes? a surface", model, "--levels", 2)


if __name__ == "__main__":
    unittest.main()
