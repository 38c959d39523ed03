# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The style that touches, in the interactor's own loop.

A file of its own: VTK 9.1's loop crashes where two windows were open at once before.
"""

import os
import time
import unittest

from support.touch import TOP, Touch, block_model
from support.window import TouchWindow, ensure_display


def setUpModule():
    if not os.environ.get("DISPLAY"):
        raise unittest.SkipTest("there is no display, and no xvfb-run")


class Loop(unittest.TestCase):
    def test_touches_while_the_window_draws(self):
        style = Touch(block_model())
        window = TouchWindow(style)
        self.addCleanup(window.close)
        window.interactor.Initialize()
        frames = []
        window.window.AddObserver("EndEvent", lambda *_: frames.append(time.monotonic()))
        self.assertTrue(style.Start())
        window.look((0, -0.25, 0.3))
        window.event("LeftButtonPressEvent", TOP)
        window.start(20, until=style.IsTouching)  # at once but on a busy machine
        self.assertTrue(style.IsTouching())
        window.event("LeftButtonReleaseEvent")
        window.run(20, until=lambda: not style.IsTouching())
        self.assertFalse(style.IsTouching())
        self.assertEqual(style.events, ["ContactBeginEvent", "ContactEndEvent"])
        self.assertGreater(len(frames), 2)
        style.Stop()
        drawn = len(frames)
        window.run(0.2)
        self.assertEqual(len(frames), drawn)


if __name__ == "__main__":
    ensure_display()
    unittest.main()
