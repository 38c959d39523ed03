# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that were damaged: each is refused with one sentence, or is read as the whole one is.

Mutants are read in another process, so that a crash or a hang is counted and not the end of the test.
Positions and values are drawn with fixed seeds.
"""

import functools
import os
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import numpy as np
from vtkmodules.vtkIOGeometry import vtkOBJWriter, vtkSTLWriter
from vtkmodules.vtkIOPLY import vtkPLYWriter

import palpate
from palpate.arrays import as_vtk
from support.hard_case import HardCase
from support.surfaces import PROGRAM, copy_of, lower_cap, points_of, sphere, triangles_of

LONGEST = 20  # seconds that one file may take, a hundred times what the whole one does
SEAL = b"\n<!-- CRC-32"

# What becomes of a mutant: the same result, a refusal, another sound result; and what must never be: no
# sentence or no finite result, and the end of the process.
SAME, REFUSED, OTHER, WRONG, CRASHED = b"sro!x"


def model():
    """A model of 42 vertices with six Green's functions, as its file is."""
    surface = sphere(1)
    fixed = lower_cap(surface)
    columns = np.flatnonzero(~fixed)[:6]
    return palpate.precompute(surface, 1e4, 0.3, fixed=fixed, columns=columns)


def same_surface(surface, whole):
    points = points_of(whole)
    return (surface.GetNumberOfPoints() == len(points)
            and np.abs(points_of(surface) - points).max() <= 1e-6
            and surface.GetPolys().GetNumberOfCells() == len(triangles_of(whole))
            and surface.GetNumberOfCells() == len(triangles_of(whole))
            and surface.GetPolys().GetNumberOfConnectivityIds() == triangles_of(whole).size
            and (triangles_of(surface) == triangles_of(whole)).all())


def sentence(error, path):
    """Whether a refusal is one line about the file."""
    said = str(error)
    return "\n" not in said.strip() and (path is None or said.startswith(str(path)))


def judge_surface(path, whole):
    """What becomes of a file that held a sound surface."""
    try:
        surface = palpate.read(path)
    except palpate.Error as error:
        return REFUSED if sentence(error, path) else WRONG
    if same_surface(surface, whole):
        return SAME
    try:
        made = palpate.precompute(surface, 1e4, 0.3, fixed=lower_cap(surface), columns=[0])
    except palpate.Error as error:
        return REFUSED if sentence(error, None) else WRONG
    return OTHER if np.isfinite(palpate.greens_functions(made)).all() else WRONG


def pressed(surface):
    """What a model answers to two constraints."""
    nodes = palpate.greens_function_nodes(surface)[:2]
    solved = palpate.solve(surface, nodes, [(0, 0, 0.01), (0.01, 0, 0)])
    return palpate.array(solved, "Displacement")


def judge_model(path, whole):
    """What becomes of a file that held a model: the same answers, to rounding, or a refusal."""
    try:
        surface = palpate.read(path)
    except palpate.Error as error:
        return REFUSED if sentence(error, path) else WRONG
    try:
        difference = np.abs(pressed(surface) - whole).max()
    except palpate.Error as error:
        return REFUSED if sentence(error, None) else WRONG
    return SAME if difference <= 1e-15 else OTHER


def judged_here(mutants, path, judge, pipe):
    """In the process that may crash: a byte for each mutant."""
    signal.signal(signal.SIGALRM, signal.SIG_DFL)
    for mutant in mutants:
        signal.alarm(LONGEST)
        path.write_bytes(mutant)
        try:
            told = judge(path)
        except BaseException as raised:  # anything but palpate.Error
            print("raised", repr(raised), file=sys.stderr)
            told = WRONG
        os.write(pipe, bytes([told]))


def outcomes(mutants, path, judge):
    """A byte for each mutant, CRASHED where the process died of it or of the alarm."""
    told = b""
    while len(told) < len(mutants):
        reading, writing = os.pipe()
        process = os.fork()
        if process == 0:
            os.close(reading)
            judged_here(mutants[len(told):], path, judge, writing)
            os._exit(0)
        os.close(writing)
        with os.fdopen(reading, "rb") as pipe:
            told += pipe.read()
        os.waitpid(process, 0)
        if len(told) < len(mutants):
            told += bytes([CRASHED])
    return told


