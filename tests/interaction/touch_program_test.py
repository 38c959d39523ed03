# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`palpate touch`, `palpate grasp` and `palpate devices`: what they print and write, and how they fail."""

import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import numpy as np

import palpate
from support.surfaces import PROGRAM
from support.touch import PRESS, RATE, REST, STROKE, Touch, block_model, path, write_recording
from support.window import read_picture

DATA = Path(__file__).resolve().parents[2] / "data"
WITHOUT_DISPLAY = {k: v for k, v in os.environ.items() if k != "DISPLAY"}


class Program(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.model = Path(folder.name) / "block.vtp"
        palpate.write(block_model(), cls.model)

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def start(self, *arguments, **options):
        return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True,
                              **{"env": WITHOUT_DISPLAY, **options})

    def run_well(self, *arguments, **options):
        """What a command prints."""
        ran = self.start(*arguments, **options)
        self.assertEqual((ran.returncode, ran.stderr), (0, ""), arguments)
        return ran.stdout

    def run_badly(self, sentence, *arguments, **options):
        """The command fails with one line that holds a sentence, and writes nothing."""
        before = sorted((p.name, p.stat().st_mtime_ns) for p in self.folder.iterdir())
        ran = self.start(*arguments, **options)
        self.assertGreater(ran.returncode, 0, arguments)
        self.assertEqual(ran.stdout, "")
        self.assertTrue(ran.stderr.startswith("palpate: ") and ran.stderr.count("\n") == 1, ran.stderr)
        self.assertIn(sentence, ran.stderr)
        after = sorted((p.name, p.stat().st_mtime_ns) for p in self.folder.iterdir())
        self.assertEqual(before, after)
        return ran.returncode

    def scripted(self, stations, **how):
        """Arguments that replay a motion on the model without a window."""
        file = write_recording(self.folder / "motion.txt", path(*stations), **how)
        return ("touch", self.model, "--device", f"scripted:{file}", "--headless")


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
                                "--radius", 0.05, "--rate", 1000, "--rigid-stiffness", 100,
                                "--deformation", "contact")
        self.assertIn("mu 0.7", printed)
        self.assertIn("mask 50 mm", printed)
        self.assertIn("sticks", printed)
        self.assertIn("at 0.05 0.05 0.1", printed)
        self.assertIn(f"ticks    {round((REST + 0.4) * RATE)}, 0 left out", printed)

    def test_records_the_motion_that_it_replays(self):
        first, again = self.folder / "first.csv", self.folder / "again.csv"
        copy = self.folder / "copy.txt"
        self.run_well(*self.scripted(PRESS), "--seconds", 1.7, "--forces", first, "--record", copy)
        self.run_well("touch", self.model, "--device", f"scripted:{copy}", "--headless", "--seconds",
                      1.7, "--forces", again)
        self.assertEqual(first.read_bytes(), again.read_bytes())

    def test_a_device_that_can_render_no_force_is_told(self):
        for limits, told in (("0 0 0", True), ("3.3 0 0", False)):
            printed = self.run_well(*self.scripted(PRESS, limits=limits), "--seconds", REST + 0.4)
            self.assertIn("sticks", printed)
            self.assertEqual("not rendered: its device's limits allow no force" in printed, told)

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
        self.assertIn("watched", self.run_well("touch", self.model, "--plan", "--tool-radius", 0.02))


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

    def test_refuses_other_devices_and_numbers(self):
        self.run_badly("needs a glove's recording", "grasp", self.model, "--device", "simulated")
        for frames in (-3, 0, 1000000):
            self.run_badly("--frames: must be a number from 1 to 10000", "grasp", self.model,
                           "--frames", frames)
        self.run_badly("--hand-length: must be a positive number", "grasp", self.model,
                       "--hand-length", 0)
        self.run_badly("there is no such file", "grasp", self.folder / "none.vtp")


