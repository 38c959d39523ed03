# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The style that touches, from Python, without a window."""

import json
import unittest

import numpy as np

import palpate
from support.surfaces import points_of, sphere
from support.touch import (MODES, PRESS, RATE, REST, SIZE, STROKE, TOP, Touch, Touching, block_model,
                           path, write_recording)

LOST = "the device is not there"
INVALID = "a pose that is not finite, out of reach or no rotation"


class Models(Touching):
    def test_without_greens_functions_are_refused_and_the_last_one_stays(self):
        style = Touch(block_model())
        self.refuse(style, "carries no Green's functions: compute them with", style.SetModel, sphere(1))
        self.refuse(style, "there is no model to touch", style.SetModel, None)
        self.assertIs(style.GetTouchedModel(), block_model())
        self.assertTrue(style.RunHeadless(0.01), style.GetFailureMessage())

    def test_are_needed_to_run_move_or_plan(self):
        style = Touch()
        for method, arguments in ((style.Start, ()), (style.RunHeadless, (1,)),
                                  (style.MoveProbe, (0, 0, 0))):
            self.refuse(style, "there is no model to touch: set one or load a scene", method, *arguments)
        self.refuse(style, "there is no model to plan for", style.GetEvaluationPlan)

    def test_are_not_changed_by_touch(self):
        before = points_of(block_model()).copy()
        style = self.scripted(path(*PRESS))
        self.run_well(style, REST + 0.4)
        self.assertTrue(style.IsTouching())
        self.assertTrue((points_of(block_model()) == before).all())


