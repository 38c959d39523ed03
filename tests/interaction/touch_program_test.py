# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`palpate touch`, `palpate grasp` and `palpate devices`: what they print and write."""

import json
import re
import unittest
from pathlib import Path

import numpy as np

from support.touch import PRESS, RATE, REST, SIZE, STROKE, TOP, Touch, block_model, path, write_recording
from support.touch_program import WITHOUT_DISPLAY, Program
from support.window import read_picture


DATA = Path(__file__).resolve().parents[2] / "data"


class Headless(Program):
    def test_forces_are_the_same_twice_byte_for_byte_and_those_of_the_style(self):
        files = [self.folder / name for name in ("a.csv", "b.csv")]
        for file in files:
            self.run_well(*self.scripted(STROKE), "--seconds", 2, "--forces", file)
        self.assertEqual(files[0].read_bytes(), files[1].read_bytes())
        self.assertEqual(files[0].read_text().splitlines()[0],
                         "force_x,force_y,force_z,torque_x,torque_y,torque_z")
        forces = np.loadtxt(files[0], delimiter=",", skiprows=1)
        style = Touch(block_model())
        style.SetDeviceToScript(str(self.folder / "motion.txt"))
        self.assertTrue(style.RunHeadless(2))
        self.assertEqual(forces.tobytes(), style.trace().tobytes())
        self.assertGreater(forces[:, 2].max(), 0.1)

    def test_options_are_those_of_the_style(self):
        printed = self.run_well(*self.scripted(PRESS), "--seconds", REST + 0.4, "--friction", 0.7,
                                "--radius", 0.05, "--mask", "hertzian", "--rate", 1000, "--rigid-stiffness", 100,
                                "--deformation", "contact")
        self.assertIn("mu 0.7", printed)
        self.assertIn("mask 50 mm", printed)
        self.assertIn("sticks", printed)
        self.assertIn("at 0.05 0.05 0.1", printed)
        self.assertIn(f"ticks    {round((REST + 0.4) * RATE)}, 0 left out", printed)

    def test_the_status_line_tells_what_is_rendered_where_that_is_less(self):
        pressed = self.scripted(PRESS, limits="0.05 0 0")
        status = self.run_well(*pressed, "--seconds", REST + 0.4).splitlines()[0]
        self.assertRegex(status, r"N sticks \(rendered 50 mN, limited or faded for safety\)")
        whole = self.run_well(*self.scripted(PRESS), "--seconds", REST + 0.4).splitlines()[0]
        self.assertNotIn("rendered", whole)

    def test_a_rigid_stiffness_bounds_the_frobenius_norm_of_what_a_point_shows(self):
        pressed = (*self.scripted(PRESS), "--seconds", REST + 0.4)
        for rigid in (5, 20):
            printed = self.run_well(*pressed, "--rigid-stiffness", rigid)
            shown = float(re.search(r"tool 0   force \S+ \S+ (\S+) N", printed)[1]) / 0.002
            # Along the normal, in which it is stiffest, no less than were it alike in all directions.
            self.assertTrue(rigid < shown < 3**0.5 * rigid, shown)

    def test_no_point_is_stiffer_than_its_device_renders_stably(self):
        def shown(stiffness, *options):
            ran = self.start(*self.scripted(PRESS, limits=f"3.3 0.1 {stiffness}"), "--seconds", REST + 0.4, *options)
            self.assertEqual(ran.returncode, 0, ran.stderr)
            return float(re.search(r"tool 0   force \S+ \S+ (\S+) N", ran.stdout)[1]) / 0.002, ran.stderr
        own, silent = shown(0)
        self.assertEqual((own, silent), shown(1e4))
        self.assertEqual(silent, "")
        soft, told = shown(own / 4)
        self.assertTrue(own / 4 / 3**0.5 < soft <= own / 4, (own, soft))
        limit = float(re.search(r"warning: the model's stiffness, up to \S+ N/m, is limited to the (\S+) N/m "
                                "that the device states to render stably", told)[1])
        self.assertAlmostEqual(limit, own / 4, delta=1e-3 * own)
        self.assertEqual(soft, shown(own / 4, "--rigid-stiffness", 1e6)[0])
        ball = ("--tool-radius", 0.02)
        self.assertEqual(shown(1e4, *ball)[1], "")
        whole = shown(0, *ball)[0]
        held, told = shown(1, *ball)
        tool, factor = re.search(r"the tools' stiffness on the model, up to (\S+) N/m where they are \S+ m deep, is "
                                 r"limited to the 1 N/m that the device states to render stably: all forces are (\S+) "
                                 "times the model's", told).groups()
        self.assertAlmostEqual(float(tool) * float(factor), 1, delta=0.01)
        self.assertAlmostEqual(held / whole, float(factor), delta=0.01 * float(factor) + 1e-3 / whole)

    def test_contacts_that_there_is_no_room_for_are_told_and_the_rest_is_rendered(self):
        ball = (*self.scripted(PRESS), "--seconds", REST + 0.4, "--tool-radius", 0.02)
        plenty, few = self.run_well(*ball), self.run_well(*ball, "--contacts", 2)
        self.assertNotIn("left out:", plenty)
        self.assertIn("(contacts left out: more than there is room for)", few)
        self.assertRegex(few, r"\d+ with contacts left out, whose force is too small: raise --contacts")
        for printed in (plenty, few):
            self.assertNotIn("too late", printed)
            self.assertGreater(float(re.search(r"tool 0   force \S+ \S+ (\S+) N", printed)[1]), 0.1)

    def test_records_the_motion_that_it_replays(self):
        first, again = self.folder / "first.csv", self.folder / "again.csv"
        copy = self.folder / "copy.txt"
        self.run_well(*self.scripted(PRESS), "--seconds", 1.7, "--forces", first, "--record", copy)
        self.run_well("touch", self.model, "--device", f"scripted:{copy}", "--headless", "--seconds",
                      1.7, "--forces", again)
        self.assertEqual(first.read_bytes(), again.read_bytes())

    def test_a_recording_replays_under_the_mapping_of_its_scene(self):
        write_recording(self.folder / "motion.txt", path(*PRESS))
        scene, recording = self.folder / "scene.json", self.folder / "recording.txt"
        scene.write_text(json.dumps({
            "models": [{"file": str(self.model)}], "tools": [{"shape": "point", "device": "hand"}],
            "devices": [{"name": "hand", "type": "scripted", "file": "motion.txt",
                         "mapping": {"origin": [0, 0, -0.001]}}]}))
        forces = []
        for arguments in (("--record", recording), ("--device", f"scripted:{recording}")):
            file = self.folder / f"{len(forces)}.csv"
            self.run_well("touch", "--scene", scene, "--headless", "--seconds", 1.7, "--forces", file,
                          *arguments)
            forces.append(np.loadtxt(file, delimiter=",", skiprows=1))
        self.assertGreater(forces[0][:, 2].max(), 0.1)
        self.assertTrue((forces[0] == forces[1]).all())

    def test_a_device_that_can_render_no_force_is_told(self):
        for limits, told in (("0 0 0", True), ("3.3 0 0", False)):
            printed = self.run_well(*self.scripted(PRESS, limits=limits), "--seconds", REST + 0.4)
            self.assertIn("sticks", printed)
            self.assertEqual("not rendered: its device's limits allow no force" in printed, told)
            self.assertEqual("rendered 0 0 0 N, limited or faded for safety" in printed, told)

    def test_a_simulated_hand_presses_and_lifts(self):
        simulated = ("touch", self.model, "--device", "simulated", "--headless", "--seconds")
        for tool in ((), ("--tool-radius", 0.02)):
            self.assertRegex(self.run_well(*simulated, 1, *tool).splitlines()[0], r" s(tick|lide)s ")
            self.assertIn(" 0 N free", self.run_well(*simulated, 2, *tool))

    def test_faults_are_told_at_the_end_with_their_first_time(self):
        script = path(*PRESS)
        script[900:903] = np.nan
        file = write_recording(self.folder / "broken.txt", script, away=(1200, 1300))
        printed = self.run_well("touch", self.model, "--device", f"scripted:{file}", "--headless",
                                "--seconds", len(script) / RATE)
        self.assertIn("tool 0   fault: a pose that is not finite, out of reach or no rotation, in 3 ticks, "
                      "first at 0.9 s\ntool 0   fault: the device is not there, in 2 ticks, first at 1.2 s\n",
                      printed)
        self.assertNotIn("fault", self.run_well(*self.scripted(PRESS), "--seconds", 1))

    def test_a_point_that_starts_inside_is_told_and_comes_to_bear_its_force(self):
        inside = ((0, (0, 0, -2)), (2.5, (0, 0, -2)))
        printed, pressed = (self.run_well(*self.scripted(script), "--seconds", seconds)
                            for script, seconds in ((inside, 2.5), (PRESS, REST + 0.4)))
        self.assertIn("tool 0   fault: a tool that was inside the body when its touch began, in 1 ticks, "
                      "first at 0 s\n", printed)
        self.assertNotIn("fault", pressed)
        force, expected = (float(re.search(r"tool 0   force \S+ \S+ (\S+) N", text)[1])
                           for text in (printed, pressed))
        self.assertAlmostEqual(force, expected, delta=0.01 * expected)
        self.assertNotIn("rendered", printed)

    def test_forces_between_bodies_are_told_and_torques_where_they_are_computed(self):
        scene, depth = self.folder / "scene.json", 0.002
        described = {
            "models": [{"file": str(self.model)},
                       {"file": str(self.model), "position": [0, SIZE, 2 * SIZE - depth],
                        "orientation": {"axis": [1, 0, 0], "angle": np.pi}}],
            "tools": [{"shape": "sphere", "radius": 0.02, "device": "m"}],
            "devices": [{"name": "m", "type": "simulated"}]}
        for torque in (False, True):
            scene.write_text(json.dumps({**described, "effects": {"elastic_elastic": True, "torque": torque}}))
            ran = self.start("touch", "--scene", scene, "--headless", "--seconds", 0.1)
            self.assertEqual(ran.returncode, 0, ran.stderr)
            self.assertRegex(ran.stderr, r"^palpate: warning: the scene's model 1 overlaps the first by "
                                         r"0\.002 m: .*\n$")
            printed = ran.stdout
            self.assertEqual(torque, "torque" in printed, printed)
            found = re.search(r"(?m)^body 1   force (\S+) (\S+) (\S+) N, of body 0$", printed)
            self.assertTrue(found, printed)
            # As two bars of E = 10 kPa in a row, each half the depth shorter; their feet hold them in
            # breadth, and a mesh of six squares yields a little more at the rims.
            bars = 1e4 * SIZE * depth / 2
            self.assertAlmostEqual(float(found[3]), bars, delta=0.1 * bars)

    def test_a_margin_far_beyond_the_edges_is_told(self):
        scene = self.folder / "scene.json"
        for margin, told in ((0.01, False), (0.05, True)):
            scene.write_text(json.dumps({
                "models": [{"file": str(self.model)}], "solver": {"margin": margin},
                "tools": [{"shape": "sphere", "radius": 0.02, "device": "m"}],
                "devices": [{"name": "m", "type": "simulated"}]}))
            ran = self.start("touch", "--scene", scene, "--headless", "--seconds", 0.1)
            self.assertEqual(ran.returncode, 0, ran.stderr)
            self.assertEqual(told, "warning: solver.margin, 0.05 m, is much wider than" in ran.stderr, ran.stderr)

    def test_the_mouse_moves_nothing_without_a_window_and_that_is_told(self):
        told = "nothing moved the mouse's tool, which needs a window: --device simulated presses and lifts"
        scene = self.folder / "scene.json"
        scene.write_text(json.dumps({
            "models": [{"file": str(self.model)}], "tools": [{"shape": "point", "device": "m"}],
            "devices": [{"name": "m", "type": "mouse"}]}))
        run = ("--headless", "--seconds", 0.1)
        for of_mouse in (("touch", self.model), ("touch", "--scene", scene)):
            self.assertIn(told, self.run_well(*of_mouse, *run))
            self.assertNotIn(told, self.run_well(*of_mouse, *run, "--device", "simulated"))
            self.assertNotIn(told, self.run_well(*of_mouse, "--plan"))

    def test_probes_of_a_scene_are_told_with_their_displacements(self):
        write_recording(self.folder / "press.txt", path(*PRESS))
        scene = self.folder / "scene.json"
        scene.write_text(json.dumps({
            "models": [{"file": str(self.model)}], "tools": [{"shape": "point", "device": "m"}],
            "devices": [{"name": "m", "type": "scripted", "file": "press.txt"}],
            "effects": {"masks": {"radius_edges": 2}, "probes": [
                {"name": "the top", "position": list(TOP)}, {"name": "foot", "node": 0}]}}))
        printed = self.run_well("touch", "--scene", scene, "--headless", "--seconds", REST + 0.4)
        found = re.search(r"(?m)^probe the top   displacement (\S+) (\S+) (\S+) m$", printed)
        self.assertTrue(found, printed)
        self.assertLess(float(found[3]), -0.001)
        self.assertIn("probe foot   displacement 0 0 0 m\n", printed)

    def test_pictures_need_no_display_and_show_the_press(self):
        for name, seconds in (("before.png", 0.1), ("pressed.png", REST + 0.4)):
            self.run_well(*self.scripted(PRESS), "--seconds", seconds, "--image", self.folder / name)
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()),
                         ["before.png", "motion.txt", "pressed.png"])
        before, pressed = (read_picture(self.folder / n) for n in ("before.png", "pressed.png"))
        self.assertEqual(before.shape, (750, 1000, 3))
        self.assertGreater(np.abs(before - pressed).mean(), 0.4)

    def test_plan_is_printed_without_a_display_or_a_device(self):
        plan = self.run_well("touch", self.model, "--plan")
        for line in ("nodes under forces", "a tick, 1 k a second", "a frame", "memory"):
            self.assertIn(line, plan)
        ball = ("touch", self.model, "--plan", "--tool-radius", 0.02)
        self.assertIn("watched", self.run_well(*ball))
        self.assertNotEqual(self.run_well(*ball), self.run_well(*ball, "--contacts", 9))


