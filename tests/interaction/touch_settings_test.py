# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the style that touches is told, without a window: recordings, settings, scenes."""

import json
import unittest

import numpy as np

import palpate
from support.surfaces import cube, points_of
from support.touch import (MODES, PRESS, RATE, REST, SIZE, TOP, Touch, Touching, block_model, path,
                           write_recording)


class Recordings(Touching):
    def test_replay_what_the_mouse_did_bit_for_bit(self):
        file = self.folder / "recorded.txt"
        style = Touch(block_model())
        self.assertTrue(style.SetRecordFileName(str(file)))
        forces = []
        for offset in ((0, 0, 0.005), (0, 0, -0.002), (0.004, 0, -0.002), (0, 0, 0.01)):
            style.MoveProbe(*(TOP + offset))
            self.run_well(style, 0.7)
            forces.append(style.force())
        self.assertFalse(file.exists())
        self.assertTrue(style.Stop(), style.GetFailureMessage())
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), ["recorded.txt"])
        again = Touch(block_model())
        self.assertTrue(again.SetDeviceToScript(str(file)))
        for force in forces:
            self.run_well(again, 0.7)
            self.assertTrue((again.force() == force).all())
        self.assertGreater(np.abs(forces[1]).max(), 0.1)

    def test_of_a_recording_are_the_recording(self):
        file = write_recording(self.folder / "motion.txt", path(*PRESS), away=range(3))
        style = Touch(block_model())
        style.SetDeviceToScript(str(file))
        style.SetRecordFileName(str(self.folder / "copy.txt"))
        self.run_well(style, len(path(*PRESS)) / RATE)
        self.assertTrue(style.Stop())
        copy = (self.folder / "copy.txt").read_text().splitlines()
        self.assertEqual((copy[0], copy[3]), ("palpate-device-recording 2", f"rate {RATE}"))
        self.assertEqual(copy[4:],
                         [" ".join(repr(float(n)).removesuffix(".0") for n in line.split())
                          if line[0].isdigit() else line for line in file.read_text().splitlines()[3:]])

    def test_are_kept_when_asked_for_after_the_probe_was_put(self):
        style = Touch(block_model())
        style.MoveProbe(*TOP)
        self.assertTrue(style.SetRecordFileName(str(self.folder / "late.txt")))
        self.run_well(style, 0.1)
        self.assertTrue(style.Stop())
        self.assertTrue((self.folder / "late.txt").is_file())

    def test_state_their_rate_and_are_replayed_at_no_other(self):
        file = self.folder / "fast.txt"
        style = Touch(block_model())
        style.SetServoRate(2000)
        style.SetRecordFileName(str(file))
        self.run_well(style, 0.1)
        self.assertTrue(style.Stop())
        self.assertIn("\nrate 2000\n", file.read_text())
        again = Touch(block_model())
        again.SetDeviceToScript(str(file))
        self.refuse(again, "fast.txt' has 2000 moments a second, but the servo loop runs at 1000 Hz, a "
                    "moment a tick: choose the recording's rate", again.RunHeadless, 0.1)
        again.SetServoRate(2000)
        self.assertTrue(again.RunHeadless(0.1), again.GetFailureMessage())

    def test_that_are_too_long_tell_what_is_left_out(self):
        style = Touch(block_model())
        warnings = []
        style.AddObserver("WarningEvent", lambda *_: warnings.append(style.GetWarnings()))
        style.SetServoRate(250)
        style.SetRecordFileName(str(self.folder / "long.txt"))
        self.run_well(style, 121.5)
        self.assertEqual(style.GetWarnings(), "")
        self.assertTrue(style.Stop())
        told = "the recording holds the first 120 s: the 1.5 s after them are left out\n"
        self.assertEqual((style.GetWarnings(), warnings), (told, [told]))
        self.assertIn(f"moments {120 * 250}\n", (self.folder / "long.txt").read_text())

    def test_of_poses_out_of_reach_touch_nothing(self):
        # The block has a corner at the origin, where a hand would be taken to be.
        style = Touch(block_model())
        style.SetToolToSphere(0.02)
        style.SetDeviceToScript(
            str(write_recording(self.folder / "far.txt", np.full((400, 3), 50.0))))
        self.run_well(style, 0.4)
        self.assertFalse(style.IsTouching())
        self.assertEqual(np.abs(style.force()).max(), 0)
        self.assertIn("out of reach", style.GetFault())

    def test_that_cannot_be_written_are_a_failure_that_leaves_nothing(self):
        style = Touch(block_model())
        for name, why in (("no/file.txt", "there is no folder"), ("", "it is a folder")):
            self.refuse(style, why, style.SetRecordFileName, str(self.folder / name))
        style = Touch(block_model())
        folder = self.folder / "gone"
        folder.mkdir()
        self.assertTrue(style.SetRecordFileName(str(folder / "file.txt")))
        folder.rmdir()
        self.run_well(style, 0.1)
        self.refuse(style, "file.txt cannot be written", style.Stop)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_that_are_missing_or_wrong_are_a_failure_of_the_start(self):
        style = Touch(block_model())
        missing = str(self.folder / "none.txt")
        style.SetDeviceToScript(missing)
        for method, arguments in ((style.Start, ()), (style.RunHeadless, (1,))):
            self.refuse(style, f"the recording '{missing}' cannot be opened", method, *arguments)
        wrong = write_recording(self.folder / "wrong.txt", path(*PRESS))
        wrong.write_text(wrong.read_text().replace("1 0 0 0 0 0", "1 0 zero 0 0 0", 1))
        style.SetDeviceToScript(str(wrong))
        self.refuse(style, "line 5", style.RunHeadless, 1)


