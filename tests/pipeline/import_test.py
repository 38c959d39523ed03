# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Matrices made elsewhere through filters, files, program and package."""

import functools
import os
import tempfile
import unittest
import warnings
from pathlib import Path

import numpy as np

import palpate
from palpate.arrays import as_vtk
from support.matrices import (
    dmig_text,
    harwell_boeing_text,
    mapping_text,
    market_text,
    truss,
)
from support.refused import Refusals
from support.surfaces import (
    Executions,
    copy_of,
    failure_of,
    lower_cap,
    points_of,
    run,
    sphere,
    sphere_model,
)


@functools.lru_cache(maxsize=None)
def body():
    """A unit sphere's force compliance between its free vertices, their numbers, and the model."""
    model = sphere_model(1)
    free = palpate.greens_function_nodes(model)
    rows = (3 * free[:, None] + np.arange(3)).ravel()
    areas = np.repeat(palpate.array(model, "VertexArea")[free], 3)
    return palpate.greens_functions(model)[rows] / areas, free, model


def held_sphere():
    surface = sphere(1)
    surface.GetPointData().AddArray(as_vtk(lower_cap(surface), "BoundaryType", 1, np.uint8))
    return surface


def matrix_of(model):
    nodes = palpate.greens_function_nodes(model)
    return palpate.greens_functions(model)[(3 * nodes[:, None] + np.arange(3)).ravel()]


class Unsupported(Refusals):
    def test_a_loose_bodys_stiffness_is_one_that_nothing_holds(self):
        surface = sphere(1)
        points = points_of(surface)
        n = len(points)
        stiffness = np.zeros((3 * n, 3 * n))  # springs between all
        for i in range(n):
            for j in range(i):
                along = points[i] - points[j]
                spring = np.outer(along, along) / np.linalg.norm(along) ** 3
                pair = np.zeros((n, n))
                pair[i, i] = pair[j, j] = 1
                pair[i, j] = pair[j, i] = -1
                stiffness += np.kron(pair, spring)
        model = palpate.import_stiffness(surface, stiffness, unsupported=True)
        areas = palpate.array(model, "VertexArea")
        forces = np.zeros((n, 3))
        top, bottom = points[:, 2].argmax(), points[:, 2].argmin()
        forces[top, 2], forces[bottom, 2] = -1, 1
        pressed = palpate.solve(model, [], np.zeros((0, 3)), free_tractions=forces / areas[:, None])
        moved = palpate.array(pressed, "Displacement")
        np.testing.assert_allclose(stiffness @ moved.ravel(), forces.ravel(), atol=1e-9)
        springs = np.where(points[:, 2] < 0, 0.1, 0.0)
        pushed = palpate.press(palpate.foundation(model, springs=springs), points[top], force=(0, 0, -1))
        np.testing.assert_allclose(springs @ palpate.array(pushed, "Displacement"), (0, 0, -1), atol=1e-6)
        with tempfile.TemporaryDirectory() as folder:
            ball, matrix, made = (os.path.join(folder, name) for name in ("b.vtp", "k.npy", "m.vtp"))
            palpate.write(surface, ball)
            np.save(matrix, stiffness)
            told = run("import", ball, made, "--stiffness", matrix, "--unsupported")
            self.assertEqual(told.returncode, 0, told.stderr)
            self.assertIn("unsupported", told.stdout)
        self.refused("or import it as unsupported", palpate.import_stiffness, surface, stiffness)
        self.refused("resists rigid motions", palpate.import_stiffness, surface,
                     stiffness + np.eye(3 * n), unsupported=True)


class Folder(Refusals):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)


