# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of the program against stored ones, without a display.

PALPATE_STORE_PICTURES=1 stores new ones: look at them before they are committed.
"""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGReader, vtkPNGWriter

import palpate
from support.surfaces import PROGRAM

STORED = Path(__file__).parent / "pictures"
SHRINK = 4
# Mean difference of the channels, of 255, that other drivers, fonts and versions of VTK may make; most
# of a picture is paper, so that wrong ones differ by little more than twice this.
ALLOWED = 0.4


def read(path):
    """Height by width by 3, float."""
    reader = vtkPNGReader()
    reader.SetFileName(str(path))
    reader.Update()
    image = reader.GetOutput()
    width, height, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1).astype(float)


def shrunk(pixels):
    rows, columns = pixels.shape[0] // SHRINK, pixels.shape[1] // SHRINK
    return pixels[:rows * SHRINK, :columns * SHRINK].reshape(
        rows, SHRINK, columns, SHRINK, 3).mean(axis=(1, 3))


def write(pixels, path):
    image = vtkImageData()
    image.SetDimensions(pixels.shape[1], pixels.shape[0], 1)
    image.GetPointData().SetScalars(
        numpy_to_vtk(pixels.round().astype(np.uint8).reshape(-1, 3), deep=True))
    writer = vtkPNGWriter()
    writer.SetFileName(str(path))
    writer.SetInputData(image)
    writer.Write()


class Pictures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.model = cls.folder / "model.vtp"
        palpate.write(palpate.precompute(palpate.refine(palpate.read(palpate.example("kidney"))),
                                         None, None), cls.model)

    def draw(self, name, *arguments):
        path = self.folder / name
        environment = {k: v for k, v in os.environ.items() if k != "DISPLAY"}
        subprocess.run([PROGRAM, *map(str, arguments), "--image", str(path)], check=True,
                       capture_output=True, env=environment)
        return shrunk(read(path))

    def compare(self, name, pixels, wrong):
        if os.environ.get("PALPATE_STORE_PICTURES"):
            write(pixels, STORED / name)
        stored = read(STORED / name)
        self.assertEqual(stored.shape, pixels.shape)
        difference = np.abs(stored - pixels).mean()
        self.assertLess(difference, ALLOWED)
        self.assertGreater(np.abs(stored - wrong).mean(), 2 * ALLOWED)

    def test_of_a_press_shows_the_surface_before_and_after(self):
        press = ("press", self.model, "--at", 0, 0, 0.03, "--radius", 0.015, "--view", 0.4, -0.9, 0.5)
        right = self.draw("press.png", *press, "--displacement", 0, 0, -0.01)
        wrong = self.draw("wrong.png", *press, "--displacement", 0, 0, 0.02)
        self.compare("press.png", right, wrong)

    def test_of_the_stiffness_shows_its_norm(self):
        masked = self.draw("stiffness.png", "stiffness", self.model, "--radius-edges", 2)
        single = self.draw("single.png", "stiffness", self.model)
        self.compare("stiffness.png", masked, single)

    def test_of_a_stiffness_over_decades_shows_what_is_soft_and_what_is_stiff(self):
        spatula = self.folder / "spatula.vtp"
        model = palpate.precompute(palpate.refine(palpate.read(palpate.example("spatula"))), None, None)
        palpate.write(model, spatula)
        field = palpate.array(palpate.stiffness(model, radius_in_edges=2), "StiffnessNorm")
        mean = field[palpate.array(model, "BoundaryType") == 0].mean()
        stiffness = ("stiffness", spatula, "--radius-edges", 2)
        right = self.draw("spatula.png", *stiffness)
        wrong = self.draw("wrong.png", *stiffness, "--range", 0.7 * mean, 1.3 * mean)
        self.compare("spatula.png", right, wrong)


if __name__ == "__main__":
    unittest.main()
