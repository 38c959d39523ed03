# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The program `palpate`: what it prints and writes, and how it fails."""

import os
import resource
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

import numpy as np
from vtkmodules.vtkIOGeometry import vtkOBJWriter, vtkSTLWriter
from vtkmodules.vtkIOPLY import vtkPLYWriter

import palpate
from support.surfaces import PROGRAM, points_of, quad_cube, sphere, triangles_of

KIDNEY = palpate.example("kidney")


def start(*arguments, **options):
    return subprocess.Popen([PROGRAM, *map(str, arguments)], stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, text=True, **options)


class Program(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_well(self, *arguments):
        """What a command prints."""
        process = start(*arguments)
        printed, errors = process.communicate()
        self.assertEqual(process.returncode, 0, (arguments, errors))
        for line in errors.splitlines():  # the coarse kidney has a thin wall and a small support
            self.assertTrue(line.startswith("palpate: warning: "), line)
        return printed

    def run_badly(self, sentence, *arguments, **options):
        """The command fails with one line that holds a sentence, and writes nothing."""
        before = sorted((p.name, p.lstat().st_mtime_ns) for p in self.folder.iterdir())
        process = start(*arguments, **options)
        printed, errors = process.communicate()
        self.assertGreater(process.returncode, 0, arguments)
        self.assertEqual(printed, "")
        self.assertTrue(errors.startswith("palpate: ") and errors.count("\n") == 1, errors)
        self.assertIn(sentence, errors)
        after = sorted((p.name, p.lstat().st_mtime_ns) for p in self.folder.iterdir())
        self.assertEqual(before, after)

    def model(self):
        path = self.folder / "model.vtp"
        self.run_well("precompute", KIDNEY, path)
        return path


class Walkthrough(Program):
    def test_of_the_help_runs(self):
        surface, model = self.folder / "kidney.vtp", self.folder / "model.vtp"
        self.run_well("refine", KIDNEY, surface, "--levels", 1)
        self.assertIn("Green's functions           49", self.run_well("precompute", surface, model))
        pressed = self.run_well("press", model, self.folder / "pressed.vtp", "--at", 0, 0, 0.03,
                                "--displacement", 0, 0, -0.005, "--radius", 0.015)
        self.assertIn("contact force, N", pressed)
        field = self.run_well("stiffness", model, self.folder / "field.vtp", "--radius-edges", 2)
        self.assertIn("coefficient of variation", field)
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()),
                         ["field.vtp", "kidney.vtp", "model.vtp", "pressed.vtp"])

    def test_says_the_same_as_the_package(self):
        path = self.model()
        model = palpate.precompute(palpate.read(KIDNEY), None, None)
        self.assertTrue((palpate.greens_functions(palpate.read(path))
                         == palpate.greens_functions(model)).all())
        output = self.folder / "pressed.vtp"
        self.run_well("press", path, output, "--at", 0, 0, 0.03, "--force", 0, 0.1, -0.5, "--radius",
                      0.02, "--mask", "hertzian")
        expected = palpate.press(model, (0, 0, 0.03), force=(0, 0.1, -0.5), radius=0.02,
                                 mask="hertzian")
        difference = (palpate.array(palpate.read(output), "Displacement")
                      - palpate.array(expected, "Displacement"))
        self.assertEqual(np.abs(difference).max(), 0)

    def test_takes_every_mask_measure_and_torque(self):
        path, output = self.model(), self.folder / "twisted.vtp"
        told = self.run_well("press", path, output, "--at", 0, 0, 0.03, "--displacement", 0, 0, -0.002,
                             "--torque", 0, 0, 1e-4, "--radius", 0.02, "--mask", "gradient",
                             "--measure", "mean")
        self.assertIn("turns by, rad", told)
        expected = palpate.press(palpate.read(path), (0, 0, 0.03), displacement=(0, 0, -0.002),
                                 torque=(0, 0, 1e-4), radius=0.02, mask="gradient", measure="mean")
        for name in ("Displacement", "ContactRotation"):
            self.assertEqual(np.abs(palpate.array(palpate.read(output), name)
                                    - palpate.array(expected, name)).max(), 0)
        field = self.folder / "field.vtp"
        told = self.run_well("stiffness", path, field, "--radius-edges", 2, "--distance", "geodesic",
                             "--measure", "mean", "--rotational")
        self.assertIn("masks cut off at the support", told)
        expected = palpate.stiffness(palpate.read(path), radius_in_edges=2, distance="geodesic",
                                     measure="mean", rotational=True)
        for name in ("Stiffness", "RotationalStiffness"):
            self.assertTrue(np.array_equal(palpate.array(palpate.read(field), name),
                                           palpate.array(expected, name), equal_nan=True))

    def test_info_tells_what_a_file_is(self):
        self.assertIn("sound                       yes", self.run_well("info", KIDNEY))
        told = self.run_well("info", self.model())
        for label in ("Young's modulus", "condition number", "reciprocity defect", "made by"):
            self.assertIn(label, told)
        for line in told.splitlines():
            self.assertRegex(line, r"^\S.*?  +\S")
        flat = self.folder / "open.off"
        flat.write_text("OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n")
        self.assertIn("sound                       no", self.run_well("info", flat))

    def test_every_command_has_help_with_an_example(self):
        self.assertIn("To begin with", self.run_well("--help"))
        for command in ("repair", "refine", "precompute", "press", "stiffness"):
            told = self.run_well(command, "--help")
            self.assertIn(f"  palpate {command} ", told)
        self.run_well("info", "--help")
        self.assertRegex(palpate.__version__, r"^\d+\.\d+\.\d+$")
        self.assertEqual(self.run_well("--version"), palpate.__version__ + "\n")


    def test_takes_negative_numbers_however_they_are_written(self):
        model = self.model()
        pressed = [self.run_well("press", model, "--at", 0, x, x, "--force", x, 0, x)
                   for x in ("-0.5", "-.5", "-5e-1", "-.05e1")]
        self.assertEqual(len(set(pressed)), 1)
        fixed = [self.run_well("precompute", KIDNEY, model, "--fix-sphere", 0, 0, z, 1,
                               "--fix-half-space", 0, 0, z, 0, 0, "1").splitlines()[1]
                 for z in ("-0.99", "-.99")]
        self.assertEqual(fixed[0], fixed[1])
        self.run_badly("--help", "press", model, "--at", 0, 0, "-.5x", "--force", 0, 0, 1)


