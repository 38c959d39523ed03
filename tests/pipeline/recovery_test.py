# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Contacts from displacements through filters, files, program and package."""

import doctest
import functools
import re
import tempfile
import unittest
from pathlib import Path

import numpy as np

import palpate
from palpate import recovery
from palpate.arrays import as_vtk
from support.refused import Refusals
from support.surfaces import failure_of, lower_cap, points_of, run, sphere
from support.tables import write_table

FORCE = np.array([0.1, -0.2, -1.5])
PLACE = np.array([0.0, 0.0, 1.0])


@functools.lru_cache(maxsize=None)
def body():
    surface = sphere(3)
    surface.GetPointData().AddArray(as_vtk(lower_cap(surface), "BoundaryType", 1, np.uint8))
    return palpate.precompute(surface, young=2e4, poisson=0.4, estimate_error=False)


@functools.lru_cache(maxsize=None)
def seen(count=120, noise=0.01):
    """Vertices and displacements of some of them, with noise, under a known force."""
    pressed = palpate.press(body(), point=PLACE, force=FORCE, radius=0.3)
    random = np.random.default_rng(3)
    free = np.flatnonzero(palpate.array(body(), "BoundaryType") == 0)
    vertices = np.sort(random.choice(free, count, replace=False))
    u = palpate.array(pressed, "Displacement")[vertices]
    return vertices, u + noise * np.abs(u).max() * random.standard_normal(u.shape)


@functools.lru_cache(maxsize=None)
def recovered():
    vertices, u = seen()
    return palpate.recover_contacts(body(), palpate.displacement_table(u, vertices=vertices))


def edge():
    points = points_of(body())
    return np.sort(np.linalg.norm(points - points[0], axis=1))[1]


class Package(Refusals):
    def test_finds_force_and_place(self):
        model = recovered()
        force = palpate.array(model, "ContactForce")
        self.assertEqual(force.shape, (1, 3))
        self.assertLess(np.linalg.norm(force[0] - FORCE), 0.05 * np.linalg.norm(FORCE))
        np.testing.assert_allclose(force.sum(0), palpate.array(model, "RecoveredForce")[0])
        peak = points_of(model)[int(palpate.array(model, "ContactPeak")[0])]
        self.assertLess(np.linalg.norm(peak - PLACE), edge())
        centre = palpate.array(model, "ContactCentre")[0]
        self.assertLess(np.linalg.norm(centre - PLACE), 0.5 * edge())
        deviation = palpate.array(model, "ContactForceDeviation")[0]
        self.assertTrue((deviation > 0).all())
        self.assertTrue((np.abs(force[0] - FORCE) < 5 * deviation).all())

    def test_arrays_go_together(self):
        model = recovered()
        area, traction = palpate.array(model, "VertexArea"), palpate.array(model, "Traction")
        np.testing.assert_allclose(area @ traction, palpate.array(model, "RecoveredForce")[0])
        pressure = palpate.array(model, "ContactPressure")
        self.assertTrue((pressure >= 0).all())
        self.assertEqual(np.argmax(pressure), palpate.array(model, "ContactPeak")[0])
        self.assertTrue((pressure[palpate.array(model, "ContactNumber") == 1] > 0).all())
        vertices, u = seen()
        explained = palpate.array(model, "Displacement")[vertices]
        np.testing.assert_allclose(palpate.array(model, "ObservedResidual"), u - explained, atol=1e-12)

    def test_another_contact_takes_it_away(self):
        pressed = palpate.press(recovered(), point=PLACE, force=FORCE, radius=0.3)
        self.assertFalse(pressed.GetFieldData().HasArray("RecoveredForce"))
        self.assertFalse(pressed.GetPointData().HasArray("ContactPressure"))

    def test_refuses_in_a_sentence(self):
        vertices, u = seen()

        def refused(sentence, displacements, **options):
            table = palpate.displacement_table(displacements, vertices=vertices[:len(displacements)])
            self.refused(sentence, palpate.recover_contacts, body(), table, **options)

        refused("not recovered from 6 components", u[:2])
        refused("nothing moved", 0 * u)
        refused("check the table's unit of length", 1e6 * u)
        broken = u.copy()
        broken[4] = np.nan
        refused("tuple 4: no component of the displacement was measured", broken)
        broken[4] = np.inf
        refused("tuple 4: the displacement is not finite", broken)
        refused("friction must be from 0", u, friction=-1)
        refused("there is no probe other among 0", u, probe="other")
        refused("patch_radius must not be negative", u, patch_radius=-1)
        refused("are larger than the body", u, patch_radius=100)
        self.refused("give one of the two", palpate.displacement_table, u)
        self.refused("displacements must be a file", palpate.recover_contacts, body(), 3)
        far = palpate.displacement_table(u, points=1e3 * points_of(body())[vertices])
        self.refused("times 0.001 it would be on it", palpate.recover_contacts, body(), far)


    def test_every_example_runs(self):
        failed, attempted = doctest.testmod(recovery)
        self.assertEqual(failed, 0)
        self.assertGreater(attempted, 5)


