# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Probes inside a body while it is touched, and the event where a limit is exceeded."""

import json
import subprocess
import tempfile
import unittest
from pathlib import Path

import palpate
from support.solids import bar, base_of, set_cells
from support.surfaces import PROGRAM
from support.touch import PRESS, RATE, SIZE, Touch, block_model, path, write_recording

INSIDE = (0.05, 0.05, 0.08)


class Probes(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        palpate.write(block_model(), str(self.folder / "block.vtp"))
        write_recording(self.folder / "press.txt", path(*PRESS))

    def scene(self, probes, **effects):
        file = self.folder / "scene.json"
        file.write_text(json.dumps({
            "models": [{"file": "block.vtp"}],
            "tools": [{"shape": "sphere", "radius": 0.02, "device": "hand"}],
            "devices": [{"name": "hand", "type": "scripted", "file": "press.txt",
                         "mapping": {"origin": [0, 0, 0.02]}}],
            "effects": {"probes": probes, "deformation": "none", **effects}}))
        return file

    def touched(self, *probes, seconds=1.7, **effects):
        style = Touch()
        self.assertTrue(style.LoadScene(str(self.scene(probes, **effects))))
        self.exceeded = []
        style.AddObserver(style.ThresholdEvent, lambda *_: self.exceeded.append(style.GetProbeLimitTime(0)))
        done = 0
        while done < seconds:
            self.assertTrue(style.RunHeadless(0.1))
            style.Update()
            done += 0.1
        return style

    def test_keep_the_largest_stress_of_any_tick_and_tell_of_a_limit_once(self):
        style = self.touched({"name": "deep", "inside": INSIDE, "von_mises_limit": 50.0})
        largest = style.GetLargestProbeVonMisesStress(0)
        self.assertGreater(largest, 50)
        self.assertLess(style.GetProbeVonMisesStress(0), 1e-6 * largest)  # it was let go
        self.assertGreater(style.GetLargestProbeDisplacementGradient(0), 0)
        self.assertEqual(len(self.exceeded), 1)
        self.assertGreater(self.exceeded[0], 0.8)
        self.assertLess(self.exceeded[0], 1.4)

    def test_read_what_a_press_with_the_same_forces_does(self):
        style = self.touched({"name": "deep", "inside": INSIDE}, seconds=1.2)
        force = [0.0] * 3
        style.GetForce(0, force)
        pressed = palpate.press(block_model(), (0.05, 0.05, SIZE), force=[-f for f in force], radius=0.008)
        inside = palpate.probe(pressed, [INSIDE])
        self.assertAlmostEqual(
            style.GetProbeVonMisesStress(0) / palpate.array(inside, "VonMisesStress")[0], 1, delta=0.15)
        self.assertEqual(self.exceeded, [])
        self.assertEqual(style.GetProbeLimitTime(0), -1)

    def test_look_into_bodies_of_several_materials_where_these_were_asked(self):
        grid = set_cells(bar((3, 3, 3), (SIZE,) * 3), YoungsModulus=[1e4 + c for c in range(162)],
                         PoissonRatio=[0.3] * 162)
        model = palpate.precompute(grid, 1e4, 0.3, fixed=base_of(grid), method="fem", probes=[INSIDE],
                                   estimate_error=False)
        palpate.write(model, str(self.folder / "block.vtp"))
        style = self.touched({"name": "deep", "inside": INSIDE}, seconds=1.2)
        other = self.touched({"name": "deep", "inside": INSIDE}, seconds=1.2)
        self.assertGreater(style.GetProbeVonMisesStress(0), 10)
        self.assertEqual(style.GetProbeVonMisesStress(0), other.GetProbeVonMisesStress(0))
        refused = Touch()
        self.assertTrue(refused.LoadScene(str(self.scene([{"name": "out", "inside": [0.05, 0.05, 0.03]}]))))
        self.assertFalse(refused.RunHeadless(0.1))
        self.assertIn("no probe at", refused.GetFailureMessage())

    def test_on_the_surface_read_no_stress(self):
        style = self.touched({"name": "top", "node": 3}, seconds=0.2)
        self.assertEqual(style.GetLargestProbeVonMisesStress(0), 0)
        self.assertEqual(style.GetProbeLimitTime(0), -1)

    def test_outside_are_refused(self):
        style = Touch()
        self.assertTrue(style.LoadScene(str(self.scene([{"name": "out", "inside": [0, 0, 1]}]))))
        self.assertFalse(style.RunHeadless(0.1))
        self.assertIn("not inside the material", style.GetFailureMessage())

    def test_the_program_prints_them_and_warns_of_limits(self):
        file = self.scene([{"name": "deep", "inside": INSIDE, "gradient_limit": 0.005}])
        done = subprocess.run([PROGRAM, "touch", "--scene", file, "--headless", "--seconds", "1.2", "--rate",
                               str(RATE)], capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"von Mises stress \d.*at most")
        self.assertRegex(done.stderr, r"a limit of the probe deep was first exceeded at [01]\.\d+ s")


if __name__ == "__main__":
    unittest.main()