class Lab(Program):
    def test_finds_the_colgate_bound_where_the_press_sticks(self):
        plot = self.folder / "zwidth.png"
        printed = self.run_well("touch", self.model, "--lab", "--at", 0.05, 0.05, 0.1, "--rates", 500,
                                1000, "--dampings", 0.5, 2, "--delays", 0, 1, "--image", plot)
        lines = printed.splitlines()
        self.assertIn("pressed at 0.05 0.05 0.1", lines[0])
        table = np.array([[float(x) for x in line.split()] for line in lines[2:]])
        self.assertEqual(table.shape, (8, 5))
        rate, damping, delay, stable, bound = table.T
        # b > K T / 2 + K T d
        self.assertLess(np.abs(bound * (0.5 + delay) / rate / damping - 1).max(), 1e-3)
        self.assertLess(np.abs(stable / bound - 1).max(), 0.05)
        picture = read_picture(plot)
        self.assertGreater(picture.std(), 10)  # curves on paper

    def test_refuses_what_it_cannot_press(self):
        lab = ("touch", self.model, "--lab")
        for rate in (0, 1e9, "nan"):
            self.run_badly("--rates: must be a number from 10 to 100000", *lab, "--rates", rate)
        for depth in (-1, 0, "nan"):
            self.run_badly("--depth: must be a positive number", *lab, "--depth", depth)
        self.run_badly("--dampings: must be a number from 0.001 to 1000", *lab, "--dampings", 0)
        self.run_badly("--delays: must be a number from 0 to 1000", *lab, "--delays", 100000)
        self.run_badly("pictures are written as .png", *lab, "--image", self.folder / "a.jpg")
        self.run_badly("the lab presses one model", "touch", "--scene", "none.json", "--lab")

    def test_and_touch_do_not_take_each_others_options(self):
        touch = ("touch", self.model, "--headless", "--seconds", 1)
        for option in (("--at", 0, 0, 0), ("--depth", 1), ("--rates", 500), ("--dampings", 1),
                       ("--delays", 1)):
            self.run_badly(f"{option[0]} requires --lab", *touch, *option)
        for option in (("--seconds", 1), ("--rate", 500), ("--friction", 1), ("--plan",)):
            self.run_badly("excludes", "touch", self.model, "--lab", *option)

    def test_tells_where_the_stiffness_varies_along_the_way_and_the_bound_says_little(self):
        coarse, fine = self.folder / "coarse.vtp", self.folder / "fine.vtp"
        self.start("precompute", DATA / "kidney.vtp", coarse)
        self.run_well("refine", DATA / "kidney.vtp", fine, "--levels", 2)
        self.start("precompute", fine, fine)
        for model, uneven in ((coarse, True), (fine, False), (self.model, False)):
            ran = self.start("touch", model, "--lab", "--rates", 1000, "--dampings", 1, "--delays", 0)
            stable, bound = (float(x) for x in ran.stdout.splitlines()[-1].split()[-2:])
            self.assertEqual(uneven, stable < 0.9 * bound, ran.stdout)
            self.assertEqual(uneven, bool(re.search(r"warning: the stiffness varies by \d+ % along", ran.stderr)))


