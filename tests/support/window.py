# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A window in which a style touches, pictures of it, and tests in it."""

import os
import shutil
import sys
import tempfile
import time
import unittest
from pathlib import Path

import numpy as np
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGReader, vtkPNGWriter
from vtkmodules.vtkRenderingCore import (vtkRenderer, vtkRenderWindow, vtkRenderWindowInteractor,
                                         vtkWindowToImageFilter)

from support.touch import TOP, Touch, block_model


def ensure_display():
    """Runs the script again with a display of its own, where there is none."""
    if not os.environ.get("DISPLAY") and shutil.which("xvfb-run"):
        os.execvp("xvfb-run", ["xvfb-run", "-a", "-s", "-screen 0 1280x1024x24", sys.executable,
                               *sys.argv])


def pixels_of(image):
    """Height by width by 3, float; the first row is the lowest."""
    width, height, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1).astype(float)


def read_picture(path):
    reader = vtkPNGReader()
    reader.SetFileName(str(path))
    reader.Update()
    return pixels_of(reader.GetOutput())


def write_picture(pixels, path):
    image = vtkImageData()
    image.SetDimensions(pixels.shape[1], pixels.shape[0], 1)
    image.GetPointData().SetScalars(
        numpy_to_vtk(pixels.round().astype(np.uint8).reshape(-1, 3), deep=True))
    writer = vtkPNGWriter()
    writer.SetFileName(str(path))
    writer.SetInputData(image)
    writer.Write()


class TouchWindow:
    """A style's window: the camera looks onto the block's top from the front."""

    SIZE = (480, 360)

    def __init__(self, style, seen_from=(0, -0.25, 0.3)):
        self.style = style
        self.renderer, self.window = vtkRenderer(), vtkRenderWindow()
        self.renderer.SetBackground(1, 1, 1)
        self.window.SetSize(*self.SIZE)
        self.window.SetMultiSamples(0)
        self.window.AddRenderer(self.renderer)
        self.interactor = vtkRenderWindowInteractor()
        self.interactor.SetRenderWindow(self.window)
        self.interactor.SetInteractorStyle(style)
        self.window.Render()
        if not style.RunHeadless(0):
            raise ValueError(style.GetFailureMessage())
        self.look(seen_from)

    def close(self):
        self.style.Stop()
        self.interactor.SetInteractorStyle(None)
        # The loops of later interactors look at this one as long as it is there, whatever its window is.
        self.window.SetInteractor(None)
        self.interactor.SetRenderWindow(None)
        del self.interactor, self.renderer, self.window

    def look(self, offset, at=TOP):
        """From a place beside a point, onto it."""
        camera = self.renderer.GetActiveCamera()
        camera.SetFocalPoint(*at)
        camera.SetPosition(*(np.asarray(at) + offset))
        camera.SetViewUp(0, 0.6, 0.8)
        self.renderer.ResetCameraClippingRange()
        self.window.Render()

    def towards(self):
        """Unit vector of the view, from the eye."""
        return np.array(self.renderer.GetActiveCamera().GetDirectionOfProjection())

    def pixel(self, place):
        """The pixel below which a place is seen."""
        self.renderer.SetWorldPoint(*place, 1)
        self.renderer.WorldToDisplay()
        return [round(c) for c in self.renderer.GetDisplayPoint()[:2]]

    def event(self, name, place=None, control=False):
        """A place is one in space or a pixel."""
        if place is None:
            place = self.interactor.GetEventPosition()
        x, y = self.pixel(place) if len(place) == 3 else place
        self.interactor.SetEventInformation(x, y, int(control), 0)
        self.interactor.InvokeEvent(name)

    def key(self, character):
        self.interactor.SetKeyCode(character)
        self.interactor.SetKeySym(character)
        self.interactor.InvokeEvent("CharEvent")

    def run(self, seconds, until=lambda: False):
        """Timer events, as the interactor's own loop sends them."""
        end = time.monotonic() + seconds
        while time.monotonic() < end and not until():
            self.interactor.InvokeEvent("TimerEvent")
            time.sleep(0.01)

    def start(self, seconds, until):
        """The interactor's own loop, until a frame is drawn in which that is so. Once a window."""
        end = time.monotonic() + seconds

        def look(*_):
            if time.monotonic() >= end or until():
                self.interactor.TerminateApp()

        tag = self.window.AddObserver("EndEvent", look)
        self.interactor.Start()
        self.window.RemoveObserver(tag)

    def picture(self):
        self.window.Render()
        grab = vtkWindowToImageFilter()
        grab.SetInput(self.window)
        grab.ReadFrontBufferOff()
        grab.Update()
        return pixels_of(grab.GetOutput())


class Windowed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if not os.environ.get("DISPLAY"):
            raise unittest.SkipTest("there is no display, and no xvfb-run")

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def open(self, radius=0, **how):
        style = Touch(block_model())
        if radius:
            style.SetToolToSphere(radius)
        window = TouchWindow(style, **how)
        self.addCleanup(window.close)
        return style, window

    def do(self, window, event, place=None, seconds=0.3, **how):
        """An event, and the time for the probe to follow."""
        window.event(event, place, **how)
        self.assertTrue(window.style.RunHeadless(seconds), window.style.GetFailureMessage())
