# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The style that touches in hostile hands: without model or interactor, with NaN, changed while it drags, runs or
announces, several at once, from several threads. It refuses or does nothing; it never crashes."""

import gc
import os
import threading
import time
import unittest

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkRenderingCore import vtkRenderWindow, vtkRenderWindowInteractor

from support.touch import TOP, Touch, block_model
from support.window import TouchWindow, ensure_display

HANDLERS = ("OnTimer", "OnMouseMove", "OnLeftButtonDown", "OnLeftButtonUp", "OnRightButtonDown", "OnRightButtonUp",
            "OnMouseWheelForward", "OnMouseWheelBackward", "OnChar")
NAN = float("nan")


def call_handlers(style):
    for name in HANDLERS:
        getattr(style, name)()


class Hostile(unittest.TestCase):
    def refuse(self, sentence, style, method, *arguments):
        self.assertFalse(getattr(style, method)(*arguments), method)
        self.assertIn(sentence, style.GetFailureMessage())


class Alone(Hostile):
    def test_without_a_model_it_says_so(self):
        style = Touch()
        for call in (("Start",), ("RunHeadless", 1), ("MoveProbe", 0, 0, 0)):
            self.refuse("there is no model to touch", style, *call)
        self.assertEqual(style.GetEvaluationPlan(), "")
        self.assertIn("no model", style.GetFailureMessage())
        self.assertTrue(style.Stop())
        style.Update()
        self.assertEqual((style.GetStatus(), style.GetTimingTable(), style.GetFault()), ("", "", ""))
        self.assertEqual((style.GetTouchedModel(), style.GetDeformedSurface(), style.IsRunning()),
                         (None, None, False))
        self.assertEqual((len(style.trace()), style.GetNumberOfTicks(), style.force().tolist()), (0, 0, [0, 0, 0]))

    def test_nothing_is_a_sentence(self):
        style = Touch()
        self.refuse("there is no model", style, "SetModel", None)
        self.refuse("the scene '' cannot be opened", style, "LoadScene", None)
        self.assertFalse(style.SetModel(vtkPolyData()))
        self.assertNotEqual(style.GetFailureMessage(), "")
        style.GetForceTrace(None)
        style.SetInteractor(None)
        style.SetModel(block_model())
        style.SetDeviceToScript(None)
        self.refuse("the recording '' cannot be opened", style, "Start")

    def test_tools_that_are_not_there_have_no_state(self):
        style = Touch(block_model())
        style.RunHeadless(0.01)
        for tool in (-1, 1, 2**31 - 1):
            self.assertEqual((style.IsTouching(tool), style.IsSliding(tool), style.GetFault(tool)), (False, False, ""))
            self.assertEqual((style.force(tool).tolist(), style.rendered(tool).tolist()), ([0] * 3, [0] * 3))
            self.assertIsNone(style.GetDeformedSurface(-1 if tool < 0 else tool))

    def test_without_an_interactor_events_do_nothing(self):
        for style in (Touch(), Touch(block_model())):
            style.RunHeadless(0)
            call_handlers(style)

    def test_numbers_that_are_none_change_nothing(self):
        style = Touch(block_model())
        self.refuse("must be a number", style, "SetPressDepth", NAN)
        self.refuse("must be a number", style, "SetFrameRate", NAN)
        self.assertEqual((style.GetPressDepth(), style.GetFrameRate()), (0.02, 60))
        for value, kept in ((-1, (0, 1)), (np.inf, (1, 240))):
            self.assertTrue(style.SetPressDepth(value) and style.SetFrameRate(value))
            self.assertEqual((style.GetPressDepth(), style.GetFrameRate()), kept)
        for place in ((NAN, 0, 0), (0, np.inf, 0)):
            self.refuse("must be three finite numbers", style, "MoveProbe", *place)
        for numbers in ((-1, 0), (0, 1 << 16)):
            self.refuse("from 0 to 65535", style, "SetDeviceToHid", *numbers)
        self.assertTrue(style.MoveProbe(1e300, 0, 0) and style.RunHeadless(0.1))
        self.assertEqual(style.force().tolist(), [0, 0, 0])


class Busy(Hostile):
    def test_is_deleted_while_it_runs(self):
        for _ in range(5):
            style = Touch(block_model())
            self.assertTrue(style.Start())
            del style
            gc.collect()

    def test_keeps_its_model_when_the_callers_is_emptied(self):
        model = vtkPolyData()
        model.DeepCopy(block_model())
        style = Touch(model)
        self.assertTrue(style.Start())
        model.Initialize()
        style.Update()
        self.assertTrue(style.Stop() and style.Start() and style.SetMaskRadius(0.03))
        self.assertTrue(style.Stop())

    def test_observers_may_change_the_scene(self):
        for change in (lambda style: style.SetModel(block_model()), lambda style: style.SetToolToSphere(0.01),
                       lambda style: style.RunHeadless(0.1), lambda style: style.Start()):
            style = Touch(block_model())
            style.AddObserver(int(style.ContactBeginEvent), lambda caller, _, change=change: change(caller))
            self.assertTrue(style.MoveProbe(*(TOP + (0, 0, 0.01))) and style.RunHeadless(0.5))
            self.assertTrue(style.MoveProbe(*(TOP - (0, 0, 0.002))) and style.RunHeadless(0.5))
            self.assertIn("ContactBeginEvent", style.events)
            self.assertTrue(style.Stop() and style.RunHeadless(0.1))

    def test_two_touch_one_model(self):
        styles = [Touch(block_model()) for _ in range(2)]
        self.assertTrue(all(style.Start() and style.Start() for style in styles))
        self.assertTrue(styles[0].Stop() and styles[0].Stop())
        self.assertEqual([style.IsRunning() for style in styles], [False, True])
        self.refuse("runs already", styles[1], "RunHeadless", 1)

    def test_is_called_from_several_threads(self):
        style = Touch(block_model())
        end = time.time() + 1

        def work(number):
            while time.time() < end:
                style.Start()
                style.MoveProbe(*(TOP - (0, 0, 1e-3 * number)))
                style.SetFriction(0.1 * number)
                style.SetMaskRadius(0.01 * number)
                style.Update()
                style.force()
                if number == 3:
                    style.Stop()
                    style.SetModel(block_model())

        threads = [threading.Thread(target=work, args=(number,)) for number in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertTrue(style.Stop())


@unittest.skipUnless(os.environ.get("DISPLAY"), "there is no display, and no xvfb-run")
class Windowed(Hostile):
    def test_without_a_window_or_a_renderer_events_do_nothing(self):
        style, interactor = Touch(block_model()), vtkRenderWindowInteractor()
        interactor.SetInteractorStyle(style)
        for window in (None, vtkRenderWindow()):
            if window:
                window.SetOffScreenRendering(1)
                interactor.SetRenderWindow(window)
            self.assertTrue(style.Start())
            for key in "rvwn[+":
                interactor.SetKeyCode(key)
                call_handlers(style)
            self.assertTrue(style.Stop())
        other = Touch(block_model())
        interactor.SetInteractorStyle(other)
        self.assertTrue(other.Start() and style.Start())
        interactor.SetInteractorStyle(None)
        for left in (style, other):
            call_handlers(left)
            left.Update()

    def test_a_drag_outlives_its_model_its_mouse_and_its_window(self):
        for change in (lambda style: style.SetModel(block_model()), lambda style: style.SetDeviceToSimulated(),
                       lambda style: style.SetToolToSphere(0.01), lambda style: style.SetInteractor(None)):
            style = Touch(block_model())
            window = TouchWindow(style)
            self.addCleanup(window.close)
            window.event("LeftButtonPressEvent", TOP)
            change(style)
            for name in ("OnMouseMove", "OnMouseWheelForward", "OnTimer", "OnLeftButtonUp", "OnMouseMove"):
                getattr(style, name)()
            self.assertTrue(style.RunHeadless(0.1))


if __name__ == "__main__":
    ensure_display()
    unittest.main()
