# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of what the style that touches draws.

Without a display it starts one of its own. PALPATE_STORE_PICTURES=1 stores new pictures: look at them
before they are committed.
"""

import os
import unittest
from pathlib import Path

import numpy as np

from support.touch import PRESS, REST, Touch, block_model, path, write_recording
from support.window import TouchWindow, Windowed, ensure_display, read_picture, write_picture

STORED = Path(__file__).parent / "pictures"
# Mean difference of the channels, of 255, that other drivers and versions of VTK may make.
ALLOWED = 0.4


class Pictures(Windowed):
    def compare(self, name, pixels, wrong):
        if os.environ.get("PALPATE_STORE_PICTURES"):
            write_picture(pixels, STORED / name)
        stored = read_picture(STORED / name)
        self.assertEqual(stored.shape, pixels.shape)
        self.assertLess(np.abs(stored - pixels).mean(), ALLOWED)
        self.assertGreater(np.abs(stored - wrong).mean(), 2 * ALLOWED)

    def pressed(self, radius, seconds, **how):
        # Without the status line, in which there are times.
        pixels = self.picture(radius, seconds, **how)[60:]
        return pixels[:300].reshape(150, 2, 240, 2, 3).mean(axis=(1, 3))

    def picture(self, radius, seconds, rigid_stiffness=0):
        style = Touch(block_model())
        style.SetRigidStiffness(rigid_stiffness)
        style.SetToolToSphere(radius) if radius else style.SetToolToPoint()
        deep = [(s, (x, y, 4 * z if z < 0 else z)) for s, (x, y, z) in PRESS]
        style.SetDeviceToScript(str(write_recording(self.folder / "press.txt",
                                                    path(*deep) + (0, 0, radius))))
        window = TouchWindow(style, seen_from=(0.03, -0.2, 0.17))
        self.addCleanup(window.close)
        self.assertTrue(style.RunHeadless(seconds), style.GetFailureMessage())
        return window.picture()

    def test_of_a_point_tell_its_three_places_apart_inside_the_body(self):
        """[JP01] fig. 8: a probe that a limited stiffness lets go deeper than the surface follows."""
        hues = {"x^C": lambda r, g, b: (b > r + 30) & (b > g + 25),
                "x^E": lambda r, g, b: (r > b + 60) & (g > b + 45) & (r > 120),
                "x^H": lambda r, g, b: (g > r + 40) & (g > b + 40)}
        below = slice(0, 300)  # of the legend, which begins at the upper edge
        before, pressed = (np.moveaxis(self.picture(0, s, rigid_stiffness=80)[below], -1, 0)
                           for s in (REST, REST + 0.4))
        places = {}
        for name, hue in hues.items():
            # The green probe is there before it touches.
            self.assertEqual(hue(*before).sum() > 0, name == "x^H", name)
            found = np.argwhere(hue(*pressed))
            self.assertGreater(len(found), 5, name)
            places[name] = found.mean(axis=0)
        self.assertGreater(places["x^C"][0], places["x^E"][0])  # above one another
        self.assertGreater(places["x^E"][0], places["x^H"][0])

    def test_have_a_status_line_that_is_seen_on_any_background(self):
        for ground in ((1, 1, 1), (0, 0, 0), (0.1, 0.1, 0.4)):
            style = Touch(block_model())
            window = TouchWindow(style)
            self.addCleanup(window.close)
            window.renderer.SetBackground(*ground)
            self.assertTrue(style.RunHeadless(0.01), style.GetFailureMessage())
            line = window.picture()[5:30, 5:200]  # the lowest rows are the first
            self.assertGreater(np.abs(line - 255 * np.array(ground)).min(axis=-1).max(), 110, ground)

    def test_of_a_point_show_the_dent_the_force_and_its_nodes(self):
        self.compare("point.png", self.pressed(0, REST + 0.4), self.pressed(0, REST))

    def test_of_a_ball_show_the_ball_in_the_dent(self):
        self.compare("ball.png", self.pressed(0.03, REST + 0.4), self.pressed(0.03, REST))


if __name__ == "__main__":
    ensure_display()
    unittest.main()
