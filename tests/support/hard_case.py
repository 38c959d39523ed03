# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A case of the catalogue of hard cases, as tests/stability/hard_case.h records it."""

import itertools
import os
import sys
from pathlib import Path

_numbers = itertools.count()


class HardCase:
    """What is expected of a case is asserted and recorded in one call."""

    def __init__(self, test, area, name, danger):
        self.test, self.fields = test, (area, name, danger)

    def expect_at_most(self, quantity, measured, bound):
        """measured <= bound, which no NaN is."""
        self._record(quantity, f"{measured:.2g}", f"≤ {bound:.4g}")
        self.test.assertTrue(measured <= bound, f"{self.fields[1]}: {quantity} is {measured}")

    def expect_count(self, quantity, measured, expected):
        self._record(quantity, str(measured), str(expected))
        self.test.assertEqual(measured, expected, f"{self.fields[1]}: {quantity}")

    def expect_said(self, sentence, words):
        self._record("sentence", sentence or "(none)", f"“{words}”")
        self.test.assertIn(words, sentence)

    def _record(self, quantity, measured, bound):
        folder = os.environ.get("PALPATE_HARD_CASES")
        if folder:
            path = Path(folder) / f"{Path(sys.argv[0]).stem}-{next(_numbers):03d}.tsv"
            path.write_text("\t".join((*self.fields, quantity, measured, bound)) + "\n")