class Package(Folder):
    def test_answers_as_the_model_whose_compliance_it_is(self):
        compliance, free, model = body()
        again = palpate.import_compliance(held_sphere(), compliance)
        np.testing.assert_array_equal(palpate.greens_function_nodes(again), free)
        np.testing.assert_allclose(matrix_of(again), matrix_of(model), rtol=1e-12, atol=1e-18)
        for function, arguments in (
                (palpate.press, dict(point=(0, 0, 1), displacement=(0, 0, -0.01), radius=0.5)),
                (palpate.stiffness, dict(radius_in_edges=2))):
            name = "Displacement" if function is palpate.press else "Stiffness"
            here, there = (palpate.array(function(m, **arguments), name)[free] for m in (again, model))
            # Masks that reach where it is held elsewhere have no stiffness to serve.
            served = ~np.isnan(here).any(axis=1)
            self.assertGreater(served.sum(), len(free) / 3)
            np.testing.assert_allclose(here[served], there[served], rtol=1e-9,
                                       atol=1e-12 * np.nanmax(abs(there)))

    def test_takes_files_of_any_format_and_any_order_of_nodes(self):
        compliance, free, model = body()
        points = points_of(sphere(1))[free]
        order = np.random.default_rng(1).permutation(len(free))
        rows = (3 * order[:, None] + np.arange(3)).ravel()
        shuffled, places = compliance[np.ix_(rows, rows)], points[order]
        np.save(self.folder / "c.npy", shuffled)
        np.save(self.folder / "f.npy", np.asfortranarray(shuffled))
        np.savetxt(self.folder / "c.csv", shuffled, delimiter=",", fmt="%.17g")
        np.savetxt(self.folder / "c.txt", shuffled, fmt="%.17g", header="m/N")
        market = ["%%MatrixMarket matrix array real general", "%d %d" % shuffled.shape]
        market += [repr(float(v)) for v in shuffled.T.ravel()]
        (self.folder / "c.mtx").write_text("\n".join(market))
        np.savetxt(self.folder / "nodes.csv", places, delimiter=";", fmt="%.17g", header="x;y;z")
        np.save(self.folder / "nodes.npy", places)
        for name in ("c.npy", "f.npy", "c.csv", "c.txt", "c.mtx"):
            nodes = self.folder / ("nodes.npy" if name == "c.npy" else "nodes.csv")
            again = palpate.import_compliance(held_sphere(), self.folder / name, nodes)
            np.testing.assert_allclose(matrix_of(again), matrix_of(model), rtol=1e-11, atol=1e-16)

    def test_takes_what_scipy_writes(self):
        try:
            from scipy.io import hb_write, mmwrite
            from scipy.sparse import csc_matrix
        except ImportError:
            self.skipTest("no SciPy")
        stiffness, surface, points = truss()
        mmwrite(self.folder / "k.mtx", csc_matrix(stiffness))
        hb_write(self.folder / "k.hb", csc_matrix(stiffness))
        fixed = points[:6, 2] < 0.5
        given = matrix_of(palpate.import_stiffness(surface, stiffness, points, fixed=fixed))
        for name in ("k.mtx", "k.hb"):
            read = palpate.import_stiffness(surface, self.folder / name, points, fixed=fixed)
            np.testing.assert_allclose(matrix_of(read), given, rtol=1e-8)

    def test_condenses_what_is_inside_and_holds_what_is_fixed(self):
        stiffness, surface, points = truss()
        fixed = np.array([False, False, False, True, True, True])
        model = palpate.import_stiffness(surface, stiffness, points, fixed=fixed)
        moving = [0, 1, 2, 6]
        rows = np.add.outer(3 * np.array(moving), np.arange(3)).ravel()
        areas = np.repeat(palpate.array(model, "VertexArea")[:3], 3)
        expected = np.linalg.inv(stiffness[np.ix_(rows, rows)])[:9, :9] * areas
        np.testing.assert_allclose(matrix_of(model), expected, rtol=1e-10, atol=1e-12 * expected.max())
        np.testing.assert_array_equal(palpate.array(model, "BoundaryType"), fixed)
        pressed = palpate.press(model, (1, 0, 0), force=(1, 2, -3))
        tractions = palpate.array(pressed, "Traction") * palpate.array(model, "VertexArea")[:, None]
        np.testing.assert_allclose(tractions.sum(axis=0), 0, atol=1e-9)

    def test_knows_units_and_orders(self):
        stiffness, surface, points = truss()
        fixed = points[:6, 2] < 0.5
        plain = matrix_of(palpate.import_stiffness(surface, stiffness, points, fixed=fixed))
        by_component = stiffness.reshape(7, 3, 7, 3).transpose(1, 0, 3, 2).reshape(21, 21)
        other = palpate.import_stiffness(surface, by_component * 1e-6, points * 1e3, fixed=fixed,
                                         order="by-component", length_unit="mm", force_unit="kN")
        np.testing.assert_allclose(matrix_of(other), plain, rtol=1e-10, atol=1e-12 * plain.max())
        self.refused("in another order", palpate.import_stiffness, surface, by_component, points,
                     fixed=fixed)
        self.refused("1000 times the surface's size", palpate.import_stiffness, surface, stiffness,
                     points * 1e3, fixed=fixed)

    def test_survives_a_file_and_another_youngs_modulus(self):
        model = palpate.import_compliance(held_sphere(), body()[0], young=3e4)
        palpate.write(model, self.folder / "model.vtp")
        read = palpate.read(self.folder / "model.vtp")
        self.assertEqual(float(palpate.array(read, "YoungsModulus")[0]), 3e4)
        self.assertEqual(palpate.array(read, "GreensFunctionDomain")[0], "given")
        press = functools.partial(palpate.press, point=(0, 0, 1), force=(0, 0, -1))
        first = palpate.array(press(model), "Displacement")
        np.testing.assert_array_equal(palpate.array(press(read), "Displacement"), first)
        palpate.array(read, "YoungsModulus")[0] *= 2
        np.testing.assert_allclose(palpate.array(press(read), "Displacement"), first / 2, rtol=1e-12,
                                   atol=1e-12 * abs(first).max())

    def test_is_stale_on_another_surface(self):
        model = copy_of(palpate.import_compliance(held_sphere(), body()[0]))
        model.GetPoints().SetPoint(3, 0, 0, 1.01)
        self.refused("stale", palpate.stiffness, model)

    def test_the_apparent_modulus_is_that_of_the_body_to_an_order(self):
        model = palpate.import_compliance(held_sphere(), body()[0])
        self.assertAlmostEqual(np.log10(palpate.array(model, "YoungsModulus")[0]), 4, delta=1)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            palpate.import_compliance(held_sphere(), body()[0], length_unit="um", force_unit="MN")
        self.assertEqual([w.category for w in caught], [palpate.ModelWarning])
        self.assertIn("state the units of the matrix", str(caught[0].message))
        self.assertEqual(caught[0].filename, __file__)

    def test_what_is_no_matrix_of_the_surface_is_refused(self):
        compliance, free, _ = body()
        surface, take = held_sphere(), palpate.import_compliance
        for matrix, sentence in (
                (compliance[:-1], "compliances and stiffnesses are square"),
                (compliance[:-3, :-3], "rows, but the surface has 42 vertices"),
                (compliance[0], "a table of rows and columns"),
                ([["a"]], "compliance must be numbers"),
                (compliance * np.nan, "which is no number of any unit"),
                (compliance - 0.5 * compliance.max() * np.eye(len(compliance)), "negative eigenvalue"),
                (compliance + np.triu(compliance), "is not symmetric")):
            self.refused(sentence, take, surface, matrix)
        for options, sentence in (
                (dict(nodes=np.zeros((3, 2))), "by number, x, y and z, not by 2 columns"),
                (dict(nodes=points_of(surface)), "there are 42 nodes for"),
                (dict(order="blocked"), "there is no order 'blocked'"),
                (dict(length_unit="mile"), "there is no unit of length 'mile'"),
                (dict(force_unit=3), "a unit must be a string"),
                (dict(young=-1), "Young's modulus must be above 0"),
                (dict(mapping="k.mapping"), "a mapping file goes with a file"),
                (dict(columns=[int(np.flatnonzero(lower_cap(surface))[0])]), "is held where the matrix"),
                (dict(node_tolerance=0), "above 0 and at most 0.1")):
            self.refused(sentence, take, surface, compliance, **options)
        self.refused("there is no such file", take, surface, self.folder / "none.npy")
        self.refused("a surface must be a vtkPolyData", take, None, compliance)
        self.refused("translation", palpate.import_stiffness, truss()[1], truss()[0], truss()[2])
        self.assertFalse(surface.GetFieldData().HasArray("GreensFunctions"))