class Settings(Touching):
    def test_that_are_out_of_range_are_refused_and_the_last_ones_stay(self):
        style = Touch(block_model())
        before = [style.GetFriction(), style.GetMaskRadius(), style.GetStiffnessScale(),
                  style.GetRigidStiffness(), style.GetServoRate()]
        nan = float("nan")
        for method, sentence, values in (
                (style.SetFriction, "friction must be from 0 to 100", (-1, 101, nan, np.inf)),
                (style.SetMaskRadius, "radius of a mask must be from 0 to 1e6 m", (-1, 1e300, nan)),
                (style.SetStiffnessScale, "stiffness scale must be positive", (0, -1, 1e300, nan)),
                (style.SetRigidStiffness, "rigid stiffness must be from 0 to 1e15 N/m", (-1, 1e300, nan)),
                (style.SetServoRate, "between 250 and 10000 Hz", (0, 249, 10001, nan)),
                (style.SetLargestForce, "safety setting largestForce", (-1, nan, np.inf)),
                (style.SetForceSlew, "safety setting forceSlew", (0, -1, nan)),
                (style.SetForceRamp, "safety setting rampSeconds", (0, -1, nan)),
                (style.SetToolToSphere, "radius of a ball must be positive", (0, -1, nan)),
                (style.RunHeadless, "time to run must be from 0 to 86400 s", (-1, 1e300, nan, np.inf))):
            for value in values:
                self.refuse(style, sentence, method, value)
        self.assertEqual(before, [style.GetFriction(), style.GetMaskRadius(), style.GetStiffnessScale(),
                                  style.GetRigidStiffness(), style.GetServoRate()])
        self.assertTrue(style.RunHeadless(0.01))
        self.assertEqual(style.GetFailureMessage(), "")

    def test_of_safety_bound_what_a_device_is_given(self):
        # Stations of a press: whole force from 1.1 s on, of more than 8 N on a ball this deep.
        deep = tuple((seconds, (0, 0, -8 if z < 0 else z)) for seconds, (_, _, z) in PRESS)
        file = write_recording(self.folder / "deep.txt", path(*deep), limits="8 0.1 0")
        largest = {}
        for limit in (None, 1.0, 8.0):
            style = Touch(block_model())
            style.SetToolToSphere(0.02)
            if limit is not None:
                self.assertTrue(style.SetLargestForce(limit))
                self.assertEqual(style.GetLargestForce(), limit)
            style.SetDeviceToScript(str(file))
            self.run_well(style, 1.2)
            self.assertGreater(np.linalg.norm(style.force()), 3.2)
            largest[limit] = np.linalg.norm(style.rendered())
        self.assertAlmostEqual(largest[None], 3)
        self.assertAlmostEqual(largest[1.0], 1)
        self.assertGreater(largest[8.0], 3.2)

    def test_have_the_values_of_the_header(self):
        style = Touch(block_model())
        self.assertEqual((style.GetFriction(), style.GetStiffnessScale(), style.GetRigidStiffness(),
                          style.GetServoRate(), style.GetPressDepth(), style.GetFrameRate(),
                          style.GetDeformation(), style.GetNumberOfTools()),
                         (0.3, 1, 0, 1000, 0.02, 60, MODES["all"], 1))
        self.assertEqual((style.GetLargestForce(), style.GetForceSlew(), style.GetForceRamp()),
                         (3, 1000, 0.5))
        corners = points_of(block_model())[np.array(
            [[block_model().GetCell(c).GetPointId(k) for k in range(3)]
             for c in range(block_model().GetNumberOfCells())])]
        edges = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)  # each of them twice
        self.assertAlmostEqual(style.GetMaskRadius() / (2 * edges.mean()), 1, delta=1e-12)

    def test_that_were_made_last_hold_however_many_came_between_two_ticks(self):
        for radius in (0, 0.03):
            style = self.scripted(path((0, (0, 0, 5 + 1e3 * radius)), (REST, (0, 0, 5 + 1e3 * radius)),
                                       (0.3, (0, 0, -2 + 1e3 * radius)), (9, (0, 0, -2 + 1e3 * radius))),
                                  radius)
            self.run_well(style, REST + 0.4)
            before = style.force()
            for i in range(200):
                self.assertTrue(style.SetStiffnessScale(1 + 0.01 * i) and style.SetFriction(0.01 * i))
            self.assertTrue(style.SetStiffnessScale(0.5) and style.SetFriction(0.3))
            self.run_well(style, 0.2)  # points change their stiffness over 100 ticks
            self.assertGreater(before[2], 0.1)
            self.assertLess(np.abs(style.force() - 0.5 * before).max(), 1e-6 * before[2])

    def test_that_the_mesh_is_too_coarse_for_warn_once(self):
        style = Touch(block_model())
        warnings = []
        style.AddObserver("WarningEvent", lambda *_: warnings.append(style.GetWarnings()))
        for i in range(5):
            style.SetMaskRadius(0.002 - 1e-4 * i)
            self.run_well(style, 0.1)
        self.assertEqual(len(warnings), 1)
        self.assertIn("the pressure mask of radius 0.002 m is much smaller", warnings[0])
        self.assertEqual(style.GetWarnings(), warnings[0])

    def test_of_the_rate_count_ticks(self):
        for rate in (250, 1000, 2000):
            style = Touch(block_model())
            self.assertTrue(style.SetServoRate(rate))
            self.run_well(style, 0.5)
            self.assertEqual(style.GetNumberOfTicks(), rate / 2)
            self.assertEqual(style.GetNumberOfMissedTicks(), 0)
            self.assertIn(f"{rate} Hz", style.GetStatus())
            self.assertGreater(style.GetTickTime(0.99), 0)
            self.assertIn("compute", style.GetTimingTable())

    def test_of_a_simulated_hand_let_it_press_and_lift(self):
        for radius in (0, 0.02):
            style = Touch(block_model())
            self.assertTrue(style.SetDeviceToSimulated())
            self.assertTrue(style.SetToolToSphere(radius) if radius else style.SetToolToPoint())
            forces = []
            for second in range(4):  # pressed after each first one, lifted after each second
                self.run_well(style, 1)
                forces.append(np.linalg.norm(style.rendered()))
            self.assertGreater(min(forces[::2]), 0.05)
            self.assertEqual(forces[1::2], [0, 0])
            self.assertEqual(style.GetFaultTable(), "")

    def test_of_a_device_that_is_not_there_fail_at_the_start(self):
        style = Touch(block_model())
        style.SetDeviceToHid(0x0001, 0x0002)
        self.refuse(style, "the HID device 0001:0002 is not there: `palpate devices` lists", style.Start)
        self.assertFalse(style.IsRunning())
        style.SetDeviceToMouse()
        self.assertTrue(style.RunHeadless(0.01))