class Formats(Program):
    def test_are_read_alike(self):
        surface = sphere(1)
        for writer, name in ((vtkSTLWriter(), "s.stl"), (vtkOBJWriter(), "s.obj"),
                             (vtkPLYWriter(), "s.ply")):
            writer.SetInputData(surface)
            writer.SetFileName(str(self.folder / name))
            writer.Write()
        binary = vtkSTLWriter()
        binary.SetFileTypeToBinary()
        binary.SetInputData(surface)
        binary.SetFileName(str(self.folder / "binary.stl"))
        binary.Write()
        lines = ["OFF", "42 80 0"] + [" ".join(map(repr, map(float, p))) for p in points_of(surface)]
        lines += ["3 " + " ".join(map(str, t)) for t in triangles_of(surface)]
        (self.folder / "s.off").write_text("\n".join(lines) + "\n")
        areas = []
        for name in ("s.stl", "binary.stl", "s.obj", "s.ply", "s.off"):
            told = self.run_well("info", self.folder / name)
            self.assertIn("vertices                    42", told, name)
            self.assertIn("sound                       yes", told, name)
            areas.append([line for line in told.splitlines() if line.startswith("area")])
        self.assertTrue(all(area == areas[0] for area in areas))
        model = self.folder / "model.vtp"
        self.run_well("precompute", self.folder / "s.stl", model, "--young", 1e4, "--poisson", 0.3,
                      "--fix-half-space", 0, 0, -0.6, 0, 0, 1)
        self.assertGreater((palpate.array(palpate.read(model), "BoundaryType") == 1).sum(), 2)

    def test_of_quadrilaterals_are_repaired(self):
        path = self.folder / "box.obj"
        surface = quad_cube()
        cells = triangles_of(surface).reshape(-1, 4)
        path.write_text("".join("v %g %g %g\n" % tuple(p) for p in points_of(surface))
                        + "".join("f %d %d %d %d\n" % tuple(c + 1) for c in cells))
        self.run_badly("only triangles are allowed", "refine", path, self.folder / "fine.vtp")
        self.run_well("repair", path, self.folder / "box.vtp")
        self.assertIn("sound                       yes", self.run_well("info", self.folder / "box.vtp"))

    def test_cut_short_or_changed_are_refused_or_read_but_never_crash(self):
        whole = self.model().read_bytes()
        random = np.random.default_rng(11)
        path = self.folder / "damaged.vtp"
        for trial in range(60):
            damaged = bytearray(whole)
            if trial % 2:
                damaged = damaged[:random.integers(1, len(whole))]
            else:
                for at in random.integers(0, min(len(whole), 6000), size=4):
                    damaged[at] = random.integers(0, 256)
            path.write_bytes(damaged)
            process = start("stiffness", path)
            printed, errors = process.communicate()
            self.assertIn(process.returncode, (0, 1), (trial, errors))
            if process.returncode:
                self.assertEqual((printed, errors.count("\n")), ("", 1), errors)

    def test_stl_cut_short_is_refused(self):
        writer = vtkSTLWriter()
        writer.SetFileTypeToBinary()
        writer.SetInputData(sphere(1))
        writer.SetFileName(str(self.folder / "s.stl"))
        writer.Write()
        path = self.folder / "s.stl"
        whole = path.read_bytes()
        for start in (whole[:80], b"solid from a program that begins binary files so".ljust(80)):
            path.write_bytes(start + whole[80:])
            self.run_well("info", path)
            path.write_bytes((start + whole[80:])[:len(whole) // 2])
            self.run_badly("s.stl: the file is cut short", "info", path)


class Failures(Program):
    def test_of_arguments_are_one_line(self):
        self.run_badly("--help", "precompute")
        self.run_badly("there is no command 'frobnicate': choose one of info, repair", "frobnicate")
        self.run_badly("--levels", "refine", KIDNEY, self.folder / "a.vtp", "--levels", "many")
        self.run_badly("--precision", "precompute", KIDNEY, self.folder / "a.vtp", "--precision", "x")

    def test_of_files_are_one_line(self):
        self.run_badly("there is no such file", "info", self.folder / "none.vtp")
        self.run_badly("choose a name that ends so", "refine", KIDNEY, self.folder / "a.stl")
        self.run_badly("cannot be written", "refine", KIDNEY, self.folder / "no" / "a.vtp")
        self.run_badly("is a folder, not a file", "info", self.folder)
        loop = self.folder / "loop.vtp"  # what an unreadable file is to the superuser, too
        loop.symlink_to(loop)
        self.run_badly("loop.vtp: cannot be read: Too many levels", "info", loop)

    def test_of_outputs_are_found_before_the_work(self):
        none, folder = self.folder / "none.vtp", self.folder / "folder.vtp"
        folder.mkdir()
        model = self.model()
        for command, *options in (("refine",), ("repair",), ("precompute",), ("stiffness",),
                                  ("press", "--at", 0, 0, 0, "--force", 0, 0, 1)):
            for output, sentence in (("a.stl", "models are written as .vtp"),
                                     ("no/a.vtp", "there is no folder"), (folder, "it is a folder")):
                self.run_badly(sentence, command, none, self.folder / output, *options)
            if command in ("stiffness", "press"):
                for image, sentence in (("a.jpg", "written as .png"), ("no/a.png", "no folder")):
                    self.run_badly(sentence, command, none, "--image", self.folder / image, *options)
                picture = (none, *options, "--image", self.folder / "a.png")
                for view in ((0, 0, 0), (0, "nan", 1), ("inf", 0, 0)):
                    self.run_badly("--view must be a direction", command, *picture, "--view", *view)
                for ends in ((5, 1), (1, 1), ("nan", 1), (0, "inf")):
                    self.run_badly("--range must be two", command, *picture, "--range", *ends)
        self.assertTrue(model.is_file())

    def test_of_a_full_disk_are_one_line(self):
        with open("/dev/full", "w") as full:
            for arguments in (("info", KIDNEY), ("--help",)):
                process = subprocess.run([PROGRAM, *arguments], stdout=full, stderr=subprocess.PIPE,
                                         text=True)
                self.assertEqual((process.returncode, process.stderr),
                                 (1, "palpate: standard output cannot be written to\n"))
        model = self.model()
        for bytes_allowed, arguments in ((30000, ("--image", self.folder / "a.png")),  # Xvfb's files
                                         (4000, (self.folder / "a.vtp",))):
            self.run_badly("cannot be written", "stiffness", model, *arguments, preexec_fn=lambda:
                           resource.setrlimit(resource.RLIMIT_FSIZE, (bytes_allowed,) * 2),
                           restore_signals=False)  # Python ignores SIGXFSZ

    def test_of_problems_are_one_line(self):
        output = self.folder / "model.vtp"
        self.run_badly("Poisson's ratio", "precompute", KIDNEY, output, "--poisson", 0.7)
        self.run_badly("Young's modulus", "precompute", KIDNEY, output, "--young", -1)
        self.run_badly("tolerance", "precompute", KIDNEY, output, "--integration-tolerance", 2)
        self.run_badly("rigid motion", "precompute", KIDNEY, output, "--fix-sphere", 9, 9, 9, 0.1)
        self.run_badly("palpate precompute", "stiffness", KIDNEY, output)
        model = self.model()
        self.run_badly("--displacement or --force", "press", model, "--at", 0, 0, 0)
        self.run_badly("excludes", "press", model, "--at", 0, 0, 0, "--force", 0, 0, 1,
                       "--displacement", 0, 0, 1)
        self.run_badly("radius", "stiffness", model, "--radius", -1)

    def test_of_pictures_are_one_line_and_leave_no_file(self):
        self.run_badly("cannot be written", "stiffness", self.model(), "--image",
                       self.folder / "no" / "a.png")

    def test_keep_what_was_there_before(self):
        model = self.model()
        before = model.read_bytes()
        self.run_badly("Poisson's ratio", "precompute", KIDNEY, model, "--poisson", 0.7)
        self.assertEqual(model.read_bytes(), before)

    def test_by_interruption_leave_nothing(self):
        surface = self.folder / "surface.vtp"
        self.run_well("refine", KIDNEY, surface, "--levels", 3)
        process = start("precompute", surface, self.folder / "model.vtp")
        time.sleep(0.7)
        process.send_signal(signal.SIGINT)
        printed, errors = process.communicate(timeout=60)
        self.assertEqual((process.returncode, printed), (1, ""))
        self.assertEqual(errors, "palpate: interrupted; nothing was written\n")
        self.assertEqual([p.name for p in self.folder.iterdir()], ["surface.vtp"])


class Terminal(Program):
    def test_shows_a_progress_bar_only_on_a_terminal(self):
        surface = self.folder / "surface.vtp"
        self.run_well("refine", KIDNEY, surface, "--levels", 2)
        master, slave = os.openpty()
        process = subprocess.Popen([PROGRAM, "precompute", surface, self.folder / "model.vtp"],
                                   stdout=subprocess.PIPE, stderr=slave)
        os.close(slave)
        shown = b""
        try:
            while chunk := os.read(master, 4096):
                shown += chunk
        except OSError:  # the terminal's other end was closed
            pass
        process.communicate()
        os.close(master)
        self.assertIn(b"100 %", shown)


if __name__ == "__main__":
    unittest.main()