def changed(whole, positions, random):
    """The bytes at some positions each made another."""
    mutant = bytearray(whole)
    for at in positions:
        mutant[at] ^= int(random.integers(1, 256))
    return bytes(mutant)


def text_files(folder):
    """A sphere of 42 vertices in every format that is text; the paths."""
    surface = sphere(1)
    for writer, name in ((vtkSTLWriter(), "text.stl"), (vtkPLYWriter(), "text.ply"),
                         (vtkOBJWriter(), "s.obj")):
        if hasattr(writer, "SetFileTypeToASCII"):
            writer.SetFileTypeToASCII()
        writer.SetInputData(surface)
        writer.SetFileName(str(folder / name))
        writer.Write()
    lines = ["OFF", "42 80 0"] + [" ".join(map(repr, map(float, p))) for p in points_of(surface)]
    lines += ["3 " + " ".join(map(str, t)) for t in triangles_of(surface)]
    (folder / "s.off").write_text("\n".join(lines) + "\n")
    kidney = folder / "kidney.vtp"
    kidney.write_bytes(Path(palpate.example("kidney")).read_bytes())
    return [folder / "text.stl", folder / "text.ply", folder / "s.obj", folder / "s.off", kidney]


def binary_files(folder):
    for writer, name in ((vtkSTLWriter(), "binary.stl"), (vtkPLYWriter(), "binary.ply")):
        writer.SetFileTypeToBinary()
        writer.SetInputData(sphere(1))
        writer.SetFileName(str(folder / name))
        writer.Write()
    return [folder / "binary.stl", folder / "binary.ply"]


def header_size(path, whole):
    """Bytes before the first coordinate."""
    if path.suffix == ".ply":
        return whole.index(b"end_header") + 11
    if path.suffix == ".vtp":
        return whole.index(b">", whole.index(b"<Points")) + 1
    if path.suffix == ".obj":
        return whole.index(b"\n")
    return {"text.stl": 40, "binary.stl": 84, "s.off": 12}[path.name]


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.random = np.random.default_rng(7)

    def row(self, name, danger):
        return HardCase(self, "files", name, danger)

    def expect_safe(self, row, told, others=0):
        """None crashed, hung or went wrong, and none gave another result, where that can be known."""
        self.assertGreater(len(told), 50)
        row.expect_count("of them crashed, hung, without a sentence",
                         told.count(CRASHED) + told.count(WRONG), 0)
        if others is not None:
            row.expect_count("of them accepted as something else", told.count(OTHER), others)
        self.assertGreater(told.count(REFUSED), 0)

    def one_byte_changed(self, whole, positions):
        return [changed(whole, [at], self.random) for at in positions]


class Models(Files):
    """A model of 42 vertices with six Green's functions."""

    def setUp(self):
        super().setUp()
        self.path = self.folder / "model.vtp"
        palpate.write(model(), self.path)
        self.whole = self.path.read_bytes()
        self.header = self.whole.index(b"_", self.whole.index(b"<AppendedData"))
        self.judge = functools.partial(judge_model, whole=pressed(palpate.read(self.path)))

    def test_with_every_header_byte_changed(self):
        mutants = self.one_byte_changed(self.whole, range(self.header))
        self.expect_safe(self.row("a model, every byte of its header changed",
                                  "arrays of another size, offsets that lead elsewhere"),
                         outcomes(mutants, self.path, self.judge))

    def test_without_seal_with_header_bytes_changed(self):
        whole = self.whole[:self.whole.rindex(SEAL)]
        mutants = self.one_byte_changed(whole, range(3, self.header, 23))
        self.expect_safe(self.row("a model without Palpate's checksum, every 23rd byte of its header changed",
                                  "VTK's reader trusts what it reads"),
                         outcomes(mutants, self.path, self.judge))

    def test_cut_off_anywhere(self):
        size = len(self.whole)
        mutants = [self.whole[:n] for n in [*range(0, size - 200, 211), *range(size - 200, size)]]
        self.expect_safe(self.row("a model cut off at every 211th byte and all of the last 200",
                                  "Green's functions that end in the middle"),
                         outcomes(mutants, self.path, self.judge))

    def test_with_data_changed(self):
        places = self.random.integers(self.header, len(self.whole), 500)
        mutants = self.one_byte_changed(self.whole, places)
        self.expect_safe(self.row("a model with one of its numbers' bytes changed, 500 times",
                                  "wrong forces that nobody sees"),
                         outcomes(mutants, self.path, self.judge))

    def test_of_impossible_materials(self):
        whole = palpate.read(self.path)
        for name, values, words in (
                ("YoungsModulus", (0, -1, np.inf, np.nan), "Young's modulus must be"),
                ("PoissonRatio", (-1, 0.6, np.nan), "Poisson's ratio must be")):
            said = []
            for value in values:
                spoilt = copy_of(whole)
                spoilt.GetFieldData().AddArray(as_vtk(np.array([float(value)]), name, 1))
                palpate.write(spoilt, self.path)
                with self.assertRaises(palpate.Error) as caught:
                    pressed(palpate.read(self.path))
                said.append(str(caught.exception))
                self.assertIn(words, said[-1])
            shown = ", ".join(f"{v:g}" for v in values)
            self.row(f"a model file whose {name} is {shown}",
                     "forces of the wrong sign, or none").expect_said(said[0], words)