class Grasp(Program):
    def numbers(self, printed, line):
        """Those in a line of what is printed."""
        found = re.search(rf"(?m)^{line}(.*)$", printed)
        self.assertTrue(found, (line, printed))
        return [float(x) for x in re.findall(r"-?\d+(?:\.\d+)?(?:e-?\d+)?", found[1])]

    def test_tells_the_force_of_each_finger_and_draws_the_hand(self):
        image = self.folder / "grasp.png"
        printed = self.run_well("grasp", self.model, "--frames", 60, "--image", image)
        for finger in ("thumb", "index", "middle", "ring", "little", "palm"):
            size, x, y, z, largest = self.numbers(printed, rf"{finger} +force, N ")
            self.assertLess(abs(np.linalg.norm([x, y, z]) - size), 0.01 * size + 1e-9)  # 3 digits
            self.assertGreaterEqual(largest, size)
        frames, step, _, _ = self.numbers(printed, "frames ")
        self.assertEqual((frames, step), (60, 32))
        self.assertEqual([p.name for p in self.folder.iterdir()], ["grasp.png"])
        picture = read_picture(image)
        red = (picture[..., 0] > 120) & (picture[..., 1:].max(axis=-1) < 60)
        self.assertGreater(red.sum(), 300)  # arrows

    def test_counts_constraints_that_come_and_go(self):
        printed = self.run_well("grasp", self.model, "--frames", 60)
        median, most, frames = self.numbers(printed, "constraint dof ")
        self.assertTrue(0 < median <= most and 0 < frames < 60)  # the hand comes from afar
        change, largest, _, many = self.numbers(printed, "  changed since the last frame")
        self.assertTrue(0 <= change <= largest <= 2 * most and 0 <= many <= frames)
        self.assertGreater(largest, 0)
        still = self.run_well("grasp", self.model, "--frames", 10)  # not there yet
        self.assertEqual(self.numbers(still, "constraint dof "), [0, 0, 0])
        self.assertEqual(self.numbers(still, "thumb +force, N "), [0] * 5)

    def test_strokes_a_kidney_over_more_than_a_hundred_dof_a_frame_with_light_fingers(self):
        kidney, model = self.folder / "kidney.vtp", self.folder / "model.vtp"
        self.run_well("refine", DATA / "kidney.vtp", kidney, "--levels", 2)
        self.run_well("precompute", kidney, model, "--young", 8e3, "--poisson", 0.45)
        printed = self.run_well("grasp", model)
        self.assertEqual(self.numbers(printed, "model "), [966])
        touching = self.numbers(printed, "constraint dof ")[2]
        median, _, bound, many = self.numbers(printed, "  changed since the last frame")
        self.assertEqual(bound, 100)
        self.assertTrue(median > bound and many > 0.5 * touching, printed)
        residual, unsettled, left_out = self.numbers(printed, "worst residual ")
        self.assertTrue(residual < 1e-8 and unsettled == left_out == 0, printed)
        for finger in ("thumb", "index", "middle", "ring", "little", "palm"):
            largest = self.numbers(printed, rf"{finger} +force, N ")[-1]
            self.assertTrue(0.3 < largest < 3, printed)  # newtons: what devices are limited to

    def test_refuses_other_devices_and_numbers(self):
        self.run_badly("needs a glove's recording", "grasp", self.model, "--device", "simulated")
        for frames in (-3, 0, 1000000):
            self.run_badly("--frames: must be a number from 1 to 10000", "grasp", self.model,
                           "--frames", frames)
        self.run_badly("--hand-length: must be a positive number", "grasp", self.model,
                       "--hand-length", 0)
        self.run_badly("there is no such file", "grasp", self.folder / "none.vtp")


class Devices(Program):
    def test_that_are_built_in_are_told(self):
        printed = self.run_well("devices")
        for name in ("mouse", "simulated", "recording", "glove"):
            self.assertRegex(printed, rf"(?m)^{name} +built in: ")


class Batch(Program):
    def loaded(self, *arguments):
        """The libraries that a command loads."""
        ran = self.start(*arguments, env={**WITHOUT_DISPLAY, "LD_DEBUG": "files"})
        return ran.stderr

    def test_commands_load_nothing_that_touches_draws_or_looks_for_devices(self):
        # VTK's readers need vtkRenderingCore, which draws nothing by itself.
        drawing = ("libpalpate_touch", "libPalpateHaptics", "vtkRenderingOpenGL", "vtkInteraction",
                   "libGL.", "libX11", "libhidapi")
        for command in (("info", self.model), ("stiffness", self.model), ("--version",)):
            loaded = self.loaded(*command)
            for library in drawing:
                self.assertFalse(library in loaded, (command, library))
        touching = self.loaded("touch", self.model, "--plan")
        self.assertTrue("libpalpate_touch" in touching and "vtkRenderingOpenGL" in touching)


if __name__ == "__main__":
    unittest.main()
