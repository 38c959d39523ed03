# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The style that touches, in a window: mouse, keys, servo thread.

Without a display it starts one of its own.
"""

import gc
import time
import unittest

import numpy as np
from vtkmodules.vtkRenderingCore import vtkInteractorEventRecorder

from support.surfaces import points_of
from support.touch import MODES, PRESS, SIZE, TOP, Touch, block_model, path, write_recording
from support.window import Windowed, ensure_display

DIAGONAL = 3**0.5 * SIZE
PIXEL = 1e-3  # m, more than a pixel of the window covers


class Mouse(Windowed):
    def test_press_touches_where_the_pointer_is(self):
        for radius in (0, 0.02):
            style, window = self.open(radius)
            for place in (TOP, TOP + (0.02, 0.01, 0)):
                self.do(window, "LeftButtonPressEvent", place)
                self.assertTrue(style.IsTouching(), place)
                self.assertGreater(style.force()[2], 0.01)
                self.assertLess(np.linalg.norm(style.contact_point() - place),
                                PIXEL if radius == 0 else SIZE / 6)  # a ball touches at nodes
                pressed = style.position() - (place + (0, 0, radius))
                self.assertLess(np.linalg.norm(pressed - 0.02 * DIAGONAL * window.towards()), PIXEL)
                self.do(window, "LeftButtonReleaseEvent")
                self.assertFalse(style.IsTouching())
                self.assertTrue((style.force() == 0).all())
            self.assertEqual(style.events, ["ContactBeginEvent", "ContactEndEvent"] * 2)
            self.assertEqual(style.errors, [])

    def test_press_on_another_side_has_nothing_to_do_with_the_one_before(self):
        style, window = self.open()
        self.do(window, "LeftButtonPressEvent", TOP)
        self.do(window, "LeftButtonReleaseEvent")
        front = np.array([0.05, 0, 0.05])
        window.look((0, -0.4, 0.1), at=front)
        self.do(window, "LeftButtonPressEvent", front)
        self.assertTrue(style.IsTouching())
        self.assertLess(np.linalg.norm(style.contact_point() - front), PIXEL)
        self.assertLess(style.force()[1], -0.1)
        self.do(window, "LeftButtonReleaseEvent")
        self.assertFalse(style.IsTouching())

    def test_press_depth_is_in_diagonals_of_the_body(self):
        style, window = self.open()
        forces = []
        for depth in (0.01, 0.02):
            style.SetPressDepth(depth)
            self.do(window, "LeftButtonPressEvent", TOP)
            forces.append(style.force()[2])
            self.do(window, "LeftButtonReleaseEvent")
        self.assertAlmostEqual(forces[1] / forces[0], 2, delta=0.01)  # pixels' whole numbers

    def test_wheel_presses_deeper_and_out_again(self):
        style, window = self.open()
        self.do(window, "LeftButtonPressEvent", TOP)
        before, place = style.force(), style.position()
        self.do(window, "MouseWheelForwardEvent")
        self.assertGreater(style.force()[2], 1.1 * before[2])
        self.assertLess(np.abs(style.position() - place - 0.004 * DIAGONAL * window.towards()).max(),
                        1e-9)
        self.do(window, "MouseWheelBackwardEvent")
        self.assertLess(np.abs(style.position() - place).max(), 1e-9)
        for _ in range(6):
            self.do(window, "MouseWheelBackwardEvent")
        self.assertFalse(style.IsTouching())

    def test_wheel_without_a_press_moves_the_camera(self):
        style, window = self.open()
        before = np.array(window.renderer.GetActiveCamera().GetPosition())
        self.do(window, "MouseWheelForwardEvent", TOP)
        after = np.array(window.renderer.GetActiveCamera().GetPosition())
        self.assertLess(np.linalg.norm(after - TOP), np.linalg.norm(before - TOP))
        self.assertFalse(style.IsTouching())

    def test_drag_moves_the_probe_in_the_plane_of_the_view(self):
        style, window = self.open()
        self.do(window, "LeftButtonPressEvent", TOP)
        place = style.position()
        x, y = window.pixel(TOP)
        self.do(window, "MouseMoveEvent", (x + 30, y))
        moved = style.position() - place
        self.assertGreater(moved[0], 0.005)
        self.assertLess(abs(moved @ window.towards()), 1e-6)
        self.assertLess(style.force()[0], 0)
        self.assertTrue(style.IsTouching())

    def test_press_with_control_adheres_and_pulls(self):
        style, window = self.open(seen_from=(0, -0.001, 0.4))
        self.do(window, "LeftButtonPressEvent", TOP, control=True)
        for _ in range(8):
            self.do(window, "MouseWheelBackwardEvent", control=True)
        self.assertTrue(style.IsTouching())
        self.assertLess(style.force()[2], -0.1)
        self.assertGreater(style.surface()[:, 2].max(), SIZE + 1e-3)
        self.do(window, "LeftButtonReleaseEvent")
        self.assertFalse(style.IsTouching())

    def test_beside_the_surface_or_with_the_right_button_turns_the_camera(self):
        for press, release, begin in (
                ("RightButtonPressEvent", "RightButtonReleaseEvent", TOP),
                ("LeftButtonPressEvent", "LeftButtonReleaseEvent", (5, 5))):
            style, window = self.open()
            camera = window.renderer.GetActiveCamera()
            before, focus = np.array(camera.GetPosition()), np.array(camera.GetFocalPoint())
            self.do(window, press, begin)
            x, y = window.interactor.GetEventPosition()
            self.do(window, "MouseMoveEvent", (x + 40, y + 15))
            self.do(window, release)
            turned = np.array(camera.GetPosition())
            self.assertGreater(np.linalg.norm(turned - before), 0.01)
            self.assertLess(np.abs(np.array(camera.GetFocalPoint()) - focus).max(), 1e-12)
            self.do(window, "MouseMoveEvent", (x + 80, y + 30))  # the button is up
            self.assertTrue((np.array(camera.GetPosition()) == turned).all())
            self.assertEqual(style.events, [])

    def test_leaves_the_surface_to_another_device(self):
        style, window = self.open()
        style.SetDeviceToScript(str(write_recording(self.folder / "rest.txt", path(*PRESS))))
        style.RunHeadless(0)
        self.do(window, "LeftButtonPressEvent", TOP, seconds=0.01)
        self.do(window, "LeftButtonReleaseEvent", seconds=0.01)
        self.assertEqual((style.events, style.errors), ([], []))


class Keys(Windowed):
    def test_change_what_the_header_says(self):
        style, window = self.open()
        body = window.renderer.GetActors().GetItemAsObject(0)
        state = {"friction": style.GetFriction, "mask": style.GetMaskRadius,
                 "stiffness": style.GetStiffnessScale,
                 "wireframe": lambda: body.GetProperty().GetRepresentation() == 1,
                 "colours": lambda: bool(body.GetMapper().GetScalarVisibility())}
        for key, name, wanted in (
                ("]", "friction", 0.35), ("[", "friction", 0.3),
                (".", "mask", 1.25 * style.GetMaskRadius()), (",", "mask", style.GetMaskRadius()),
                ("+", "stiffness", 1.25), ("-", "stiffness", 1), ("=", "stiffness", 1.25),
                ("w", "wireframe", True), ("s", "wireframe", False), ("v", "colours", True),
                ("v", "colours", False)):
            before = {each: value() for each, value in state.items()}
            window.key(key)
            self.assertAlmostEqual(state[name](), wanted, delta=1e-12, msg=key)
            for other in set(state) - {name}:
                self.assertEqual(state[other](), before[other], key)
        self.assertEqual(style.errors, [])

    def test_end_friction_at_none(self):
        style, window = self.open()
        style.SetFriction(0.12)
        for _ in range(4):
            window.key("[")
        self.assertEqual((style.GetFriction(), style.errors), (0, []))

    def test_take_effect_on_the_force(self):
        style, window = self.open()
        style.MoveProbe(*(TOP + (0, 0, 0.005)))
        style.RunHeadless(1)
        style.MoveProbe(*(TOP - (0, 0, 0.002)))
        style.RunHeadless(0.3)
        before = style.force()[2]
        window.key("+")
        style.RunHeadless(0.3)
        self.assertAlmostEqual(style.force()[2] / before, 1.25, delta=1e-9)
        window.key(".")  # a wider mask is stiffer
        style.RunHeadless(0.3)
        self.assertGreater(style.force()[2] / before, 1.3)

    def test_begin_contact_anew(self):
        for key in "nr":
            style, window = self.open()
            for offset in ((0, 0, 0.005), (0, 0, -0.002)):
                style.MoveProbe(*(TOP + offset))
                style.RunHeadless(1)
            self.assertTrue(style.IsTouching())
            self.assertNotIn("inside the body", style.GetFaultTable())
            camera = window.renderer.GetActiveCamera()
            before = camera.GetPosition()
            window.key(key)
            style.RunHeadless(0.1)
            # It is inside, of which is told, and touches the nearest place; from outside it touches as ever.
            self.assertIn("inside the body when its touch began", style.GetFaultTable())
            self.assertEqual(camera.GetPosition() != before, key == "r")
            for offset in ((0, 0, 0.005), (0, 0, -0.002)):
                style.MoveProbe(*(TOP + offset))
                style.RunHeadless(1)
            self.assertTrue(style.IsTouching())

    def test_without_a_renderer_do_no_harm(self):
        style, window = self.open()
        window.window.RemoveRenderer(window.renderer)
        for key in "[],.-+wsvnr":
            window.key(key)
        self.assertEqual(style.errors, [])


class Deformation(Windowed):
    def test_of_visible_moves_what_faces_the_camera_and_as_much(self):
        surfaces = {}
        for mode in ("all", "visible"):
            style, window = self.open(seen_from=(0, -0.01, 0.4))
            style.SetDeformation(MODES[mode])
            for offset in ((0, 0, 0.005), (0, 0, -0.002)):
                style.MoveProbe(*(TOP + offset))
                self.assertTrue(style.RunHeadless(1))
            surfaces[mode] = style.surface() - points_of(block_model())
        moved = np.abs(surfaces["visible"]).max(axis=1) > 0
        top = points_of(block_model())[:, 2] == SIZE
        self.assertTrue(moved[top].all())
        self.assertTrue((~moved).sum() > points_of(block_model()).shape[0] // 6)
        self.assertLess(np.abs(surfaces["visible"] - surfaces["all"])[moved].max(), 1e-14)


class ServoThread(Windowed):
    def test_runs_until_it_is_stopped_and_counts_what_it_misses(self):
        style, window = self.open()
        window.interactor.Initialize()
        self.assertFalse(style.IsRunning())
        self.assertTrue(style.Start(), style.GetFailureMessage())
        self.assertTrue(style.IsRunning())
        self.assertTrue(style.Start())  # it does already
        window.run(0.5)

        def count():
            return np.array([time.monotonic(), style.GetNumberOfTicks(), style.GetNumberOfMissedTicks()])

        before = count()
        window.run(1.5)
        passed, ticks, missed = count() - before
        self.assertGreater(ticks, 0)
        self.assertGreaterEqual(missed, 0)
        # Of those that are late, some may not have been counted at either end.
        self.assertAlmostEqual((ticks + missed) / (1000 * passed), 1, delta=0.15)
        self.assertFalse(style.RunHeadless(0.1))
        self.assertIn("runs already", style.GetFailureMessage())
        self.assertTrue(style.Stop())
        self.assertFalse(style.IsRunning())
        stopped = style.GetNumberOfTicks()
        window.run(0.1)
        self.assertEqual(style.GetNumberOfTicks(), stopped)
        self.assertIn("lateness", style.GetTimingTable())

    def test_takes_settings_at_once_and_stops_for_another_scene(self):
        style, window = self.open()
        self.assertTrue(style.Start())
        for change in (lambda: style.SetFriction(0.5), lambda: style.SetStiffnessScale(2),
                       lambda: style.SetMaskRadius(0.05), lambda: style.SetRigidStiffness(100)):
            self.assertTrue(change())
            self.assertTrue(style.IsRunning())
        for change in (lambda: style.SetModel(block_model()), lambda: style.SetToolToSphere(0.02),
                       style.SetToolToPoint, lambda: style.SetServoRate(500),
                       lambda: style.SetDeviceToMouse()):
            self.assertTrue(style.Start(), style.GetFailureMessage())
            self.assertTrue(change())
            self.assertFalse(style.IsRunning())

    def test_ends_with_the_style(self):
        style = Touch(block_model())
        style.Start()
        self.assertTrue(style.IsRunning())
        gone = []
        style.AddObserver("DeleteEvent", lambda *_: gone.append(True))
        del style
        gc.collect()  # its observers know it
        self.assertEqual(gone, [True])

    def test_records_what_it_did(self):
        style, window = self.open()
        self.assertTrue(style.SetRecordFileName(str(self.folder / "recorded.txt")))
        self.assertTrue(style.Start())
        while style.GetNumberOfTicks() < 100:
            time.sleep(0.01)
        self.assertTrue(style.Stop(), style.GetFailureMessage())
        again = Touch(block_model())
        again.SetDeviceToScript(str(self.folder / "recorded.txt"))
        self.assertTrue(again.RunHeadless(0.1), again.GetFailureMessage())
        self.assertEqual(len(again.trace()), 100)


class Events(Windowed):
    def test_that_are_recorded_play_the_same_touch(self):
        style, window = self.open()
        x, y = window.pixel(TOP)
        drag = [("MouseMoveEvent", (x + 6 * step, y - 2 * step)) for step in range(1, 6)]
        by_hand = [("LeftButtonPressEvent", (x, y)), *drag, ("MouseWheelForwardEvent", None),
                   ("LeftButtonReleaseEvent", None), ("LeftButtonPressEvent", (x - 40, y)),
                   ("LeftButtonReleaseEvent", None)]
        file = self.folder / "events.log"
        recorder = vtkInteractorEventRecorder()
        recorder.SetFileName(str(file))
        recorder.SetInteractor(window.interactor)
        recorder.On()
        recorder.Record()
        forces = []
        for event, place in by_hand:
            self.do(window, event, place)
            forces.append(tuple(style.force()))
        recorder.Stop()
        recorder.Off()
        del recorder  # or the file would not be whole
        self.assertEqual(style.events, ["ContactBeginEvent", "ContactEndEvent"] * 2)
        again, window = self.open()
        lines = [line for line in file.read_text().splitlines() if not line.startswith("#")]
        played = []
        for line in lines:  # one by one, for time to pass between them
            player = vtkInteractorEventRecorder()
            player.ReadFromInputStringOn()
            player.SetInputString("# StreamVersion 1.1\n" + line + "\n")
            player.SetInteractor(window.interactor)
            player.Play()
            player.SetInteractor(None)
            if line.split()[0] in dict(by_hand):
                self.assertTrue(again.RunHeadless(0.3))
                played.append(tuple(again.force()))
        self.assertEqual(again.events, style.events)
        self.assertEqual(played, forces)


if __name__ == "__main__":
    ensure_display()
    unittest.main()
