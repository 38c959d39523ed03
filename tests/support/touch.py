# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A block to touch, recordings to touch it with, the style that does, and tests without a window."""

import functools
import tempfile
import unittest
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray

import palpate
import palpate.haptics
from support.surfaces import cube, points_of

SIZE = 0.1  # m, of the block [0, SIZE]^3
TOP = np.array([0.5, 0.5, 1.0]) * SIZE  # the middle of its free, flat top
RATE = 1000  # moments a second
REST = 0.8  # s, after which a device that is there gets the whole force
MODES = {"all": 0, "visible": 1, "contact": 2, "none": 3}


@functools.lru_cache(maxsize=None)
def block_model(scale=1):
    """Stands on its bottom, E = 10 kPa, nu = 0.3. Shared: do not change it."""
    surface = cube(6, scale * SIZE)
    return palpate.precompute(surface, 1e4, 0.3, fixed=points_of(surface)[:, 2] == 0)


def path(*stations):
    """Positions, a row a tick, on straight lines through (seconds, offset from TOP in mm)."""
    times = np.cumsum([seconds for seconds, _ in stations])
    offsets = np.array([offset for _, offset in stations]) * 1e-3
    ticks = np.arange(round(times[-1] * RATE)) / RATE
    return TOP + np.array([np.interp(ticks, times, column) for column in offsets.T]).T


PRESS = ((0, (0, 0, 5)), (REST, (0, 0, 5)), (0.3, (0, 0, -2)), (0.2, (0, 0, -2)),
         (0.3, (0, 0, 5)), (0.1, (0, 0, 5)))
STROKE = ((0, (0, 0, 5)), (REST, (0, 0, 5)), (0.3, (0, 0, -2)), (0.5, (9, 4, -2)),
          (0.3, (9, 4, 5)), (0.1, (9, 4, 5)))


def write_recording(file, positions, away=(), limits="3.3 0.1 0"):
    """Positions as a device's moments; None, or a row of NaN, as it is; away: numbers of moments in
    which it was not there."""
    lines = ["palpate-device-recording 1", "name a hand on rails", f"limits {limits}",
             f"moments {len(positions)}"]
    for i, position in enumerate(positions):
        x, y, z = (repr(float(c)) for c in position)
        lines.append("away" if i in away else f"{i + 1} {x} {y} {z} 1 0 0 0 0 0")
    file.write_text("\n".join(lines) + "\n")
    return file


class Touch(palpate.haptics.vtkInteractorStyleHaptic):
    """A style that keeps its errors and events instead of printing them."""

    def __init__(self, model=None):
        self.errors, self.events = [], []
        self.AddObserver("ErrorEvent", lambda *_: self.errors.append(self.GetFailureMessage()))
        for name in ("ContactBeginEvent", "ContactEndEvent", "FaultEvent"):
            self.AddObserver(int(getattr(self, name)), lambda *_, name=name: self.events.append(name))
        if model is not None and not self.SetModel(model):
            raise ValueError(self.GetFailureMessage())

    def force(self, tool=0):
        values = [0.0] * 3
        self.GetForce(tool, values)
        return np.array(values)

    def torque(self, tool=0):
        values = [0.0] * 3
        self.GetTorque(tool, values)
        return np.array(values)

    def rendered(self, tool=0):
        values = [0.0] * 3
        self.GetRenderedForce(tool, values)
        return np.array(values)

    def position(self, tool=0):
        values = [0.0] * 3
        self.GetToolPosition(tool, values)
        return np.array(values)

    def contact_point(self, tool=0):
        values = [0.0] * 3
        self.GetContactPoint(tool, values)
        return np.array(values)

    def trace(self):
        """Ticks by 6: force and torque."""
        values = vtkDoubleArray()
        self.GetForceTrace(values)
        return vtk_to_numpy(values).reshape(-1, 6).copy()

    def surface(self, body=0):
        """#nodes by 3, as they are drawn."""
        return points_of(self.GetDeformedSurface(body)).copy()


class Touching(unittest.TestCase):
    """Styles that run on virtual time, and how they fail."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def scripted(self, positions, radius=0, **how):
        """A fresh style whose tool follows positions."""
        style = Touch(block_model())
        self.recordings = getattr(self, "recordings", 0) + 1
        file = write_recording(self.folder / f"motion{self.recordings}.txt", positions, **how)
        self.assertTrue(style.SetDeviceToScript(str(file)))
        self.assertTrue(style.SetToolToSphere(radius) if radius else style.SetToolToPoint())
        return style

    def run_well(self, style, seconds):
        self.assertTrue(style.RunHeadless(seconds), style.GetFailureMessage())
        self.assertEqual(style.errors, [])

    def trace_of(self, positions, radius=0, friction=0.3):
        style = self.scripted(positions, radius)
        self.assertTrue(style.SetFriction(friction))
        self.run_well(style, len(positions) / RATE)
        return style.trace()

    def refuse(self, style, sentence, method, *arguments):
        """The call fails with one sentence and one error event."""
        before = len(style.errors)
        self.assertFalse(method(*arguments), (method, arguments))
        self.assertIn(sentence, style.GetFailureMessage())
        self.assertEqual(style.errors[before:], [style.GetFailureMessage()])
        self.assertNotIn("\n", style.GetFailureMessage())