class Forces(Touching):
    def test_of_a_script_are_the_same_twice_bit_for_bit(self):
        for radius in (0, 0.03):
            positions = path(*STROKE) + (0, 0, radius)
            first, second = self.trace_of(positions, radius), self.trace_of(positions, radius)
            self.assertEqual(first.shape, (len(positions), 6))
            self.assertGreater(np.abs(first).max(), 0.1)
            self.assertEqual(first.tobytes(), second.tobytes())

    def test_do_not_depend_on_how_often_they_are_looked_at(self):
        positions = path(*STROKE)
        style = self.scripted(positions)
        for _ in range(len(positions) // 100):
            self.run_well(style, 0.1)
        self.assertEqual(style.trace().tobytes(), self.trace_of(positions).tobytes())

    def test_push_out_while_pressed_and_are_zero_before_and_after(self):
        for radius in (0, 0.03):
            positions = path(*PRESS)
            trace = self.trace_of(positions + (0, 0, radius), radius)
            inside = positions[:, 2] < TOP[2]
            self.assertTrue((trace[~inside] == 0).all())
            self.assertTrue((trace[inside, 2] > 0).all())
            # By symmetry, up to rounding in forces of a newton.
            firm = trace[:, 2] > (0.05 * trace[:, 2].max() if radius else -1)
            self.assertLess(np.abs(trace[firm, :2]).max(), 1e-9)
            # In the last ticks of lifting off a ball's points inside triangles end one after another.
            self.assertLess(np.abs(trace[:, :2]).max(), 1e-5 * trace[:, 2].max())
            deepest = positions[:, 2] == positions[:, 2].min()
            # The ball also touches triangles inside, at points that settle while it rests.
            self.assertLess(np.ptp(trace[deepest, 2]), 2e-3 * trace[deepest, 2].max() if radius else 1e-9)

    def test_of_a_point_that_sticks_grow_in_proportion_to_depth(self):
        positions = path(*PRESS)
        trace = self.trace_of(positions)
        inside = positions[:, 2] < TOP[2] - 1e-4
        stiffness = trace[inside, 2] / (TOP[2] - positions[inside, 2])
        self.assertLess(np.ptp(stiffness) / stiffness.mean(), 1e-9)  # rounding

    def test_stay_within_the_friction_cone_of_a_flat_place(self):
        for friction in (0, 0.1, 0.5):
            trace = self.trace_of(path(*STROKE), friction=friction)
            normal, tangential = trace[:, 2], np.hypot(trace[:, 0], trace[:, 1])
            # The servo loop's slip is solved to a few millionths of the force.
            self.assertTrue((tangential <= friction * normal + 1e-5 * normal.max()).all())
            sliding = normal > 0.5 * normal.max()
            if friction:
                self.assertGreater((tangential[sliding] / normal[sliding]).max(), 0.999 * friction)
                moved = path(*STROKE)[np.argmax(tangential)] - TOP
                self.assertLess(trace[np.argmax(tangential), :2] @ moved[:2], 0)  # against the motion

    def test_of_a_pushed_ball_turn_about_its_centre(self):
        style = Touch(block_model())
        style.SetToolToSphere(0.08)  # so large that it touches vertices alone
        for offset, seconds in ((0.085, 1), (0.079, 0.3)):
            style.MoveProbe(*(TOP + (0, 0, offset)))
            self.run_well(style, seconds)
        self.assertLess(np.linalg.norm(style.torque()), 1e-9)
        style.MoveProbe(*(TOP + (0.003, 0, 0.079)))
        self.run_well(style, 0.3)
        self.assertLess(style.force()[0], 0)
        self.assertEqual(style.GetNumberOfContacts(), 1)
        node = np.linalg.norm(points_of(block_model()) - TOP, axis=1).argmin()
        torque = np.cross(style.surface()[node] - style.position(), style.force())
        # Where the node is, the contact's linearisation knows to its second order.
        self.assertLess(np.linalg.norm(style.torque() - torque), 0.01 * np.linalg.norm(torque))

    def test_scale_with_the_stiffness_and_are_bounded_by_the_rigid_one(self):
        style = Touch(block_model())
        style.MoveProbe(*(TOP + (0, 0, 0.005)))
        self.run_well(style, 1)
        style.MoveProbe(*(TOP - (0, 0, 0.002)))
        self.run_well(style, 0.3)
        before, shape = style.force(), style.surface()
        self.assertTrue(style.SetStiffnessScale(2))
        self.run_well(style, 0.3)
        self.assertLess(np.abs(style.force() / before - 2)[2], 1e-9)
        self.assertLess(np.abs(style.surface() - shape).max(), 1e-9)  # the probe is where it was
        self.assertTrue(style.SetRigidStiffness(1))
        self.run_well(style, 0.5)
        # 2 mm at 1 N/m, which bounds the mean square over directions: each one by root 3.
        self.assertLess(style.force()[2], 3**0.5 * 2e-3)
        self.assertGreater(style.force()[2], 0)


class Probe(Touching):
    def place(self, style, offset, adheres=False):
        self.assertTrue(style.MoveProbe(*(TOP + offset), adheres), style.GetFailureMessage())
        self.run_well(style, 1)

    def test_goes_where_it_is_put_and_no_faster_than_a_hand(self):
        style = Touch(block_model())
        self.place(style, (0, 0, 0.005))
        self.assertTrue((style.position() == TOP + (0, 0, 0.005)).all())
        style.MoveProbe(*(TOP + (0, 0, 0.1)))
        self.run_well(style, 0.01)
        self.assertLess(np.linalg.norm(style.position() - TOP), 0.05)

    def test_touches_slides_and_lets_go(self):
        style = Touch(block_model())
        self.place(style, (0, 0, 0.005))
        self.assertFalse(style.IsTouching())
        self.place(style, (0, 0, -0.002))
        self.assertTrue(style.IsTouching())
        self.assertFalse(style.IsSliding())
        self.assertLess(np.abs(style.contact_point() - TOP).max(), 1e-9)
        self.assertEqual(style.GetNumberOfContacts(), 1)
        style.MoveProbe(*(TOP + (0.01, 0, -0.002)))
        self.run_well(style, 0.012)  # still under way
        self.assertTrue(style.IsSliding())
        self.place(style, (0.01, 0, 0.005))
        self.assertFalse(style.IsTouching())
        self.assertTrue((style.force() == 0).all())
        self.assertEqual(style.events, ["ContactBeginEvent", "ContactEndEvent"])

    def test_that_adheres_pulls(self):
        style = Touch(block_model())
        self.place(style, (0, 0, 0.005))
        self.place(style, (0, 0, -0.001), adheres=True)
        self.place(style, (0, 0, 0.002), adheres=True)
        self.assertLess(style.force()[2], -0.1)
        self.assertGreater(style.surface()[:, 2].max(), SIZE + 0.0015)
        self.place(style, (0, 0, 0.002), adheres=False)
        self.assertFalse(style.IsTouching())
        self.assertTrue((style.surface() == points_of(block_model())).all())

    def test_is_refused_where_there_is_no_place_or_no_mouse(self):
        style = Touch(block_model())
        for place in ((np.nan, 0, 0), (0, np.inf, 0), (0, 0, -np.inf)):
            self.refuse(style, "three finite numbers", style.MoveProbe, *place)
        style.SetDeviceToSimulated()
        self.refuse(style, "no tool of this scene is moved by the mouse", style.MoveProbe, 0, 0, 0)


class Faults(Touching):
    def test_end_the_force_and_let_it_return_over_a_ramp(self):
        again = path(*PRESS, *PRESS[1:])
        at = round((REST + 0.4) * RATE)  # in the first press
        second = len(path(*PRESS)) + round((REST + 0.3) * RATE)  # the second one is at its depth
        broken = again.copy()
        broken[at] = np.nan
        for fault, fades, style in ((LOST, 1, self.scripted(again, away=range(at, at + 5))),
                                    (INVALID, 10, self.scripted(broken))):
            self.run_well(style, at / RATE)
            self.assertEqual((style.events, style.GetFault()), (["ContactBeginEvent"], ""))
            self.run_well(style, 1 / RATE)
            self.assertEqual(style.GetFault(), fault)
            self.assertEqual(style.events.count("FaultEvent"), 1)
            self.assertIn(fault, style.GetStatus())
            self.assertRegex(style.GetFaultTable(), rf"^tool 0   fault: {fault}, in 1 ticks, first at "
                             rf"{at / RATE:g} s\n$")
            lifted = len(path(*PRESS))
            self.run_well(style, (lifted - at) / RATE)
            # What comes back is inside, which is told as well.
            self.assertEqual(style.events, ["ContactBeginEvent", "FaultEvent", "ContactEndEvent", "FaultEvent"])
            self.assertIn("fault: a tool that was inside the body when its touch began, in 1 ticks",
                          style.GetFaultTable())
            self.run_well(style, (second - lifted) / RATE)
            trace = style.trace()
            self.assertGreater(trace[at - 1, 2], 0.1)
            # A device that is gone gets no force at once, an invalid pose a fading one: 10 ms.
            fading = trace[at - 1:at + fades, 2] / trace[at - 1, 2]
            self.assertLess(np.abs(fading - np.linspace(1, 0, fades + 1)).max(), 1e-12)
            self.assertTrue((trace[at + fades - 1:at + 100] == 0).all())
            self.assertTrue(style.IsTouching())
            self.assertEqual(style.GetFault(), "")
            self.assertAlmostEqual(trace[second, 2] / trace[at - 1, 2], 1, delta=1e-9)
            self.assertEqual(style.events[4:], ["ContactBeginEvent"])

    def test_ramp_the_force_of_one_who_is_pressing_already(self):
        # A device that appears 0.1 s before it touches gets the force little by little.
        trace = self.trace_of(path((0, (0, 0, 1)), (0.1, (0, 0, 1)), (0.1, (0, 0, -2)),
                                   (0.6, (0, 0, -2))))
        force = trace[220:, 2]
        self.assertTrue((np.diff(force) >= -1e-12).all())
        self.assertLess(force[0], 0.5 * force[-1])

    def test_are_the_end_of_a_recording_too(self):
        style = self.scripted(path(*PRESS))
        self.run_well(style, 2)
        self.assertEqual(style.GetFault(), "the end of the recording")
        self.assertEqual(len(style.trace()), len(path(*PRESS)))

    def test_come_with_the_number_of_the_tool(self):
        palpate.write(block_model(), self.folder / "block.vtp")
        positions = path(*PRESS)
        write_recording(self.folder / "a.txt", positions + (0.02, 0, 0))
        write_recording(self.folder / "b.txt", positions - (0.02, 0, 0), away=[1200])
        (self.folder / "scene.json").write_text(json.dumps({
            "models": [{"file": "block.vtp"}],
            "tools": [{"shape": "point", "device": name} for name in "ab"],
            "devices": [{"name": name, "type": "scripted", "file": name + ".txt"} for name in "ab"]}))
        style = Touch()
        self.assertTrue(style.LoadScene(str(self.folder / "scene.json")), style.GetFailureMessage())
        self.run_well(style, 1.201)
        self.assertEqual(style.GetNumberOfTools(), 2)
        self.assertEqual((style.GetFault(0), style.GetFault(1)), ("", LOST))
        self.assertEqual((style.GetFault(2), style.GetFault(-1)), ("", ""))


class Deformation(Touching):
    def displacement(self, mode, radius=0):
        style = self.scripted(path(*PRESS) + (0, 0, radius), radius)
        style.SetDeformation(MODES[mode])
        self.assertEqual(style.GetDeformation(), MODES[mode])
        self.run_well(style, REST + 0.4)
        self.assertTrue(style.IsTouching())
        return style.surface() - points_of(block_model()), style.force()

    def test_of_all_moves_every_free_point_and_no_fixed_one(self):
        for radius in (0, 0.03):
            moved, _ = self.displacement("all", radius)
            fixed = points_of(block_model())[:, 2] == 0
            self.assertTrue((moved[fixed] == 0).all())
            self.assertTrue((np.abs(moved[~fixed]).max(axis=1) > 0).all())
            # The mesh's middle node is where the tool is, as deep as it is; below a ball that rests on the
            # triangles round it, a little deeper.
            self.assertAlmostEqual(moved[:, 2].min(), -0.002 * (1.05 if radius else 1),
                                   delta=1e-4 if radius else 1e-7)

    def test_of_contact_moves_loaded_points_only_and_as_much(self):
        for radius in (0, 0.03):
            everything, force = self.displacement("all", radius)
            some, same = self.displacement("contact", radius)
            touched = np.abs(some).max(axis=1) > 0
            self.assertTrue(0 < touched.sum() < len(some) // 2)
            # Summed in another order: rounding of millimetres.
            self.assertLess(np.abs(some - everything)[touched].max(), 1e-14)
            near = np.linalg.norm(points_of(block_model()) - TOP, axis=1)
            self.assertLess(near[touched].max(), 0.062)  # the mask's radius and a diagonal of the grid
            self.assertTrue((force == same).all())

    def test_of_none_moves_nothing_and_changes_no_force(self):
        moved, force = self.displacement("none")
        self.assertTrue((moved == 0).all())
        self.assertTrue((force == self.displacement("all")[1]).all())

    def test_modes_that_there_are_not_are_refused(self):
        style = Touch(block_model())
        self.assertTrue(style.SetDeformation(2))
        for mode in (-3, 4, 99):
            self.refuse(style, f"the deformation must be from 0 (all) to 3 (none), not {mode}",
                        style.SetDeformation, mode)
            self.assertEqual(style.GetDeformation(), 2)


if __name__ == "__main__":
    unittest.main()
