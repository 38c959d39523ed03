# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`palpate touch`, `palpate grasp` and `palpate devices` in hostile hands: bad arguments, files and scenes, files
written over, interruptions. Each is a sentence, and nothing is half written."""

import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

import numpy as np

import palpate
from support.surfaces import PROGRAM, cube, points_of, polydata, triangles_of
from support.touch import PRESS, REST, SIZE, TOP, block_model, path, write_recording
from support.touch_program import WITHOUT_DISPLAY, Program

DATA = Path(__file__).resolve().parents[2] / "data"


class Failures(Program):
    def test_without_a_display_are_one_sentence(self):
        for display in ({}, {"DISPLAY": ""}, {"DISPLAY": ":4321"}, {"DISPLAY": "nonsense"}):
            status = self.run_badly("there is no display for a window: set DISPLAY to one, or run with "
                                    "--headless", "touch", self.model, env={**WITHOUT_DISPLAY, **display})
            self.assertEqual(status, 1)

    def test_to_print_are_told(self):
        for command in (("grasp", self.model, "--frames", 1), ("touch", self.model, "--plan"),
                        ("touch", self.model, "--headless", "--seconds", 0.1),
                        ("touch", self.model, "--lab", "--rates", 1000, "--dampings", 1, "--delays", 0)):
            with open("/dev/full", "w") as full:
                ran = subprocess.run([PROGRAM, *map(str, command)], stdout=full, text=True,
                                     stderr=subprocess.PIPE, env=WITHOUT_DISPLAY)
            self.assertEqual((ran.returncode, ran.stderr),
                             (1, "palpate: standard output cannot be written to\n"))

    def test_of_devices_name_them(self):
        touch = ("touch", self.model, "--headless", "--seconds", 1, "--device")
        for name in ("banana", "mouses", "hid:", "hid:xyz:1", "hid:046d:c626z", "scripted"):
            self.run_badly(f"there is no device '{name}': choose mouse, scripted:FILE", *touch, name)
        self.run_badly("the HID device 0001:0002 is not there: `palpate devices` lists", *touch,
                       "hid:0001:0002")
        self.run_badly("the recording 'none.txt' cannot be opened", *touch, "scripted:none.txt")

    def test_of_a_scene_are_those_of_its_plan_too(self):
        scene = self.folder / "scene.json"
        described = {"models": [{"file": str(self.model)}], "tools": [{"shape": "point", "device": "m"}],
                     "devices": [{"name": "m", "type": "simulated"}]}
        (self.folder / "empty.txt").write_text("")
        for sentence, change in (
                ("is not inside the material", {"effects": {"probes": [{"name": "a", "inside": [0, 0, 1]}]}}),
                ("the probe 'a' is at node 999999", {"effects": {"probes": [{"name": "a", "node": 999999}]}}),
                ("none.txt' cannot be opened", {"devices": [{"name": "m", "type": "scripted", "file": "none.txt"}]}),
                ("empty.txt': the file ends", {"devices": [{"name": "m", "type": "scripted", "file": "empty.txt"}]}),
                ("none.json' cannot be opened",
                 {"devices": [{"name": "m", "type": "hid", "description": "none.json"}]}),
                ("none.stl", {"tools": [{"shape": "mesh", "file": "none.stl", "device": "m"}]})):
            scene.write_text(json.dumps({**described, **change}))
            run = ("touch", "--scene", scene, "--headless", "--seconds", 0.1)
            self.run_badly(sentence, *run)
            self.assertEqual(self.start(*run).stderr, self.start("touch", "--scene", scene, "--plan").stderr)
            self.run_badly(sentence, "touch", "--scene", scene, "--plan")

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
        self.run_badly("--friction: must be a number from 0 to 100, not ", *touch, "--friction", "")
        for option, value in (("--radius", 1), ("--mask", "uniform")):
            self.run_badly("excludes", *touch, option, value, "--tool-radius", 0.01)
        self.run_badly("--mask: round not in {linear,uniform,gaussian,hertzian}", *touch, "--mask", "round")
        self.run_badly("--contacts: must be a number from 1 to 2000, not 0", *touch, "--contacts", 0)
        self.run_badly("--contacts is of tools with a shape: add --tool-radius", *touch, "--contacts", 9)
        for option in ("--record", "--forces", "--image"):
            self.run_badly("the name of a file is missing", *touch, option, "")
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

    def test_of_files_that_may_not_grow_leave_nothing(self):
        limited = ("sh", "-c", f'ulimit -f 1; exec "{PROGRAM}" "$@"', "palpate")
        arguments = [str(x) for x in (*self.scripted(PRESS), "--seconds", 1, "--forces",
                                      self.folder / "a.csv")]
        ran = subprocess.run([*limited, *arguments], capture_output=True, text=True)
        self.assertEqual(ran.returncode, 1)
        self.assertIn("a.csv cannot be written", ran.stderr)
        self.assertEqual([p.name for p in self.folder.iterdir()], ["motion.txt"])

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
        ball = {"tools": [{"shape": "sphere", "radius": 0.01, "device": "m"}]}
        file.write_text(json.dumps({**scene, **ball}))
        self.run_badly("but the scene's tools have a shape", "touch", "--scene", file, "--headless",
                       "--seconds", 1, "--radius", 0.01)
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


class BadFiles(Program):
    """Files that are none, too long, of other units or without sense."""

    def glove(self, joints="0", **how):
        """A recording of a hand far away; joints as text, 22 of them."""
        moment = f"1 {how.get('position', '0 0 1')} {how.get('rotation', '1 0 0 0')} 0 22 "
        return ("palpate-device-recording 1\nname a\nlimits 0 0 0\nmoments 1\n" + moment +
                " ".join([joints] * 22) + "\n")

    def test_that_are_no_files_or_never_end(self):
        (self.folder / "empty").touch()
        for path, told in ((self.folder, "is a folder"), (self.folder / "empty", "is empty"),
                           ("/dev/zero", "is longer than 16 MiB"), ("none", "cannot be opened")):
            self.run_badly(told, "touch", "--scene", path, "--plan", timeout=60)
            self.run_badly(told, "devices", "--description", path, timeout=60)
        self.run_badly("cannot be opened", "devices", "--description", "")
        for path, told in ((self.folder, "is a folder"), ("/dev/zero", "line 1 of '/dev/zero': the line "
                           "is too long"), (self.folder / "empty", "the file ends before")):
            for command in (("touch", self.model, "--headless", "--seconds", 1), ("grasp", self.model)):
                self.run_badly(told, *command, "--device", f"scripted:{path}", timeout=60)

    def test_recordings_may_have_been_edited_on_windows(self):
        arguments = self.scripted(PRESS)
        script = self.folder / "motion.txt"
        forces = [self.folder / "a.csv", self.folder / "b.csv"]
        self.run_well(*arguments, "--seconds", 1.2, "--forces", forces[0])
        script.write_bytes(script.read_bytes().replace(b"\n", b"\r\n"))
        self.run_well(*arguments, "--seconds", 1.2, "--forces", forces[1])
        self.assertEqual(forces[0].read_bytes(), forces[1].read_bytes())

    def test_gloves_that_are_nowhere_are_refused(self):
        file = self.folder / "glove.txt"
        grasp = ("grasp", self.model, "--frames", 1, "--device", f"scripted:{file}")
        for text in (self.glove("nan"), self.glove(position="0 inf 0"), self.glove(rotation="0 0 0 0")):
            file.write_text(text)
            self.run_badly("moment 0 of", *grasp)
        file.write_text("palpate-device-recording 1\nname a\nlimits 0 0 0\nmoments 1\naway\n")
        self.run_badly("the glove is never there", *grasp)
        file.write_text(self.glove())
        self.run_well(*grasp)

    def test_scenes_name_the_model_without_greens_functions(self):
        bare = self.folder / "bare.vtp"
        palpate.write(palpate.read(palpate.example("kidney")), bare)
        scene = self.folder / "scene.json"
        scene.write_text(json.dumps({"models": [{"file": "bare.vtp"}],
                                     "tools": [{"shape": "point", "device": "m"}],
                                     "devices": [{"name": "m", "type": "mouse"}]}))
        self.run_badly("bare.vtp: the surface carries no Green's functions", "touch", "--scene", scene,
                       "--plan")

    def test_units_that_do_not_fit_are_told(self):
        touch = ("touch", self.model, "--headless", "--seconds", 0.1)
        for radius in (1e-300, 1e-6, 2, 1000):
            self.run_badly("does not fit a model of 0.1732 m: are both in metres?", *touch,
                           "--tool-radius", radius)
        self.run_badly("--depth is more than the model's length", "touch", self.model, "--lab",
                       "--depth", 1)
        for length in (1e-6, 1e6):
            self.run_badly("--hand-length does not fit the model", "grasp", self.model, "--hand-length",
                           length)
        millimetres = block_model(1000)
        file = self.folder / "millimetres.vtp"
        palpate.write(millimetres, file)
        for command in (("touch", file, "--headless", "--seconds", 0.1), ("grasp", file, "--frames", 1),
                        ("touch", file, "--lab", "--rates", 1000, "--dampings", 1, "--delays", 0)):
            ran = self.start(*command)
            self.assertEqual(ran.returncode, 0, ran.stderr)
            self.assertEqual(ran.stderr, "palpate: warning: the model is 173.205 m long: its points are "
                             "taken for metres; are they millimetres?\n")
        block = block_model()
        away = polydata(points_of(block) + (12, 0, 0), triangles_of(block))
        far = self.folder / "far.vtp"
        palpate.write(palpate.precompute(away, 1e4, 0.3, fixed=points_of(block)[:, 2] == 0), far)
        self.assertRegex(self.start("touch", far, "--headless", "--seconds", 0.1).stderr,
                         "lies up to 12[.0-9]* m from the origin: devices reach 10 m")

    def test_forces_that_safety_limits_are_told(self):
        block, stiff = block_model(), self.folder / "stiff.vtp"
        palpate.write(palpate.precompute(block, 1e8, 0.3), stiff)
        touch = ("--device", "simulated", "--headless", "--seconds", 1)
        self.assertRegex(self.run_well("touch", stiff, *touch), "rendered .* N, limited or faded for safety")
        self.assertNotIn("rendered", self.run_well("touch", self.model, *touch))

    def test_tools_that_the_mesh_is_too_coarse_for_are_told_once(self):
        for option in (("--tool-radius", 0.001), ("--radius", 0.002)):
            ran = self.start("touch", self.model, "--headless", "--seconds", 0.3, *option)
            self.assertEqual(ran.returncode, 0, ran.stderr)
            self.assertRegex(ran.stderr, r"^palpate: warning: (a tool|the pressure mask) of radius "
                             rf"{option[1]} m is much smaller than the model's edges, 0.0\d+ m: the force "
                             r"depends on the mesh; `palpate refine` makes it finer\n$")

    def test_models_whose_material_is_outside_are_refused(self):
        cavity = self.folder / "cavity.vtp"
        block = cube(3, SIZE)
        palpate.write(palpate.precompute(block, 1e4, 0.3, fixed=points_of(block)[:, 2] == 0,
                                         domain="exterior"), cavity)
        touch = ("touch", cavity)
        for command in ((*touch, "--headless", "--seconds", 0.1), (*touch, "--plan"), (*touch, "--lab"),
                        (*touch, "--headless", "--seconds", 0.1, "--tool-radius", 0.01),
                        ("grasp", cavity)):
            self.run_badly("the model's material lies outside its surface, where no tool can be: only "
                           "models that `palpate precompute --domain interior` made can be touched",
                           *command)

    def test_models_of_some_columns_tell_where_they_are_touched_without(self):
        block = cube(6, SIZE)
        points = points_of(block)
        near = np.flatnonzero((np.linalg.norm(points - TOP, axis=1) < 0.07) & (points[:, 2] > 0))
        far = np.flatnonzero((points[:, 0] > 0.99 * SIZE) & (points[:, 2] > 0.02))
        model = self.folder / "part.vtp"
        for columns, served in ((near, True), (far, False)):
            part = palpate.precompute(block, 1e4, 0.3, fixed=points[:, 2] == 0, columns=columns)
            palpate.write(part, model)
            for tool in ((), ("--tool-radius", 0.02)):
                lift = 1e3 * tool[1] if tool else 0
                file = write_recording(self.folder / "motion.txt", path(*(
                    (seconds, (x, y, z + lift)) for seconds, (x, y, z) in PRESS)))
                ran = self.start("touch", model, "--device", f"scripted:{file}", "--headless",
                                 "--seconds", REST + 0.4, *tool)
                self.assertEqual(ran.returncode, 0, ran.stderr)
                self.assertRegex(ran.stderr, r"^palpate: warning: the model has no Green's functions of \d+ "
                                 r"of its \d+ free vertices and gives no force near them: `palpate "
                                 r"precompute` without --columns computes all\n$")
                fault = re.search(r"(?m)^tool 0   fault: touched where the model's Green's functions were "
                                  r"not computed, in \d+ ticks, first at \S+ s$", ran.stdout)
                self.assertEqual(fault is None, served, ran.stdout)
                self.assertEqual(" 0 N " in ran.stdout.splitlines()[0], not served, ran.stdout)

    def test_a_body_that_folds_over_under_its_weight_is_told(self):
        kidney = palpate.refine(palpate.read(palpate.example("kidney")), 1)
        kidney = palpate.precompute(kidney, 8e3, 0.45)
        palpate.write(kidney, self.folder / "kidney.vtp")
        scene = self.folder / "scene.json"
        scene.write_text(json.dumps({"models": [{"file": "kidney.vtp", "density": 1000}],
                                     "tools": [{"shape": "point", "device": "m"}],
                                     "devices": [{"name": "m", "type": "mouse"}],
                                     "effects": {"gravity": [0, 0, -1e6]}}))
        self.run_badly("under gravity the model sags by ", "touch", "--scene", scene, "--headless",
                       "--seconds", 0.1)


class Interruption(Program):
    """Ctrl-C, termination and a closed terminal end a run soon, with a sentence and without a file; in a
    window they close it, and what was recorded is kept."""

    def end_by(self, how, *arguments, env=WITHOUT_DISPLAY):
        with subprocess.Popen([PROGRAM, *map(str, arguments)], stdout=subprocess.PIPE, text=True,
                              stderr=subprocess.PIPE, env=env, start_new_session=True) as run:
            try:
                self.await_handler(run.pid, how)
                time.sleep(0.5)
                os.killpg(run.pid, how)
                return *run.communicate(timeout=30), run.wait()
            finally:
                run.kill()

    def interrupt(self, how, *arguments):
        before = sorted(self.folder.iterdir())
        self.assertEqual(self.end_by(how, *arguments),
                         ("", "palpate: interrupted; nothing was written\n", 1))
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
        for how in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
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
    def test_closes_a_window_and_keeps_the_recording(self):
        record = self.folder / "a.txt"
        with subprocess.Popen(["Xvfb", "-displayfd", "1", "-nolisten", "tcp"], text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as server:
            try:
                env = {**os.environ, "DISPLAY": ":" + server.stdout.readline().strip()}
                out, errors, code = self.end_by(signal.SIGTERM, "touch", self.model, "--record",
                                                record, env=env)
            finally:
                server.terminate()
        self.assertEqual((errors, code), ("", 0))
        self.assertIn("ticks", out)
        self.assertIn("palpate-device-recording", record.read_text())

    @unittest.skipUnless(shutil.which("Xvfb"), "no display to be had")
    def test_that_the_display_has_gone_is_told_and_keeps_the_recording(self):
        record = self.folder / "b.txt"
        with subprocess.Popen(["Xvfb", "-displayfd", "1", "-nolisten", "tcp"], text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as server:
            env = {**os.environ, "DISPLAY": ":" + server.stdout.readline().strip()}
            with subprocess.Popen([PROGRAM, "touch", self.model, "--record", record], env=env, text=True,
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE) as run:
                self.await_handler(run.pid, signal.SIGTERM)
                time.sleep(2)
                server.kill()
                _, errors = run.communicate(timeout=30)
        self.assertEqual(run.returncode, 1)
        self.assertIn("palpate: the display is gone", errors)
        self.assertIn("palpate-device-recording", record.read_text())


if __name__ == "__main__":
    unittest.main()