class Scenes(Touching):
    def scene(self, **changed):
        palpate.write(block_model(), self.folder / "block.vtp")
        file = self.folder / "scene.json"
        file.write_text(json.dumps({
            "models": [{"file": "block.vtp"}], "tools": [{"shape": "sphere", "radius": 0.03,
                                                          "device": "mouse"}],
            "devices": [{"name": "mouse", "type": "mouse"}],
            "effects": {"friction": {"mu": 0.4}}, **changed}))
        return str(file)

    def test_are_taken_over(self):
        style = Touch()
        self.assertTrue(style.LoadScene(self.scene()), style.GetFailureMessage())
        self.assertEqual(style.GetFriction(), 0.4)
        style.MoveProbe(*(TOP + (0, 0, 0.05)))
        self.run_well(style, 1)
        style.MoveProbe(*(TOP + (0, 0, 0.028)))
        self.run_well(style, 1)
        self.assertGreater(style.force()[2], 0.1)
        self.assertTrue((style.torque() == 0).all())  # not asked for

    def test_that_are_wrong_name_the_key_and_leave_the_last_one(self):
        style = Touch(block_model())
        for sentence, changed in (
                ('"tools[0].shape" must be one of', {"tools": [{"shape": "cone", "device": "mouse"}]}),
                ('"servo.rate"', {"servo": {"rate": 3}}),
                ('"effects.friction.mu"', {"effects": {"friction": {"mu": -1}}}),
                ("none.vtp: there is no such file", {"models": [{"file": "none.vtp"}]})):
            self.refuse(style, sentence, style.LoadScene, self.scene(**changed))
            self.assertIs(style.GetTouchedModel(), block_model())
        self.refuse(style, "cannot be opened", style.LoadScene, str(self.folder / "none.json"))

    def test_that_lack_a_file_say_so_each_time(self):
        style = Touch()
        point = {"shape": "point"}
        self.assertTrue(style.LoadScene(self.scene(
            effects={}, tools=[{**point, "device": "mouse"}, {**point, "device": "script"}],
            devices=[{"name": "mouse", "type": "mouse"},
                     {"name": "script", "type": "scripted", "file": "script.txt"}])))
        for _ in range(2):
            self.refuse(style, "script.txt' cannot be opened", style.RunHeadless, 1)
        write_recording(self.folder / "script.txt", path(*PRESS))
        self.assertTrue(style.RunHeadless(REST + 0.4), style.GetFailureMessage())
        self.assertGreater(style.force(1)[2], 0.1)

    def two_tools(self, shapes):
        return self.scene(
            tools=[{**shape, "device": name} for shape, name in zip(shapes, "ab")],
            devices=[{"name": "a", "type": "mouse"}, {"name": "b", "type": "simulated"}])

    def test_keep_their_further_tools_when_the_first_is_changed(self):
        style = Touch()
        ball = {"shape": "sphere", "radius": 0.03}
        self.assertTrue(style.LoadScene(self.two_tools((ball, ball))))
        self.assertTrue(style.SetToolToSphere(0.02))
        self.assertEqual(style.GetNumberOfTools(), 2)
        self.run_well(style, 1)
        self.assertGreater(np.linalg.norm(style.force(1)), 0.05)
        together = "points and tools with a shape do not touch a surface together"
        self.refuse(style, together, style.SetToolToPoint)
        point = {"shape": "point"}
        self.assertTrue(style.LoadScene(self.two_tools((point, point))))
        self.refuse(style, together, style.SetToolToSphere, 0.02)
        self.assertEqual(style.GetNumberOfTools(), 2)

    def test_tell_how_far_their_probes_go(self):
        style = Touch()
        probes = [{"name": "top", "position": [0.05, 0.05, 0.1]}, {"name": "foot", "node": 0}]
        self.assertTrue(style.LoadScene(self.scene(effects={"probes": probes, "deformation": "none"})))
        style.MoveProbe(*(TOP + (0, 0, 0.05)))
        self.run_well(style, 1)
        style.MoveProbe(*(TOP + (0, 0, 0.028)))
        self.run_well(style, 1)
        self.assertEqual([style.GetProbeName(i) for i in range(-1, style.GetNumberOfProbes() + 1)],
                         ["", "top", "foot", ""])
        moved = [1.0] * 3
        style.GetProbeDisplacement(0, moved)
        self.assertTrue(-0.003 < moved[2] < -0.0015, moved)
        for probe in (-1, 1, 2):  # none, fixed, none
            style.GetProbeDisplacement(probe, moved)
            self.assertEqual(moved, [0, 0, 0])

    def test_of_a_hand_need_a_glove(self):
        write_recording(self.folder / "stylus.txt", path(*PRESS))
        style = Touch()
        for device, told in (({"type": "scripted", "file": "stylus.txt"},
                              "stylus.txt' moves no hand: moment 0 of a glove's trace has 0 joints"),
                             ({"type": "simulated"}, "a simulated device has no joints")):
            self.assertTrue(style.LoadScene(self.scene(
                tools=[{"shape": "hand", "device": "glove"}], devices=[{"name": "glove", **device}])))
            self.refuse(style, told, style.RunHeadless, 0.1)

    def test_name_the_file_of_a_tool_that_is_no_body(self):
        surface = cube(2, 0.02)
        surface.DeleteCells()
        surface.BuildCells()
        surface.DeleteCell(0)
        surface.RemoveDeletedCells()
        palpate.write(surface, self.folder / "open.vtp")
        style = Touch()
        self.assertTrue(style.LoadScene(self.scene(
            tools=[{"shape": "mesh", "file": "open.vtp", "device": "mouse"}])))
        self.refuse(style, "open.vtp: ", style.RunHeadless, 0.1)

    def test_do_not_lift_what_a_device_renders_stably(self):
        depth, most = 0.002, 30
        style = self.scripted(np.repeat(path(*PRESS)[[1100]], 2000, axis=0), limits=f"3.3 0.1 {most}")
        free = self.scripted(np.repeat(path(*PRESS)[[1100]], 2000, axis=0))
        style.AddObserver("WarningEvent", lambda *_: None)
        for touch in (style, free):
            self.run_well(touch, 1)
        self.assertIn("is limited to the 30 N/m that the device states to render stably", style.GetWarnings())
        for method, value in (("SetStiffnessScale", 10), ("SetRigidStiffness", 1e6), ("SetMaskRadius", 0.05),
                              ("SetStiffnessScale", 100), ("SetStiffnessScale", 1)):
            for touch in (style, free):
                self.assertTrue(getattr(touch, method)(value))
                self.run_well(touch, 0.2)
            self.assertLess(np.linalg.norm(style.force()), most * depth * (1 + 1e-9))
            self.assertGreater(np.linalg.norm(style.force()), 0.5 * most * depth)
            self.assertGreater(np.linalg.norm(free.force()), 1.1 * most * depth)

    def test_of_the_mask_choose_its_functional_before_and_while_it_touches(self):
        forces = {}
        for name in ("linear", "uniform", "gaussian", "hertzian"):
            held = np.repeat(path(*PRESS)[[1100]], 1000, axis=0)
            before, later = self.scripted(held), self.scripted(held)
            for style in (before, later):
                self.assertTrue(style.SetMaskRadius(0.05))
            self.assertTrue(before.SetMaskShape(name))
            self.run_well(before, 0.5)
            self.run_well(later, 0.1)
            self.assertTrue(later.SetMaskShape(name))
            self.assertEqual(later.GetMaskShape(), name)
            self.run_well(later, 0.9)
            forces[name] = np.linalg.norm(later.force())
            self.run_well(before, 0.5)
            self.assertAlmostEqual(np.linalg.norm(before.force()) / forces[name], 1, delta=1e-6)
        self.assertEqual(len({round(force, 6) for force in forces.values()}), 4)
        style = Touch(block_model())
        self.refuse(style, "there is no mask 'round': choose linear, uniform", style.SetMaskShape, "round")
        self.assertEqual(style.GetMaskShape(), "linear")

    def test_do_not_lift_what_a_device_renders_stably_with_a_ball(self):
        held = np.repeat(path(*PRESS)[[1100]] + [0, 0, 0.02], 3000, axis=0)  # 2 mm deep
        style, free = self.scripted(held, 0.02, limits="3.3 0.1 30"), self.scripted(held, 0.02)
        style.AddObserver("WarningEvent", lambda *_: None)
        for touch in (style, free):
            self.run_well(touch, 1)
        self.assertIn("limited to the 30 N/m that the device states to render stably", style.GetWarnings())
        bounded = np.linalg.norm(style.force())
        self.assertLess(bounded, 30 * 0.002)
        self.assertGreater(np.linalg.norm(free.force()), 3 * bounded)
        for scale, share in ((10, 1), (1e-3, None), (1, 1)):
            for touch in (style, free):
                self.assertTrue(touch.SetStiffnessScale(scale))
                self.run_well(touch, 0.3)
            force = np.linalg.norm(style.force())
            wanted = share * bounded if share else np.linalg.norm(free.force())
            self.assertAlmostEqual(force / wanted, 1, delta=1e-3)

    def test_of_the_rigid_stiffness_reach_balls(self):
        forces = []
        for steps in (((0.1, 100),), ((0.1, 1000),), ((0.1, 100), (0.3, 1000))):
            below = np.array([*TOP[:2], -0.019])  # of a ball with a radius of 20 mm, at its middle
            style = self.scripted(np.tile(below, (3000, 1)))
            self.assertTrue(style.SetToolToSphere(0.02))
            for seconds, stiffness in steps:
                self.assertTrue(style.SetRigidStiffness(stiffness))
                self.run_well(style, seconds)
            self.run_well(style, 0.7)
            forces.append(np.linalg.norm(style.force()))
        self.assertAlmostEqual(forces[1] / forces[0], 10, delta=0.01)
        self.assertAlmostEqual(forces[2] / forces[1], 1, delta=1e-3)

    def test_have_a_plan_of_what_is_computed(self):
        style = Touch(block_model())
        plan = style.GetEvaluationPlan()
        for line in ("nodes under forces", "a tick, 1 k a second", "a frame", "memory", "deformation"):
            self.assertIn(line, plan)
        style.SetDeformation(MODES["none"])
        self.assertNotIn("displacements", style.GetEvaluationPlan())
        self.assertTrue(style.LoadScene(self.scene(servo={"rate": 500})))
        self.assertIn("a tick, 500 a second", style.GetEvaluationPlan())
        self.assertIn("watched", style.GetEvaluationPlan())

    def test_give_way_to_a_finer_model(self):
        style = Touch()
        self.assertTrue(style.LoadScene(self.scene()))
        self.run_well(style, 0.01)
        fine = cube(4, SIZE)
        model = palpate.precompute(fine, 1e4, 0.3, fixed=points_of(fine)[:, 2] == 0)
        self.assertTrue(style.SetModel(model), style.GetFailureMessage())
        self.run_well(style, 0.01)
        self.assertEqual(len(style.surface()), model.GetNumberOfPoints())


if __name__ == "__main__":
    unittest.main()