class Surfaces(Files):
    """A sphere of 42 vertices, and the kidney as .vtp."""

    def told_of(self, paths, mutants_of):
        told = b""
        for path in paths:
            whole = path.read_bytes()
            judge = functools.partial(judge_surface, whole=palpate.read(path))
            told += outcomes(mutants_of(path, whole), path, judge)
            path.write_bytes(whole)
            self.assertEqual(judge(path), SAME)
        return told

    def test_with_header_bytes_changed(self):
        def spoilt(path, whole):
            return self.one_byte_changed(whole, range(header_size(path, whole)))
        told = self.told_of(text_files(self.folder) + binary_files(self.folder), spoilt)
        self.expect_safe(
            self.row("STL and PLY, text and binary, OBJ, OFF, VTP: every header byte changed",
                     "counts that no memory holds, readers that crash"), told)

    def test_cut_off_anywhere(self):
        def cut(_, whole):
            size = len(whole)
            return [whole[:n] for n in [*self.random.integers(0, size, 60), *range(size - 40, size)]]
        told = self.told_of(text_files(self.folder) + binary_files(self.folder), cut)
        self.expect_safe(
            self.row("STL and PLY, text and binary, OBJ, OFF, VTP, cut off at 100 places each",
                     "half a body"), told)

    def test_of_text_with_garbage_in_it(self):
        def spoilt(_, whole):
            mutants = []
            for at in self.random.integers(0, len(whole), 120):
                mutant = bytearray(whole)
                mutant[at] = self.random.choice(list(b"?w_\x01\xf0&,;"))
                mutants.append(bytes(mutant))
            return mutants
        told = self.told_of(text_files(self.folder), spoilt)
        self.expect_safe(
            self.row("text STL, PLY, OBJ, OFF, VTP with a character that is no digit at 120 places each",
                     "“0.3w7” read as 0.3"), told)

    def test_of_words_that_are_numbers_in_part(self):
        for line, words in (("v 0 0 0.3w7", "a coordinate in line 2 is not a number"),
                            ("v 0 0", "the vertex in line 2 has not three coordinates"),
                            ("f 1 2 x", "a corner in line 2 is not a number")):
            path = self.folder / "words.obj"
            path.write_text(f"v 0 0 0 # the first\n{line}\nv 0 1 0\nf 1/1 2//2 -1\n")
            with self.assertRaises(palpate.Error) as caught:
                palpate.read(path)
            self.row(f"an OBJ file with a line “{line}”", "numbers that nobody wrote").expect_said(
                str(caught.exception).replace(str(path), "words.obj"), words)

    def test_with_bytes_changed_anywhere(self):
        def spoilt(_, whole):
            count = self.random.integers(1, 5, 60)
            return [changed(whole, self.random.integers(0, len(whole), n), self.random) for n in count]
        told = self.told_of(text_files(self.folder) + binary_files(self.folder), spoilt)
        # No format of these has a checksum: a digit for another is another surface, which is as sound.
        self.expect_safe(
            self.row("STL and PLY, text and binary, OBJ, OFF, VTP: one to four bytes changed, 60 times each",
                     "readers that crash, results that are not finite"), told, others=None)


