# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Volume meshes from files, and models of them."""

import contextlib
import io
import os
import tempfile
import unittest

import numpy as np
from vtkmodules.vtkCommonDataModel import VTK_TRIANGLE
from vtkmodules.vtkIOLegacy import vtkUnstructuredGridWriter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

import palpate
from support.solids import bar, base_of, boundary_of, set_cells
from support.surfaces import points_of, run, triangles_of

YOUNG, POISSON = 8e3, 0.3


def written(writer, grid, path):
    writer.SetFileName(path)
    writer.SetInputData(grid)
    writer.Write()
    return path


def gmsh41(points, cells, arrays):
    """A file of Gmsh's as it writes them: the surface's cells come first."""
    lines = ["$MeshFormat", "4.1 0 8", "$EndMeshFormat", "$Nodes", f"1 {len(points)} 1 {len(points)}",
             f"3 1 0 {len(points)}", *(str(i + 1) for i in range(len(points)))]
    lines += [" ".join(map(repr, map(float, point))) for point in points]
    lines += ["$EndNodes", "$Elements", f"2 {len(cells) + 2} 1 {len(cells) + 2}", "2 1 2 2"]
    lines += [f"{i + 1} " + " ".join(map(str, cells[i, :3] + 1)) for i in range(2)]
    lines += [f"3 1 4 {len(cells)}"]
    lines += [f"{i + 3} " + " ".join(map(str, cell + 1)) for i, cell in enumerate(cells)]
    lines += ["$EndElements"]
    for name, values in arrays.items():
        lines += ["$ElementData", "1", f'"{name}"', "1", "0.0", "3", "0", "1", str(len(cells) + 2)]
        lines += [f"{i + 1} {float(value)!r}" for i, value in enumerate([0, 0, *values])]
        lines += ["$EndElementData"]
    return "\n".join(lines) + "\n"