class Filter(unittest.TestCase):
    def test_needs_one_table(self):
        filter = palpate.vtkContactRecovery()
        filter.SetInputData(body())
        self.assertIn("from a file or from the input of their table", failure_of(filter))

    def test_needs_a_model(self):
        filter = palpate.vtkContactRecovery()
        filter.SetInputData(sphere(1))
        vertices, u = seen()
        filter.SetInputData(1, palpate.displacement_table(u, vertices=vertices))
        self.assertNotEqual(failure_of(filter), "")


class Program(Refusals):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.model = self.folder / "model.vtp"
        palpate.write(body(), self.model)

    def table(self, unit=1.0):
        """Places and displacements alone."""
        vertices, u = seen()
        path = self.folder / "seen.csv"
        rows = np.hstack([points_of(body())[vertices], u]) / unit
        np.savetxt(path, rows, delimiter=",", header="x,y,z,u_x,u_y,u_z", comments="", fmt="%.17g")
        return path

    def test_recovers_from_a_table_without_forces(self):
        out = self.folder / "contacts.vtp"
        done = run("recover", self.model, self.table(1e-3), out, "--length-unit", "mm")
        self.assertEqual(done.returncode, 0, done.stderr)
        size = float(re.search(r"contact 1 +(\S+) N at ", done.stdout)[1])
        self.assertLess(abs(size / np.linalg.norm(FORCE) - 1), 0.05)
        self.assertRegex(done.stdout, r"force, N +\S+  \S+  \S+ \+- \S+  \S+  \S+")
        np.testing.assert_allclose(
            palpate.array(palpate.read(out), "RecoveredForce"),
            palpate.array(recovered(), "RecoveredForce"), rtol=1e-4)

    def test_recovers_from_tables_of_vtk(self):
        vertices, u = seen()
        table = palpate.displacement_table(u, vertices=vertices)
        expected = palpate.array(palpate.recover_contacts(body(), table, samples=0), "RecoveredForce")
        out = self.folder / "contacts.vtp"
        for name in ("seen.vtu", "SEEN.VTP"):
            path = write_table(table, self.folder / name)
            done = run("recover", self.model, path, out, "--samples", 0)
            self.assertEqual(done.returncode, 0, done.stderr)
            for model in (palpate.read(out), palpate.recover_contacts(body(), path, samples=0)):
                np.testing.assert_allclose(palpate.array(model, "RecoveredForce"), expected, rtol=1e-9)

    def test_takes_one_probe_of_a_rig(self):
        rig, out = self.folder / "rig.csv", self.folder / "contacts.vtp"
        self.assertEqual(run("measure", self.model, rig, "--probes", 2, "--markers", 100).returncode, 0)
        done = run("recover", self.model, rig, out)
        self.assertEqual(done.returncode, 1)
        self.assertIn("choose one of the 2 probes: 1, 2", done.stderr)
        self.assertIn("--seed", run("recover", self.model, rig, out, "--seed", -1).stderr)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1)
        self.assertFalse(out.exists())
        done = run("recover", self.model, rig, out, "--probe", 2, "--friction", 1, "--samples", 0)
        self.assertEqual(done.returncode, 0, done.stderr)
        lines = [line.split(",") for line in rig.read_text().splitlines()]
        true = np.array([float(x) for x in next(row for row in lines if row[0] == "2")[6:9]])
        force = palpate.array(palpate.read(out), "RecoveredForce")[0]
        self.assertLess(np.linalg.norm(force - true), 0.05 * np.linalg.norm(true))


if __name__ == "__main__":
    unittest.main()