class Failures(Program):
    def test_without_a_display_are_one_sentence(self):
        status = self.run_badly("there is no display for a window: set DISPLAY, or run with --headless",
                                "touch", self.model)
        self.assertEqual(status, 1)

    def test_of_devices_name_them(self):
        touch = ("touch", self.model, "--headless", "--seconds", 1, "--device")
        for name in ("banana", "mouses", "hid:", "hid:xyz:1", "hid:046d:c626z", "scripted"):
            self.run_badly(f"there is no device '{name}': choose mouse, scripted:FILE", *touch, name)
        self.run_badly("the HID device is not there: `palpate devices` lists", *touch, "hid:0001:0002")
        self.run_badly("the recording 'none.txt' cannot be opened", *touch, "scripted:none.txt")

    def test_of_arguments_say_how_to_mend_them(self):
        self.run_badly("--headless needs --seconds, which is required", "touch", self.model, "--headless")
        self.run_badly("a model or a --scene, one of the two, is required", "touch")
        self.run_badly("a model or a --scene", "touch", self.model, "--scene", "a.json")
        self.run_badly("--image needs --headless or --lab", "touch", self.model, "--image",
                       self.folder / "a.png")
        touch = ("touch", self.model, "--headless", "--seconds", 1)
        self.run_badly("--deformation", *touch, "--deformation", "some")
        for option, limits in (("--rate", "from 250 to 10000"), ("--friction", "from 0 to 100"),
                               ("--radius", "from 0 to 1e+06"),
                               ("--rigid-stiffness", "from 0 to 1e+15")):
            for value in (-2, "nan", "inf"):
                self.run_badly(f"{option}: must be a number {limits}, not {value}", *touch, option,
                               value)
        self.run_badly("--rate: must be a number from 250", *touch, "--rate", 0)
        for value in (-1, 0, "nan", "inf"):
            self.run_badly("--tool-radius: must be a positive number of at most 1e+06", *touch,
                           "--tool-radius", value)
            self.run_badly("--seconds: must be a positive number of at most 86400", *touch[:-1], value)
        self.run_badly("--seconds: must be a positive number", *touch[:-1], 1e12)
        self.run_badly("--record holds at most 120 seconds", *touch[:-1], 121, "--record",
                       self.folder / "a.txt")
        for device in ("mouse", "simulated"):
            self.run_badly("--forces tells the forces on a recording that is replayed", *touch,
                           "--device", device, "--forces", self.folder / "a.csv")

    def test_of_files_leave_nothing_half_written(self):
        self.run_badly("none.vtp: there is no such file", "touch", self.folder / "none.vtp", "--plan")
        touch = (*self.scripted(PRESS), "--seconds", 80000)  # no time to run before the complaint
        for option in ("--forces", "--record", "--image"):
            self.run_badly("there is no folder", *touch, option, self.folder / "no" / "a.png")
            folder = self.folder / "folder.png"
            folder.mkdir(exist_ok=True)
            self.run_badly("it is a folder", *touch, option, folder)
        for option in ("--forces", "--record"):
            self.run_badly("it is not an ordinary file", *touch, option, "/dev/null")
        self.run_badly("pictures are written as .png", *touch, "--image", self.folder / "a.jpg")
        bare = self.folder / "bare.vtp"
        palpate.write(palpate.read(palpate.example("kidney")), bare)
        self.run_badly("carries no Green's functions", "touch", bare, "--plan")

    def test_are_told_before_a_file_is_written_over_or_twice(self):
        touch = (*self.scripted(PRESS), "--seconds", 0.1)
        script, link = self.folder / "motion.txt", self.folder / "link.png"
        link.symlink_to(script)
        for option in ("--forces", "--record"):
            for name in (script, self.folder / ".." / self.folder.name / "motion.txt", link):
                self.run_badly(f"{option} would write over the recording of --device", *touch, option,
                               name)
            self.run_badly(f"{option} would write over the model", *touch, option, self.model)
        self.run_badly("--image would write over the recording", *touch, "--image", link)
        same = self.folder / "same.png"
        self.run_badly("--forces would write over --record", *touch, "--record", same, "--forces",
                       same)
        self.run_badly("--image would write over --record", *touch, "--record", same, "--image", same)
        scene = self.folder / "scene.json"
        scene.write_text(json.dumps({
            "models": [{"file": str(self.model)}], "tools": [{"shape": "point", "device": "m"}],
            "devices": [{"name": "m", "type": "scripted", "file": "motion.txt"}]}))
        scened = ("touch", "--scene", scene, "--headless", "--seconds", 0.1)
        self.run_badly("--record would write over a recording of --scene", *scened, "--record", script)
        self.run_badly("--record would write over a model of --scene", *scened, "--record", self.model)
        self.run_badly("--record would write over --scene", *scened, "--record", scene)
        self.run_well(*scened, "--forces", self.folder / "forces.csv")
        self.run_badly("--forces tells the forces on a recording", *scened, "--device", "mouse",
                       "--forces", self.folder / "none.csv")

    def test_of_scenes_name_the_key(self):
        scene = {"models": [{"file": str(self.model)}], "tools": [{"shape": "point", "device": "m"}],
                 "devices": [{"name": "m", "type": "mouse"}]}
        file = self.folder / "scene.json"
        for key, changed in (
                ("tools[0].colour", {"tools": [{"shape": "point", "device": "m", "colour": 1}]}),
                ("tools[0].device", {"tools": [{"shape": "point", "device": "n"}]}),
                ("effects.friction.mu", {"effects": {"friction": {"mu": -1}}}),
                ("servo.rate", {"servo": {"rate": 20000}}), ("gravity", {"gravity": 1})):
            file.write_text(json.dumps({**scene, **changed}))
            self.run_badly(key, "touch", "--scene", file, "--headless", "--seconds", 1)
        file.write_text("{")
        self.run_badly("scene.json", "touch", "--scene", file, "--headless", "--seconds", 1)
        file.write_text(json.dumps(scene))
        self.assertIn("0 N free", self.run_well("touch", "--scene", file, "--headless", "--seconds", 0.1))


