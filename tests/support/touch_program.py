# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A case that runs `palpate` on a model of a block, without a display."""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import palpate
from support.surfaces import PROGRAM
from support.touch import block_model, path, write_recording

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