class VolumeFiles(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = lambda name: os.path.join(folder.name, name)
        self.grid = bar((2, 2, 4))
        modulus = np.linspace(1e3, 1e4, self.grid.GetNumberOfCells())
        set_cells(self.grid, YoungsModulus=modulus, PoissonRatio=np.full(len(modulus), 0.3))

    def precompute(self, path, *options):
        return run("precompute", path, self.path("model.vtp"), "--young", YOUNG, "--poisson", POISSON,
                   "--fix-half-space", 0, 0, 1e-9, 0, 0, 1, *options)

    def expected(self):
        return palpate.precompute(self.grid, YOUNG, POISSON, fixed=base_of(self.grid), method="fem")

    def test_both_vtk_formats_give_the_model_of_the_grid(self):
        expected = palpate.greens_functions(self.expected())
        binary = vtkUnstructuredGridWriter()
        binary.SetFileTypeToBinary()
        for writer, name in ((vtkXMLUnstructuredGridWriter(), "bar.vtu"), (binary, "bar.vtk"),
                             (vtkUnstructuredGridWriter(), "text.vtk")):
            made = self.precompute(written(writer, self.grid, self.path(name)), "--method", "fem")
            self.assertEqual(made.returncode, 0, made.stderr)
            found = palpate.greens_functions(palpate.read(self.path("model.vtp")))
            digits = 1e-12 if name != "text.vtk" else 1e-4  # text has six digits
            self.assertLess(np.abs(found - expected).max(), digits * np.abs(expected).max(), name)

    def test_gmsh_files_are_read_with_their_arrays(self):
        import meshio

        points = np.array([self.grid.GetPoint(i) for i in range(self.grid.GetNumberOfPoints())])
        cells = np.array([[self.grid.GetCell(c).GetPointId(k) for k in range(4)]
                          for c in range(self.grid.GetNumberOfCells())])
        modulus = palpate.array(self.grid, "YoungsModulus")
        poisson = np.full(len(cells), 0.3)
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            meshio.Mesh(points, [("tetra", cells)], cell_data={
                "YoungsModulus": [modulus], "PoissonRatio": [poisson]}).write(
                    self.path("gmsh22.msh"), file_format="gmsh22")
        with open(self.path("gmsh41.msh"), "w") as file:
            file.write(gmsh41(points, cells, {"YoungsModulus": modulus, "PoissonRatio": poisson}))
        expected = palpate.greens_functions(self.expected())
        for version in ("gmsh22", "gmsh41"):
            path = self.path(version + ".msh")
            read = palpate.read_volume(path)
            self.assertEqual(read.GetNumberOfCells(), len(cells))
            self.grid = read
            np.testing.assert_allclose(palpate.greens_functions(self.expected()), expected, rtol=0,
                                       atol=1e-12 * np.abs(expected).max())
        refused = self.precompute(path, "--method", "fem")
        self.assertNotEqual(refused.returncode, 0)
        self.assertEqual(refused.stderr.count("\n"), 1, refused.stderr)

    def test_the_boundary_is_closed_outwards_and_keeps_point_data(self):
        self.grid.InsertNextCell(VTK_TRIANGLE, 3, [0, 1, 9])  # of lower dimension: does not count
        heights = palpate.arrays.as_vtk([self.grid.GetPoint(i)[2] for i in range(self.grid.GetNumberOfPoints())],
                                        "Height", 1)
        self.grid.GetPointData().AddArray(heights)
        surface = boundary_of(self.grid)
        points, corners = points_of(surface), triangles_of(surface)
        volume = np.einsum("fi,fi", points[corners[:, 0]],
                           np.cross(points[corners[:, 1]], points[corners[:, 2]])) / 6
        self.assertAlmostEqual(volume, 2, delta=1e-12)
        self.assertEqual(len(points), self.grid.GetNumberOfPoints() - 3)  # three are inside
        np.testing.assert_array_equal(palpate.array(surface, "Height"), points[:, 2])

    def test_what_cannot_be_read_is_refused_in_a_sentence(self):
        whole = open(written(vtkXMLUnstructuredGridWriter(), self.grid, self.path("whole.vtu")), "rb").read()
        only_triangles = bar((1, 1, 1))
        only_triangles.Reset()
        only_triangles.InsertNextCell(VTK_TRIANGLE, 3, [0, 1, 2])
        files = {"cut.vtu": whole[:len(whole) // 2], "empty.vtk": b"", "text.vtu": b"no mesh at all",
                 "cut.vtk": b"# vtk DataFile Version 3.0\n\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 9 do"}
        for name, content in files.items():
            with open(self.path(name), "wb") as file:
                file.write(content)
        written(vtkXMLUnstructuredGridWriter(), only_triangles, self.path("flat.vtu"))
        for name in [*files, "flat.vtu", "missing.vtu", "missing.msh"]:
            refused = self.precompute(self.path(name), "--method", "fem")
            self.assertNotEqual(refused.returncode, 0, name)
            self.assertEqual(refused.stderr.count("\n"), 1, refused.stderr)
            self.assertFalse(os.path.exists(self.path("model.vtp")), name)
            if name != "flat.vtu":
                with self.assertRaises(palpate.Error):
                    palpate.read_volume(self.path(name))
        other = self.precompute(self.path("whole.vtu"))
        self.assertIn("add --method fem", other.stderr)
        with self.assertRaisesRegex(palpate.Error, "go with method='fem'"):
            palpate.precompute(self.grid, YOUNG, POISSON)
        with open(self.path("broken.msh"), "w") as file:
            file.write("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\nx")
        with self.assertRaisesRegex(palpate.Error, "meshio cannot read"):
            palpate.read_volume(self.path("broken.msh"))

    def test_three_axes_of_a_wood_are_those_of_its_cells(self):
        moduli = (12e4, 1e4, 0.5e4, 0.0, 0.0, 0.0, 6e3, 5e3, 4e3)  # without contraction: rods
        for axes, along in (((0, 0, 2, 1, 0, 0), 12e4), ((1, 0, 0, 0, 0, 5), 1e4),
                            ((1, 0, 0, 0.7, 1, 0), 0.5e4)):
            grid = bar((2, 2, 4))
            cells = grid.GetNumberOfCells()
            set_cells(grid, OrthotropicModuli=[moduli] * cells, MaterialAxes=[axes] * cells)
            model = palpate.precompute(grid, YOUNG, POISSON, fixed=base_of(grid), method="fem",
                                       patch_columns=True, reciprocal=False)
            points, corners = points_of(model), triangles_of(model)
            top = np.flatnonzero(points[:, 2] > 2 - 1e-9)
            tractions = np.zeros((len(corners), 3))
            tractions[np.isin(corners, top).all(axis=1), 2] = 1
            solved = palpate.solve(model, [], np.zeros((0, 3)), face_tractions=tractions)
            self.assertAlmostEqual(palpate.array(solved, "Displacement")[top, 2].mean() * along / 2, 1,
                                   delta=1e-9)
        fixed = base_of(grid)
        set_cells(grid, MaterialAxes=[(1, 0, 0, 3, 0, 0)] * cells)
        with self.assertRaisesRegex(palpate.Error, "cell 0 of the volume mesh: its MaterialAxes"):
            palpate.precompute(grid, YOUNG, POISSON, fixed=fixed, method="fem")

    def test_the_program_tells_what_makes_a_volume_mesh_of_other_files(self):
        with open(self.path("part.msh"), "w", encoding="utf-8") as file:
            file.write("$MeshFormat\n")
        refused = run("precompute", self.path("part.msh"), self.path("model.vtp"), "--method", "fem", "--young", 1,
                      "--poisson", 0.3)
        self.assertNotEqual(refused.returncode, 0)
        self.assertIn("meshio convert", refused.stderr)
        self.assertFalse(os.path.exists(self.path("model.vtp")))


if __name__ == "__main__":
    unittest.main()