class Filter(Folder):
    def filter(self):
        stiffness, surface, points = truss()
        surface.GetPointData().AddArray(as_vtk(points[:6, 2] < 0.5, "BoundaryType", 1, np.uint8))
        np.save(self.folder / "k.npy", stiffness)
        np.savetxt(self.folder / "nodes.txt", points)
        made = palpate.vtkImportedGreensFunctions()
        made.SetInputData(surface)
        made.SetKindToStiffness()
        made.SetMatrixFileName(str(self.folder / "k.npy"))
        made.SetNodeFileName(str(self.folder / "nodes.txt"))
        return made

    def test_serves_a_pipeline_and_keeps_what_it_has(self):
        made = self.filter()
        contact = palpate.vtkPointContact()
        contact.SetInputConnection(made.GetOutputPort())
        contact.SetPoint(0, 0, 1)
        contact.SetForce(0, 0, -1)
        executions = Executions(made)
        contact.Update()
        contact.SetForce(0, 0, -2)
        contact.Update()
        self.assertEqual(executions.count, 1)
        first = made.GetOutput().GetFieldData().GetArray("GreensFunctions")
        made.GetInput().GetPointData().AddArray(as_vtk(np.zeros(6), "Colour", 1))
        made.Update()
        self.assertIs(made.GetOutput().GetFieldData().GetArray("GreensFunctions"), first)
        self.assertEqual(palpate.array(made.GetOutput(), "GreensFunctionSource")[0],
                         "imported stiffness (NumPy, 7 nodes, 3 degrees of freedom condensed out)")

    def test_reads_arrays_anew_when_they_change(self):
        made = self.filter()
        matrix = as_vtk(truss()[0], "k", 21)
        made.SetMatrixFileName(None)
        made.SetMatrix(matrix)
        made.Update()
        before = matrix_of(made.GetOutput()).copy()
        for i in range(441):
            matrix.SetValue(i, 2 * matrix.GetValue(i))
        matrix.Modified()
        made.Update()
        np.testing.assert_allclose(matrix_of(made.GetOutput()), before / 2, rtol=1e-12)

    def test_failures_leave_the_output_empty(self):
        for change, sentence in (
                (lambda f: f.SetMatrixFileName("none.npy"), "none.npy: there is no such file"),
                (lambda f: f.SetMatrixFileName(None), "give one of the two"),
                (lambda f: f.SetMatrix(as_vtk(np.eye(3), "k", 3)), "give one of the two"),
                (lambda f: f.PatchColumnsOn(), "leave patch columns out"),
                (lambda f: f.SetKindToCompliance(), "it is the stiffness of a loose body")):
            made = self.filter()
            change(made)
            self.assertIn(sentence, failure_of(made))
            self.assertEqual(made.GetOutput().GetNumberOfPoints(), 0)