class Scenes(Program):
    def test_of_the_data_are_made_by_one_command_and_run(self):
        scenes = sorted((DATA / "scenes").glob("*.json"))
        self.assertEqual(len(scenes), 3)
        for scene in scenes:
            shutil.copy(scene, self.folder)
        scene = self.folder / "two_kidneys_hand.json"
        self.run_badly("kidney.vtp` makes a model of a surface, `python3 data/make_scenes.py` those of "
                       "Palpate's own scenes", "touch", "--scene", scene, "--plan")
        made = subprocess.run([sys.executable, DATA / "make_scenes.py", "--program", PROGRAM,
                               "--folder", self.folder], capture_output=True, text=True)
        self.assertEqual((made.returncode, made.stdout, made.stderr), (0, "", ""))
        for file in scenes:
            self.run_well("touch", "--scene", self.folder / file.name, "--headless", "--seconds", 0.1)
        forces = self.folder / "forces.csv"
        printed = self.run_well("touch", "--scene", scene, "--headless", "--seconds", 4, "--forces", forces)
        self.assertIn("sticks", printed)
        rendered = np.loadtxt(forces, delimiter=",", skiprows=1)[:, :3]
        self.assertTrue(0.3 < rendered[-1][1] < 3, rendered[-1])  # the fingers are pushed away
        self.assertEqual(np.abs(rendered[:1000]).max(), 0)  # before they close

    def test_that_cannot_be_made_say_why(self):
        made = subprocess.run([sys.executable, DATA / "make_scenes.py", "--program",
                               self.folder / "none", "--folder", self.folder], capture_output=True,
                              text=True)
        self.assertEqual(made.returncode, 1)
        self.assertTrue(made.stderr.startswith("make_scenes: ") and made.stderr.count("\n") == 1)


class Interruption(Program):
    """Ctrl-C and termination end a run soon, with a sentence and without a file."""

    def interrupt(self, how, *arguments, env=WITHOUT_DISPLAY):
        before = sorted(self.folder.iterdir())
        with subprocess.Popen([PROGRAM, *map(str, arguments)], stdout=subprocess.PIPE, text=True,
                              stderr=subprocess.PIPE, env=env, start_new_session=True) as run:
            try:
                self.await_handler(run.pid, how)
                time.sleep(0.5)
                os.killpg(run.pid, how)
                out, errors = run.communicate(timeout=30)
            finally:
                run.kill()
        self.assertEqual((out, errors), ("", "palpate: interrupted; nothing was written\n"))
        self.assertEqual(run.returncode, 1)
        self.assertEqual(before, sorted(self.folder.iterdir()))

    def await_handler(self, process, how):
        status = Path(f"/proc/{process}/status")
        for _ in range(3000):
            caught = [line for line in status.read_text().splitlines() if line.startswith("SigCgt")]
            if int(caught[0].split()[1], 16) >> (how - 1) & 1:
                return
            time.sleep(0.01)
        self.fail("the program does not catch the signal")

    def test_ends_a_run_without_a_window(self):
        for how in (signal.SIGINT, signal.SIGTERM):
            self.interrupt(how, *self.scripted(PRESS), "--seconds", 80000, "--forces",
                           self.folder / "a.csv")

    def test_ends_a_run_that_draws_on_a_display_of_its_own(self):
        self.interrupt(signal.SIGINT, *self.scripted(PRESS), "--seconds", 80000, "--image",
                       self.folder / "a.png")

    def test_ends_the_lab(self):
        self.interrupt(signal.SIGTERM, "touch", self.model, "--lab", "--rates", 100000, 100000,
                       "--dampings", 0.001, "--image", self.folder / "a.png")

    def test_ends_a_grasp(self):
        self.interrupt(signal.SIGINT, "grasp", self.model, "--frames", 10000, "--image",
                       self.folder / "a.png")

    @unittest.skipUnless(shutil.which("Xvfb"), "no display to be had")
    def test_ends_a_window(self):
        with subprocess.Popen(["Xvfb", "-displayfd", "1", "-nolisten", "tcp"], text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as server:
            try:
                env = {**os.environ, "DISPLAY": ":" + server.stdout.readline().strip()}
                self.interrupt(signal.SIGTERM, "touch", self.model, "--record",
                               self.folder / "a.txt", env=env)
            finally:
                server.terminate()


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