class Hostile(Files):
    def refused_soon(self, name, content):
        path = self.folder / name
        path.write_bytes(content)
        whole = sphere(1)
        start = time.monotonic()
        told = outcomes([content], path, functools.partial(judge_surface, whole=whole))
        self.assertEqual(told, bytes([REFUSED]), name)
        return time.monotonic() - start

    def test_counts_and_entities_are_refused_soon(self):
        vtp = Path(palpate.example("kidney")).read_bytes()
        ply = (b"ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\n"
               b"property double x\nproperty double y\nproperty double z\nelement face 1\n"
               b"property list uchar int vertex_indices\nend_header\n" + bytes(64))
        count = vtp.index(b'NumberOfPoints="') + 16
        many = vtp[:count] + b"4611686018427387904" + vtp[vtp.index(b'"', count):]
        stl = bytes(80) + struct.pack("<I", 2**32 - 1) + bytes(50)
        seconds = [self.refused_soon("many.stl", stl),
                   self.refused_soon("many.ply", ply),
                   self.refused_soon("many.off", b"OFF\n2000000000 2000000000 0\n0 0 0\n"),
                   self.refused_soon("many.vtp", many)]
        laughs = b"".join(b'<!ENTITY l%d "%s">' % (k + 1, b"&l%d;" % k * 10) for k in range(9))
        root = vtp.index(b"<VTKFile")
        bomb = (b'<?xml version="1.0"?><!DOCTYPE VTKFile [<!ENTITY l0 "0 ">' + laughs + b"]>"
                + vtp[root:].replace(b"</DataArray>", b"&l9;</DataArray>", 1))
        seconds.append(self.refused_soon("bomb.vtp", bomb))
        self.row("STL, PLY, OFF, VTP of 2·10⁹ … 4·10¹⁸ vertices in a few bytes; entities of 10⁹ numbers",
                 "all memory, all time").expect_at_most("longest time to refuse one, s", max(seconds),
                                                        LONGEST)

    def test_nothing_outside_the_file_is_read(self):
        vtp = Path(palpate.example("kidney")).read_bytes()
        root, points = vtp.index(b"<VTKFile"), vtp.index(b"<DataArray", vtp.index(b"<Points"))
        start = vtp.index(b">", points) + 1
        end = vtp.index(b"</DataArray>", start)
        (self.folder / "points.txt").write_bytes(vtp[start:end])
        outside = (b'<?xml version="1.0"?><!DOCTYPE VTKFile [<!ENTITY points SYSTEM "%s">]>'
                   % str(self.folder / "points.txt").encode()
                   + vtp[root:start] + b"&points;" + vtp[end:])
        path = self.folder / "outside.vtp"
        path.write_bytes(outside)
        kidney = palpate.read(palpate.example("kidney"))
        told = outcomes([outside], path, functools.partial(judge_surface, whole=kidney))
        self.row("a VTP file whose points are in another file, by an XML entity",
                 "what is on the disk ends up in a model").expect_count("refused", told.count(REFUSED), 1)

    def test_the_program_ends_with_a_sentence(self):
        model_path, surface = self.folder / "model.vtp", text_files(self.folder)[2]
        palpate.write(model(), model_path)
        bad = 0
        for path, commands in ((model_path, ("info", "stiffness")), (surface, ("info", "repair"))):
            whole = path.read_bytes()
            for trial in range(10):
                if trial % 2:
                    path.write_bytes(whole[:self.random.integers(1, len(whole))])
                else:
                    places = self.random.integers(0, len(whole), 4)
                    path.write_bytes(changed(whole, places, self.random))
                for command in commands:
                    output = [self.folder / "out.vtp"] if command == "repair" else []
                    done = subprocess.run([PROGRAM, command, path, *output], capture_output=True,
                                          timeout=LONGEST)
                    said = done.stderr.decode()
                    lines = [line for line in said.splitlines() if "warning" not in line]
                    fine = (done.returncode == 0 and not lines or done.returncode == 1 and not done.stdout
                            and len(lines) == 1 and said.startswith("palpate: "))
                    bad += not fine
        row = self.row("`palpate info`, `stiffness`, `repair` of damaged files, 40 times",
                       "a crash instead of a sentence")
        row.expect_count("of them without exit code 0, or 1 and one line", bad, 0)


if __name__ == "__main__":
    unittest.main()