class Program(Folder):
    def setUp(self):
        super().setUp()
        self.surface, self.model, self.out = (self.folder / f"{n}.vtp" for n in ("s", "model", "out"))
        palpate.write(held_sphere(), self.surface)
        np.save(self.folder / "c.npy", body()[0])

    def test_makes_models_that_all_commands_take(self):
        made = run("import", self.surface, self.model, "--compliance", self.folder / "c.npy",
                   "--young", 1e4)
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertEqual(made.stderr, "")
        self.assertRegex(made.stdout, r"made by +imported compliance \(NumPy, 35 nodes, 7 vertices held")
        info = run("info", self.model).stdout
        self.assertRegex(info, "sound +yes")
        self.assertIn("imported compliance", info)
        for command in (("press", self.model, self.out, "--at", 0, 0, 1, "--displacement", 0, 0, -0.01,
                         "--radius", 0.5),
                        ("stiffness", self.model, self.out, "--radius-edges", 2),
                        ("touch", self.model, "--tool-radius", 0.5, "--device", "simulated",
                         "--headless", "--seconds", 1),
                        ("touch", self.model, "--device", "simulated", "--headless", "--seconds", 1)):
            done = run(*command)
            self.assertEqual(done.returncode, 0, done.stderr)

    def test_imports_bulk_data_and_harwell_boeing_with_their_numbers(self):
        stiffness, surface, points = truss()
        palpate.write(surface, self.surface)
        (self.folder / "k.pch").write_text(dmig_text(stiffness, 1e3 * points))
        (self.folder / "k.mtx").write_text(market_text(stiffness))
        (self.folder / "k.matrix").write_text(harwell_boeing_text(stiffness))
        (self.folder / "k.mapping").write_text(mapping_text(21))
        np.savetxt(self.folder / "nodes.txt", np.column_stack([np.arange(1, 8), 1e3 * points]))
        files = {}
        numbered = ("--mapping", self.folder / "k.mapping", "--nodes", self.folder / "nodes.txt")
        for name, options in (("k.pch", ()), ("k.matrix", numbered), ("k.mtx", numbered)):
            made = run("import", self.surface, self.model, "--stiffness", self.folder / name,
                       "--length-unit", "mm", "--force-unit", "kN", "--fix-half-space", 0, 0, 0.5, 0, 0, 1,
                       *options)
            self.assertEqual(made.returncode, 0, made.stderr)
            files[name] = matrix_of(palpate.read(self.model))
        expected = matrix_of(palpate.import_stiffness(surface, 1e6 * stiffness, points,
                                                      fixed=points[:6, 2] <= 0.5))
        for name, matrix in files.items():
            np.testing.assert_allclose(matrix, expected, rtol=1e-9, atol=1e-12 * expected.max(),
                                       err_msg=name)

    def test_refusals_are_one_line_and_leave_no_file(self):
        (self.folder / "bad.csv").write_text("1,2\n3,x\n")
        np.save(self.folder / "k.npy", truss()[0])
        np.save(self.folder / "wide.npy", np.ones((3, 4)))
        for options, sentence in (
                ((), "give a file with --compliance or --stiffness"),
                (("--compliance", "none.npy"), "none.npy: there is no such file"),
                (("--compliance", self.folder / "bad.csv"), "bad.csv, line 2: 'x' is not a number"),
                (("--compliance", self.folder / "wide.npy"), "the matrix is 3 by 4"),
                (("--stiffness", self.folder / "k.npy"), "the matrix has 21 rows"),
                (("--compliance", self.folder / "c.npy", "--stiffness", self.folder / "k.npy"),
                 "excludes"),
                (("--compliance", self.folder / "c.npy", "--length-unit", "mile"), "no unit of length"),
                (("--compliance", self.folder / "c.npy", "--columns", 99), "column 0 names vertex 99"),
                (("--compliance", self.folder / "c.npy", "--nodes", self.folder / "bad.csv"),
                 "line 2")):
            done = run("import", self.surface, self.out, *options)
            self.assertEqual(done.stdout, "")
            self.assertNotEqual(done.returncode, 0)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
            self.assertIn(sentence, done.stderr)
            self.assertFalse(self.out.exists())
        self.assertEqual(sorted(os.listdir(self.folder)),
                         ["bad.csv", "c.npy", "k.npy", "s.vtp", "wide.npy"])


if __name__ == "__main__":
    unittest.main()
